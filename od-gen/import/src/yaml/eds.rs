//! What an EDS shows of an entry, and the keys for what does not follow.

use od_spec::model::{Access, Dictionary, Entry, PdoMapping, Storage};

use super::node::{Item, Node};

/// Which defaults the EDS withholds unless an entry says otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EdsDefaults {
    /// Those of writable entries that are locked or stored.
    Safe,
    /// None.
    All,
}

/// The policy of the device from which fewer of its entries differ.
pub(super) fn fewest_exceptions(device: &Dictionary) -> EdsDefaults {
    let exceptions = |defaults| {
        let entries = device.entries().filter(|(.., entry)| entry.default.is_some());
        entries.filter(|(.., entry)| entry.eds.default != default_shown(entry, defaults)).count()
    };
    if exceptions(EdsDefaults::Safe) < exceptions(EdsDefaults::All) {
        EdsDefaults::Safe
    } else {
        EdsDefaults::All
    }
}

/// Whether the EDS shows a default where nothing is said about that.
pub(super) fn default_shown(entry: &Entry, defaults: EdsDefaults) -> bool {
    let kept = entry.locked
        || matches!(entry.stored, Storage::Application | Storage::Manufacturer | Storage::Remanent);
    match defaults {
        EdsDefaults::All => true,
        EdsDefaults::Safe => !(kept && entry.access.is_writable()),
    }
}

/// The access that the EDS shows where nothing is said about that.
fn eds_access(entry: &Entry) -> Access {
    match (entry.access, entry.pdo) {
        _ if entry.locked && entry.access.is_readable() => Access::Ro,
        (Access::Rw, PdoMapping::Receive) => Access::Rww,
        (Access::Rw, PdoMapping::Transmit) => Access::Rwr,
        (access, _) => access,
    }
}

/// Lets the EDS show what follows from the entry.
pub(super) fn forget(entry: &mut Entry) {
    entry.eds.access = eds_access(entry);
    entry.eds.default = true;
    entry.eds.no_write = entry.locked;
    entry.eds.no_scan = false;
}

/// Lets the EDS show what follows from an entry where a specification says nothing about that; `false` if it does so
/// already.
pub fn follow(entry: &mut Entry) -> bool {
    let mut before = entry.eds;
    forget(entry);
    entry.eds.default = default_shown(entry, EdsDefaults::Safe);
    if entry.default.is_none() {
        // There is nothing to withhold.
        before.default = entry.eds.default;
    }
    entry.eds != before
}

/// Where the EDS shows something else than follows from the entry.
pub(super) fn keys(entry: &Entry, defaults: EdsDefaults) -> Vec<Item> {
    let mut items = Vec::new();
    if entry.default.is_some() && entry.eds.default != default_shown(entry, defaults) {
        let word = if entry.eds.default { "written" } else { "withheld" };
        items.push(Item::new("default", Node::plain(word)));
    }
    if entry.eds.access != eds_access(entry) {
        items.push(Item::new("access", Node::plain(entry.eds.access.word())));
    }
    let flags = [(entry.eds.no_write && !entry.locked, "no-write"), (entry.eds.no_scan, "no-scan")];
    let flags: Vec<Node> =
        flags.into_iter().filter(|(set, _)| *set).map(|(_, flag)| Node::plain(flag)).collect();
    if !flags.is_empty() {
        items.push(Item::new("flags", Node::List(flags)));
    }
    items
}
