//! Parameter files and plants: the entries of a device that can be set, and their values; devices, positions and types of a plant.

use lsp_types::CompletionItemKind;
use od_spec::SettingNames;
use od_spec::keys::{KeyKind, PLANT_MACHINE, SITE};
use od_spec::model::{DataType, Entry, EntryId};
use od_spec::names::{SettingOf, Step};
use od_spec::yaml::Node;

use super::items::{Insert, Offer, Written};
use super::{MARK, Wanted, entries, names};

/// Keys that are data: entries under `parameters:`, devices, and positions. `None` in a specification.
pub(super) fn of_keys(
    map: &Node,
    kind: KeyKind,
    written: &Written,
    wanted: &Wanted<'_>,
) -> Option<Vec<Offer>> {
    let is_there = |key: &str| map.entries().iter().any(|(name, _)| name.value == key);
    let offers = match (kind, wanted.place.setting()) {
        (KeyKind::DeviceKey, _) => devices_of_plant(wanted),
        (KeyKind::Place, _) => positions(wanted),
        (_, Some(setting)) => entries_of(&setting, written, wanted),
        _ => return None,
    };
    let colon = if written.follows == ':' { "" } else { ": " };
    let keyed = |offer: Offer| {
        let text = match &offer.insert {
            Insert::Scalar(text) => od_import::yaml::spelled(text),
            Insert::Raw(text) | Insert::Snippet(text) => text.clone(),
        };
        Offer { insert: Insert::Raw(format!("{text}{colon}")), goes_on: !colon.is_empty(), ..offer }
    };
    Some(offers.into_iter().filter(|offer| !is_there(&offer.label)).map(keyed).collect())
}

/// The entries of a device that can be set; below an object, those of the object.
fn entries_of(setting: &SettingOf<'_>, written: &Written, wanted: &Wanted<'_>) -> Vec<Offer> {
    let Some((system, device)) = wanted.snapshot.device_of(setting) else { return Vec::new() };
    let object = setting.object(device);
    if object.is_none() && !setting.keys.is_empty() {
        return Vec::new();
    }
    let names = SettingNames::of(device);
    let settable = device.entries().filter(|(id, around, entry)| {
        let is_counter = around.is_structured() && id.sub.0 == 0;
        entry.access.is_writable() && !is_counter && object.is_none_or(|index| index == id.index)
    });
    let by_index = written.before.starts_with(|c: char| c.is_ascii_digit());
    let offer = |(id, around, entry): (EntryId, _, &Entry)| {
        let facts = entries::facts(entry, system);
        if object.is_some() {
            return Offer::name(&entry.name, CompletionItemKind::FIELD).detail(format!("{} {facts}", id.sub));
        }
        let name = entries::name_of(device, &names, id);
        let number = entries::reference(around, id);
        if by_index {
            Offer::word(&number, CompletionItemKind::FIELD).detail(format!("{name} {facts}"))
        } else {
            Offer::name(&name, CompletionItemKind::FIELD).detail(format!("{number} {facts}"))
        }
    };
    settable.map(offer).collect()
}

/// The values of an entry that is set: names, and a number with its unit.
pub(super) fn of_value(written: &Written, wanted: &Wanted<'_>) -> Vec<Offer> {
    let Some(entry) = set(wanted) else { return Vec::new() };
    if entry.data_type == DataType::Boolean {
        return ["0", "1"].iter().map(|bit| Offer::word(bit, CompletionItemKind::VALUE)).collect();
    }
    let mut offers = entry.named_type.as_deref().map(names::of_type).unwrap_or_default();
    let units: Vec<_> = entry.unit.as_deref().into_iter().collect();
    offers.extend(names::with_units(written, &units));
    offers
}

/// The entry that is set at the place.
fn set<'a>(wanted: &'a Wanted<'_>) -> Option<&'a Entry> {
    let setting = wanted.place.setting()?;
    let (_, device) = wanted.snapshot.device_of(&setting)?;
    device.entry(setting.entry(device)?)
}

/// Texts that are names: types of machines, and locked entries.
pub(super) fn of_text(wanted: &Wanted<'_>) -> Vec<Offer> {
    let key = wanted.place.path.iter().rev().find_map(|step| match step {
        Step::Key { keys, key, .. } => Some((keys.name, key.name)),
        Step::Data { .. } | Step::Item { .. } => None,
    });
    match key {
        Some((of, "type")) if of == SITE.name || of == PLANT_MACHINE.name => {
            words(wanted.tree.get("types").map(Node::entries).unwrap_or_default(), CompletionItemKind::CLASS)
        }
        Some((_, "unlock")) => {
            let device = wanted.place.path.iter().rev().find_map(|step| match step {
                Step::Data { kind: KeyKind::DeviceKey, name, .. } => Some(name.value.as_str()),
                Step::Data { .. } | Step::Key { .. } | Step::Item { .. } => None,
            });
            locked(wanted, device.unwrap_or_default())
        }
        _ => Vec::new(),
    }
}

/// The locked entries of a device.
fn locked(wanted: &Wanted<'_>, device: &str) -> Vec<Offer> {
    let Some(device) = wanted.snapshot.device_called(device).map(|(_, device)| device) else {
        return Vec::new();
    };
    let names = SettingNames::of(device);
    let locked = device.entries().filter(|(.., entry)| entry.locked);
    let name = |id| entries::name_of(device, &names, id);
    locked.map(|(id, ..)| Offer::name(&name(id), CompletionItemKind::FIELD).detail(id.to_string())).collect()
}

type Pairs = [(od_spec::source::Spanned<String>, Node)];

fn words(pairs: &Pairs, kind: CompletionItemKind) -> Vec<Offer> {
    let names = pairs.iter().map(|(name, _)| name.value.as_str()).filter(|name| !name.contains(MARK));
    names.map(|name| Offer::name(name, kind)).collect()
}

/// The devices of the plant; none where it defines them.
fn devices_of_plant(wanted: &Wanted<'_>) -> Vec<Offer> {
    match wanted.place.path.as_slice() {
        [Step::Key { key, .. }] if key.name == "devices" => Vec::new(),
        _ => words(
            wanted.tree.get("devices").map(Node::entries).unwrap_or_default(),
            CompletionItemKind::MODULE,
        ),
    }
}

/// The positions of all types; none where a type defines them.
fn positions(wanted: &Wanted<'_>) -> Vec<Offer> {
    let is_level = matches!(wanted.place.path.first(), Some(Step::Key { key, .. }) if key.name == "sites");
    let is_position =
        matches!(wanted.place.path.last(), Some(Step::Key { key, .. }) if key.name == "positions");
    if !is_level || !is_position {
        return Vec::new();
    }
    let types = wanted.tree.get("types").map(Node::entries).unwrap_or_default();
    let mut offers: Vec<Offer> = Vec::new();
    for positions in types.iter().filter_map(|(_, one)| one.get("positions")) {
        for offer in words(positions.entries(), CompletionItemKind::REFERENCE) {
            if !offers.iter().any(|known| known.label == offer.label) {
                offers.push(offer);
            }
        }
    }
    offers
}
