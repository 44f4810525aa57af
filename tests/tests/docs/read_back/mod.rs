//! The tables of the Markdown, read back cell by cell, are what the model says.

mod appendices;
mod cells;
mod dictionary;
mod figures;
mod machines;

use std::sync::Arc;

use od_spec::model::{
    Dictionary, Direction, EntryId, Index, NamedType, Object, PdoTarget, SubIndex, System, TableContent,
    Text, TypeKind, Value,
};
use od_tests::compile_clean;

use crate::markdown::Table;
use crate::{EVERYTHING, FULLMO, PITCH, TWO, behind, pages};
use cells::{flat, index, reported};
use dictionary::{check_bits, check_entry, check_overview, check_values};
use figures::{check_axis, check_flow, check_ladder, check_switches, check_timing};
use machines::{check_commands, check_states, check_transitions};

/// The devices with an object of an index, and that object.
fn objects(system: &System, index: Index) -> Vec<(&Dictionary, &Object)> {
    let list = system.devices.iter().filter_map(|device| Some((device, device.objects.get(&index)?)));
    list.collect()
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
