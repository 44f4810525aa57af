//! Tables below figures: thresholds, switches, blocks, axes and sequences of events.

use od_spec::model::{
    Axis, AxisReach, EntryId, Flow, LadderTable, Level, NamedBits, Ratio, SignalCarrier, Switch, SwitchBack,
    SwitchSide, System, Timing, Value,
};

use super::cells::{cell_if_there, decimal, default, entry_id, reported};
use super::objects;
use crate::markdown::Table;

/// Indices and names of entries, one line each.
fn listed(system: &System, entries: &[EntryId]) -> Vec<String> {
    let named = entries.iter().map(|id| {
        let (device, object) = objects(system, id.index)[0];
        let name = if id.sub.0 == 0 { object.name.clone() } else { device.entry_name(*id).unwrap() };
        format!("{id} {name}")
    });
    named.collect()
}

pub(super) fn check_ladder(system: &System, table: &Table, ladder: &LadderTable) {
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
pub(super) fn check_switches(system: &System, table: &Table, switches: &[Switch]) {
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

/// A row for each block: what it takes from which block, its entries and bits, and what it does.
pub(super) fn check_flow(system: &System, table: &Table, flow: &Flow) {
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

/// A row for each mark, then one for each span with the marks where it begins and ends.
pub(super) fn check_axis(system: &System, table: &Table, axis: &Axis) {
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
pub(super) fn check_timing(system: &System, table: &Table, timing: &Timing) {
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
