//! A tree as text: on one line what fits, else a line for each key.

use std::ops::Range;

use super::node::{Item, Node, Spot};
use super::scalar::spelled;

/// Longest line that is filled with several keys, in characters.
const WIDTH: usize = 140;

/// A text, and what its parts say.
#[derive(Debug, Default)]
pub(super) struct Written {
    pub text: String,
    /// Byte ranges; what belongs together lies inside each other. They are in the order of their ends, a part before
    /// what it is a part of.
    pub spots: Vec<(Range<usize>, Spot)>,
}

impl Written {
    /// What the text says at a byte: the narrowest part.
    pub(super) fn spot(&self, at: usize) -> Option<&(Range<usize>, Spot)> {
        let first = self.spots.partition_point(|(range, _)| range.end <= at);
        self.spots.get(first..)?.iter().find(|(range, _)| range.start <= at)
    }

    /// Adds texts that say nothing by themselves.
    fn push(&mut self, texts: &[&str]) {
        self.text.extend(texts.iter().copied());
    }

    /// Adds a text with what its parts say.
    fn append(&mut self, other: Self) {
        let start = self.text.len();
        self.text.push_str(&other.text);
        let moved =
            other.spots.into_iter().map(|(range, spot)| (range.start + start..range.end + start, spot));
        self.spots.extend(moved);
    }
}

/// The document of these keys.
pub(super) fn write(items: &[Item]) -> Written {
    let mut out = Written::default();
    block(items, 0, &mut out);
    out
}

/// A line for each key, or more.
fn block(items: &[Item], indent: usize, out: &mut Written) {
    let margin = " ".repeat(indent);
    for item in items {
        for line in &item.above {
            if line.is_empty() {
                out.text.push('\n');
            } else {
                out.push(&[&margin, "# ", line, "\n"]);
            }
        }
        out.text.push_str(&margin);
        let start = out.text.len();
        out.push(&[&item.key, ":"]);
        value(&item.value, indent, indent + item.key.chars().count() + 2, out);
        out.spots.extend(item.spot.map(|spot| (start..out.text.len(), spot)));
        out.text.push('\n');
    }
}

/// The value of a key that ends at a column.
fn value(node: &Node, indent: usize, column: usize, out: &mut Written) {
    let line = flow(node);
    let fits = line.as_ref().is_some_and(|line| column + line.text.chars().count() <= WIDTH);
    match (node, line) {
        (Node::Block(items), _) if !items.is_empty() => nested(items, indent, out),
        (Node::Map(items), line) if !items.is_empty() && (!fits || line.is_none()) => {
            nested(items, indent, out);
        }
        (Node::List(items), _) if !fits => {
            for item in items {
                let line = flow(item).unwrap_or_default();
                out.push(&["\n", &" ".repeat(indent + 2), "- "]);
                out.append(line);
            }
        }
        (Node::Text(text), _) if !fits && is_foldable(text) => fold(text, indent + 2, out),
        (Node::Text(_) | Node::Plain(_) | Node::List(_) | Node::Map(_) | Node::Block(_), line) => {
            out.text.push(' ');
            out.append(line.unwrap_or_default());
        }
    }
}

fn nested(items: &[Item], indent: usize, out: &mut Written) {
    out.text.push('\n');
    block(items, indent + 2, out);
    // The line is ended where the key is.
    out.text.pop();
}

/// A value on one line; `None` where something is above a part of it.
fn flow(node: &Node) -> Option<Written> {
    let mut out = Written::default();
    match node {
        Node::Text(text) => out.text.push_str(&spelled(text)),
        Node::Plain(word) => out.text.push_str(word),
        Node::List(items) => {
            out.text.push('[');
            for (at, item) in items.iter().enumerate() {
                out.text.push_str(if at == 0 { "" } else { ", " });
                out.append(flow(item)?);
            }
            out.text.push(']');
        }
        Node::Map(items) | Node::Block(items) => {
            out.text.push('{');
            for (at, item) in items.iter().enumerate() {
                if !item.above.is_empty() {
                    return None;
                }
                out.text.push_str(if at == 0 { "" } else { ", " });
                let start = out.text.len();
                out.push(&[&item.key, ": "]);
                out.append(flow(&item.value)?);
                out.spots.extend(item.spot.map(|spot| (start..out.text.len(), spot)));
            }
            out.text.push('}');
        }
    }
    Some(out)
}

