//! The tree of a text that comes with the compiler, packed into bytes: unpacking takes a small part of the work of parsing.
//!
//! Bytes that belong to another text are noticed, so that a text whose bytes were not made again is only slower to read.
//!
//! First comes a digest of the text, eight bytes. Then each node in the order of the text: its [`Kind`], how far its place
//! begins after the beginning of the node before it, and how long the place is; then
//!
//! - a scalar whose text is not the one at its place: the text's length and bytes,
//! - a list: how many items, and the items,
//! - a map: how many entries, and each key, as a scalar, before its value.
//!
//! Numbers have seven bits in each byte, the low ones first; the eighth bit says that more follow. A distance may be
//! negative, so that its sign is the lowest bit.

use super::{Node, NodeKind};
use crate::source::{FileId, Span, Spanned};

/// What a node is, and where the text of a scalar is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Null,
    /// Written without quotes, as its place has it.
    Plain,
    /// What is between the quotes of its place.
    Quoted,
    /// Written without quotes, in another form than its place has.
    PlainApart,
    /// Written in quotes, in another form than its place has, or as a block.
    QuotedApart,
    List,
    Map,
}

impl Kind {
    const ALL: [Kind; 7] =
        [Kind::Null, Kind::Plain, Kind::Quoted, Kind::PlainApart, Kind::QuotedApart, Kind::List, Kind::Map];
}

/// The tree of a text as bytes; `None` if something in the text is broken.
pub fn pack(text: &str, tree: &Node) -> Option<Vec<u8>> {
    let mut packer = Packer { text, packed: digest(text).to_le_bytes().to_vec(), at: 0 };
    packer.node(tree)?;
    Some(packer.packed)
}

/// The tree of a text; `None` if the bytes are not those of this text.
pub fn unpack(file: FileId, text: &str, packed: &[u8]) -> Option<Node> {
    let (of, rest) = packed.split_first_chunk()?;
    (u64::from_le_bytes(*of) == digest(text)).then_some(())?;
    let mut unpacker = Unpacker { file, text, rest, at: 0 };
    let tree = unpacker.node()?;
    unpacker.rest.is_empty().then_some(tree)
}

/// What two texts that differ hardly have in common (FNV-1a, over eight bytes at once).
fn digest(text: &str) -> u64 {
    let step = |digest: u64, part: u64| (digest ^ part).wrapping_mul(0x0000_0100_0000_01B3);
    let (parts, rest) = text.as_bytes().as_chunks();
    let digest = parts.iter().fold(text.len() as u64, |digest, part| step(digest, u64::from_le_bytes(*part)));
    rest.iter().fold(digest, |digest, byte| step(digest, u64::from(*byte)))
}

struct Packer<'a> {
    text: &'a str,
    packed: Vec<u8>,
    at: u32,
}

impl Packer<'_> {
    fn node(&mut self, node: &Node) -> Option<()> {
        match &node.kind {
            NodeKind::Null => self.head(Kind::Null, node.span),
            NodeKind::Scalar { text, plain } => self.scalar(text, *plain, node.span)?,
            NodeKind::List(items) => {
                self.head(Kind::List, node.span);
                self.number(items.len() as u64);
                for item in items {
                    self.node(item)?;
                }
            }
            NodeKind::Map(entries) => {
                self.head(Kind::Map, node.span);
                self.number(entries.len() as u64);
                for (key, value) in entries {
                    self.scalar(&key.value, true, key.span)?;
                    self.node(value)?;
                }
            }
            NodeKind::Broken => return None,
        }
        Some(())
    }

    fn scalar(&mut self, text: &str, plain: bool, span: Span) -> Option<()> {
        let written = self.text.get(span.start as usize..span.end as usize)?;
        let kind = match plain {
            true if written == text => Kind::Plain,
            true => Kind::PlainApart,
            false if unquoted(written) == Some(text) => Kind::Quoted,
            false => Kind::QuotedApart,
        };
        self.head(kind, span);
        if matches!(kind, Kind::PlainApart | Kind::QuotedApart) {
            self.number(text.len() as u64);
            self.packed.extend(text.bytes());
        }
        Some(())
    }

    fn head(&mut self, kind: Kind, span: Span) {
        let distance = i64::from(span.start) - i64::from(self.at);
        self.packed.push(kind as u8);
        self.number(distance.unsigned_abs() << 1 | u64::from(distance < 0));
        self.number(u64::from(span.end - span.start));
        self.at = span.start;
    }

    fn number(&mut self, mut number: u64) {
        loop {
            let [low, ..] = number.to_le_bytes();
            number >>= 7;
            if number == 0 {
                self.packed.push(low);
                return;
            }
            self.packed.push(low | 0x80);
        }
    }
}

