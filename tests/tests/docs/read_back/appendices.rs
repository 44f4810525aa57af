//! Appendices: aliases, storage, units, errata, constraints and error codes.

use std::collections::BTreeSet;

use od_spec::model::{AnyError, Constraint, Entry, EntryId, ErratumPlace, Storage, System, Text};
use od_tests::compile_clean;

use super::cells::{decimal, entry_id, flat, reported};
use super::objects;
use crate::{FULLMO, PITCH, pages};

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
