//! Entries and objects, by name or by index, with their facts.

use lsp_types::CompletionItemKind;
use od_spec::SettingNames;
use od_spec::model::{DataType, Dictionary, Direction, Entry, EntryId, Object, PdoMapping, System};
use od_spec::names::Step;
use od_spec::order::Arrange as _;

use super::items::{Insert, Offer, Written};
use super::{MARK, Wanted};
use crate::hover::Words;

/// Entries that can be written there: in a PDO those that can be mapped in its direction.
pub(super) fn entries(wanted: &Wanted<'_>, written: &Written) -> Vec<Offer> {
    let direction = mapped_in(wanted);
    let fits = |entry: &Entry| match direction {
        None => true,
        Some(Direction::Receive) => matches!(entry.pdo, PdoMapping::Receive | PdoMapping::Both),
        Some(Direction::Transmit) => matches!(entry.pdo, PdoMapping::Transmit | PdoMapping::Both),
    };
    let mut offers = references(wanted, &written.before, fits);
    if direction == Some(Direction::Receive) {
        let dummies = DataType::ALL.into_iter().filter(|data_type| data_type.is_dummy());
        offers.extend(dummies.map(|data_type| {
            Offer::word(data_type.name(), CompletionItemKind::KEYWORD).detail("placeholder").rank(7)
        }));
    }
    offers
}

/// The direction of the PDO whose map is around.
fn mapped_in(wanted: &Wanted<'_>) -> Option<Direction> {
    let keys: Vec<&str> = wanted
        .place
        .path
        .iter()
        .filter_map(|step| match step {
            Step::Key { key, .. } => Some(key.name),
            Step::Data { .. } | Step::Item { .. } => None,
        })
        .collect();
    match keys.as_slice() {
        ["pdos", direction, "map"] => {
            [Direction::Receive, Direction::Transmit].into_iter().find(|one| one.word() == *direction)
        }
        _ => None,
    }
}

/// Entries of the devices that the place speaks of: by index where an index has been begun or nothing, by name elsewhere.
fn references(wanted: &Wanted<'_>, before: &str, fits: impl Fn(&Entry) -> bool) -> Vec<Offer> {
    let Some(system) = wanted.snapshot.system() else { return Vec::new() };
    let keys = wanted.place.devices();
    let devices =
        system.devices.iter().filter(|device| keys.is_empty() || keys.contains(&device.key.as_str()));
    let by_index = before.is_empty() || before.starts_with('0');
    let mut offers: Vec<Offer> = Vec::new();
    let mut seen = std::collections::BTreeSet::new();
    for device in devices {
        let names = SettingNames::of(device);
        for (id, object, entry) in device.entries() {
            // How many elements there are is hardly ever meant.
            if object.is_structured() && id.sub.0 == 0 || !fits(entry) {
                continue;
            }
            let name = name_of(device, &names, id);
            let number = reference(object, id);
            if !seen.insert((number.clone(), name.clone())) {
                continue;
            }
            let facts = facts(entry, system);
            offers.push(if by_index {
                Offer::word(&number, CompletionItemKind::FIELD).detail(format!("{name} {facts}"))
            } else {
                Offer::name(&name, CompletionItemKind::FIELD).detail(format!("{number} {facts}"))
            });
        }
    }
    offers
}

/// The name of an entry; a name that several have leads to none of them.
pub(super) fn name_of(device: &Dictionary, names: &SettingNames<'_>, id: EntryId) -> String {
    let name = device.entry_name(id).filter(|name| names.instead(name).is_empty());
    name.or_else(|| device.entry_label(id)).unwrap_or_default()
}

/// `0x6041`, `0x30FA.3`.
pub(super) fn reference(object: &Object, id: EntryId) -> String {
    if object.is_structured() { format!("{}.{}", id.index.notation(), id.sub) } else { id.index.notation() }
}

/// Type, unit and access.
pub(super) fn facts(entry: &Entry, system: &System) -> String {
    let words = Words::of(Some(system));
    let unit = entry.unit.as_ref().map(|unit| format!(", {}", words.wording.step(unit)));
    format!("{}{}, {}", entry.data_type, unit.unwrap_or_default(), words.wording.access(entry))
}

/// Objects by index.
pub(super) fn objects(wanted: &Wanted<'_>) -> Vec<Offer> {
    let Some(system) = wanted.snapshot.system() else { return Vec::new() };
    let mut objects: Vec<&Object> =
        system.devices.iter().flat_map(|device: &Dictionary| device.objects.values()).collect();
    objects.arrange_by_key(|object| object.index);
    objects.dedup_by(|one, other| one.index == other.index && one.name == other.name);
    let offer = |object: &Object| {
        let label = object.index.notation();
        Offer::word(&label, CompletionItemKind::STRUCT).detail(format!(
            "{} {}",
            object.name,
            object.kind.name()
        ))
    };
    objects.into_iter().map(offer).collect()
}

/// What may go on in a condition: an entry, a bit, `and` and `or`; only the word at the cursor is replaced.
pub(super) fn condition(wanted: &Wanted<'_>, written: &Written) -> Vec<Offer> {
    let signs = |c: char| "<>=!()+*/,:&|".contains(c);
    let before = written.before.rsplit(signs).next().unwrap_or_default();
    let before = [" and ", " or "]
        .iter()
        .fold(before, |rest, word| rest.rsplit(word).next().unwrap_or(rest))
        .trim_start();
    let kept = &written.before[..written.before.len() - before.len()];
    let after = &written.after[word_length(&written.after)..];
    let mut offers = references(wanted, before, |_| true);
    offers
        .push(Offer::word("bit(", CompletionItemKind::FUNCTION).detail("bit(entry, number or name)").rank(6));
    offers
        .into_iter()
        .map(|offer| {
            let (Insert::Scalar(text) | Insert::Raw(text) | Insert::Snippet(text)) = &offer.insert;
            // The whole condition is one scalar, and may need quotes then.
            let whole = format!("{kept}{text}{after}");
            Offer { insert: Insert::Scalar(whole), kept: kept.to_owned(), ..offer }
        })
        .collect()
}

/// How much of a text is the rest of a word.
fn word_length(text: &str) -> usize {
    text.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '.' | '-') || c == MARK))
        .unwrap_or(text.len())
}
