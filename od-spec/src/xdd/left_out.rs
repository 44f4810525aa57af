//! What an XDD has in addition to its objects, for which the model has no place.

use roxmltree::Node;

use super::editor::is_property;
use super::tree::{Tree, is_named};
use crate::diag::{Diagnostic, Diagnostics, Repeated, codes};
use crate::eds::view::View;

/// Says, once for each kind, what is not read.
pub(super) fn say(tree: Tree<'_>, diagnostics: &mut Diagnostics) {
    for (name, what) in [
        ("property", "what other programs keep there"),
        ("moduleManagement", "modules that can be plugged in"),
        ("templateList", "templates of parameters"),
        ("functionTypeList", "functions of the device"),
    ] {
        let is_kept = |node: &Node<'_, '_>| name == "property" && is_property(tree, *node);
        let mut found = tree
            .xml
            .descendants()
            .filter(|node| node.is_element() && is_named(*node, name) && !is_kept(node));
        let Some(first) = found.next() else { continue };
        let message = match 1 + found.count() {
            1 => format!("a `{name}` is left out: {what}"),
            number => format!("{number} elements `{name}` are left out: {what}"),
        };
        diagnostics.push(
            Diagnostic::new(codes::XDD_LEFT_OUT, tree.place(first), message)
                .help("keep the file for tools that need it; what is made from it does not have it"),
        );
    }
}

/// Says that only the first list of objects is read.
pub(super) fn say_lists(tree: Tree<'_>, first: Node<'_, '_>, diagnostics: &mut Diagnostics) {
    let lists =
        tree.xml.descendants().filter(|node| node.is_element() && is_named(*node, "CANopenObjectList"));
    for list in lists.filter(|list| *list != first) {
        diagnostics.push(
            Diagnostic::new(codes::XDD_LISTS, tree.place(list), "a further `CANopenObjectList` is left out")
                .with(tree.place(first), "the first one is read")
                .help("put all objects into one list"),
        );
    }
}

/// Says that an XDD has values of one node, which belong into an XDC.
pub(crate) fn say_values(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (key, attribute) in [("ParameterValue", "actualValue"), ("Denotation", "denotation")] {
        for value in view.topics().filter_map(|(_, part)| part.value(key)) {
            let message = format!("`{attribute}` belongs into an XDC, and is left out");
            found.add(value.span, [], || {
                Diagnostic::new(codes::XDD_VALUES, value.span, message)
                    .help("call the file `.xdc` if it is for one node, otherwise remove the values")
            });
        }
    }
    found.finish("values", diagnostics);
}
