//! The tables of a device.

use std::collections::BTreeMap;
use std::sync::Arc;

use od_import::yaml::value_text;
use od_spec::model::{
    BitField, BitUsage, DataType, Dictionary, Direction, Entry, EntryId, Fact, Family, Index, NamedType,
    Object, PdoMapping, PdoTarget, Ratio, Storage, SubIndex, System, Text, TypeKind, Unit, Value as Raw,
};

use super::{Table, Value};
use crate::columns::Column;
use crate::spelling::{Language, is_nothing, number, of_node_id};

/// Whole numbers up to this one are exact in a spreadsheet, which counts in floating point.
const LARGEST: i64 = 1 << 53;

/// All tables that have a row. `system` and `device` have nothing that tables do not hold.
pub(super) fn tables(system: &System, device: &Dictionary) -> Vec<Table> {
    let mut types: BTreeMap<&str, &Arc<NamedType>> = BTreeMap::new();
    let mut units: BTreeMap<&str, &Arc<Unit>> = BTreeMap::new();
    for (.., entry) in device.entries() {
        types.extend(entry.named_type.as_ref().map(|named| (named.name.as_str(), named)));
        units.extend(entry.unit.as_ref().map(|unit| (unit.name.as_str(), unit)));
    }
    let mut tables = vec![
        objects(system, device),
        self::types(system, &types),
        bits(system, &types),
        values(system, &types),
        self::units(system, &units),
        pdos(device),
        errors(system),
        self::device(system, device),
    ];
    tables.retain(|table| !table.rows.is_empty());
    tables
}

fn text(text: impl Into<String>) -> Value {
    Value::Text(text.into())
}

const fn empty() -> Value {
    Value::Text(String::new())
}

fn numbered(number: impl Into<i64>) -> Value {
    Value::Number(number.into())
}

/// A cell of values: a number where a spreadsheet keeps it exactly.
fn value(of: String) -> Value {
    match of.parse::<i64>() {
        Ok(number) if number.abs() <= LARGEST && number.to_string() == of => Value::Number(number),
        Ok(_) | Err(_) => text(of),
    }
}

/// The languages of the columns of descriptions: the first without its code.
fn titles_of(system: &System, title: &str) -> Vec<String> {
    let further = system.languages.iter().skip(1).map(|code| format!("{title} ({code})"));
    std::iter::once(title.to_owned()).chain(further).collect()
}

/// A text in the languages of the system.
fn in_languages(system: &System, of: &Text) -> Vec<Value> {
    let in_language =
        |code: &String| of.iter().find(|(language, _)| language == code).map_or("", |(_, text)| text);
    system.languages.iter().map(|code| text(in_language(code))).collect()
}

/// A table without the columns that are empty in every row, except those that it needs.
fn without_empty(mut table: Table, needed: usize) -> Table {
    let kept: Vec<bool> = (0..table.titles.len())
        .map(|at| {
            at < needed || table.rows.iter().any(|row| row.get(at).is_some_and(|cell| !cell.is_empty()))
        })
        .collect();
    let keep = |list: &mut Vec<Value>| {
        let mut kept = kept.iter();
        list.retain(|_| *kept.next().unwrap_or(&false));
    };
    table.rows.iter_mut().for_each(keep);
    let mut kept = kept.iter();
    table.titles.retain(|_| *kept.next().unwrap_or(&false));
    table
}

/// Columns of facts that few entries have.
const RARE: [(Column, Fact); 7] = [
    (Column::Special, Fact::Special),
    (Column::Storage, Fact::Storage),
    (Column::Capacity, Fact::Capacity),
    (Column::Category, Fact::Category),
    (Column::Since, Fact::Since),
    (Column::Condition, Fact::WriteCondition),
    (Column::Identifier, Fact::Identifier),
];

fn objects(system: &System, device: &Dictionary) -> Table {
    let columns = [
        Column::Index,
        Column::Sub,
        Column::Kind,
        Column::Name,
        Column::Type,
        Column::List,
        Column::Access,
        Column::Mapping,
        Column::Default,
        Column::Low,
        Column::High,
        Column::Unit,
    ];
    let rare = RARE.map(|(column, _)| column);
    let mut titles: Vec<String> =
        columns.into_iter().chain(rare).map(|column| column.title().to_owned()).collect();
    let needed = columns.len();
    for column in [Column::Description, Column::Warning] {
        titles.extend(titles_of(system, column.title()));
    }
    let mut rows = Vec::new();
    for object in device.objects.values() {
        if object.is_structured() {
            rows.push(of_object(system, object));
        }
        rows.extend(object.entries.iter().map(|entry| of_entry(system, object, entry)));
    }
    without_empty(Table { name: "Objects", titles, rows }, needed)
}

