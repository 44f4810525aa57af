//! The texts for people in a specification: wherever a key takes one.

use crate::keys::{Keys, Shape};
use crate::yaml::{Node, NodeKind};

/// A text: a scalar, or a map from language to text.
pub(super) struct WrittenText<'a> {
    /// The key of the specification that it is part of, such as `objects`.
    pub part: &'a str,
    /// The text.
    pub node: &'a Node,
}

/// All texts of a specification, in the order of its keys.
pub(super) fn all<'a>(root: &'a Node, keys: &Keys) -> Vec<WrittenText<'a>> {
    let mut found = Vec::new();
    for (name, value) in root.entries() {
        if let Some(key) = keys.get(&name.value) {
            each_in(value, key.shape, &mut |node| found.push(WrittenText { part: &name.value, node }));
        }
    }
    found
}

/// Calls `visit` with each text in the value of a key.
fn each_in<'a>(node: &'a Node, shape: Shape, visit: &mut impl FnMut(&'a Node)) {
    match (shape, &node.kind) {
        (Shape::Words, _) => visit(node),
        (Shape::Map(keys) | Shape::ShortOr(_, keys), NodeKind::Map(entries)) => {
            for (name, value) in entries {
                if let Some(key) = keys.get(&name.value) {
                    each_in(value, key.shape, visit);
                }
            }
        }
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
