//! Tables of objects, entries, bits and values.

use std::collections::BTreeSet;

use od_spec::model::{Access, BitUsage, Edge, Entry, EntryId, ModeMeaning, Object, Ratio, Storage, TypeKind};

use super::cells::{access, default, flat, mapping, pattern, range};
use crate::markdown::Table;

/// Compares one row of a detail table with an entry.
pub(super) fn check_entry(table: &Table, row: &[String], object: &Object, entry: &Entry) {
    let at = EntryId { index: object.index, sub: entry.sub };
    assert_eq!(table.cell(row, "Name"), entry.name, "{at}");
    assert_eq!(table.cell(row, "Type"), entry.data_type.name(), "{at}");
    let shown = access(table.cell(row, "Attr"));
    let rw = matches!(entry.access, Access::Rw | Access::Rwr | Access::Rww);
    let shown_access = if entry.locked && rw { Access::Rw } else { entry.access };
    assert_eq!(shown, (shown_access, entry.locked), "{at}");
    assert_eq!(mapping(table.cell(row, "Map")), entry.pdo, "{at}");
    assert_eq!(default(entry, table.cell(row, "Default")), entry.default, "{at}");
    let unit = entry.unit.as_ref().map_or(String::new(), |unit| {
        let space = if unit.symbol == "°" { "" } else { " " };
        if unit.scale == Ratio::ONE {
            unit.symbol.clone()
        } else {
            format!("{}{space}{}", unit.scale, unit.symbol)
        }
    });
    assert_eq!(table.cell(row, "Unit"), unit, "{at}");
    // Limits of an enum are its values; a limit that the type has anyhow is not one.
    if !matches!(entry.named_type.as_ref().map(|named| &named.kind), Some(TypeKind::Enum(_))) {
        let shown = range(entry, table.cell(row, "Range"));
        let of_type = entry.data_type.range();
        let limits = |limit: Option<i128>, shown: Option<i128>, end: Option<i128>| {
            assert!(shown == limit || (shown.is_none() && limit == end), "{at}: {shown:?}, not {limit:?}");
        };
        limits(entry.low, shown.0, of_type.map(|(low, _)| low));
        limits(entry.high, shown.1, of_type.map(|(_, high)| high));
    }
    let description = table.cell(row, "Description");
    assert!(description.starts_with(&flat(entry.about.get("en").unwrap_or_default())), "{at}: {description}");
    for special in &entry.special {
        let says_it = |line: &str| {
            let rest = line.split_once(": ").filter(|(_, rest)| rest.starts_with(&special.name));
            rest.is_some_and(|(shown, _)| {
                pattern(entry, shown).or_else(|| shown.parse().ok()) == Some(special.value)
            })
        };
        assert!(description.lines().any(says_it), "{at}: {}: {description}", special.name);
    }
    if let Some(alias) = &entry.alias {
        assert!(description.contains(&format!("View of {}", alias.target)), "{at}: {description}");
    }
    assert_eq!(
        description.contains("Writable while: "),
        entry.writable_when.is_some(),
        "{at}: {description}"
    );
}

/// Compares an overview row with one of the objects of its index.
pub(super) fn check_overview(table: &Table, row: &[String], object: &Object) {
    let index = object.index;
    assert_eq!(table.cell(row, "Object"), object.kind.name(), "{index}");
    assert_eq!(table.cell(row, "Name"), object.name, "{index}");
    let entries = if object.is_structured() { &object.entries[1..] } else { &object.entries[..] };
    let types: BTreeSet<&str> = table.cell(row, "Type").split(", ").collect();
    assert_eq!(types, entries.iter().map(|entry| entry.data_type.name()).collect(), "{index}");
    let shown: BTreeSet<(Access, bool)> = table.cell(row, "Attr").split(", ").map(access).collect();
    assert_eq!(shown, entries.iter().map(|entry| (entry.access, entry.locked)).collect(), "{index}");
    let stored = object.entries.iter().any(|entry| entry.stored != Storage::No);
    assert_eq!(table.cell(row, "Mem."), if stored { "Y" } else { "N" }, "{index}");
}

