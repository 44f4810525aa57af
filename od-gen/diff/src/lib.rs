//! The difference of two object dictionaries, fact by fact, and what each change breaks.
//!
//! ```
//! use od_diff::{Class, Question, Scope, compare};
//! use od_spec::source::SourceMap;
//! use od_spec::{NoFiles, compile};
//!
//! let lamp = |limit: u8| {
//!     let mut sources = SourceMap::new();
//!     let root = sources.add("lamp.od.yaml", format!("
//! od-spec: 1
//! title: Lamp
//! uses: [cia301]
//! devices:
//!   lamp: {{name: Lamp, bit-rates: [125], features: [heartbeat producer]}}
//! objects:
//!   0x2000: {{name: brightness, type: unsigned8, access: rw, default: 80, max: {limit}}}
//! "));
//!     compile(&mut sources, root, &mut NoFiles).system.expect("no errors")
//! };
//! let (old, new) = (lamp(100), lamp(90));
//! let found = compare(&Question { old: &old, new: &new, scope: Scope::Everything, device: None, nodes: None });
//! let found = found.expect("each has one device");
//! assert_eq!(found.class(), Some(Class::Plc));
//! let change = &found.devices[0].changes[0];
//! assert_eq!((change.before.as_deref(), change.after.as_deref()), (Some("100"), Some("90")));
//! ```

mod change;
mod code;
mod device;
mod editor;
mod entries;
mod further;
mod manual;
mod node;
mod objects;
mod pairs;
mod print;
mod proposal;
mod relations;
mod rules;
mod scope;
mod sides;
mod stored;
mod texts;
mod types;
mod units;
mod unused;
mod words;

use od_spec::Commissioning;
use od_spec::model::{Dictionary, System};

pub use self::change::{Change, Class, Consequence, Kind, Place};
pub use self::pairs::Unpaired;
pub use self::print::{Row, human, json, markdown, row, short};
pub use self::proposal::{Advice, Parts, Proposal, Proposals};
pub use self::scope::Scope;

use self::code::Code;
use self::objects::Devices;
use self::relations::Systems;
use self::stored::Groups;
use self::types::Names;

/// What is compared with what.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    /// Before.
    pub old: &'a System,
    /// After.
    pub new: &'a System,
    /// The facts that both can state.
    pub scope: Scope,
    /// Only the device with this key.
    pub device: Option<&'a str>,
    /// The nodes before and after, where both are read from a DCF.
    pub nodes: Option<(&'a Commissioning, &'a Commissioning)>,
}

/// What differs between two systems.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Difference {
    /// The facts that were compared.
    pub scope: Scope,
    /// What is not about one device: the maker, the manual, devices that came or went.
    pub system: Vec<Change>,
    /// What differs in each device that both systems have, in the order of the new one.
    pub devices: Vec<DeviceDifference>,
}

/// What differs in a device.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct DeviceDifference {
    /// Its key in the new system.
    pub key: String,
    /// Its name there.
    pub name: String,
    /// The changes, by place.
    pub changes: Vec<Change>,
    /// Which version numbers report them.
    pub proposals: Proposals,
    /// What could not be judged.
    pub unknown: Vec<Unknown>,
}

/// What could not be judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unknown {
    /// One of the two cannot be generated code, so that nothing is said about firmware.
    Firmware,
    /// The values of one of the two cannot be laid out, so that nothing is said about stored parameters.
    Stored,
}

impl Difference {
    /// All changes.
    pub fn changes(&self) -> impl Iterator<Item = &Change> {
        self.system.iter().chain(self.devices.iter().flat_map(|device| &device.changes))
    }

    /// The heaviest consequence; `None` where nothing differs.
    pub fn class(&self) -> Option<Class> {
        self.changes().map(Change::class).max()
    }
}

/// Compares two systems.
///
/// # Errors
/// It is unknown which device is meant.
pub fn compare(question: &Question<'_>) -> Result<Difference, Unpaired> {
    let &Question { old, new, scope, .. } = question;
    let pairs = pairs::pair(question)?;
    let language = new.language();
    let mut system = relations::system(old, new, scope.is_everything(), language);
    system.extend(pairs.unpaired);
    if scope.is_everything() && question.device.is_none() {
        system.extend(unused::changes(old, new, language));
    }
    let system = change::tidy(system);
    let device = |(before, after): (&Dictionary, &Dictionary)| {
        let vendors = [old.vendor.number, new.vendor.number];
        let devices = Devices { old: before, new: after, vendors, scope, language };
        let (mut changes, unknown) = device_changes(old, new, devices);
        let shared = system.iter().filter(|change| change.place == Place::System);
        let all = changes.iter().chain(shared);
        let proposals = proposal::proposals((old, before), (new, after), scope, all);
        // How a node is set up is no news about its type.
        changes.extend(
            question.nodes.into_iter().flat_map(|(old, new)| node::changes((before, old), (after, new))),
        );
        let changes = change::tidy(changes);
        DeviceDifference { key: after.key.clone(), name: after.name.clone(), changes, proposals, unknown }
    };
    let devices = pairs.pairs.into_iter().map(device).collect();
    Ok(Difference { scope, system, devices })
}

/// Everything that differs in a device, with its consequences.
fn device_changes(old: &System, new: &System, devices: Devices<'_>) -> (Vec<Change>, Vec<Unknown>) {
    let mut changes = devices.device();
    changes.extend(devices.objects());
    changes.extend(devices.further());
    let mut unknown = Vec::new();
    if devices.scope.is_everything() {
        let meanings = |names| {
            let types = types::changes(devices.old, devices.new, names, devices.language);
            types.into_iter().chain(Systems { old, new, devices, names }.relations())
        };
        changes.extend(units::changes(devices.old, devices.new, devices.language));
        // Planning the code takes longer than all the rest.
        let is_same = changes.is_empty() && meanings(Names::Nowhere).next().is_none();
        if is_same && devices.old.key == devices.new.key {
            return (changes, unknown);
        }
        match (Code::of(old, devices.old), Code::of(new, devices.new)) {
            (Some(before), Some(after)) => {
                code::judge(&before, &after, &devices.new.key, &mut changes);
                changes.extend(meanings(Names::InCode));
            }
            (None, _) | (_, None) => {
                unknown.push(Unknown::Firmware);
                changes.extend(meanings(Names::Nowhere));
            }
        }
        match (Groups::of(devices.old), Groups::of(devices.new)) {
            (Some(before), Some(after)) => stored::judge(&before, &after, &mut changes),
            (None, _) | (_, None) => unknown.push(Unknown::Stored),
        }
    }
    changes.retain(|change| devices.scope.states(change.fact));
    (change::tidy(changes), unknown)
}
