//! Access: by the attribute of an object, or by its parameter; and the direction, which the PDO mapping states.

use super::parameters::Parameter;
use super::tree::Tree;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::model::{Access, EntryId};
use crate::notation::words;
use crate::source::{Span, Spanned};

/// Access and mapping of an entry, as an EDS has them.
pub(super) struct Taken {
    pub access: Spanned<Access>,
    /// Whether it can be mapped; nothing where the file does not say.
    pub is_mappable: Option<Spanned<bool>>,
}

/// Reads access and mapping of an entry.
pub(super) fn of<'x>(
    tree: Tree<'x>,
    node: roxmltree::Node<'x, 'x>,
    id: EntryId,
    is_domain: bool,
    parameter: Option<Parameter<'_, 'x>>,
    diagnostics: &mut Diagnostics,
) -> Taken {
    let mapping = tree.attribute(node, "PDOmapping");
    let stated = stated(tree, node, id, parameter, diagnostics);
    let access = stated.unwrap_or_else(|| {
        if !is_domain {
            let message = format!("{id} has no access; it is taken as read-only");
            let help = "add `accessType`: `ro`, `wo`, `rw` or `const`, as the manual has it";
            diagnostics.push(Diagnostic::new(codes::XDD_NO_ACCESS, tree.place(node), message).help(help));
        }
        Spanned::new(if is_domain { Access::Rw } else { Access::Ro }, tree.place(node))
    });
    let Some(mapping) = mapping else { return Taken { access, is_mappable: None } };
    let directed = match (mapping.value.to_ascii_lowercase().as_str(), access.value) {
        ("no", _) => return Taken { access, is_mappable: Some(mapping.map(|_| false)) },
        ("default" | "optional", access) => access,
        ("tpdo", Access::Const | Access::Ro | Access::Rwr) => access.value,
        ("tpdo", Access::Rw) => Access::Rwr,
        ("rpdo", Access::Wo | Access::Rww) => access.value,
        ("rpdo", Access::Rw) => Access::Rww,
        ("tpdo", found @ (Access::Wo | Access::Rww)) => contradiction(found, id, mapping, diagnostics),
        ("rpdo", found @ (Access::Const | Access::Ro | Access::Rwr)) => {
            contradiction(found, id, mapping, diagnostics)
        }
        _ => {
            let is_mappable = words::yes_no(mapping.value).unwrap_or(false);
            let taken = if is_mappable { "optional" } else { "no" };
            let message =
                format!("{id}: found `PDOmapping=\"{}\"`; it is taken as `{taken}`", shorten(mapping.value));
            let help = "write `no`, `default`, `optional`, `TPDO` or `RPDO`";
            diagnostics.push(Diagnostic::new(codes::XDD_ATTRIBUTE, mapping.span, message).help(help));
            return Taken { access, is_mappable: Some(mapping.map(|_| is_mappable)) };
        }
    };
    Taken { access: access.map(|_| directed), is_mappable: Some(mapping.map(|_| true)) }
}

fn contradiction(
    access: Access,
    id: EntryId,
    mapping: Spanned<&str>,
    diagnostics: &mut Diagnostics,
) -> Access {
    let message = format!("{id}: a `{}` entry cannot be mapped into `{}`", access.word(), mapping.value);
    let help =
        "a TPDO carries what can be read, an RPDO what can be written: correct the access or the mapping";
    diagnostics.push(Diagnostic::new(codes::XDD_CONTRADICTION, mapping.span, message).help(help));
    access
}

/// The access that the object states, or else its parameter.
fn stated<'x>(
    tree: Tree<'x>,
    node: roxmltree::Node<'x, 'x>,
    id: EntryId,
    parameter: Option<Parameter<'_, 'x>>,
    diagnostics: &mut Diagnostics,
) -> Option<Spanned<Access>> {
    if let Some(text) = tree.attribute(node, "accessType") {
        let known = Access::from_word(text.value);
        return Some(text.map(|_| known.unwrap_or_else(|| other(id, "accessType", text, diagnostics))));
    }
    let parameter = parameter?;
    let Some(text) = parameter.attribute("access") else {
        // What the format says of a parameter that does not.
        return Some(Spanned::new(Access::Ro, place(tree, parameter)));
    };
    let access = match text.value {
        "const" => Access::Const,
        "read" => Access::Ro,
        "write" => Access::Wo,
        "readWrite" => Access::Rw,
        "readWriteInput" => Access::Rwr,
        "readWriteOutput" => Access::Rww,
        _ => other(id, "access", text, diagnostics),
    };
    Some(text.map(|_| access))
}

fn place<'x>(tree: Tree<'x>, parameter: Parameter<'_, 'x>) -> Span {
    tree.place(parameter.node)
}

/// An access in words that the attribute does not have; read-only where they are not known.
fn other(id: EntryId, name: &str, text: Spanned<&str>, diagnostics: &mut Diagnostics) -> Access {
    let known = words::access(text.value);
    let taken = known.map_or_else(|| "read-only".to_owned(), |access| format!("`{}`", access.word()));
    let message = format!("{id}: found `{name}=\"{}\"`; it is taken as {taken}", shorten(text.value));
    let help = match name {
        "access" if text.value == "noAccess" => "correct it if the entry can be read or written over the bus",
        "access" => "write `const`, `read`, `write`, `readWrite`, `readWriteInput` or `readWriteOutput`",
        _ => "write `const`, `ro`, `wo` or `rw`",
    };
    diagnostics.push(Diagnostic::new(codes::XDD_ATTRIBUTE, text.span, message).help(help));
    known.unwrap_or(Access::Ro)
}
