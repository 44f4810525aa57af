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

/// Comments above an object's section.
pub(super) fn object(object: &Object, language: &str) -> Vec<String> {
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
    let id = EntryId { index, sub: entry.sub };
    let lock = match node {
        _ if !entry.locked => Lock::None,
        Some(node) if node.unlocked.contains(&id) => Lock::Lifted,
        Some(_) | None => Lock::Closed,
    };
    let mut lines: Vec<String> = Vec::new();
    if lock == Lock::Lifted {
        lines.push(LIFTED.to_owned());
    }
    lines.extend(warning(&entry.warning, language));
    lines.extend(entry.about.get(language).map(ToOwned::to_owned));
    lines.extend(facts(device, index, entry, lock));
    lines.extend(entry.special.iter().map(|special| WORDING.special(entry, special)));
    match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) if values.len() <= MOST_MEMBERS => {
            lines.extend(values.iter().map(|value| {
                let support = if value.supported { "" } else { " (not supported)" };
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

/// The danger that comes from an object or entry.
fn warning(warning: &Text, language: &str) -> Option<String> {
    warning.get(language).map(|warning| format!("Warning: {warning}"))
}

/// Unit, alias, storage and the like, in one line.
fn facts(device: &Dictionary, index: Index, entry: &Entry, lock: Lock) -> Option<String> {
    let mut facts = Vec::new();
    if let Some(unit) = &entry.unit {
        facts.push(format!("unit {}", WORDING.step(unit)));
    }
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
    facts.into_iter().reduce(|line, fact| line + "; " + &fact)
}

/// The name of the entry that an alias shows.
fn target(device: &Dictionary, id: EntryId) -> String {
    device.entry_name(id).unwrap_or_else(|| id.to_string())
}

fn bits(field: &BitField) -> Option<String> {
    if field.usage != BitUsage::Used {
        return None;
    }
    Some(if field.first == field.last {
        format!("bit {}: {}", field.first, field.name)
    } else {
        format!("bits {}..{}: {}", field.first, field.last, field.name)
    })
}
