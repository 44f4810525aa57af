//! Source texts and places in them.
//!
//! A [`Span`] is a byte range in one file of a [`SourceMap`]; every value of a specification keeps
//! its span until the resolved model is built, so that each message can show the line it is about.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::Deref;
use std::sync::OnceLock;

use crate::encoding::Encoding;
use crate::visible::visible;

/// Identifies one file of a [`SourceMap`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId {
    number: u32,
    /// Number of the file that it is a part of, or its own.
    whole: u32,
}

impl FileId {
    /// Whether two files are one specification: one file, a file and a part of it, or two of its parts.
    pub const fn is_one_with(self, file: FileId) -> bool {
        self.whole == file.whole
    }
}

/// A byte range in a source file; `start..end`, both on character boundaries.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The span from the start of `self` to the end of `other`, both in the same file.
    pub fn to(self, other: Span) -> Span {
        Span { end: other.end.max(self.end), ..self }
    }

    /// Whether another span lies within this one.
    pub fn contains(self, other: Span) -> bool {
        self.file == other.file && self.start <= other.start && other.end <= self.end
    }

    /// A part of this span, given in bytes relative to its start.
    pub fn part(self, start: usize, end: usize) -> Span {
        let at = |offset: usize| {
            self.start.saturating_add(u32::try_from(offset).unwrap_or(u32::MAX)).min(self.end)
        };
        Span { file: self.file, start: at(start), end: at(end) }
    }
}

/// A value with the place it was read from. Comparison and hashing ignore the place.
#[derive(Debug, Clone, Copy)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Where it is written.
    pub span: Span,
}

impl<T> Spanned<T> {
    /// Attaches a place to a value.
    pub const fn new(value: T, span: Span) -> Self {
        Self { value, span }
    }

    /// Replaces the value and keeps the place.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Spanned<U> {
        Spanned { value: f(self.value), span: self.span }
    }
}

impl<T> Deref for Spanned<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T: PartialEq> PartialEq for Spanned<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}
impl<T: Eq> Eq for Spanned<T> {}
impl<T: Hash> Hash for Spanned<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.value.hash(state);
    }
}

/// Line and column, both counted from 1; the column counts characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LineCol {
    /// Line number.
    pub line: usize,
    /// Character number in the line.
    pub column: usize,
}

impl fmt::Display for LineCol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}

/// One source text.
#[derive(Debug, Clone)]
pub struct SourceFile {
    id: FileId,
    name: String,
    text: String,
    encoding: Encoding,
    /// Where lines begin; only who wants to know a line pays for it.
    line_starts: OnceLock<Vec<u32>>,
    /// How many characters are before each block of bytes; for columns in long lines.
    characters: OnceLock<Vec<usize>>,
}

/// Bytes of a block whose characters are counted together.
const BLOCK: usize = 1024;

impl SourceFile {
    /// The name shown in messages, as the user gave it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How the text was stored.
    pub const fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The whole text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Line and column of a byte offset.
    pub fn line_col(&self, offset: u32) -> LineCol {
        let line = self.line_index(offset);
        let start = self.line_starts()[line] as usize;
        let end = (offset as usize).clamp(start, self.text.len());
        let characters = if end - start <= BLOCK {
            characters(&self.text.as_bytes()[start..end])
        } else {
            self.characters_before(end) - self.characters_before(start)
        };
        LineCol { line: line + 1, column: characters + 1 }
    }

    /// The number of characters before a byte.
    fn characters_before(&self, at: usize) -> usize {
        let bytes = self.text.as_bytes();
        let blocks = self.characters.get_or_init(|| {
            let counts = bytes.chunks(BLOCK).scan(0, |before, block| {
                let count = *before;
                *before += characters(block);
                Some(count)
            });
            // A text may end with a block.
            counts.chain([characters(bytes)]).collect()
        });
        let block = at / BLOCK;
        blocks.get(block).map_or(0, |before| before + characters(&bytes[block * BLOCK..at]))
    }

    fn line_starts(&self) -> &[u32] {
        self.line_starts.get_or_init(|| {
            // Sources are smaller than 4 GiB.
            let starts = line_breaks(&self.text).map(|at| u32::try_from(at).unwrap_or(u32::MAX));
            // A file of nothing but line breaks has as many lines as bytes: a list that grows would take three times as much.
            let mut list = Vec::with_capacity(1 + line_breaks(&self.text).count());
            list.extend(std::iter::once(0).chain(starts));
            list
        })
    }

    /// Number of the line (from 0) that holds a byte offset.
    pub fn line_index(&self, offset: u32) -> usize {
        self.line_starts().partition_point(|start| *start <= offset).saturating_sub(1)
    }

    /// Byte range of the lines `first..=last` (from 0), without the final line break.
    pub(crate) fn lines(&self, first: usize, last: usize) -> (usize, usize) {
        let start = self.line_starts()[first] as usize;
        let end = self.line_starts().get(last + 1).map_or(self.text.len(), |next| *next as usize);
        (start, start + self.text[start..end].trim_end_matches(['\n', '\r']).len())
    }
}

