//! A YAML text as a tree: keys in their order, comments above them, and what each part of it says.

use std::collections::BTreeSet;
use std::fmt::Display;

use od_spec::model::{EntryId, Fact, Index};

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Node {
    /// A text, which is quoted where YAML needs it.
    Text(String),
    /// A number or a word that is written as it is.
    Plain(String),
    /// A list.
    List(Vec<Node>),
    /// A map, on one line where it fits.
    Map(Vec<Item>),
    /// A map with a line for each key.
    Block(Vec<Item>),
}

/// A key with its value.
#[derive(Debug, Clone)]
pub(crate) struct Item {
    /// Comment lines above; an empty one is an empty line.
    pub above: Vec<String>,
    /// The key, as it is written.
    pub key: String,
    /// The value.
    pub value: Node,
    /// What it says.
    pub spot: Option<Spot>,
}

/// Two items say the same, whatever is above them.
impl PartialEq for Item {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key && self.value == other.value
    }
}

/// What a part of a specification is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Spot {
    /// An object.
    Object(Index),
    /// A fact about an object as a whole.
    ObjectFact(Index, Fact),
    /// An entry.
    Entry(EntryId),
    /// A fact about an entry.
    EntryFact(EntryId, Fact),
}

impl Spot {
    /// The object.
    pub(crate) const fn index(self) -> Index {
        match self {
            Self::Object(index) | Self::ObjectFact(index, _) => index,
            Self::Entry(id) | Self::EntryFact(id, _) => id.index,
        }
    }
}

impl Item {
    /// A key that says nothing about an entry.
    pub(crate) fn new(key: impl Into<String>, value: Node) -> Self {
        Self { above: Vec::new(), key: key.into(), value, spot: None }
    }

    /// The same with what it says.
    pub(crate) fn about(self, spot: Spot) -> Self {
        Self { spot: Some(spot), ..self }
    }
}

impl Node {
    /// The texts that are under a key, wherever it is.
    pub(crate) fn texts_under<'n>(&'n self, key: &str, found: &mut BTreeSet<&'n str>) {
        match self {
            Self::Text(_) | Self::Plain(_) => {}
            Self::List(nodes) => nodes.iter().for_each(|node| node.texts_under(key, found)),
            Self::Map(items) | Self::Block(items) => {
                for item in items {
                    match &item.value {
                        Self::Text(text) if item.key == key => {
                            found.insert(text);
                        }
                        value => value.texts_under(key, found),
                    }
                }
            }
        }
    }

    /// A word or a number.
    pub(crate) fn plain(value: impl Display) -> Self {
        Self::Plain(format!("{value}"))
    }

    /// A text.
    pub(crate) fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// `yes` or `no`.
    pub(crate) fn yes_no(flag: bool) -> Self {
        Self::plain(if flag { "yes" } else { "no" })
    }

    /// A number of 32 bits that people read bit by bit: `0x0001_0002`.
    pub(crate) fn hex32(number: u32) -> Self {
        Self::Plain(format!("0x{:04X}_{:04X}", number >> 16, number & 0xFFFF))
    }
}
