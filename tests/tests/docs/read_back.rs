//! The tables of the Markdown, read back cell by cell, are what the model says.

use std::collections::BTreeSet;
use std::sync::Arc;

use od_spec::model::{
    Access, AnyError, Axis, AxisReach, BitUsage, Constraint, DataType, Dictionary, Direction, Edge, Entry,
    EntryId, ErratumPlace, Flow, Index, LadderTable, Level, ModeMeaning, NamedBits, NamedType, Object,
    PatternBit, PdoMapping, PdoTarget, Ratio, SignalCarrier, StateMachine, Storage, SubIndex, Switch,
    SwitchBack, SwitchSide, System, TableContent, Text, Timing, TypeKind, Unit, Value,
};
use od_tests::compile_clean;

use super::{EVERYTHING, FULLMO, PITCH, TWO, behind, pages};
use crate::markdown::Table;

/// Reads what a Default cell says back into the raw value; `None` for an empty cell.
fn default(entry: &Entry, cell: &str) -> Option<Value> {
    if cell.is_empty() {
        return None;
    }
    if let Some(offset) = cell.strip_suffix("h + node-ID") {
        return Some(Value::NodeId(u64::from_str_radix(offset, 16).unwrap()));
    }
    Some(match entry.data_type {
        DataType::VisibleString | DataType::UnicodeString if cell == "\"\"" => Value::Text(String::new()),
        DataType::VisibleString | DataType::UnicodeString => Value::Text(cell.to_owned()),
        DataType::OctetString => {
            Value::Bytes(cell.split(' ').map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect())
        }
        DataType::Real32 | DataType::Real64 => Value::Real(cell.parse::<f64>().unwrap().into()),
        _ => Value::Integer(number(entry, cell)),
    })
}

/// The raw value that a cell gives: after a physical value in brackets, before the name of an enum's or special value,
/// or alone.
fn number(entry: &Entry, cell: &str) -> i128 {
    // A mapping parameter in its parts: 6040 00 10h.
    if let [index, sub, bits] = cell.split(' ').collect::<Vec<_>>()[..]
        && (index.len(), sub.len(), bits.len()) == (4, 2, 3)
    {
        return i128::from_str_radix(&cell.replace([' ', 'h'], ""), 16).unwrap();
    }
    let first = cell.split([' ', ':']).next().unwrap();
    if let Some(raw) = pattern(entry, first) {
        return raw;
    }
    match &entry.unit {
        Some(unit) if !entry.special.iter().any(|special| special.value.to_string() == first) => {
            physical(unit, cell)
        }
        _ => first.parse().unwrap_or_else(|_| panic!("{cell} of {}", entry.name)),
    }
}

/// The raw value of hexadecimal digits, which are as many as the type has: `00FFh`.
fn pattern(entry: &Entry, text: &str) -> Option<i128> {
    let digits = text.strip_suffix('h')?;
    let raw = i128::from_str_radix(digits, 16).ok()?;
    let bits = entry.data_type.bits().unwrap();
    assert_eq!(digits.len(), usize::from(bits.div_ceil(4)), "{text}: as many digits as the type has");
    Some(if entry.data_type.is_signed() && raw >= 1 << (bits - 1) { raw - (1 << bits) } else { raw })
}

/// The raw value of `50.0 °C (500)` or `3000 mAh`, with a look at both numbers.
fn physical(unit: &Unit, cell: &str) -> i128 {
    let (shown, raw) = match cell.rsplit_once(" (") {
        Some((shown, raw)) => (shown, Some(raw.strip_suffix(')').unwrap().parse::<i128>().unwrap())),
        None => (cell, None),
    };
    let value = shown.strip_suffix(&unit.symbol).unwrap_or_else(|| panic!("{cell} in {}", unit.symbol));
    let steps =
        decimal(value.trim()).checked_div(unit.scale).unwrap().to_whole().expect("a whole number of steps");
    assert_eq!(raw.is_none(), unit.scale == Ratio::ONE, "{cell}: the raw value where it is another number");
    assert!(raw.is_none_or(|raw| raw == steps), "{cell}: {steps}");
    steps
}

fn decimal(text: &str) -> Ratio {
    if let Some((number, step)) = text.split_once(" × ") {
        return decimal(number).checked_mul(decimal(step)).unwrap();
    }
    if let Some((upper, lower)) = text.split_once('/') {
        return decimal(upper).checked_div(decimal(lower)).unwrap();
    }
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    let digits: i128 = format!("{whole}{fraction}").parse().unwrap();
    Ratio::new(digits, 10i128.pow(u32::try_from(fraction.len()).unwrap())).unwrap()
}

