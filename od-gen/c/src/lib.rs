//! C for firmware: the same plan as the Rust, printed as C99.
//!
//! Each device has a folder, `c/KEY/`, with `OD_types.h`, what its numbers mean, and the dictionary of each [`Kind`] that is wanted.

mod canopennode;
mod conditions;
mod language;
mod literal;
mod names;
mod page;
mod plain;
mod prefix;
mod relations;
mod text;
mod types;

use std::collections::BTreeMap;

use od_gen::Artifact;
use od_gen::Provenance;
use od_gen::plan::{Plan, decided, plan};
use od_spec::diag::Diagnostics;
use od_spec::model::{Dictionary, EntryId, System};

pub(crate) use self::language::C;
use self::names::{Names, Register};
use self::page::Page;
pub use self::prefix::{NotAPrefix, Prefix};
use self::text::{Text, header};

/// For which firmware a dictionary is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Kind {
    /// By itself: tables, and the small reader and writer that comes with them.
    Plain,
    /// For the stack CANopenNode, version 4.
    CanopenNode,
}

/// What is made of a device.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// For which firmware; of several kinds, each.
    pub kinds: Vec<Kind>,
    /// What begins the names of a dictionary for CANopenNode.
    pub prefix: Prefix,
}

impl From<Kind> for Options {
    fn from(kind: Kind) -> Self {
        Self { kinds: vec![kind], ..Self::default() }
    }
}

/// The C of some devices, of each kind; of none when anything is wrong. What cannot be code is reported, as for Rust. The files include those that
/// [`shared`] gives.
pub fn artifacts<'a>(
    system: &System,
    devices: impl Iterator<Item = &'a Dictionary>,
    provenance: &Provenance,
    options: &Options,
    diagnostics: &mut Diagnostics,
) -> Vec<Artifact> {
    if options.kinds.is_empty() {
        return Vec::new();
    }
    let before = diagnostics.errors_found();
    let mut register = Register::default();
    let mut set = Vec::new();
    for device in devices {
        let decided = decided(system, device, &C);
        let plan = plan(system, &decided, &C, diagnostics);
        // What follows from a plan that is not whole would be reported once more.
        if diagnostics.errors_found() == before {
            set.extend(of_device(&plan, device, provenance, options, &mut register, diagnostics));
        }
    }
    if diagnostics.errors_found() == before { set } else { Vec::new() }
}

/// The folder of a device in C, and what begins its names: `my_fan` of the key `my-fan`.
pub fn device_prefix(key: &str) -> String {
    names::prefix(key)
}

/// The macro with the index of each entry, such as `PMC_INDEX_STATUSWORD`; of none where the device cannot be C.
pub fn index_names(system: &System, device: &Dictionary) -> BTreeMap<EntryId, String> {
    let mut diagnostics = Diagnostics::new();
    let device = decided(system, device, &C);
    let plan = plan(system, &device, &C, &mut diagnostics);
    if diagnostics.has_errors() {
        return BTreeMap::new();
    }
    let names = Names::of(&device);
    plan.entries.iter().map(|entry| (entry.id, names.macro_of(&plain::index_name(entry)))).collect()
}

/// What the files of all devices include, each once however many there are.
pub fn shared(kinds: &[Kind]) -> Vec<Artifact> {
    let of_kind = |kind: &Kind| match kind {
        Kind::Plain => plain::runtime().to_vec(),
        // Each folder is whole by itself, as the stack includes `OD.h` by this name.
        Kind::CanopenNode => Vec::new(),
    };
    kinds.iter().flat_map(of_kind).collect()
}

fn of_device(
    plan: &Plan<'_>,
    named: &Dictionary,
    provenance: &Provenance,
    options: &Options,
    register: &mut Register,
    diagnostics: &mut Diagnostics,
) -> Vec<Artifact> {
    let names = Names::of(plan.device);
    let about = |what: &str| format!("{what} of `{}`, from {}.", plan.device.key, provenance.name());
    let file = |name: &str, text: Text, purpose: &str| Artifact {
        path: format!("c/{}/{name}", names.device()),
        bytes: text.into_bytes(),
        purpose: purpose.to_owned(),
    };
    let mut page = Page { plan, names: &names, text: Text::default(), register, diagnostics };
    let mut set = Vec::new();
    types::print(&mut page);
    let guard = names.macro_of(&["OD", "TYPES", "H"]);
    let text = header(&about("What the numbers in the object dictionary mean"), &guard, &page.finish());
    set.push(file(types::FILE, text, "enums, bits, scales and error codes for C"));
    for kind in &options.kinds {
        match kind {
            Kind::Plain => {
                plain::header(&mut page);
                let guard = names.macro_of(&["OD", "H"]);
                let text = header(&about("The object dictionary"), &guard, &page.finish());
                set.push(file(&plain::file(&names, "h"), text, "the dictionary for C firmware"));
                plain::source(&mut page, &about("The table of the object dictionary"));
                set.push(file(&plain::file(&names, "c"), page.finish(), "its table"));
            }
            Kind::CanopenNode => {
                let folder = format!("c/{}", names.device());
                set.extend(canopennode::files(
                    plan,
                    named,
                    &folder,
                    &options.prefix,
                    &about,
                    page.diagnostics,
                ));
            }
        }
    }
    page.register.report_alike(plan.device, page.diagnostics);
    set
}
