//! The layout of a specification: how deep lines are, and which spaces are between their words. Comments stay, and so
//! do the order of keys, the quotes, and the choice between braces and lines.
//!
//! The text is laid out line by line, without knowing what it means: what a line continues is kept apart from what begins
//! something. Afterwards both texts are read, and only if they say the same is the new one given.

mod line;

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::source::{FileId, SourceFile, SourceMap, Span};
use crate::yaml::{self, Node, NodeKind};
use line::{Line, Open, line};

/// Spaces by which a line is further in than the one that it belongs to.
const STEP: usize = 2;
/// A mark that some editors put at the beginning of a file.
const MARK: char = '\u{feff}';
/// The fewest spaces between something and a comment after it.
const BEFORE_COMMENT: usize = 2;

/// A specification, a part or a library as it is laid out.
///
/// ```
/// let text = "objects:\n    0x2000:   {name: level,type: unsigned8}   # of the tank\n";
/// let laid_out = od_spec::layout("tank.od.yaml", text.into()).expect("it is YAML");
/// assert_eq!(laid_out, "objects:\n  0x2000: {name: level, type: unsigned8}      # of the tank\n");
/// ```
///
/// # Errors
/// The text is no YAML, or a kind of it that specifications do not have.
pub fn layout(name: &str, text: String) -> Result<String, (Diagnostics, Box<SourceMap>)> {
    let mut sources = Box::new(SourceMap::new());
    let mut diagnostics = Diagnostics::new();
    let file = sources.add(name, text);
    let Some(before) =
        yaml::parse(file, sources.file(file), &mut diagnostics).filter(|_| !diagnostics.has_errors())
    else {
        return Err((diagnostics, sources));
    };
    match laid_out(file, sources.file(file)) {
        Ok(text) => {
            let mut again = SourceMap::new();
            let id = again.add(name, text.as_str());
            let after = yaml::parse(id, again.file(id), &mut Diagnostics::new());
            if after.is_some_and(|after| is_same(&before, &after)) {
                return Ok(text);
            }
            let span = Span { file, start: 0, end: 0 };
            diagnostics.push(
                Diagnostic::new(
                    codes::BAD_NOTATION,
                    span,
                    "this text would say something else in another layout",
                )
                .help("report it, with the file; it was left as it is"),
            );
        }
        Err(diagnostic) => diagnostics.push(*diagnostic),
    }
    Err((diagnostics, sources))
}

/// Whether two trees say the same.
fn is_same(one: &Node, other: &Node) -> bool {
    match (&one.kind, &other.kind) {
        (NodeKind::Map(one), NodeKind::Map(other)) => {
            one.len() == other.len()
                && one.iter().zip(other).all(|((key, value), (other_key, other_value))| {
                    key.value == other_key.value && is_same(value, other_value)
                })
        }
        (NodeKind::List(one), NodeKind::List(other)) => {
            one.len() == other.len() && one.iter().zip(other).all(|(one, other)| is_same(one, other))
        }
        (one, other) => one == other,
    }
}

/// What is at one depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Map,
    List,
}

/// Lines that are equally deep.
#[derive(Debug, Clone, Copy)]
struct Level {
    kind: Kind,
    /// How deep they were.
    was: usize,
    /// How deep they are.
    is: usize,
}

/// What the next line may go on with.
#[derive(Debug, Clone, Copy)]
enum Continued {
    /// Nothing is open.
    No,
    /// Braces or a quoted text: every line, until they are closed.
    Open(Open),
    /// A text without quotes: lines that are deeper than its key or dash.
    Plain,
    /// A block of text: lines that are deeper than its key or dash. `shift` is known from its first line.
    Block { shift: Option<isize>, end: BlockEnd },
}

/// A comment in a line of its own.
#[derive(Debug, Clone, Copy)]
struct Comment<'a> {
    depth: usize,
    text: &'a str,
    is_behind_blank: bool,
}

/// What blank lines after a block of text are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum BlockEnd {
    /// No part of it.
    Dropped,
    /// Part of it (`|+`).
    Kept,
}

struct Layout<'a> {
    file: FileId,
    out: String,
    levels: Vec<Level>,
    continued: Continued,
    /// How deep the line that the next one may continue was, and is.
    base: (usize, usize),
    /// The least depth of what goes on with it.
    inner: usize,
    /// Where the text begins, after a mark of its encoding.
    begin: usize,
    /// Blank lines since the last one.
    blank: usize,
    /// Comments that belong to what comes.
    comments: Vec<Comment<'a>>,
}