fn of_object(system: &System, object: &Object) -> Vec<Value> {
    let mut row =
        vec![text(object.index.to_string()), empty(), text(object.kind.name()), text(object.name.clone())];
    row.resize(12, empty());
    row.extend(RARE.map(|(_, fact)| {
        text(match fact {
            Fact::Category => object.category.map_or("", |category| category.word()).to_owned(),
            Fact::Since => object.since.clone().unwrap_or_default(),
            Fact::Identifier => object.identifier.clone().unwrap_or_default(),
            _ => String::new(),
        })
    }));
    row.extend(in_languages(system, &object.about));
    row.extend(in_languages(system, &object.warning));
    row
}

fn of_entry(system: &System, object: &Object, entry: &Entry) -> Vec<Value> {
    let (sub, kind) = if object.is_structured() {
        (numbered(entry.sub.0), empty())
    } else {
        (empty(), text(object.kind.name()))
    };
    let (low, high) = entry.limits();
    let value_of = |raw: Option<&Raw>| raw.map_or_else(empty, |raw| of_value(object.index, entry, raw));
    let locked = if entry.locked { " locked" } else { "" };
    let mapping = match entry.pdo {
        PdoMapping::None => "no",
        PdoMapping::Receive => "RPDO",
        PdoMapping::Transmit => "TPDO",
        PdoMapping::Both => "RPDO/TPDO",
    };
    let mut row = vec![
        text(object.index.to_string()),
        sub,
        kind,
        text(entry.name.clone()),
        text(entry.data_type.to_string()),
        text(entry.named_type.as_ref().map_or("", |named| named.name.as_str())),
        text(format!("{}{locked}", entry.access.word())),
        text(mapping),
        value_of(entry.default.as_ref()),
        value_of(low.as_ref()),
        value_of(high.as_ref()),
        text(entry.unit.as_ref().map_or("", |unit| unit.name.as_str())),
    ];
    let special: Vec<String> =
        entry.special.iter().map(|special| format!("{}: {}", special.value, special.name)).collect();
    row.extend(RARE.map(|(_, fact)| match fact {
        Fact::Special => text(special.join("\n")),
        Fact::Storage => text(if entry.stored == Storage::No { "" } else { entry.stored.word() }),
        Fact::Capacity => {
            entry.capacity.filter(|_| entry.facts.get(Fact::Capacity).is_some()).map_or_else(empty, numbered)
        }
        Fact::Category => text(entry.category.map_or("", |category| category.word())),
        Fact::Since => text(entry.since.clone().unwrap_or_default()),
        Fact::WriteCondition => text(entry.writable_when.as_ref().map_or("", |when| when.text.as_str())),
        Fact::Identifier => text(entry.identifier.clone().unwrap_or_default()),
        _ => empty(),
    }));
    row.extend(in_languages(system, &entry.about));
    row.extend(in_languages(system, &entry.warning));
    row
}

/// A default or limit. Names that could be taken for something else are numbers, and texts that could be are in quotes.
fn of_value(index: Index, entry: &Entry, raw: &Raw) -> Value {
    let shown = value_text(index, entry, raw);
    match entry.data_type.family() {
        Family::Signed | Family::Unsigned => {
            let is_name = entry.named_type.as_ref().is_some_and(|named| {
                matches!((&named.kind, raw), (TypeKind::Enum(values), Raw::Integer(raw)) if values.of(*raw).is_some())
            });
            let is_doubtful = is_nothing(&shown)
                || number(&shown, Language::English).is_some()
                || of_node_id(&shown).is_some();
            match raw {
                Raw::Integer(raw) if is_name && is_doubtful => value(raw.to_string()),
                _ => value(shown),
            }
        }
        Family::VisibleString | Family::UnicodeString | Family::OctetString => {
            let is_doubtful = is_nothing(&shown) || shown.starts_with('"') || shown.trim() != shown;
            text(if is_doubtful { format!("\"{shown}\"") } else { shown })
        }
        Family::Boolean | Family::Real | Family::Time | Family::Domain => text(shown),
    }
}