/// Whether a text can be broken into lines without a change.
fn is_foldable(text: &str) -> bool {
    let words = text.split(' ');
    text.starts_with(|c: char| c.is_alphanumeric())
        && words
            .clone()
            .all(|word| !word.is_empty() && !word.chars().any(|c| c.is_control() || c == '\u{FEFF}'))
        && words.max_by_key(|word| word.len()).is_some_and(|word| word.len() < WIDTH / 2)
        && !text.contains(['\u{85}', '\u{2028}', '\u{2029}'])
}

/// A long text over several lines.
fn fold(text: &str, indent: usize, out: &mut Written) {
    out.text.push_str(" >-");
    for line in wrapped(text, WIDTH - indent) {
        out.push(&["\n", &" ".repeat(indent), &line]);
    }
}

/// A text in lines of at most this many characters, if its words allow.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut().filter(|line| line.chars().count() + 1 + word.chars().count() <= width) {
            Some(line) => {
                line.push(' ');
                line.push_str(word);
            }
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use od_spec::model::Index;

    use super::*;

    fn numbered(count: usize) -> Node {
        Node::Map(
            (1..=count).map(|at| Item::new(format!("key{at}"), Node::text(format!("value {at}")))).collect(),
        )
    }

    #[test]
    fn what_fits_is_on_a_line() {
        assert_eq!(write(&[Item::new("a", numbered(2))]).text, "a: {key1: value 1, key2: value 2}\n");
        let long = write(&[Item::new("a", numbered(20))]).text;
        assert!(long.starts_with("a:\n  key1: value 1\n") && long.ends_with("  key20: value 20\n"), "{long}");
        assert_eq!(write(&[Item::new("a", Node::Block(Vec::new()))]).text, "a: {}\n");
    }

    #[test]
    fn a_comment_needs_a_line() {
        let mut inner = Item::new("b", Node::plain(1));
        inner.above = vec!["why".to_owned()];
        assert_eq!(write(&[Item::new("a", Node::Map(vec![inner]))]).text, "a:\n  # why\n  b: 1\n");
    }

    #[test]
    fn long_texts_are_folded_and_long_lists_broken() {
        let text = "word ".repeat(40).trim().to_owned();
        let shown =
            write(&[Item::new("a", Node::Map(vec![Item::new("about", Node::text(text.clone()))]))]).text;
        assert!(shown.lines().all(|line| line.chars().count() <= WIDTH), "{shown}");
        let read: serde_yaml::Value = serde_yaml::from_str(&shown).unwrap();
        assert_eq!(read["a"]["about"], serde_yaml::Value::String(text));
        let list = write(&[Item::new("a", Node::List((0..60).map(Node::plain).collect()))]).text;
        assert!(list.starts_with("a:\n  - 0\n  - 1\n"), "{list}");
    }

    #[test]
    fn the_narrowest_part_is_found() {
        let (outer, inner) = (Spot::Object(Index(1)), Spot::Object(Index(2)));
        let item = Item::new("b", Node::plain(1)).about(inner);
        let written = write(&[Item::new("a", Node::Map(vec![item])).about(outer)]);
        assert_eq!(written.text, "a: {b: 1}\n");
        let spots = [0, 4, 8, 9].map(|at| written.spot(at).map(|(_, spot)| *spot));
        assert_eq!(spots, [Some(outer), Some(inner), Some(outer), None]);
    }
}
