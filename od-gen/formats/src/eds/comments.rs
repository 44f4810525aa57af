//! What EDS keys cannot say: units, meanings, bits, storage, locks. Facts are worded by [`od_spec::wording`].

use od_spec::Commissioning;
use od_spec::model::{
    BitField, BitUsage, Dictionary, Entry, EntryId, Fact, Index, Object, Storage, Text, TypeKind,
};
use od_spec::wording::{Notation, Wording};

use super::withheld::Withheld;

/// Enums and bit fields up to this many members are listed.
const MOST_MEMBERS: usize = 40;

const WORDING: Wording = Wording::english(Notation::Eds);

/// Above a locked entry that is set all the same. What reads the file back takes it for no lock, as the keys show none.
const LIFTED: &str =
    "LOCKED PARAMETER, set on request: the device takes it only while it is unlocked for service";

/// What keeps an entry from being written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Lock {
    /// Nothing.
    None,
    /// The service lock.
    Closed,
    /// Nothing in the file of a node for which the lock was lifted.
    Lifted,
}

impl Lock {
    /// The lock of an entry, for a device of the type or as one node is set up.
    fn of(index: Index, entry: &Entry, node: Option<&Commissioning>) -> Self {
        let id = EntryId { index, sub: entry.sub };
        match node {
            _ if !entry.locked => Self::None,
            Some(node) if node.unlocked.contains(&id) => Self::Lifted,
            Some(_) | None => Self::Closed,
        }
    }

    /// What is said above an entry whose lock was lifted.
    fn lifted(self) -> Option<String> {
        (self == Self::Lifted).then(|| LIFTED.to_owned())
    }
}

/// After the name of a value that the device does not support.
pub(crate) const NOT_SUPPORTED: &str = " (not supported)";

/// Comments above an object's section.
pub(crate) fn object(object: &Object, language: &str) -> Vec<String> {
    warning(&object.warning, language)
        .into_iter()
        .chain(object.about.get(language).map(ToOwned::to_owned))
        .collect()
}

/// Comments above an entry's section.
pub(super) fn entry(
    device: &Dictionary,
    index: Index,
    entry: &Entry,
    node: Option<&Commissioning>,
    language: &str,
) -> Vec<String> {
    let lock = Lock::of(index, entry, node);
    let mut lines: Vec<String> = lock.lifted().into_iter().collect();
    lines.extend(texts(entry, language));
    lines.extend(joined(facts(device, index, entry, lock)));
    lines.extend(entry.special.iter().map(|special| WORDING.special(entry, special)));
    match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) if values.len() <= MOST_MEMBERS => {
            lines.extend(values.iter().map(|value| {
                let support = if value.supported { "" } else { NOT_SUPPORTED };
                format!("{}: {}{support}", WORDING.enum_number(entry.data_type, value.value), value.name)
            }));
        }
        Some(TypeKind::Bits(fields)) if fields.len() <= MOST_MEMBERS => {
            lines.extend(fields.iter().filter_map(bits));
        }
        Some(TypeKind::Enum(_) | TypeKind::Bits(_)) | None => {}
    }
    lines
}

/// What is to be said about an entry where its unit and its named values have a place of their own.
pub(crate) fn beyond_values(
    device: &Dictionary,
    index: Index,
    entry: &Entry,
    node: Option<&Commissioning>,
    language: &str,
) -> Vec<String> {
    let lock = Lock::of(index, entry, node);
    let mut lines: Vec<String> = lock.lifted().into_iter().collect();
    lines.extend(texts(entry, language));
    let unit = unit(entry);
    lines.extend(joined(
        facts(device, index, entry, lock).into_iter().filter(|fact| unit.as_ref() != Some(fact)).collect(),
    ));
    if let Some(TypeKind::Bits(fields)) = entry.named_type.as_ref().map(|named| &named.kind) {
        lines.extend(fields.iter().filter_map(bits));
    }
    lines
}

/// The words for people.
fn texts(entry: &Entry, language: &str) -> Vec<String> {
    let about = entry.about.get(language).map(ToOwned::to_owned);
    warning(&entry.warning, language).into_iter().chain(about).collect()
}

fn unit(entry: &Entry) -> Option<String> {
    entry.unit.as_ref().map(|unit| format!("unit {}", WORDING.step(unit)))
}

fn joined(facts: Vec<String>) -> Option<String> {
    facts.into_iter().reduce(|line, fact| line + "; " + &fact)
}

/// The danger that comes from an object or entry.
fn warning(warning: &Text, language: &str) -> Option<String> {
    warning.get(language).map(|warning| format!("Warning: {warning}"))
}

/// Unit, alias, storage and the like.
fn facts(device: &Dictionary, index: Index, entry: &Entry, lock: Lock) -> Vec<String> {
    let mut facts: Vec<String> = unit(entry).into_iter().collect();
    if let Some(alias) = &entry.alias {
        facts.push(format!("view of {}", target(device, alias.target)));
    }
    if lock == Lock::Closed {
        facts.push("writable only when unlocked for service".to_owned());
    }
    if entry.stored != Storage::No {
        facts.push(WORDING.storage(entry.stored).to_owned());
    }
    if let Some(condition) = &entry.writable_when {
        facts.push(format!("writable only while {}", condition.text_without_device(&device.key)));
    }
    // The keys hold limits that are widened to take in the special values.
    if entry.hull() != (entry.low, entry.high)
        && let Some(range) = WORDING.range(index, entry)
    {
        facts.push(format!("range {range}, or a special value"));
    }
    if let Some((default, why)) = entry.default.as_ref().zip(Withheld::of(entry)) {
        let what = match why {
            _ if entry.is_only_standard(Fact::Default) => "default of the standard",
            Withheld::Standard | Withheld::Kept => "factory default",
            Withheld::NoPromise => "start value",
        };
        facts.push(format!("{what} {}", WORDING.value(Some(index), entry, default)));
    }
    facts
}

/// The name of the entry that an alias shows.
fn target(device: &Dictionary, id: EntryId) -> String {
    device.entry_name(id).unwrap_or_else(|| id.to_string())
}

fn bits(field: &BitField) -> Option<String> {
    // One that means something only in some modes has no name of its own.
    if field.usage != BitUsage::Used || field.name.is_empty() {
        return None;
    }
    Some(if field.first == field.last {
        format!("bit {}: {}", field.first, field.name)
    } else {
        format!("bits {}..{}: {}", field.first, field.last, field.name)
    })
}
