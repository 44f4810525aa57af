//! What EDS keys cannot say: units, meanings, bits, storage, locks.

use od_spec::model::{BitField, BitUsage, Dictionary, Entry, Fact, Object, Storage, TypeKind, format_value};

/// Enums and bit fields up to this many members are listed.
const MOST_MEMBERS: usize = 40;

/// Comments above an object's section.
pub(super) fn object(object: &Object, language: &str) -> Vec<String> {
    object.about.get(language).map(ToOwned::to_owned).into_iter().collect()
}

/// Comments above an entry's section.
pub(super) fn entry(device: &Dictionary, entry: &Entry, language: &str) -> Vec<String> {
    let mut lines: Vec<String> = entry.about.get(language).map(ToOwned::to_owned).into_iter().collect();
    lines.extend(facts(device, entry));
    let is_bits = matches!(entry.named_type.as_ref().map(|named| &named.kind), Some(TypeKind::Bits(_)));
    for special in &entry.special {
        let value = if is_bits { format!("{:X}h", special.value) } else { special.value.to_string() };
        lines.push(format!("{value}: {}", special.name));
    }
    match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) if values.len() <= MOST_MEMBERS => {
            lines.extend(values.iter().map(|value| {
                let support = if value.supported { "" } else { " (not supported)" };
                format!("{}: {}{support}", value.value, value.name)
            }));
        }
        Some(TypeKind::Bits(fields)) if fields.len() <= MOST_MEMBERS => {
            lines.extend(fields.iter().filter_map(bits));
        }
        _ => {}
    }
    lines
}

/// Unit, alias, storage and the like, in one line.
fn facts(device: &Dictionary, entry: &Entry) -> Option<String> {
    let mut facts = Vec::new();
    if let Some(unit) = &entry.unit {
        facts.push(format!("unit {}", unit.step_text()));
    }
    if let Some(alias) = &entry.alias {
        facts.push(format!(
            "view of {}",
            device.entry_name(alias.target).unwrap_or_else(|| alias.target.to_string())
        ));
    }
    if entry.locked {
        facts.push("writable only when unlocked for service".to_owned());
    }
    match entry.stored {
        Storage::No => {}
        Storage::Remanent => facts.push("kept over power-off".to_owned()),
        stored => facts.push(format!("stored with the {} parameters", stored.word())),
    }
    if let Some(condition) = &entry.writable_when {
        facts.push(format!("writable only while {}", condition.text));
    }
    if let (Some(default), false) = (&entry.default, entry.eds.default) {
        let whose =
            if entry.is_only_standard(Fact::Default) { "default of the standard" } else { "factory default" };
        let shown = format_value(entry, default);
        facts.push(format!("{whose} {}", if shown.is_empty() { "an empty text" } else { &shown }));
    }
    (!facts.is_empty()).then(|| facts.join("; "))
}

fn bits(field: &BitField) -> Option<String> {
    if field.usage != BitUsage::Used {
        return None;
    }
    let position = if field.first == field.last {
        format!("bit {}", field.first)
    } else {
        format!("bits {}..{}", field.first, field.last)
    };
    Some(format!("{position}: {}", field.name))
}
