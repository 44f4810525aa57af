//! What values mean: unit, scale and named values of a parameter, as the comments of an EDS say them.

use super::parameters::Parameter;
use super::tree::{Tree, child, children};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::EntryId;

/// Comment lines about the unit and the named values of a parameter.
pub(super) fn lines<'x>(
    tree: Tree<'x>,
    parameter: Parameter<'_, 'x>,
    id: EntryId,
    diagnostics: &mut Diagnostics,
) -> Vec<String> {
    let mut lines: Vec<String> = unit(tree, parameter, id, diagnostics).into_iter().collect();
    let listed = child(parameter.node, "allowedValues");
    let of_type = parameter.named_type();
    let values = listed.into_iter().flat_map(|list| children(list, "value"));
    let values = values.chain(of_type.into_iter().flat_map(|named| children(named, "enumValue")));
    for value in values {
        let (Some(number), Some(name)) = (tree.attribute(value, "value"), label(tree, value)) else {
            continue;
        };
        lines.push(format!("{}: {name}", number.value));
    }
    lines
}

/// The unit with its step: `unit 0.1 bar`.
fn unit<'x>(
    tree: Tree<'x>,
    parameter: Parameter<'_, 'x>,
    id: EntryId,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    let scale = parameter.attribute("multiplier").filter(|scale| scale.value != "1");
    // How an offset and a multiplier go together is not certain enough to show a wrong temperature.
    if let Some(offset) =
        parameter.attribute("offset").filter(|offset| !offset.value.trim_matches(['0', '.']).is_empty())
    {
        let message = format!("the unit of {id} is left out: its raw values count from `{}`", offset.value);
        let help = "write the unit with what a raw value of 0 means into the specification";
        diagnostics.push(Diagnostic::new(codes::XDD_LEFT_OUT, offset.span, message).help(help));
        return None;
    }
    let symbol = label(tree, child(parameter.node, "unit")?)?;
    Some(match scale {
        Some(scale) => format!("unit {} {symbol}", scale.value),
        None => format!("unit {symbol}"),
    })
}

/// The label of an element, on one line.
fn label<'x>(tree: Tree<'x>, node: roxmltree::Node<'x, 'x>) -> Option<String> {
    let text = tree.text(child(node, "label")?)?;
    Some(text.value.split_whitespace().collect::<Vec<_>>().join(" "))
}
