//! YAML tree to specification as written.
//!
//! First [`shape`] compares the whole tree with the key tables and reports everything that does not fit; then
//! [`spec`] reads what does fit and silently leaves out the rest, so that each mistake is reported once.

mod devices;
mod entry;
mod languages;
pub(crate) mod lexical;
mod machines;
mod manual;
mod numbered;
mod objects;
mod pdos;
mod read;
mod shape;
mod spec;
mod types;

pub use lexical::is_device_key;
pub(crate) use shape::inside;

use crate::ast::Spec;
use crate::diag::Diagnostics;
use crate::keys;
use crate::yaml::Node;

/// Reads a specification or library.
pub(crate) fn decode(root: &Node, diagnostics: &mut Diagnostics) -> Spec {
    shape::check_map(root, &keys::SPEC, shape::start(root), diagnostics);
    languages::check(root, &keys::SPEC, diagnostics);
    spec::read(root, diagnostics)
}
