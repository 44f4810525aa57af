//! What a byte of a text is a part of, by the table of keys.

use super::settings::SettingOf;
use super::walk::{Step, devices_of, keys_of};
use crate::keys::{KeyKind, Keys, Shape};
use crate::source::Spanned;
use crate::yaml::{Node, NodeKind};

/// What a byte of a text is a part of.
#[derive(Debug)]
#[non_exhaustive]
pub struct Place<'t> {
    /// What leads there, from the outside.
    pub path: Vec<Step<'t>>,
    /// What is there.
    pub spot: Spot<'t>,
}

/// What is at a [`Place`].
#[derive(Debug, Clone, Copy)]
pub enum Spot<'t> {
    /// A key of a map with fixed keys, or a word that may become one.
    Key {
        /// The map; the word, where that is alone.
        map: &'t Node,
        /// The keys that it may have.
        keys: &'static Keys,
        /// The key.
        name: Spanned<&'t str>,
    },
    /// A key that is data.
    Data {
        /// The map; the word, where that is alone.
        map: &'t Node,
        /// What its keys are.
        kind: KeyKind,
        /// The key.
        name: Spanned<&'t str>,
    },
    /// A value.
    Value {
        /// What it should look like.
        shape: Shape,
        /// The value.
        node: &'t Node,
    },
}

impl<'t> Place<'t> {
    /// What a byte of a text is a part of, including directly after the last one; `None` between keys and values, in
    /// comments and below what is not a key.
    pub fn of(root: &'t Node, offset: u32) -> Option<Self> {
        let mut finder = Finder { offset, path: Vec::new() };
        let spot = finder.map(root, keys_of(root))?;
        Some(Self { path: finder.path, spot })
    }

    /// The keys of the devices that it speaks of; empty for all.
    pub fn devices(&self) -> Vec<&'t str> {
        devices_of(&self.path)
    }

    /// The setting of a parameter file or plant that it is in.
    pub fn setting(&self) -> Option<SettingOf<'t>> {
        SettingOf::around(&self.path)
    }

    /// The value of a key next to it.
    pub fn beside(&self, key: &str) -> Option<&'t Node> {
        self.map().and_then(|(map, _)| map.get(key))
    }

    /// The innermost map with fixed keys around it, with those keys.
    pub fn map(&self) -> Option<(&'t Node, &'static Keys)> {
        self.path.iter().rev().find_map(|step| match step {
            Step::Key { map, keys, .. } => Some((*map, *keys)),
            Step::Data { .. } | Step::Item { .. } => None,
        })
    }
}

struct Finder<'t> {
    offset: u32,
    path: Vec<Step<'t>>,
}

impl<'t> Finder<'t> {
    fn holds(&self, span: crate::source::Span) -> bool {
        (span.start..=span.end).contains(&self.offset)
    }

    fn map(&mut self, map: &'t Node, keys: &'static Keys) -> Option<Spot<'t>> {
        for (name, value) in map.entries() {
            if self.holds(name.span) {
                let name = Spanned::new(name.value.as_str(), name.span);
                return Some(Spot::Key { map, keys, name });
            }
            if self.holds(value.span) {
                let key = keys.get(&name.value)?;
                self.path.push(Step::Key { map, keys, key, name });
                return self.value(value, key.shape);
            }
        }
        None
    }

    fn value(&mut self, node: &'t Node, shape: Shape) -> Option<Spot<'t>> {
        match (shape, &node.kind) {
            (Shape::Map(keys) | Shape::ShortOr(_, keys), NodeKind::Map(_)) => self.map(node, keys),
            (Shape::Map(keys), _) => Some(Spot::Key { map: node, keys, name: node.text()? }),
            (Shape::MapOf(kind, inner), NodeKind::Map(_)) => self.keyed(node, kind, *inner),
            (Shape::MapOf(kind, _), _) => Some(Spot::Data { map: node, kind, name: node.text()? }),
            (Shape::Feature, NodeKind::Map(_)) => self.keyed(node, KeyKind::Name, Shape::Integer(0, 0)),
            (Shape::Default, NodeKind::Map(_)) => self.keyed(node, KeyKind::Name, Shape::Default),
            (Shape::Words, NodeKind::Map(_)) => self.keyed(node, KeyKind::Language, Shape::Words),
            (Shape::List(item) | Shape::OneOrMore(item), NodeKind::List(items)) => {
                self.items(node, items, *item)
            }
            (Shape::Default, NodeKind::List(items)) => self.items(node, items, Shape::Default),
            (Shape::Setting, NodeKind::Map(_)) => self.keyed(node, KeyKind::Name, Shape::Setting),
            (Shape::Setting, NodeKind::List(items)) => self.items(node, items, Shape::Setting),
            (Shape::OneOrMore(item), _) => self.value(node, *item),
            _ => Some(Spot::Value { shape, node }),
        }
    }

    fn keyed(&mut self, map: &'t Node, kind: KeyKind, inner: Shape) -> Option<Spot<'t>> {
        for (name, value) in map.entries() {
            if self.holds(name.span) {
                let name = Spanned::new(name.value.as_str(), name.span);
                return Some(Spot::Data { map, kind, name });
            }
            if self.holds(value.span) {
                self.path.push(Step::Data { map, kind, name });
                return self.value(value, inner);
            }
        }
        None
    }

    fn items(&mut self, list: &'t Node, items: &'t [Node], shape: Shape) -> Option<Spot<'t>> {
        let at = items.iter().position(|item| self.holds(item.span))?;
        self.path.push(Step::Item { list, at });
        self.value(&items[at], shape)
    }
}
