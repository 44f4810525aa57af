//! Typed reading of nodes whose shape was checked: what does not fit is left out without a word.

use crate::ast::{Name, Words};
use crate::model::{Index, Text};
use crate::scalar;
use crate::source::{Span, Spanned};
use crate::yaml::{MERGE, Node, NodeKind};

use super::lexical;

/// A map with fixed keys, and the language that plain texts are in.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a> {
    pub node: &'a Node,
    pub language: &'a str,
}

impl<'a> Reader<'a> {
    pub(super) const fn at(self, node: &'a Node) -> Self {
        Self { node, ..self }
    }

    pub(super) fn child(self, key: &str) -> Option<Self> {
        self.node.get(key).map(|node| self.at(node))
    }

    /// The place of a key, and its value.
    pub(super) fn keyed(self, key: &str) -> Option<(Span, Self)> {
        let (name, node) = self.node.entries().iter().find(|(name, _)| name.value == key)?;
        Some((name.span, self.at(node)))
    }

    /// The values of a list, or the one value that stands in its place.
    pub(super) fn items(self, key: &str) -> impl Iterator<Item = Self> {
        let nodes = match self.node.get(key) {
            Some(Node { kind: NodeKind::List(items), .. }) => items.as_slice(),
            Some(node) => std::slice::from_ref(node),
            None => &[],
        };
        nodes.iter().map(move |node| self.at(node))
    }

    /// The entries of a map with data in its keys.
    pub(super) fn entries(self, key: &str) -> impl Iterator<Item = (Spanned<&'a str>, Self)> {
        let entries = self.node.get(key).map(Node::entries).unwrap_or_default();
        let entries = entries.iter().filter(|(name, _)| name.value != MERGE);
        entries.map(move |(name, node)| (Spanned::new(name.value.as_str(), name.span), self.at(node)))
    }

    /// Reads the scalar itself.
    pub(super) fn scalar<T>(self, read: impl Fn(&str) -> Option<T>) -> Option<Spanned<T>> {
        let text = self.node.text()?;
        read(text.value).map(|value| Spanned::new(value, text.span))
    }

    pub(super) fn value<T>(self, key: &str, read: impl Fn(&str) -> Option<T>) -> Option<Spanned<T>> {
        self.child(key)?.scalar(read)
    }

    pub(super) fn text(self, key: &str) -> Option<Name> {
        self.value(key, |text| Some(text.to_owned()))
    }

    pub(super) fn integer(self, key: &str) -> Option<Spanned<i128>> {
        self.value(key, |text| scalar::integer(text).ok())
    }

    pub(super) fn yes_no(self, key: &str) -> Option<Spanned<bool>> {
        self.value(key, scalar::yes_no)
    }

    pub(super) fn texts(self, key: &str) -> Vec<Name> {
        self.items(key).filter_map(|item| item.scalar(|text| Some(text.to_owned()))).collect()
    }

    /// Texts, or `None` when the key is not there.
    pub(super) fn optional_texts(self, key: &str) -> Option<Vec<Name>> {
        self.node.get(key).map(|_| self.texts(key))
    }

    pub(super) fn integers(self, key: &str) -> Vec<Spanned<i128>> {
        self.items(key).filter_map(|item| item.scalar(|text| scalar::integer(text).ok())).collect()
    }

    pub(super) fn indices(self, key: &str) -> Vec<Spanned<Index>> {
        self.items(key).filter_map(|item| item.scalar(lexical::index)).collect()
    }

    /// A text, or a map from language to text.
    pub(super) fn words(self, key: &str) -> Words {
        let child = self.child(key)?;
        child.own_words().map(|text| Spanned::new(text, child.node.span))
    }

    pub(super) fn own_words(self) -> Option<Text> {
        let text = |node: &'a Node| node.text().map(|text| text.value.trim());
        let text = match &self.node.kind {
            NodeKind::Map(entries) => {
                Text::new(entries.iter().filter_map(|(name, node)| Some((name.value.as_str(), text(node)?))))
            }
            _ => Text::new([(self.language, text(self.node)?)]),
        };
        (!text.is_empty()).then_some(text)
    }
}