/// What types are for, where that is said.
fn types(system: &System, types: &BTreeMap<&str, &Arc<NamedType>>) -> Table {
    let mut titles = vec![Column::List.title().to_owned()];
    titles.extend(titles_of(system, Column::Description.title()));
    let described = types.iter().filter(|(_, named)| !named.about.is_empty());
    let row = |(name, named): (&&str, &&Arc<NamedType>)| {
        let mut row = vec![text(*name)];
        row.extend(in_languages(system, &named.about));
        row
    };
    Table { name: "Types", titles, rows: described.map(row).collect() }
}

fn bits(system: &System, types: &BTreeMap<&str, &Arc<NamedType>>) -> Table {
    let columns = [Column::List, Column::Type, Column::Bit, Column::Name, Column::ErrorCode];
    let mut titles: Vec<String> = columns.map(|column| column.title().to_owned()).into();
    titles.extend(titles_of(system, Column::Description.title()));
    let mut rows = Vec::new();
    for (name, named) in types {
        let TypeKind::Bits(fields) = &named.kind else { continue };
        for field in fields {
            let word = match field.usage {
                BitUsage::Used => field.name.as_str(),
                BitUsage::Reserved => "reserved",
                BitUsage::Unused => "unused",
            };
            let codes: Vec<String> = field.error_codes().map(|code| format!("{code:04X}h")).collect();
            let mut row = vec![
                text(*name),
                text(named.base.to_string()),
                bit_range(field),
                text(word),
                text(codes.join(", ")),
            ];
            row.extend(in_languages(system, &field.about));
            rows.push(row);
        }
    }
    without_empty(Table { name: "Bits", titles, rows }, 4)
}

/// `3`, `4..7`.
fn bit_range(field: &BitField) -> Value {
    if field.first == field.last {
        numbered(field.first)
    } else {
        text(format!("{}..{}", field.first, field.last))
    }
}

fn values(system: &System, types: &BTreeMap<&str, &Arc<NamedType>>) -> Table {
    let columns = [Column::List, Column::Type, Column::Value, Column::Name, Column::Bit, Column::Supported];
    let mut titles: Vec<String> = columns.map(|column| column.title().to_owned()).into();
    titles.extend(titles_of(system, Column::Description.title()));
    let mut rows = Vec::new();
    for (name, named) in types {
        let base = || text(named.base.to_string());
        let mut row = |of: Value, one: &od_spec::model::EnumValue| {
            let supported = text(if one.supported { "" } else { "no" });
            let mut row = vec![
                text(*name),
                base(),
                value(one.value.to_string()),
                text(one.name.clone()),
                of,
                supported,
            ];
            row.extend(in_languages(system, &one.about));
            rows.push(row);
        };
        match &named.kind {
            TypeKind::Enum(values) => values.iter().for_each(|one| row(empty(), one)),
            TypeKind::Bits(fields) => {
                for field in fields {
                    field.values.iter().for_each(|one| row(bit_range(field), one));
                }
            }
        }
    }
    without_empty(Table { name: "Values", titles, rows }, 4)
}

fn units(system: &System, units: &BTreeMap<&str, &Arc<Unit>>) -> Table {
    let columns = [Column::Unit, Column::Symbol, Column::Scale, Column::Offset, Column::Base];
    let mut titles: Vec<String> = columns.map(|column| column.title().to_owned()).into();
    titles.extend(titles_of(system, Column::Description.title()));
    let ratio = |ratio: Ratio| match ratio.to_whole() {
        Some(whole) => whole.to_string(),
        None => format!("{}/{}", ratio.numerator(), ratio.denominator()),
    };
    let row = |(name, unit): (&&str, &&Arc<Unit>)| {
        let base = unit.base.as_ref().map(|base| format!("{} {}", ratio(base.factor), base.symbol));
        let mut row = vec![
            text(*name),
            text(unit.symbol.clone()),
            text(if unit.scale == Ratio::ONE { String::new() } else { ratio(unit.scale) }),
            text(if unit.offset == Ratio::ZERO { String::new() } else { ratio(unit.offset) }),
            text(base.unwrap_or_default()),
        ];
        row.extend(in_languages(system, &unit.about));
        row
    };
    without_empty(Table { name: "Units", titles, rows: units.iter().map(row).collect() }, 3)
}

fn pdos(device: &Dictionary) -> Table {
    let titles = [
        "PDO number",
        "COB-ID",
        "Transmission type",
        "Inhibit time",
        "Event timer",
        "Position",
        "Entry",
        "Name",
        "Bits",
    ];
    without_empty(Table { name: "PDOs", titles: titles.map(str::to_owned).into(), rows: pdo_rows(device) }, 2)
}