fn laid_out(file: FileId, source: &SourceFile) -> Result<String, Box<Diagnostic>> {
    let mut layout = Layout {
        file,
        out: String::new(),
        levels: Vec::new(),
        continued: Continued::No,
        base: (0, 0),
        inner: 0,
        begin: 0,
        blank: 0,
        comments: Vec::new(),
    };
    // A mark at the beginning is not part of the first line.
    let mut at = if source.text().starts_with(MARK) { MARK.len_utf8() } else { 0 };
    layout.out.push_str(&source.text()[..at]);
    layout.begin = layout.out.len();
    for whole in source.text()[at..].split_inclusive('\n') {
        let text = whole.trim_end_matches(['\n', '\r']);
        layout.take(at, text)?;
        at += whole.len();
    }
    layout.end_block();
    let comments = layout.placed_comments();
    layout.write_comments(comments, None);
    Ok(layout.out)
}

impl<'a> Layout<'a> {
    fn take(&mut self, at: usize, text: &'a str) -> Result<(), Box<Diagnostic>> {
        let content = text.trim_start_matches(' ');
        let depth = text.len() - content.len();
        if content.trim().is_empty() {
            // Spaces that are deeper than a block of text are part of it.
            match self.continued {
                Continued::Block { shift: Some(shift), end } if self.is_in_block(depth, shift) => {
                    self.block_line(depth, content, Some(shift), end);
                }
                Continued::No | Continued::Open(_) | Continued::Plain | Continued::Block { .. } => {
                    self.blank += 1;
                }
            }
            return Ok(());
        }
        match self.continued {
            Continued::Open(open) => return self.go_on(at, depth, content, open),
            Continued::Block { shift, end } if depth >= self.inner => {
                self.block_line(depth, content, shift, end);
                return Ok(());
            }
            Continued::Plain if depth >= self.inner && !content.starts_with('#') => {
                let open = Open { plain: true, ..Open::default() };
                return self.go_on(at, depth, content, open);
            }
            Continued::No | Continued::Plain | Continued::Block { .. } => {}
        }
        self.end_block();
        if content.starts_with('#') {
            self.remember_comment(depth, content.trim_end());
            return Ok(());
        }
        if content.starts_with('\t') {
            return Err(self.refused(at, "a tab is where spaces make the structure"));
        }
        self.begin(at, depth, content)
    }

    fn refused(&self, at: usize, why: &str) -> Box<Diagnostic> {
        let place = u32::try_from(at).unwrap_or(u32::MAX);
        let span = Span { file: self.file, start: place, end: place };
        Box::new(
            Diagnostic::new(codes::BAD_NOTATION, span, format!("this line cannot be laid out: {why}")).help(
                "write it as specifications are written, without tags, directives and keys that are not texts",
            ),
        )
    }

