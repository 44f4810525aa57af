//! The Rust backend: a dictionary as a module that firmware compiles.
//!
//! The work has two steps. The plan decides everything that is the same in every language: the place of every value, the
//! tables, and with the help of `language` the names. `print` writes it down as Rust.

mod language;
mod print;

use std::collections::BTreeMap;

use od_spec::diag::Diagnostics;
use od_spec::model::{Dictionary, EntryId, System};
use proc_macro2::TokenStream;

pub use self::language::{Rust, module};
use crate::plan::{Plan, PlannedEntry, Shape, decided, plan};
pub use crate::provenance::Provenance;

/// The items of a device's module. What cannot be code (two names that give one identifier, a string without capacity) is
/// reported, and nothing comes out. An EDS cannot say what code needs of it, and its objects often share names: there, what would
/// clash gets its index after its name, and a text has room for its default and for 32 bytes.
pub fn tokens(system: &System, device: &Dictionary, diagnostics: &mut Diagnostics) -> Option<TokenStream> {
    let errors = diagnostics.errors_found();
    let device = decided(system, device, &Rust);
    let plan = plan(system, &device, &Rust, diagnostics);
    (diagnostics.errors_found() == errors).then(|| print::tokens(&plan))
}

/// How code reads each entry of a device: the call of its accessor, `battery_parameter().nominal_capacity()`. Empty where the
/// device cannot be code.
pub fn accessors(system: &System, device: &Dictionary) -> BTreeMap<EntryId, String> {
    let mut diagnostics = Diagnostics::new();
    let device = decided(system, device, &Rust);
    let plan = plan(system, &device, &Rust, &mut diagnostics);
    if diagnostics.has_errors() {
        return BTreeMap::new();
    }
    plan.entries.iter().filter_map(|entry| Some((entry.id, call(&plan, entry)?))).collect()
}

/// The call that reads an entry.
pub fn call(plan: &Plan<'_>, entry: &PlannedEntry<'_>) -> Option<String> {
    let object = plan.objects.get(entry.object)?;
    Some(match &object.shape {
        Shape::Var => format!("{}()", object.name),
        Shape::Indexed { count } if entry.id.sub.0 == 0 => format!("{}()", count.as_ref()?),
        Shape::Indexed { .. } => format!("{}({})", object.name, entry.id.sub),
        Shape::Group { .. } => format!("{}().{}()", object.name, entry.member),
    })
}

mod file;
pub use file::{Layout, modules, plain_file};
#[cfg(feature = "format")]
pub use file::{artifacts, file};
