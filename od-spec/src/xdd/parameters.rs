//! Parameters and types of `ApplicationProcess`, by their identifiers.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::tree::{Tree, child, children, is_named};
use super::types;
use crate::model::DataType;
use crate::source::Spanned;

/// What objects refer to.
pub(super) struct Parameters<'x> {
    tree: Tree<'x>,
    by_uid: BTreeMap<&'x str, Node<'x, 'x>>,
    types: BTreeMap<&'x str, Node<'x, 'x>>,
}

impl<'x> Parameters<'x> {
    /// Those of a file.
    pub(super) fn of(tree: Tree<'x>) -> Self {
        let mut found = Self { tree, by_uid: BTreeMap::new(), types: BTreeMap::new() };
        for node in tree.xml.descendants().filter(Node::is_element) {
            let Some(uid) = tree.attribute(node, "uniqueID") else { continue };
            match node.tag_name().name() {
                "parameter" => drop(found.by_uid.entry(uid.value).or_insert(node)),
                "array" | "struct" | "enum" | "derived" => drop(found.types.entry(uid.value).or_insert(node)),
                _ => {}
            }
        }
        found
    }

    /// The parameter that an object or sub-index refers to; `Err` with the name of one that there is not.
    pub(super) fn referred(&self, node: Node<'x, 'x>) -> Result<Option<Parameter<'_, 'x>>, Spanned<&'x str>> {
        let Some(uid) = self.tree.attribute(node, "uniqueIDRef") else { return Ok(None) };
        let node = self.by_uid.get(uid.value).copied().ok_or(uid)?;
        Ok(Some(Parameter { all: self, node }))
    }
}

/// A parameter.
#[derive(Clone, Copy)]
pub(super) struct Parameter<'p, 'x> {
    all: &'p Parameters<'x>,
    pub node: Node<'x, 'x>,
}

impl<'x> Parameter<'_, 'x> {
    /// An attribute.
    pub(super) fn attribute(self, name: &str) -> Option<Spanned<&'x str>> {
        self.all.tree.attribute(self.node, name)
    }

    /// Its data type: that of its element, or of the type that it refers to.
    pub(super) fn data_type(self) -> Option<DataType> {
        types::of_element(self.node).or_else(|| types::of_element(self.named_type()?))
    }

    /// The `enum`, or another type of the list, that it refers to.
    pub(super) fn named_type(self) -> Option<Node<'x, 'x>> {
        let mut uid = self.all.tree.attribute(child(self.node, "dataTypeIDRef")?, "uniqueIDRef")?;
        // A type may be derived from another one, which is derived from a third; a circle ends somewhere.
        for _ in 0..8 {
            let named = self.all.types.get(uid.value).copied()?;
            let base = child(named, "dataTypeIDRef").filter(|_| is_named(named, "derived"));
            match base.and_then(|base| self.all.tree.attribute(base, "uniqueIDRef")) {
                Some(base) => uid = base,
                None => return Some(named),
            }
        }
        None
    }

    /// The value of a child such as `defaultValue`.
    pub(super) fn value(self, name: &str) -> Option<Spanned<&'x str>> {
        self.all.tree.attribute(child(self.node, name)?, "value")
    }

    /// An end of the range of its values, if it has a single range.
    pub(super) fn limit(self, name: &str) -> Option<Spanned<&'x str>> {
        let allowed = child(self.node, "allowedValues")?;
        let mut ranges = children(allowed, "range");
        let range = ranges.next().filter(|_| ranges.next().is_none())?;
        self.all.tree.attribute(child(range, name)?, "value")
    }
}