    fn line(&self, at: usize, content: &'a str, open: Open) -> Result<Line<'a>, Box<Diagnostic>> {
        line(content, open)
            .ok_or_else(|| self.refused(at, "it has a tag, a directive or a key that is not a text"))
    }

    /// A line that begins something.
    fn begin(&mut self, at: usize, depth: usize, content: &'a str) -> Result<(), Box<Diagnostic>> {
        if content.trim_end() == "---" || depth == 0 && content.starts_with('%') {
            let comments = self.placed_comments();
            self.write_comments(comments, None);
            self.blank_line();
            self.out.push_str(content.trim_end());
            self.out.push('\n');
            return Ok(());
        }
        let is_item = |text: &str| text == "-" || text.starts_with("- ");
        let kind = if is_item(content) { Kind::List } else { Kind::Map };
        let comments = self.placed_comments();
        while let Some(level) = self.levels.last()
            && (level.was > depth || level.was == depth && level.kind == Kind::List && kind == Kind::Map)
        {
            self.levels.pop();
        }
        let is = match self.levels.last() {
            Some(level) if level.was == depth && level.kind == kind => level.is,
            // A list may be as deep as the key that it belongs to.
            Some(level) => {
                let is = level.is + STEP;
                self.levels.push(Level { kind, was: depth, is });
                is
            }
            None => {
                self.levels.push(Level { kind, was: depth, is: 0 });
                0
            }
        };
        self.write_comments(comments, Some((depth, is)));
        let (mut was, mut now, mut rest) = (depth, is, content);
        // A text in lines of its own goes on as deep as it begins.
        let mut inner = self.levels.iter().rev().nth(1).map_or(0, |level| level.was + 1);
        while is_item(rest) {
            let behind = rest[1..].trim_start_matches(' ');
            if behind.is_empty() || behind.starts_with('#') {
                break;
            }
            inner = was + 1;
            was += rest.len() - behind.len();
            now += STEP;
            rest = behind;
            let kind = if is_item(rest) { Kind::List } else { Kind::Map };
            self.levels.push(Level { kind, was, is: now });
        }
        let line = self.line(at, content, Open::default())?;
        // What continues a value is deeper than its key; with an item, deeper than its dash.
        self.inner = if line.has_key { was + 1 } else { inner };
        // What continues a text that has no key is where the text began.
        let step = if line.has_key { 0 } else { STEP };
        self.base = (was.saturating_sub(step), now.saturating_sub(step));
        self.blank_line();
        self.write(is, &line, depth);
        self.continued = after(&line);
        Ok(())
    }

    /// A line that goes on with braces or a text.
    fn go_on(
        &mut self,
        at: usize,
        depth: usize,
        content: &'a str,
        open: Open,
    ) -> Result<(), Box<Diagnostic>> {
        let line = self.line(at, content, open)?;
        // Blank lines in a text are part of it.
        if open.quote.is_some() || open.plain {
            self.out.extend(std::iter::repeat_n('\n', self.blank));
            self.blank = 0;
        } else {
            self.blank_line();
        }
        let (was, now) = self.base;
        let closes = open.quote.is_none() && line.text.starts_with(['}', ']']);
        let least = if closes { now } else { now + STEP };
        let is = if open.quote.is_some() || open.plain {
            now + STEP
        } else {
            (now + depth).saturating_sub(was).max(least)
        };
        self.write(is, &line, depth);
        self.continued = after(&line);
        Ok(())
    }

    /// A line of a block of text, all of which move by the same number of spaces.
    fn block_line(&mut self, depth: usize, content: &str, shift: Option<isize>, end: BlockEnd) {
        let shift = shift.unwrap_or_else(|| (self.base.1 + STEP).cast_signed() - depth.cast_signed());
        self.out.extend(std::iter::repeat_n('\n', self.blank));
        self.blank = 0;
        let is = depth.saturating_add_signed(shift);
        self.out.extend(std::iter::repeat_n(' ', is));
        self.out.push_str(content);
        self.out.push('\n');
        self.continued = Continued::Block { shift: Some(shift), end };
    }

    /// Whether a line of spaces is longer than the indentation of a block of text.
    fn is_in_block(&self, depth: usize, shift: isize) -> bool {
        depth.saturating_add_signed(shift) > self.base.1 + STEP
    }

    /// What comes does not go on with the line before.
    fn end_block(&mut self) {
        if let Continued::Block { end: BlockEnd::Kept, .. } = self.continued {
            self.out.extend(std::iter::repeat_n('\n', self.blank));
            self.blank = 0;
        }
        self.continued = Continued::No;
    }

    fn remember_comment(&mut self, depth: usize, comment: &'a str) {
        let is_behind_blank = self.blank > 0;
        self.blank = 0;
        self.comments.push(Comment { depth, text: comment, is_behind_blank });
    }

    /// The comments that were remembered, as deep as what they were with.
    fn placed_comments(&mut self) -> Vec<(Comment<'a>, usize)> {
        let levels = &self.levels;
        let place = |comment: Comment<'a>| {
            let equal = levels.iter().find(|level| level.was == comment.depth);
            let level = equal.or_else(|| levels.iter().rev().find(|level| level.was < comment.depth));
            (comment, level.map_or(comment.depth, |level| level.is))
        };
        self.comments.drain(..).map(place).collect()
    }

    /// Writes the comments in front of a line: as deep as it, but where they were deeper.
    fn write_comments(&mut self, comments: Vec<(Comment<'a>, usize)>, next: Option<(usize, usize)>) {
        let blank = std::mem::take(&mut self.blank);
        for (comment, placed) in comments {
            self.blank = usize::from(comment.is_behind_blank);
            self.blank_line();
            let is = match next {
                Some((was, is)) if comment.depth <= was => is,
                Some((_, is)) => placed.max(is),
                None => placed,
            };
            self.out.extend(std::iter::repeat_n(' ', is));
            self.out.push_str(comment.text);
            self.out.push('\n');
        }
        self.blank = blank;
    }

    /// At most one blank line, and none at the beginning.
    fn blank_line(&mut self) {
        if self.blank > 0 && self.out.len() > self.begin && !self.out.ends_with("\n\n") {
            self.out.push('\n');
        }
        self.blank = 0;
    }

    /// Writes a line; its comment stays in its column if there is room.
    fn write(&mut self, is: usize, line: &Line<'_>, depth: usize) {
        let start = self.out.len();
        self.out.extend(std::iter::repeat_n(' ', is));
        self.out.push_str(&line.text);
        if let Some((at, comment)) = line.comment {
            let width = self.out[start..].chars().count();
            let least = if line.text.is_empty() { is } else { width + BEFORE_COMMENT };
            let column = if line.text.is_empty() { is } else { depth + at };
            self.out.extend(std::iter::repeat_n(' ', column.max(least) - width));
            self.out.push_str(comment);
        }
        self.out.push('\n');
    }
}

/// What may go on with a line.
fn after(line: &Line<'_>) -> Continued {
    if line.open.depth > 0 || line.open.quote.is_some() {
        Continued::Open(Open { plain: false, ..line.open })
    } else if line.begins_block {
        let header = line.text.rsplit(' ').next().unwrap_or_default();
        let end = if header.contains('+') { BlockEnd::Kept } else { BlockEnd::Dropped };
        Continued::Block { shift: None, end }
    } else if line.open.plain && line.comment.is_none() {
        Continued::Plain
    } else {
        Continued::No
    }
}