/// What the PDOs carry: a row for each mapped entry, or for an empty PDO.
pub(crate) fn pdo_rows(device: &Dictionary) -> Vec<Vec<Value>> {
    let mut rows = Vec::new();
    let shown = |number: Option<u16>| number.map_or_else(empty, numbered);
    for pdo in &device.pdos {
        let word = match pdo.direction {
            Direction::Receive => "RPDO",
            Direction::Transmit => "TPDO",
        };
        let id = EntryId { index: Index(pdo.communication_index()), sub: SubIndex(1) };
        let cob_id = pdo.cob_id.as_ref().zip(device.entry(id));
        let head = [
            text(format!("{word} {}", pdo.number)),
            cob_id.map_or_else(empty, |(cob_id, entry)| text(value_text(id.index, entry, cob_id))),
            shown(pdo.transmission.map(u16::from)),
            shown(pdo.inhibit_time),
            shown(pdo.event_timer),
        ];
        let mapped = (1..).zip(&pdo.map).map(|(position, mapped): (u16, _)| {
            let (entry, name) = match mapped.target {
                PdoTarget::Entry(id) => (id.to_string(), device.entry_name(id).unwrap_or_default()),
                PdoTarget::Dummy(data_type) => (DataType::to_string(&data_type), String::new()),
            };
            [numbered(position), text(entry), text(name), numbered(mapped.bits)]
        });
        let mapped: Vec<[Value; 4]> = mapped.collect();
        if mapped.is_empty() {
            rows.push(head.iter().cloned().chain(std::iter::repeat_n(empty(), 4)).collect());
        }
        rows.extend(mapped.into_iter().map(|mapped| head.iter().cloned().chain(mapped).collect()));
    }
    rows
}

fn errors(system: &System) -> Table {
    let columns = [Column::ErrorCode, Column::Name, Column::Register, Column::Priority];
    let mut titles: Vec<String> = columns.map(|column| column.title().to_owned()).into();
    for column in [Column::Reaction, Column::Reset, Column::Description] {
        titles.extend(titles_of(system, column.title()));
    }
    let rows = system.errors.iter().map(|error| {
        let kinds: Vec<&str> = error.kinds.iter().map(|kind| kind.word()).collect();
        let mut row = vec![
            text(format!("{:04X}h", error.code)),
            text(error.name.clone()),
            text(kinds.join(", ")),
            text(error.priority.clone().unwrap_or_default()),
        ];
        for of in [&error.reaction, &error.reset, &error.about] {
            row.extend(in_languages(system, of));
        }
        row
    });
    without_empty(Table { name: "Errors", titles, rows: rows.collect() }, 2)
}

fn device(system: &System, device: &Dictionary) -> Table {
    let info = &device.info;
    let number = |number: u32| (number != 0).then(|| format!("0x{number:X}"));
    let flag = |flag: bool| Some(if flag { "yes" } else { "no" }.to_owned());
    let list = |list: Vec<String>| (!list.is_empty()).then(|| list.join(", "));
    let rows = [
        ("title", Some(system.title.clone())),
        ("languages", Some(format!("[{}]", system.languages.join(", ")))),
        ("vendor name", Some(system.vendor.name.clone())),
        ("vendor number", number(system.vendor.number)),
        ("key", Some(device.key.clone())),
        ("name", Some(device.name.clone())),
        ("product-name", (info.product_name != device.name).then(|| info.product_name.clone())),
        ("product", number(info.product)),
        ("product-revision", number(info.product_revision)),
        ("order-code", (info.order_code != info.product_name).then(|| info.order_code.clone())),
        ("bit-rates", list(info.bit_rates.iter().map(u16::to_string).collect())),
        ("device-type", number(info.device_type)),
        ("granularity", Some(info.granularity.to_string())),
        ("boot-up-master", flag(info.boot_up_master)),
        ("boot-up-slave", flag(info.boot_up_slave)),
        ("group-messaging", flag(info.group_messaging)),
        ("lss", flag(info.lss)),
        ("dummies", list(info.dummies.iter().map(|data_type| data_type.name().to_owned()).collect())),
    ];
    let about = titles_of(system, "about").into_iter().zip(in_languages(system, &device.about));
    let about = about.filter(|(_, value)| !value.is_empty()).map(|(key, value)| vec![text(key), value]);
    let rows = rows.into_iter().filter_map(|(key, value)| Some(vec![text(key), text(value?)])).chain(about);
    Table { name: "Device", titles: vec!["Property".to_owned(), "Value".to_owned()], rows: rows.collect() }
}