/// What is between the quotes of a scalar.
fn unquoted(written: &str) -> Option<&str> {
    written.get(1..written.len().checked_sub(1)?)
}

struct Unpacker<'a> {
    file: FileId,
    text: &'a str,
    rest: &'a [u8],
    at: u32,
}

impl<'a> Unpacker<'a> {
    fn node(&mut self) -> Option<Node> {
        let (kind, span) = self.head()?;
        let kind = match kind {
            Kind::Null => NodeKind::Null,
            Kind::Plain | Kind::PlainApart => {
                NodeKind::Scalar { text: self.scalar(kind, span)?.to_owned(), plain: true }
            }
            Kind::Quoted | Kind::QuotedApart => {
                NodeKind::Scalar { text: self.scalar(kind, span)?.to_owned(), plain: false }
            }
            Kind::List => NodeKind::List(self.several(Self::node)?),
            Kind::Map => NodeKind::Map(self.several(Self::entry)?),
        };
        Some(Node { span, kind })
    }

    /// A number, and so many items.
    fn several<T>(&mut self, item: impl Fn(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let count = usize::try_from(self.number()?).ok()?;
        // Each takes more than one byte, so that no number of broken bytes asks for more memory than they have.
        let mut items = Vec::with_capacity(count.min(self.rest.len()));
        for _ in 0..count {
            items.push(item(self)?);
        }
        Some(items)
    }

    fn entry(&mut self) -> Option<(Spanned<String>, Node)> {
        let (kind, span) = self.head()?;
        let key = Spanned::new(self.scalar(kind, span)?.to_owned(), span);
        Some((key, self.node()?))
    }

    fn scalar(&mut self, kind: Kind, span: Span) -> Option<&'a str> {
        let written = self.text.get(span.start as usize..span.end as usize)?;
        match kind {
            Kind::Plain => Some(written),
            Kind::Quoted => unquoted(written),
            Kind::PlainApart | Kind::QuotedApart => {
                let length = usize::try_from(self.number()?).ok()?;
                let (text, rest) = self.rest.split_at_checked(length)?;
                self.rest = rest;
                std::str::from_utf8(text).ok()
            }
            Kind::Null | Kind::List | Kind::Map => None,
        }
    }

    fn head(&mut self) -> Option<(Kind, Span)> {
        let kind = *Kind::ALL.get(usize::from(self.byte()?))?;
        let (distance, length) = (self.number()?, self.number()?);
        let magnitude = u32::try_from(distance >> 1).ok()?;
        let start =
            if distance & 1 == 0 { self.at.checked_add(magnitude) } else { self.at.checked_sub(magnitude) }?;
        self.at = start;
        Some((kind, Span { file: self.file, start, end: start.checked_add(u32::try_from(length).ok()?)? }))
    }

    fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(*first)
    }

    fn number(&mut self) -> Option<u64> {
        let mut number = 0;
        for shift in (0..u64::BITS).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 0x7F) << shift;
            if byte < 0x80 {
                return Some(number);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Diagnostics;
    use crate::source::SourceMap;
    use crate::yaml::parse;

    const TEXT: &str =
        "a: 1\n'b c': \"d\\te\"\nf: [x, 'y', ~, {g: äöü}]\nh: two\n  lines\ni: &k |\n  block\n\nj: *k\n";

    fn tree(text: &str) -> (FileId, Node) {
        let mut sources = SourceMap::new();
        let file = sources.add("a", text);
        (file, parse(file, sources.file(file), &mut Diagnostics::new()).unwrap())
    }

    #[test]
    fn a_tree_is_unpacked_as_it_was_parsed() {
        let (file, tree) = tree(TEXT);
        let packed = pack(TEXT, &tree).unwrap();
        assert_eq!(unpack(file, TEXT, &packed), Some(tree));
    }

    #[test]
    fn bytes_of_another_text_are_noticed() {
        let packed = pack(TEXT, &tree(TEXT).1).unwrap();
        let other = TEXT.replace("a: 1", "a: 2");
        assert_eq!(unpack(tree(&other).0, &other, &packed), None);
    }

    #[test]
    fn broken_bytes_give_nothing() {
        let (file, tree) = tree(TEXT);
        let packed = pack(TEXT, &tree).unwrap();
        for end in 0..packed.len() {
            assert_eq!(unpack(file, TEXT, &packed[..end]), None, "cut at {end}");
        }
        for at in 8..packed.len() {
            for bit in 0..8 {
                let mut broken = packed.clone();
                broken[at] ^= 1 << bit;
                // Any result, but none of these ends the program.
                let _ = unpack(file, TEXT, &broken);
            }
        }
    }
}
