//! C for firmware: the same plan as the Rust, printed as C99.
//!
//! Each device has a folder, `c/KEY/`, with `OD_types.h`, what its numbers mean, and the dictionary of each [`Kind`] that is wanted.

mod canopennode;
mod language;
mod literal;
mod names;
mod page;
mod text;
mod types;

use od_spec::diag::Diagnostics;
use od_spec::model::{Dictionary, System};

pub(crate) use self::language::C;
use self::names::{Names, Register};
use self::page::Page;
use self::text::header;
use crate::artifact::Artifact;
use crate::plan::{Plan, decided, plan};
use crate::provenance::Provenance;

/// For which firmware a dictionary is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Kind {
    /// By itself: tables, and the small reader and writer that comes with them.
    Plain,
    /// For the stack CANopenNode, version 4.
    CanopenNode,
}

/// The C of some devices, of each kind; of none when anything is wrong. What cannot be code is reported, as for Rust.
pub fn artifacts<'a>(
    system: &System,
    devices: impl Iterator<Item = &'a Dictionary>,
    provenance: &Provenance,
    kinds: &[Kind],
    diagnostics: &mut Diagnostics,
) -> Vec<Artifact> {
    if kinds.is_empty() {
        return Vec::new();
    }
    let (before, _) = diagnostics.count();
    let mut register = Register::default();
    let mut set = Vec::new();
    for device in devices {
        let device = decided(system, device, &C);
        let plan = plan(system, &device, &C, diagnostics);
        // What follows from a plan that is not whole would be reported once more.
        if diagnostics.count().0 == before {
            set.extend(of_device(&plan, provenance, kinds, &mut register, diagnostics));
        }
    }
    if diagnostics.count().0 == before { set } else { Vec::new() }
}

fn of_device(
    plan: &Plan<'_>,
    provenance: &Provenance,
    kinds: &[Kind],
    register: &mut Register,
    diagnostics: &mut Diagnostics,
) -> Vec<Artifact> {
    let names = Names::of(plan.device);
    let about =
        |what: &str| format!("{what} of the object dictionary `{}` of {}.", plan.device.key, provenance.name);
    let mut page = Page { plan, names: &names, text: text::Text::default(), register, diagnostics };
    types::print(&mut page);
    let types = header(&about("What the numbers mean"), &names.macro_of(&["OD", "TYPES", "H"]), &page.text);
    let folder = format!("c/{}", names.device());
    let mut set = vec![Artifact {
        path: format!("{folder}/{}", types::FILE),
        bytes: types.into_bytes(),
        purpose: "enums, bits, scales and error codes for C".to_owned(),
    }];
    for kind in kinds {
        match kind {
            Kind::Plain => {}
            Kind::CanopenNode => set.extend(canopennode::files(plan, &folder, &about, diagnostics)),
        }
    }
    set
}