pub(super) fn check_bits(table: &Table, kind: &TypeKind, masks: Option<u8>) {
    let TypeKind::Bits(fields) = kind else { panic!("bits") };
    assert_eq!(table.rows.len(), fields.len());
    for (row, field) in table.rows.iter().zip(fields) {
        let bits = if field.first == field.last {
            field.first.to_string()
        } else {
            format!("{}..{}", field.first, field.last)
        };
        assert_eq!(table.cell(row, "Bit"), bits);
        if let Some(width) = masks {
            let digits = usize::from(width) / 4;
            let mask: u128 = (field.first..=field.last).map(|bit| 1 << bit).sum();
            let has_meaning = field.usage == BitUsage::Used || field.first == field.last;
            let expected = match (field.last < width, has_meaning) {
                (true, true) => format!("{mask:0digits$X}h"),
                (true, false) => String::new(),
                (false, _) => "-".to_owned(),
            };
            assert_eq!(table.cell(row, "Mask"), expected, "{bits}");
        }
        let name = match field.usage {
            BitUsage::Used => field.name.as_str(),
            BitUsage::Reserved => "reserved",
            BitUsage::Unused => "free",
        };
        assert_eq!(table.cell(row, "Name"), name);
        assert_eq!(table.cell(row, "Short"), field.mnemonic.as_deref().unwrap_or_default(), "{name}");
        let meaning = table.cell(row, "Meaning");
        assert!(meaning.starts_with(&flat(field.about.get("en").unwrap_or_default())), "{meaning}");
        for value in &field.values {
            assert!(meaning.contains(&format!("{} = {}", value.value, value.name)), "{meaning}");
        }
        for ModeMeaning { mode, name, .. } in &field.modes {
            assert!(meaning.contains(&format!("{}: {name}", mode.value)), "{meaning}");
        }
        let active = match (field.edge, field.active) {
            (Some(Edge::Rising), _) => "0→1",
            (Some(Edge::Falling), _) => "1→0",
            (Some(Edge::Both), _) => "0↔1",
            (None, 0) => "0",
            (None, _) => "",
        };
        assert_eq!(table.cell(row, "Active"), active, "{name}");
        assert_eq!(table.cell(row, "Clamp"), field.clamp.as_deref().unwrap_or_default(), "{name}");
        assert_eq!(table.cell(row, "Prio."), field.priority.as_deref().unwrap_or_default(), "{name}");
        let codes = table.cell(row, "Error code").lines().next().unwrap_or_default();
        let listed: Vec<String> = field.error_codes().map(|code| format!("{code:04X}h")).collect();
        assert!(codes == listed.join(", ") || (listed.is_empty() && codes.contains(": ")), "{name}: {codes}");
    }
}

pub(super) fn check_values(table: &Table, kind: &TypeKind, order: &[i128]) {
    let TypeKind::Enum(values) = kind else { panic!("values") };
    assert_eq!(table.rows.len(), values.len());
    let shown: Vec<i128> = table
        .rows
        .iter()
        .map(|row| table.cell(row, "Value").split(' ').next().unwrap().parse().unwrap())
        .collect();
    let ascending: Vec<i128> = values.iter().map(|value| value.value).collect();
    assert_eq!(shown, if order.is_empty() { ascending } else { order.to_vec() });
    for (row, number) in table.rows.iter().zip(shown) {
        let value = values.of(number).unwrap();
        assert_eq!(table.cell(row, "Name"), value.name);
        assert_eq!(table.cell(row, "Meaning"), flat(value.about.get("en").unwrap_or_default()));
        assert_eq!(table.cell(row, "Supported"), if value.supported { "" } else { "no" });
    }
}
