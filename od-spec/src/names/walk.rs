//! Every scalar of a syntax tree, with the keys that lead to it.

use crate::keys::{
    Key, KeyKind, Keys, PARAMETER_FILE, PARAMETERS_VERSION, PART, PART_OF, PLANT, PLANT_VERSION, SPEC, Shape,
};
use crate::source::Spanned;
use crate::yaml::{Node, NodeKind};

/// A step from a map or list to what is in it.
#[derive(Debug, Clone, Copy)]
pub enum Step<'t> {
    /// The value of a key of the language.
    Key {
        /// The map.
        map: &'t Node,
        /// The keys that it may have.
        keys: &'static Keys,
        /// The key.
        key: &'static Key,
        /// The key as it is written.
        name: &'t Spanned<String>,
    },
    /// The value of a key that is data.
    Data {
        /// The map.
        map: &'t Node,
        /// What its keys are.
        kind: KeyKind,
        /// The key.
        name: &'t Spanned<String>,
    },
    /// An item of a list.
    Item {
        /// The list.
        list: &'t Node,
        /// Its number, from 0.
        at: usize,
    },
}

/// The keys that a file may have at its top level.
pub(super) fn keys_of(root: &Node) -> &'static Keys {
    let kinds = [(PART_OF, &PART), (PARAMETERS_VERSION, &PARAMETER_FILE), (PLANT_VERSION, &PLANT)];
    kinds.into_iter().find(|(key, _)| root.get(key).is_some()).map_or(&SPEC, |(_, keys)| keys)
}

/// Whether a file is about nodes: a parameter file or a plant.
pub(super) fn is_of_nodes(root: &Node) -> bool {
    [PARAMETERS_VERSION, PLANT_VERSION].into_iter().any(|key| root.get(key).is_some())
}

/// The keys of the devices that a place speaks of, by the keys that lead there; empty for all.
pub(super) fn devices_of<'t>(path: &[Step<'t>]) -> Vec<&'t str> {
    for step in path.iter().rev() {
        match step {
            Step::Data { kind: KeyKind::Device, name, .. } => return vec![name.value.as_str()],
            Step::Key { map, keys, .. } => {
                let has = keys.get("devices").is_some_and(|key| !matches!(key.shape, Shape::MapOf(..)));
                if let Some(devices) = map.get("devices").filter(|_| has) {
                    return devices.one_or_more().iter().filter_map(|one| Some(one.text()?.value)).collect();
                }
            }
            Step::Data { .. } | Step::Item { .. } => {}
        }
    }
    Vec::new()
}

/// What a scalar is where it is.
#[derive(Debug, Clone, Copy)]
pub(super) enum Role {
    /// A value.
    Value(Shape),
    /// A key that is data.
    Key(KeyKind),
    /// A feature, whose value is the number of its channels.
    FeatureKey,
    /// A key under `default:`: a device, or in a list a run of bits.
    DefaultKey,
}

/// Who looks at scalars.
pub(super) trait Visitor<'t> {
    /// A scalar with what leads to it, from the outside.
    fn scalar(&mut self, text: Spanned<&'t str>, role: Role, path: &[Step<'t>]);
}

/// Shows all scalars of a map with fixed keys.
pub(super) fn walk<'t>(root: &'t Node, keys: &'static Keys, visitor: &mut dyn Visitor<'t>) {
    Walk { visitor, path: Vec::new() }.map(root, keys);
}

struct Walk<'t, 'v> {
    visitor: &'v mut dyn Visitor<'t>,
    path: Vec<Step<'t>>,
}

impl<'t> Walk<'t, '_> {
    fn map(&mut self, map: &'t Node, keys: &'static Keys) {
        for (name, value) in map.entries() {
            if let Some(key) = keys.get(&name.value) {
                self.below(Step::Key { map, keys, key, name }, value, key.shape);
            }
        }
    }

    fn below(&mut self, step: Step<'t>, value: &'t Node, shape: Shape) {
        self.path.push(step);
        self.value(value, shape);
        self.path.pop();
    }

    fn value(&mut self, node: &'t Node, shape: Shape) {
        match (shape, &node.kind) {
            (Shape::Map(keys) | Shape::ShortOr(_, keys), NodeKind::Map(_)) => self.map(node, keys),
            (Shape::ShortOr(short, _), _) => self.value(node, *short),
            (Shape::MapOf(kind, inner), NodeKind::Map(_)) => {
                self.keyed(node, kind, Role::Key(kind), *inner);
            }
            (Shape::Feature, NodeKind::Map(_)) => {
                self.keyed(node, KeyKind::Name, Role::FeatureKey, Shape::Integer(0, 0));
            }
            (Shape::Default, NodeKind::Map(_)) => {
                self.keyed(node, KeyKind::Name, Role::DefaultKey, Shape::Default);
            }
            (Shape::List(item) | Shape::OneOrMore(item), NodeKind::List(items)) => {
                self.items(node, items, *item);
            }
            (Shape::Default, NodeKind::List(items)) => self.items(node, items, Shape::Default),
            (Shape::Setting, NodeKind::Map(_)) => {
                self.keyed(node, KeyKind::Name, Role::Key(KeyKind::Name), Shape::Setting);
            }
            (Shape::Setting, NodeKind::List(items)) => self.items(node, items, Shape::Setting),
            (Shape::OneOrMore(item), _) => self.value(node, *item),
            (_, NodeKind::Scalar { .. }) => {
                if let Some(text) = node.text() {
                    self.visitor.scalar(text, Role::Value(shape), &self.path);
                }
            }
            // Texts by language name nothing; what is of the wrong kind was reported.
            _ => {}
        }
    }

    fn keyed(&mut self, map: &'t Node, kind: KeyKind, role: Role, inner: Shape) {
        for (name, value) in map.entries() {
            let step = Step::Data { map, kind, name };
            self.path.push(step);
            self.visitor.scalar(Spanned::new(name.value.as_str(), name.span), role, &self.path);
            self.path.pop();
            self.below(step, value, inner);
        }
    }

    fn items(&mut self, list: &'t Node, items: &'t [Node], shape: Shape) {
        for (at, item) in items.iter().enumerate() {
            self.below(Step::Item { list, at }, item, shape);
        }
    }
}
