//! What a specification takes from its libraries by `from:`.

use super::scope::unknown;
use crate::ast::{Axes, EntryDecl, Name, ObjectDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::Index;
use crate::source::Spanned;

/// The library of this name, which `from:` gives.
pub(super) fn library<'a>(
    from: &Name,
    libraries: &'a [Spec],
    diagnostics: &mut Diagnostics,
) -> Option<&'a Spec> {
    let is_named = |library: &&Spec| library.profile.as_ref().is_some_and(|name| name.value == from.value);
    let found = libraries.iter().find(is_named);
    if found.is_none() {
        let known = libraries.iter().filter_map(|library| Some(library.profile.as_ref()?.value.as_str()));
        let otherwise = "name the library in `uses:` at the top of the file";
        diagnostics.push(unknown(codes::UNKNOWN_LIBRARY, from, "library", known, otherwise));
    }
    found
}

/// A library lacks what `from:` takes from it.
pub(super) fn not_there(from: &Name, what: &str) -> Diagnostic {
    Diagnostic::new(
        codes::NOT_IN_LIBRARY,
        from.span,
        format!("library `{}` does not define {what}", from.value),
    )
}

/// What a library says about an object, on any axis.
pub(super) fn object(library: &Spec, index: Index) -> Option<ObjectDecl> {
    let find = |index: Index| library.objects.iter().find(|decl| decl.index.value == index);
    if let Some(decl) = find(index) {
        return Some(decl.clone());
    }
    let axes = library.axes?;
    let (axis, first) = axes.locate(index)?;
    on_axis(find(first)?, axes, axis)
}

/// An object of axis 1 on a further axis: `Controlword axis 2`.
pub(super) fn on_axis(decl: &ObjectDecl, axes: Axes, axis: u16) -> Option<ObjectDecl> {
    let index = axes.shift(decl.index.value, axis)?;
    if axis == 1 || index == decl.index.value {
        return Some(decl.clone());
    }
    let name = decl.entry.name.as_ref();
    let name = name.map(|name| Spanned::new(format!("{} axis {axis}", name.value), name.span));
    let shifted = |link: &Spanned<Index>| Some(Spanned::new(axes.shift(link.value, axis)?, link.span));
    let links = decl.links.as_ref().map(|links| links.iter().filter_map(shifted).collect());
    Some(ObjectDecl {
        index: Spanned::new(index, decl.index.span),
        links,
        entry: EntryDecl { name, ..decl.entry.clone() },
        ..decl.clone()
    })
}
