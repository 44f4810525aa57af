//! What CANopenEditor adds to objects: `property` elements of their parameters, and in its older files attributes.

use roxmltree::Node;

use super::parameters::{Parameter, Parameters};
use super::tree::{Tree, children};
use crate::diag::{Diagnostic, codes};
use crate::eds::Document;
use crate::model::{EditorProperty, Index};
use crate::notation::words::yes_no;
use crate::source::Spanned;

/// The property of an object that is switched off, and the attribute.
const DISABLED: [&str; 2] = ["CO_disabled", "disabled"];

/// Attributes of the older files.
const ATTRIBUTES: [(&str, EditorProperty); 2] =
    [("memoryType", EditorProperty::StorageGroup), ("TPDOdetectCOS", EditorProperty::TpdoRequests)];

/// Most objects that a message names.
const MOST_NAMED: usize = 4;

/// Whether an object is switched off.
pub(super) fn is_disabled<'x>(tree: Tree<'x>, node: Node<'x, 'x>, parameters: &Parameters<'x>) -> bool {
    let [property, attribute] = DISABLED;
    // A reference to no parameter is reported with the object, if it is there.
    let parameter = parameters.referred(node).ok().flatten();
    let stated = properties(tree, node, parameter).filter(|(name, _)| name.eq_ignore_ascii_case(property));
    let stated = stated.last().map(|(_, value)| value).or_else(|| tree.attribute(node, attribute));
    stated.is_some_and(|value| value.value == "1" || yes_no(value.value) == Some(true))
}

/// Says how many objects are left out, and which.
pub(super) fn left_out(objects: &[Spanned<Index>]) -> Option<Diagnostic> {
    let first = objects.first()?;
    let names: Vec<String> = objects.iter().take(MOST_NAMED).map(|object| object.value.to_string()).collect();
    let more = match objects.len() - names.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let what = match objects.len() {
        1 => "1 object is switched off and left out".to_owned(),
        number => format!("{number} objects are switched off and left out"),
    };
    let message = format!("{what}: {}{more}", names.join(", "));
    Some(
        Diagnostic::new(codes::XDD_DISABLED, first.span, message)
            .help("take them with `--disabled`, or switch them on in CANopenEditor"),
    )
}

/// Adds the properties of an object or entry to its section.
pub(super) fn write<'x>(
    document: &mut Document<'static>,
    tree: Tree<'x>,
    node: Node<'x, 'x>,
    parameter: Option<Parameter<'_, 'x>>,
) {
    let attributes =
        ATTRIBUTES.into_iter().filter_map(|(name, property)| Some((property, tree.attribute(node, name)?)));
    let stated = properties(tree, node, parameter)
        .filter_map(|(name, value)| Some((EditorProperty::of_name(name)?, value)));
    for (property, value) in attributes.chain(stated) {
        document.push_key(property.key(), value.value, value.span);
    }
}

/// Whether an element is a property of CANopenEditor.
pub(super) fn is_property<'x>(tree: Tree<'x>, node: Node<'x, 'x>) -> bool {
    tree.attribute(node, "name").is_some_and(|name| {
        name.value.eq_ignore_ascii_case(DISABLED[0]) || EditorProperty::of_name(name.value).is_some()
    })
}

/// The properties of an object or entry and of its parameter, each with its name.
fn properties<'x>(
    tree: Tree<'x>,
    node: Node<'x, 'x>,
    parameter: Option<Parameter<'_, 'x>>,
) -> impl Iterator<Item = (&'x str, Spanned<&'x str>)> {
    let nodes = parameter.map(|parameter| parameter.node).into_iter().chain([node]);
    let elements = nodes.flat_map(|node| children(node, "property"));
    elements.filter_map(move |element| {
        Some((tree.attribute(element, "name")?.value, tree.attribute(element, "value")?))
    })
}
