//! YAML tree to specification as written.
//!
//! First [`shape`] compares the tree of each file with the key tables and reports everything that does not fit; then
//! [`spec`] reads what does fit and silently leaves out the rest, so that each mistake is reported once.

mod choices;
mod constraints;
mod devices;
mod entry;
mod languages;
pub(crate) mod lexical;
mod machines;
mod manual;
mod named;
mod numbered;
mod objects;
mod parameters;
mod pdos;
mod plant;
mod read;
mod shape;
mod spec;
mod texts;
mod types;

pub use lexical::is_device_key;
pub(crate) use parameters::{parameter_file, settings};
pub(crate) use plant::plant;
pub(crate) use shape::inside;

use crate::ast::Spec;
use crate::diag::Diagnostics;
use crate::keys::{self, Keys, Shape};
use crate::yaml::Node;

/// Says what in a file is not as its keys want it.
pub(crate) fn check(root: &Node, keys: &Keys, diagnostics: &mut Diagnostics) {
    let owner = shape::start(root);
    shape::check_map(root, keys, owner, diagnostics);
}

/// Says what in a part of a file is not of the shape that it is expected to have.
pub(crate) fn check_shape(node: &Node, shape: Shape, diagnostics: &mut Diagnostics) {
    let owner = shape::start(node);
    shape::check(node, shape, owner, diagnostics);
}

/// Reads a specification whose files were checked, or a library of one that shows some languages; without any, texts stay
/// in all of theirs.
pub(crate) fn read(root: &Node, shown: &[String], diagnostics: &mut Diagnostics) -> Spec {
    let texts = texts::all(root, &keys::SPEC);
    languages::check(root, &texts, diagnostics);
    let spec = spec::read(root, shown, diagnostics);
    if !shown.is_empty() {
        return spec;
    }
    let untranslated = languages::untranslated(root, &texts, diagnostics);
    Spec { untranslated, mentions: named::read(&texts), ..spec }
}

/// Reads a text of this crate, which a test has checked, with its texts in some languages; without any, in all of theirs.
pub(crate) fn read_own(root: &Node, shown: &[String]) -> Spec {
    spec::read(root, shown, &mut Diagnostics::new())
}

/// [`check`], then [`read()`]: a file without parts.
#[cfg(test)]
pub(crate) fn decode(root: &Node, diagnostics: &mut Diagnostics) -> Spec {
    check(root, &keys::SPEC, diagnostics);
    read(root, &[], diagnostics)
}