/// The limits that a Range cell gives.
fn range(entry: &Entry, cell: &str) -> (Option<i128>, Option<i128>) {
    let end = |text: &str| match &entry.unit {
        Some(unit) => physical(unit, text),
        None => pattern(entry, text).unwrap_or_else(|| text.parse().unwrap()),
    };
    if let Some((low, high)) = cell.split_once(" to ") {
        return (Some(end(low)), Some(end(high)));
    }
    (cell.strip_prefix("≥ ").map(end), cell.strip_prefix("≤ ").map(end))
}

fn access(cell: &str) -> (Access, bool) {
    match cell {
        "r(w)" => (Access::Rw, true),
        "(w)" => (Access::Wo, true),
        word => (Access::from_word(word).unwrap_or_else(|| panic!("access {word}")), false),
    }
}

fn mapping(cell: &str) -> PdoMapping {
    match cell {
        "N" => PdoMapping::None,
        "Y (R)" => PdoMapping::Receive,
        "Y (T)" => PdoMapping::Transmit,
        "Y (RT)" => PdoMapping::Both,
        other => panic!("mapping {other}"),
    }
}

/// Compares one row of a detail table with an entry.
fn check_entry(table: &Table, row: &[String], object: &Object, entry: &Entry) {
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

/// A text on one line, with arrows, as a table has it.
fn flat(text: &str) -> String {
    text.replace('\n', " ").replace("->", "→")
}

/// The devices' objects of an index, each different one once.
/// A text as the English document shows it.
fn reported(text: &Text) -> String {
    flat(text.get("en").unwrap_or_default())
}

fn objects(system: &System, index: Index) -> Vec<(&Dictionary, &Object)> {
    let list = system.devices.iter().filter_map(|device| Some((device, device.objects.get(&index)?)));
    list.collect()
}

/// Compares an overview row with one of the objects of its index.
fn check_overview(table: &Table, row: &[String], object: &Object) {
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

fn index(cell: &str) -> Index {
    Index(u16::from_str_radix(cell.strip_suffix('h').unwrap(), 16).unwrap())
}

/// `3020h.5`
fn entry_id(cell: &str) -> EntryId {
    let (object, sub) = cell.split_once('.').unwrap_or((cell, "0"));
    EntryId { index: index(object), sub: SubIndex(sub.parse().unwrap()) }
}

fn check_bits(table: &Table, kind: &TypeKind, masks: Option<u8>) {
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

fn check_values(table: &Table, kind: &TypeKind, order: &[i128]) {
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

fn pattern_cell(bit: PatternBit) -> &'static str {
    match bit {
        PatternBit::Zero => "0",
        PatternBit::One => "1",
        PatternBit::Any => "x",
        PatternBit::Rising => "0→1",
        PatternBit::Falling => "1→0",
    }
}

/// Compares one table of the manual with the model.
fn check(system: &System, content: &TableContent, order: &[i128], tables: &[&Table]) {
    let table = tables[0];
    match content {
        TableContent::Overview(list) => {
            let shown: Vec<Index> = table.rows.iter().map(|row| index(table.cell(row, "Index"))).collect();
            assert_eq!(&shown, list);
            for (row, index) in table.rows.iter().zip(list) {
                check_overview(table, row, objects(system, *index)[0].1);
            }
        }
        TableContent::Objects(list) => {
            let mut found = Vec::new();
            for table in tables {
                let vars = table.columns[0] == "Index";
                let head = (!vars).then(|| index(table.above.split(' ').next().unwrap_or_default()));
                for row in &table.rows {
                    let id = match head {
                        None => EntryId { index: index(&row[0]), sub: SubIndex(0) },
                        Some(index) => EntryId { index, sub: SubIndex(row[0].parse().unwrap()) },
                    };
                    found.push(id);
                    let (_, object) = objects(system, id.index)[0];
                    check_entry(table, row, object, object.entry(id.sub).unwrap());
                }
            }
            let all = list.iter().flat_map(|index| {
                let (_, object) = objects(system, *index)[0];
                object.entries.iter().map(|entry| EntryId { index: *index, sub: entry.sub })
            });
            assert_eq!(found, all.collect::<Vec<_>>());
        }
        TableContent::Bits(bits) => check_bits(table, &system.types[&bits.named_type].kind, bits.masks),
        TableContent::Values(name) => check_values(table, &system.types[name].kind, order),
        TableContent::Errors(codes) => check_errors(system, table, codes, false),
        TableContent::Reactions(codes) => check_errors(system, table, codes, true),
        TableContent::States(name) => check_states(table, &system.machines[name]),
        TableContent::Transitions(name) => check_transitions(table, &system.machines[name]),
        TableContent::Commands(name) => check_commands(table, &system.machines[name]),
        TableContent::Ladder(ladder) => check_ladder(system, table, ladder),
        TableContent::Timing(timing) => check_timing(system, table, timing),
        TableContent::Hysteresis(switches) => check_switches(system, table, switches),
        TableContent::Flow(flow) => check_flow(system, table, flow),
        TableContent::Axis(axis) => check_axis(system, table, axis),
        TableContent::Pdos(pdos) => check_pdos(system, &pdos.device, pdos.direction, table),
        TableContent::Rows { columns, rows } => {
            // Titles of columns carry no mark.
            let title = |text: &Text| flat(text.get("en").unwrap_or_default());
            assert_eq!(table.columns, columns.iter().map(title).collect::<Vec<_>>());
            let cells: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(reported).collect()).collect();
            assert_eq!(table.rows, cells);
        }
        TableContent::Glossary => {
            let shown: Vec<&str> = table.rows.iter().map(|row| row[0].as_str()).collect();
            assert_eq!(shown, system.document.glossary.keys().collect::<Vec<_>>());
        }
        TableContent::History => {
            let mut history: Vec<_> = system.document.history.iter().collect();
            let latest = system.document.revision.as_ref().unwrap();
            if latest.about.get("en").is_some() && history.iter().all(|issue| issue.number != latest.number) {
                history.push(latest);
            }
            assert_eq!(table.rows.len(), history.len());
            for (row, issue) in table.rows.iter().zip(history) {
                let date = format!("{:04}-{:02}-{:02}", issue.date.year, issue.date.month, issue.date.day);
                assert_eq!((row[0].as_str(), row[1].as_str()), (issue.number.as_str(), date.as_str()));
            }
        }
    }
}

fn check_states(table: &Table, machine: &StateMachine) {
    assert_eq!(table.rows.len(), machine.states.len());
    for (row, state) in table.rows.iter().zip(&machine.states) {
        let bits: Vec<&str> = state.pattern.0.iter().map(|bit| pattern_cell(*bit)).collect();
        assert_eq!(row[0].replace(' ', ""), bits.concat());
        assert_eq!(table.cell(row, "State"), state.name);
        assert_eq!(table.cell(row, "Meaning"), flat(state.about.get("en").unwrap_or_default()));
    }
}

fn check_transitions(table: &Table, machine: &StateMachine) {
    assert_eq!(table.rows.len(), machine.transitions.len());
    for (row, transition) in table.rows.iter().zip(&machine.transitions) {
        assert_eq!(table.cell(row, "Transition"), transition.number.to_string());
        assert_eq!(table.cell(row, "From"), transition.from.join(", "));
        assert_eq!(table.cell(row, "To"), transition.to);
        assert_eq!(table.cell(row, "Event"), flat(transition.event.get("en").unwrap_or_default()));
        assert_eq!(table.cell(row, "Action"), flat(transition.action.get("en").unwrap_or_default()));
    }
}

fn check_commands(table: &Table, machine: &StateMachine) {
    assert_eq!(table.rows.len(), machine.commands.len());
    for (row, command) in table.rows.iter().zip(&machine.commands) {
        assert_eq!(table.cell(row, "Command"), command.name);
        let width = command.pattern.0.len();
        for (at, bit) in command.pattern.0.iter().enumerate() {
            let title = format!("Bit {}", width - 1 - at);
            let column = table
                .columns
                .iter()
                .position(|column| column == &title || column.starts_with(&format!("{title} ")));
            // A bit without a column is free in every command.
            let Some(column) = column else {
                assert_eq!(*bit, PatternBit::Any, "{} {title}", command.name);
                continue;
            };
            let sent = command.send.map(|code| code & (1 << (width - 1 - at)) != 0);
            let is_open_and_sent = (*bit, sent) == (PatternBit::Any, Some(true));
            let expected = if is_open_and_sent { "x (1)" } else { pattern_cell(*bit) };
            assert_eq!(row[column], expected, "{} {title}", command.name);
        }
        let send = command.send.map_or(String::new(), |value| format!("{value:04X}h"));
        assert_eq!(table.cell(row, "Code"), send, "{}", command.name);
        let transitions: Vec<String> = command.transitions.iter().map(u8::to_string).collect();
        assert_eq!(table.cell(row, "Transition"), transitions.join(", "), "{}", command.name);
    }
}

fn check_errors(system: &System, table: &Table, codes: &[u16], reactions: bool) {
    let errors = system.errors.iter().filter(|error| codes.is_empty() || codes.contains(&error.code));
    let mut errors: Vec<_> = errors.collect();
    errors.sort_by_key(|error| codes.iter().position(|code| *code == error.code));
    assert_eq!(table.rows.len(), errors.len());
    for (row, error) in table.rows.iter().zip(&errors) {
        assert_eq!(index(table.cell(row, "Error code")).0, error.code);
        if reactions {
            assert_eq!(table.cell(row, "Errors"), error.name);
            let text = flat(error.reaction.get("en").unwrap_or_default());
            let chosen = error.option_code.map(|id| {
                let mut names = system.devices.iter().filter_map(|device| device.entry_name(id));
                format!("As chosen by {id} {}.", names.next().unwrap())
            });
            let lines = [Some(text), chosen].into_iter().flatten().filter(|line| !line.is_empty());
            assert_eq!(table.cell(row, "Reaction"), lines.collect::<Vec<_>>().join(" "));
            continue;
        }
        assert_eq!(table.cell(row, "Meaning"), error.name);
        // There is no column for what no code has, and none for the only device.
        if errors.iter().any(|error| error.priority.is_some()) {
            assert_eq!(table.cell(row, "Prio."), error.priority.as_deref().unwrap_or_default());
        }
        for device in system.devices.iter().filter(|_| system.devices.len() > 1) {
            let has = error.devices.includes(&device.key);
            let shown = table.cell(row, &device.key.to_uppercase());
            assert_eq!(shown, if has { "X" } else { "" }, "{:04X}h on {}", error.code, device.key);
        }
    }
}

fn check_ladder(system: &System, table: &Table, ladder: &LadderTable) {
    let constraint = system.constraints.iter().find(|one| one.name == ladder.constraint).unwrap();
    let named: Vec<EntryId> = constraint.require.entries().iter().map(|entry| entry.id).collect();
    let shown: Vec<EntryId> = table.rows.iter().map(|row| entry_id(table.cell(row, "Object"))).collect();
    assert_eq!(shown, named);
    if !ladder.labels.is_empty() {
        let labels: Vec<String> = ladder.labels.iter().map(reported).collect();
        let shown: Vec<&str> = table.rows.iter().map(|row| table.cell(row, "Meaning")).collect();
        assert_eq!(shown, labels);
    }
    for row in &table.rows {
        let device = system.device(&table.cell(row, "Device").to_lowercase()).unwrap();
        let id = entry_id(table.cell(row, "Object"));
        let entry = device.entry(id).unwrap();
        assert_eq!(table.cell(row, "Name"), device.entry_name(id).unwrap());
        assert_eq!(default(entry, table.cell(row, "Default")), entry.default, "{id}");
    }
}

/// A row for each switch; the values are those of the defaults.
fn check_switches(system: &System, table: &Table, switches: &[Switch]) {
    assert_eq!(table.rows.len(), switches.len());
    for (row, switch) in table.rows.iter().zip(switches) {
        let device = system.devices.iter().find(|device| device.entry(switch.threshold).is_some()).unwrap();
        let raw = |id: EntryId| {
            let entry = device.entry(id).unwrap();
            let unit = entry.unit.as_ref().unwrap();
            (Ratio::whole(entry.default.as_ref().unwrap().integer().unwrap()), unit.scale, &unit.symbol)
        };
        let times = |one: Ratio, other: Ratio| one.checked_mul(other).unwrap();
        let (on, scale, symbol) = raw(switch.threshold);
        let on = times(on, scale);
        let (back, scale, back_symbol) = raw(switch.back.entry());
        let back = times(back, scale);
        let (sign, off) = match (switch.side, switch.back) {
            (SwitchSide::Below, SwitchBack::At(_)) => ("<", back),
            (SwitchSide::Above, SwitchBack::At(_)) => (">", back),
            (SwitchSide::Below, SwitchBack::By(_)) => ("<", on.checked_add(back).unwrap()),
            (SwitchSide::Above, SwitchBack::By(_)) => (">", on.checked_sub(back).unwrap()),
        };
        let value = |cell: &str, symbol: &str| decimal(cell.strip_suffix(symbol).unwrap().trim());
        assert_eq!(table.cell(row, "Switches"), reported(&switch.what));
        let (shown, number) = table.cell(row, "On at").split_once(' ').unwrap();
        assert_eq!((shown, value(number, symbol)), (sign, on));
        assert_eq!(value(table.cell(row, "Off again at"), symbol), off);
        let (named, number) = table.cell(row, "Off value from").rsplit_once(": ").unwrap();
        assert_eq!(value(number, back_symbol), back);
        let name = |id: EntryId| format!("{id} {}", device.entry_name(id).unwrap());
        assert_eq!(named, name(switch.back.entry()));
        assert_eq!(table.cell(row, "On value from"), name(switch.threshold));
    }
}

/// Indices and names of entries, one line each.
fn listed(system: &System, entries: &[EntryId]) -> Vec<String> {
    let named = entries.iter().map(|id| {
        let (device, object) = objects(system, id.index)[0];
        let name = if id.sub.0 == 0 { object.name.clone() } else { device.entry_name(*id).unwrap() };
        format!("{id} {name}")
    });
    named.collect()
}

/// A row for each block: what it takes from which block, its entries and bits, and what it does.
fn check_flow(system: &System, table: &Table, flow: &Flow) {
    assert_eq!(table.rows.len(), flow.blocks.len());
    for (row, block) in table.rows.iter().zip(&flow.blocks) {
        assert_eq!(table.cell(row, "Block"), reported(&block.name));
        let from: Vec<String> = block
            .from
            .iter()
            .map(|inflow| {
                let (name, carries) = (reported(&flow.blocks[inflow.block].name), reported(&inflow.carries));
                if carries.is_empty() { name } else { format!("{name} ({carries})") }
            })
            .collect();
        assert_eq!(table.cell(row, "Takes from"), from.join("\n"));
        let bits =
            block.bits.as_ref().map(|bits| format!("{}, Bit {}: {}", bits.named_type, bits.first, bits.name));
        let entries: Vec<String> = listed(system, &block.entries).into_iter().chain(bits).collect();
        assert_eq!(cell_if_there(table, row, "Entries"), entries.join("\n"));
        assert_eq!(cell_if_there(table, row, "Function"), reported(&block.does));
    }
}

/// A cell; nothing where no row has anything in its column.
fn cell_if_there<'t>(table: &'t Table, row: &'t [String], column: &str) -> &'t str {
    table.columns.iter().position(|title| title == column).map_or("", |at| &row[at])
}

/// A row for each mark, then one for each span with the marks where it begins and ends.
fn check_axis(system: &System, table: &Table, axis: &Axis) {
    assert_eq!(table.rows.len(), axis.marks.len() + axis.spans.len());
    let (marks, spans) = table.rows.split_at(axis.marks.len());
    for (row, mark) in marks.iter().zip(&axis.marks) {
        assert_eq!(
            (table.cell(row, "Kind"), table.cell(row, "Name")),
            ("Mark", reported(&mark.name).as_str())
        );
        assert_eq!(cell_if_there(table, row, "Entries"), listed(system, &mark.entries).join("\n"));
    }
    for (row, span) in spans.iter().zip(&axis.spans) {
        assert_eq!(
            (table.cell(row, "Kind"), table.cell(row, "Name")),
            ("Span", reported(&span.name).as_str())
        );
        let name = |at: usize| reported(&axis.marks[at].name);
        let (from, to) = match span.reach {
            AxisReach::Between(from, to) => (name(from), name(to)),
            AxisReach::Above(from) => (name(from), "…".to_owned()),
            AxisReach::Below(to) => ("…".to_owned(), name(to)),
        };
        assert_eq!((table.cell(row, "From"), table.cell(row, "To")), (from.as_str(), to.as_str()));
        assert_eq!(cell_if_there(table, row, "Entries"), listed(system, &span.entries).join("\n"));
        assert_eq!(cell_if_there(table, row, "Meaning"), reported(&span.does));
    }
}

/// A row for each step, after one for what holds before the first.
fn check_timing(system: &System, table: &Table, timing: &Timing) {
    assert_eq!(table.rows.len(), timing.steps.len() + 1);
    let levels = table.columns.len() - timing.signals.len();
    for (at, signal) in timing.signals.iter().enumerate() {
        let title = &table.columns[levels + at];
        match &signal.carrier {
            SignalCarrier::Bits(NamedBits { named_type, first, name, .. }) => {
                assert_eq!(*title, format!("{named_type}, Bit {first}: {name}"));
            }
            SignalCarrier::Entry(id) => {
                let mut names = system.devices.iter().filter_map(|device| device.entry_name(*id));
                assert_eq!(*title, names.next().unwrap());
            }
        }
        for (row, level) in table.rows.iter().zip(&signal.levels) {
            let given = match level {
                Level::Any => "x".to_owned(),
                Level::Letter(letter) => letter.to_string(),
                Level::Value(Value::Integer(raw)) => raw.to_string(),
                Level::Value(other) => panic!("{other:?}"),
            };
            assert_eq!(row[levels + at], given, "{title}");
        }
    }
    for (at, (row, step)) in table.rows[1..].iter().zip(&timing.steps).enumerate() {
        assert_eq!(table.cell(row, "Step"), (at + 1).to_string());
        assert_eq!(table.cell(row, "Event"), reported(&step.event));
        let cause = step.cause.map_or_else(String::new, |cause| cause.to_string());
        assert_eq!(table.cell(row, "Caused by step"), cause);
    }
}

fn check_pdos(system: &System, device: &str, direction: Direction, table: &Table) {
    let device = system.device(device).unwrap();
    let mut rows = table.rows.iter();
    for pdo in device.pdos_of(direction) {
        let row = rows.next().unwrap();
        assert_eq!(table.cell(row, "PDO"), format!("{} {}", direction.pdo(), pdo.number));
        let cob_id = table.cell(row, "COB-ID");
        let shown = match cob_id.strip_suffix("h + node-ID") {
            Some(offset) => Value::NodeId(u64::from_str_radix(offset, 16).unwrap()),
            None => Value::Integer(i128::from_str_radix(cob_id.strip_suffix('h').unwrap(), 16).unwrap()),
        };
        assert_eq!(Some(shown), pdo.cob_id);
        assert_eq!(table.cell(row, "Active"), if pdo.valid { "yes" } else { "no" });
        assert_eq!(index(table.cell(row, "Index")).0, pdo.mapping_index());
        assert_eq!(table.cell(row, "Default"), pdo.map.len().to_string());
        for mapped in &pdo.map {
            let row = rows.next().unwrap();
            let parameter = table.cell(row, "Default").replace([' ', 'h'], "");
            assert_eq!(u32::from_str_radix(&parameter, 16).unwrap(), mapped.parameter());
            if let PdoTarget::Entry(id) = mapped.target {
                assert_eq!(table.cell(row, "Object"), device.entry_name(id).unwrap());
            }
        }
    }
    assert!(rows.next().is_none());
}

#[test]
fn tables_of_the_manual_read_back_as_the_model() {
    for path in [PITCH, FULLMO] {
        let system = compile_clean(path).unwrap();
        let (pages, index) = pages(path);
        let contents: Vec<_> =
            system.document.tables().map(|(.., table)| (&table.content, &table.order)).collect();
        let tables = index["tables"].as_array().unwrap();
        assert_eq!(tables.len(), contents.len());
        for (table, (content, order)) in tables.iter().zip(contents) {
            let page = &pages[&format!("{}.md", table["page"].as_str().unwrap())];
            check(&system, content, order, &behind(page, table["anchor"].as_str().unwrap()));
        }
    }
}

#[test]
fn the_object_reference_reads_back_as_the_model() {
    for path in [PITCH, FULLMO, EVERYTHING, TWO] {
        let system = compile_clean(path).unwrap();
        let (pages, _) = pages(path);
        for device in &system.devices {
            let page = &pages[&format!("{}.md", device.key)];
            let overview =
                page.tables.iter().find(|table| table.anchors.iter().any(|name| name == "overview"));
            let overview = overview.unwrap();
            assert_eq!(overview.rows.len(), device.objects.len());
            for (row, object) in overview.rows.iter().zip(device.objects.values()) {
                assert_eq!(index(&row[0]), object.index);
                check_overview(overview, row, object);
            }
            for object in device.objects.values() {
                let anchor = format!("{:04X}", object.index.0);
                let first = page.tables.iter().position(|table| table.anchors.contains(&anchor)).unwrap();
                let table = &page.tables[first];
                assert_eq!(table.rows.len(), object.entries.len(), "{}", object.index);
                for (row, entry) in table.rows.iter().zip(&object.entries) {
                    check_entry(table, row, object, entry);
                }
                // The tables of its types follow, in the order of its entries.
                let mut types: Vec<Arc<NamedType>> = Vec::new();
                for named in object.entries.iter().filter_map(|entry| entry.named_type.clone()) {
                    if types.iter().all(|before| before.name != named.name) {
                        types.push(named);
                    }
                }
                let prefix = format!("{anchor}-type-");
                let is_type = |table: &&Table| table.anchors.iter().any(|anchor| anchor.starts_with(&prefix));
                let tables: Vec<&Table> = page.tables.iter().filter(is_type).collect();
                assert_eq!(tables.len(), types.len(), "{}", object.index);
                for (table, named) in tables.into_iter().zip(types) {
                    match &named.kind {
                        TypeKind::Bits(_) => check_bits(table, &named.kind, None),
                        TypeKind::Enum(_) => check_values(table, &named.kind, &[]),
                    }
                }
            }
        }
    }
}

/// All entries of all devices.
fn entries(system: &System) -> impl Iterator<Item = (EntryId, &Entry)> {
    system.devices.iter().flat_map(|device| device.entries().map(|(id, _, entry)| (id, entry)))
}

#[test]
fn aliases_and_storage_read_back_as_the_model() {
    let system = compile_clean(PITCH).unwrap();
    let (pages, _) = pages(PITCH);
    let aliases = &pages["aliases.md"].tables[0];
    let expected: Vec<(EntryId, EntryId)> =
        entries(&system).filter_map(|(id, entry)| Some((id, entry.alias.as_ref()?.target))).collect();
    let shown: Vec<(EntryId, EntryId)> = aliases
        .rows
        .iter()
        .map(|row| (entry_id(aliases.cell(row, "View")), entry_id(aliases.cell(row, "Shows"))))
        .collect();
    assert_eq!(shown, expected);

    let storage = &pages["storage.md"];
    for device in &system.devices {
        for group in [Storage::Communication, Storage::Application, Storage::Manufacturer, Storage::Remanent]
        {
            let expected: Vec<EntryId> =
                device.entries().filter(|(.., entry)| entry.stored == group).map(|(id, ..)| id).collect();
            let anchor = format!("storage-{}-{}", device.key, group.word());
            let table = storage.tables.iter().find(|table| table.anchors.contains(&anchor));
            let shown: Vec<EntryId> =
                table.iter().flat_map(|table| table.rows.iter().map(|row| entry_id(&row[0]))).collect();
            assert_eq!(shown, expected, "{anchor}");
        }
    }
}

#[test]
fn units_read_back_as_the_model() {
    for path in [PITCH, FULLMO] {
        let system = compile_clean(path).unwrap();
        let (pages, _) = pages(path);
        let units = &pages["units.md"].tables[0];
        let used: BTreeSet<&str> =
            entries(&system).filter_map(|(_, entry)| Some(entry.unit.as_ref()?.name.as_str())).collect();
        let shown: BTreeSet<&str> = units.rows.iter().map(|row| units.cell(row, "Name")).collect();
        assert_eq!(shown, used);
        for row in &units.rows {
            let unit = &system.units[units.cell(row, "Name")];
            assert_eq!(units.cell(row, "Symbol"), unit.symbol);
            let step = units.cell(row, "One step").strip_suffix(unit.symbol.as_str()).unwrap();
            assert_eq!(decimal(step.trim()), unit.scale);
            for place in units.cell(row, "Entries").split(", ") {
                let (_, object) = objects(&system, entry_id(place).index)[0];
                let whole = entry_id(place).sub.0 == 0 && object.is_structured();
                let entries = object
                    .entries
                    .iter()
                    .filter(|entry| if whole { entry.sub.0 > 0 } else { entry.sub == entry_id(place).sub });
                for entry in entries {
                    assert_eq!(
                        entry.unit.as_ref().map(|unit| unit.name.as_str()),
                        Some(units.cell(row, "Name")),
                        "{place}"
                    );
                }
            }
        }
    }
}

#[test]
fn errata_read_back_as_the_model() {
    for path in [PITCH, FULLMO] {
        let system = compile_clean(path).unwrap();
        let (pages, _) = pages(path);
        let errata = &pages["errata.md"].tables[0];
        assert_eq!(errata.rows.len(), system.errata.len());
        for (at, (row, erratum)) in errata.rows.iter().zip(&system.errata).enumerate() {
            assert_eq!(errata.cell(row, "No."), (at + 1).to_string());
            let places: Vec<String> = erratum
                .at
                .iter()
                .map(|place| match place {
                    ErratumPlace::Object(index) => index.to_string(),
                    ErratumPlace::Entry(id) => format!("{}.{}", id.index, id.sub),
                })
                .collect();
            assert_eq!(errata.cell(row, "Entries"), places.join(", "));
            assert_eq!(errata.cell(row, "Kind"), erratum.kind.word());
            for (title, text) in
                [("Place", &erratum.place), ("Read as", &erratum.reads), ("Why", &erratum.because)]
            {
                assert_eq!(errata.cell(row, title), reported(text), "erratum {}", at + 1);
            }
            // What is quoted keeps its characters.
            let prints = erratum.prints.get("en").unwrap_or_default().replace('\n', " ");
            assert_eq!(errata.cell(row, "The manual prints"), prints, "erratum {}", at + 1);
        }
    }
}

#[test]
fn constraints_and_error_codes_read_back_as_the_model() {
    let system = compile_clean(PITCH).unwrap();
    let (pages, _) = pages(PITCH);
    let constraints = &pages["constraints.md"];
    let name = |constraint: &Constraint| match &constraint.series {
        Some(series) => series.name.replace("{n}", "n"),
        None => constraint.name.clone(),
    };
    let mut names: Vec<String> = system.constraints.iter().map(name).collect();
    names.dedup();
    let titles: Vec<&String> = constraints.tables.iter().map(|table| &table.columns[1]).collect();
    assert_eq!(titles, names.iter().collect::<Vec<_>>());
    for constraint in &system.constraints {
        let table = constraints.tables.iter().find(|table| table.columns[1] == name(constraint)).unwrap();
        let fact = |title: &str| table.rows.iter().find(|row| row[0] == title).map(|row| row[1].clone());
        let mut condition = fact("Condition").unwrap();
        if let Some(series) = &constraint.series {
            assert_eq!(fact("n").unwrap(), "0 … 11", "{}", constraint.name);
            assert!(series.number < 12);
            condition = condition.replace("bit n of", &format!("bit {} of", series.number));
        }
        for entry in constraint.require.entries() {
            assert!(condition.contains(&format!("{})", entry.id)), "{}: {condition}", constraint.name);
        }
        for (entry, bit) in constraint.require.operands() {
            let name = system.devices.iter().find_map(|device| device.entry_name(entry.id)).unwrap();
            let bit = bit.map_or(String::new(), |bit| format!("bit {bit} of "));
            assert!(condition.contains(&format!("{bit}{name} (")), "{}: {bit}{name}", constraint.name);
        }
    }
    let numbers: Vec<u32> =
        system.constraints.iter().filter_map(|one| Some(one.series.as_ref()?.number)).collect();
    assert_eq!(numbers, (0..12).collect::<Vec<u32>>());

    let any = &pages["errors.md"].tables[0];
    assert_eq!(any.rows.len(), system.devices.len());
    let said = |text: &Text| flat(text.get("en").unwrap_or_default());
    for (row, device) in any.rows.iter().zip(&system.devices) {
        assert_eq!(any.cell(row, "Device"), device.key.to_uppercase());
        let AnyError { shown, reaction, reset, .. } = &device.any_error;
        for (title, text) in [("Shown by", shown), ("Reaction", reaction), ("Reset by", reset)] {
            let expected = if text.is_empty() { "not stated".to_owned() } else { said(text) };
            assert_eq!(any.cell(row, title), expected, "{}", device.key);
        }
    }
    let errors = &pages["errors.md"].tables[1];
    assert_eq!(errors.rows.len(), system.errors.len());
    for (row, error) in errors.rows.iter().zip(&system.errors) {
        let reporting: BTreeSet<(String, u8)> = entries(&system)
            .flat_map(|(id, entry)| {
                entry.bits_of_error(error.code).into_iter().map(move |bit| (id.to_string(), bit))
            })
            .collect();
        let shown: BTreeSet<(String, u8)> = errors
            .cell(row, "Shown by")
            .lines()
            .map(|line| {
                let (place, bit) = line.split_once(" Bit ").unwrap();
                (place.to_owned(), bit.parse().unwrap())
            })
            .collect();
        assert_eq!(shown, reporting, "{:04X}h", error.code);
        let having: Vec<_> =
            system.devices.iter().filter(|device| error.devices.includes(&device.key)).collect();
        let resets: Vec<String> = having
            .iter()
            .map(|device| {
                let key =
                    if having.len() > 1 { format!("{}: ", device.key.to_uppercase()) } else { String::new() };
                format!("{key}{}", said(&device.any_error.reset))
            })
            .filter(|_| error.code != 0)
            .collect();
        assert_eq!(errors.cell(row, "Reset by").lines().collect::<Vec<_>>(), resets, "{:04X}h", error.code);
    }
}
