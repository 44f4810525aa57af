//! The texts for people in a specification: wherever a key takes one.

use crate::keys::{Keys, Shape};
use crate::yaml::{Node, NodeKind};

/// Calls `visit` with the node of each text: a scalar, or a map from language to text.
pub(super) fn each<'a>(map: &'a Node, keys: &Keys, visit: &mut impl FnMut(&'a Node)) {
    for (name, value) in map.entries() {
        if let Some(key) = keys.get(&name.value) {
            each_in(value, key.shape, visit);
        }
    }
}

/// [`each`], in the value of one key.
pub(super) fn each_in<'a>(node: &'a Node, shape: Shape, visit: &mut impl FnMut(&'a Node)) {
    match (shape, &node.kind) {
        (Shape::Words, _) => visit(node),
        (Shape::Map(keys) | Shape::ShortOr(_, keys), NodeKind::Map(_)) => each(node, keys, visit),
        (Shape::ShortOr(short, _), _) => each_in(node, *short, visit),
        (Shape::MapOf(_, value), NodeKind::Map(entries)) => {
            for (_, node) in entries {
                each_in(node, *value, visit);
            }
        }
        (Shape::List(item) | Shape::OneOrMore(item), NodeKind::List(items)) => {
            for node in items {
                each_in(node, *item, visit);
            }
        }
        (Shape::OneOrMore(item), _) => each_in(node, *item, visit),
        _ => {}
    }
}