/// The encoding of a text that was read as UTF-8.
fn encoding_of(text: &str) -> Encoding {
    if text.is_ascii() { Encoding::Ascii } else { Encoding::Utf8 }
}

/// All source texts of one compilation.
#[derive(Debug, Clone, Default)]
pub struct SourceMap {
    files: Vec<SourceFile>,
}

impl SourceMap {
    /// An empty map.
    pub const fn new() -> Self {
        Self { files: Vec::new() }
    }

    /// Adds a text under the name that messages show.
    ///
    /// # Panics
    /// If more than 2³² texts are added or a text is 4 GiB or longer; readers refuse such files long before.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> FileId {
        let text = text.into();
        let encoding = encoding_of(&text);
        self.add_decoded(name, text, encoding)
    }

    /// Adds a text that was stored in an encoding.
    ///
    /// # Panics
    /// As [`add`](Self::add).
    pub fn add_decoded(&mut self, name: impl Into<String>, text: String, encoding: Encoding) -> FileId {
        let number = self.next();
        self.push(FileId { number, whole: number }, name.into(), text, encoding)
    }

    /// Adds the text of a part of the specification in `whole`.
    ///
    /// # Panics
    /// As [`add`](Self::add).
    pub fn add_part(&mut self, name: impl Into<String>, text: String, whole: FileId) -> FileId {
        let id = FileId { number: self.next(), whole: whole.whole };
        let encoding = encoding_of(&text);
        self.push(id, name.into(), text, encoding)
    }

    #[expect(clippy::expect_used, reason = "a limit that loaders enforce far below")]
    fn next(&self) -> u32 {
        u32::try_from(self.files.len()).expect("fewer than 2^32 files")
    }

    fn push(&mut self, id: FileId, name: String, text: String, encoding: Encoding) -> FileId {
        assert!(u32::try_from(text.len()).is_ok(), "source texts are smaller than 4 GiB");
        let (line_starts, characters) = (OnceLock::new(), OnceLock::new());
        self.files.push(SourceFile { id, name, text, encoding, line_starts, characters });
        id
    }

    /// A file of this map.
    pub fn file(&self, id: FileId) -> &SourceFile {
        &self.files[id.number as usize]
    }

    /// All files, in the order they were added.
    pub fn files(&self) -> impl Iterator<Item = (FileId, &SourceFile)> {
        self.files.iter().map(|file| (file.id, file))
    }

    /// The span of a whole file.
    pub fn whole(&self, id: FileId) -> Span {
        Span { file: id, start: 0, end: u32::try_from(self.file(id).text.len()).unwrap_or(u32::MAX) }
    }

    /// The text that a span covers.
    pub fn text(&self, span: Span) -> &str {
        self.file(span.file).text.get(span.start as usize..span.end as usize).unwrap_or_default()
    }

    /// `name:line:column` of a span's start.
    pub fn place(&self, span: Span) -> String {
        let file = self.file(span.file);
        format!("{}:{}", visible(&file.name), file.line_col(span.start))
    }
}

/// The characters that begin in some bytes of a text.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| !matches!(byte, 0x80..=0xBF)).count()
}

/// Where lines begin after a line break: a line feed, or a carriage return without one.
fn line_breaks(text: &str) -> impl Iterator<Item = usize> {
    let bytes = text.as_bytes();
    let ends_line = |at: &usize| bytes[*at] == b'\n' || bytes.get(at + 1) != Some(&b'\n');
    memchr::memchr2_iter(b'\n', b'\r', bytes).filter(ends_line).map(|at| at + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_long_lines_are_those_of_short_ones() {
        let text = format!("ab\n{}", "größe €𝄞".repeat(500));
        let mut map = SourceMap::new();
        let id = map.add("a", text.clone());
        for (column, (at, _)) in text[3..].char_indices().enumerate() {
            let place = map.file(id).line_col(u32::try_from(at + 3).unwrap());
            assert_eq!(place, LineCol { line: 2, column: column + 1 });
        }
        let whole = text.chars().count() - 3;
        assert_eq!(map.file(id).line_col(u32::MAX).column, whole + 1);
        let exact = map.add("b", "x".repeat(4 * BLOCK));
        assert_eq!(map.file(exact).line_col(4 * 1024).column, 4 * BLOCK + 1);
    }

    #[test]
    fn lines_and_columns_count_characters_from_one() {
        let mut map = SourceMap::new();
        let id = map.add("a", "é: 1\r\nb");
        let file = map.file(id);
        assert_eq!(file.line_col(0), LineCol { line: 1, column: 1 });
        assert_eq!(file.line_col(2), LineCol { line: 1, column: 2 });
        assert_eq!(file.line_col(7), LineCol { line: 2, column: 1 });
        assert_eq!(file.line_col(8), LineCol { line: 2, column: 2 });
        assert_eq!(file.lines(0, 0), (0, 5));
        let id = map.add("old", "a\rb\r\n\rc");
        let lines: Vec<usize> = (0..7).map(|at| map.file(id).line_col(at).line).collect();
        assert_eq!(lines, [1, 1, 2, 2, 2, 3, 4]);
    }
}
