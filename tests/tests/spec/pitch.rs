//! The pitch control system holds its whole manual: counts per device and per table, and the facts that matter most.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use od_spec::model::{
    Access, DataType, Dictionary, EntryId, Erratum, ErratumKind, Index, ObjectKind, Origin, PdoMapping,
    Storage, SubIndex, System, TableContent, TypeKind, Value,
};
use od_tests::compile_clean;

fn pitch() -> Arc<System> {
    compile_clean("od-spec/devices/pitch-control-system.od.yaml").unwrap()
}

fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

fn manual(device: &Dictionary) -> BTreeSet<u16> {
    device
        .objects
        .values()
        .filter(|object| object.origin == Origin::Manual)
        .map(|object| object.index.0)
        .collect()
}

#[test]
fn counts_of_objects_per_device() {
    let system = pitch();
    let [pmm, pmc] = system.devices.as_slice() else { panic!("two devices") };
    assert_eq!((pmm.key.as_str(), pmc.key.as_str()), ("pmm", "pmc"));
    let (of_pmm, of_pmc) = (manual(pmm), manual(pmc));
    assert_eq!((of_pmm.len(), of_pmc.len()), (73, 85));
    let shared: Vec<u16> = of_pmm.intersection(&of_pmc).copied().collect();
    assert_eq!(shared, [0x1001, 0x1003, 0x2030, 0x5040, 0x5041, 0x603F]);
    for device in &system.devices {
        let of = |origin| device.objects.values().filter(|object| object.origin == origin).count();
        // 1000h, 1008h, 1010h, 1011h, 1014h, 1017h, 1018h, 1200h; communication and mapping of 4 + 4 PDOs.
        assert_eq!((of(Origin::Profile), of(Origin::Pdo)), (8, 16), "{}", device.key);
    }
}

#[test]
fn every_table_of_the_manual_is_there_once_and_in_order() {
    let system = pitch();
    let tables: Vec<_> = system.document.sections.iter().flat_map(|section| &section.tables).collect();
    let numbers: Vec<u16> = tables.iter().filter_map(|table| table.number).collect();
    assert_eq!(numbers, (1..=75).collect::<Vec<u16>>());
    let unnumbered_overviews: Vec<&str> = system
        .document
        .sections
        .iter()
        .filter(|section| {
            let is_one = |table: &&od_spec::model::Table| {
                table.number.is_none() && matches!(table.content, TableContent::Overview(_))
            };
            section.tables.iter().any(|table| is_one(&table))
        })
        .map(|section| section.number.as_str())
        .collect();
    assert_eq!(
        unnumbered_overviews,
        ["4.7.2", "4.7.3", "4.8.1", "4.9.1", "5.8.2", "5.9.1", "5.14.2", "5.16.1"]
    );
}

#[test]
fn rows_of_every_overview_table() {
    let system = pitch();
    let rows: BTreeMap<u16, usize> = system
        .document
        .sections
        .iter()
        .flat_map(|section| &section.tables)
        .filter_map(|table| match (&table.number, &table.content) {
            (Some(number), TableContent::Overview(list)) => Some((*number, list.len())),
            _ => None,
        })
        .collect();
    insta::assert_debug_snapshot!(rows);
}

#[test]
fn every_object_of_the_manual_is_in_a_table() {
    let system = pitch();
    let listed: BTreeSet<u16> = system
        .document
        .sections
        .iter()
        .flat_map(|section| &section.tables)
        .flat_map(|table| match &table.content {
            TableContent::Overview(list) | TableContent::Objects(list) => list.clone(),
            _ => Vec::new(),
        })
        .map(|index| index.0)
        .collect();
    for device in &system.devices {
        let missing: Vec<String> =
            manual(device).difference(&listed).map(|index| format!("{index:04X}h")).collect();
        assert!(missing.is_empty(), "{}: {missing:?}", device.key);
    }
}

#[test]
fn errata_cover_every_kind_of_trouble() {
    let system = pitch();
    assert!(system.errata.len() > 100, "{}", system.errata.len());
    let has = |index: u16, kind: ErratumKind| {
        system
            .errata
            .iter()
            .any(|erratum| erratum.kind == kind && erratum.at.iter().any(|at| at.index().0 == index))
    };
    for (index, kind) in [
        (0x3004, ErratumKind::Index),
        (0x3040, ErratumKind::Index),
        (0x30FC, ErratumKind::Index),
        (0x608F, ErratumKind::Index),
        (0x5041, ErratumKind::Access),
        (0x6041, ErratumKind::Access),
        (0x6076, ErratumKind::Type),
        (0x6080, ErratumKind::Type),
        (0x607C, ErratumKind::Sign),
        (0x687C, ErratumKind::Sign),
        (0x60FF, ErratumKind::Sign),
        (0x50FF, ErratumKind::Sign),
        (0x60C2, ErratumKind::ObjectType),
        (0x6410, ErratumKind::Count),
        (0x6076, ErratumKind::Profile),
    ] {
        assert!(has(index, kind), "{index:04X}h {}", kind.word());
    }
    let languages = |text: &od_spec::model::Text| !text.is_empty();
    for erratum in &system.errata {
        assert!(
            languages(&erratum.prints) && languages(&erratum.reads) && languages(&erratum.because),
            "{erratum:?}"
        );
    }
}

#[test]
fn facts_that_would_hurt_if_they_were_wrong() {
    let system = pitch();
    let pmm = system.device("pmm").unwrap();
    let pmc = system.device("pmc").unwrap();
    let raw = |device: &Dictionary, at| device.entry(at).unwrap().default.as_ref().and_then(Value::integer);

    // The status word is read-only, although the manual prints rw twice.
    let statusword = pmc.entry(id(0x6041, 0)).unwrap();
    assert_eq!((statusword.access, statusword.pdo), (Access::Ro, PdoMapping::Transmit));
    // Home offsets are signed.
    assert_eq!(pmc.entry(id(0x607C, 0)).unwrap().data_type, DataType::Integer32);
    assert_eq!(pmc.entry(id(0x687C, 0)).unwrap().data_type, DataType::Integer32);
    // Motor heating, 8Fh, in a signed byte.
    let modes = &pmc.entry(id(0x6060, 0)).unwrap().named_type;
    let Some(TypeKind::Enum(values)) = modes.as_ref().map(|named| &named.kind) else { panic!("an enum") };
    assert!(values.iter().any(|value| value.value == -113));
    // Table 19 swaps the PMC's thresholds.
    assert_eq!((raw(pmc, id(0x6510, 4)), raw(pmc, id(0x6510, 5))), (Some(100), Some(750)));
    // The DC link ladder, in volts.
    let ladder = [(0x30FA, 3), (0x30FB, 8), (0x30FA, 1), (0x30FB, 7), (0x30FC, 2), (0x30FC, 1), (0x30FA, 2)];
    let volts: Vec<_> = ladder.iter().map(|(index, sub)| raw(pmm, id(*index, *sub)).unwrap()).collect();
    assert_eq!(volts, [400, 420, 560, 600, 650, 670, 750]);
    // Temperatures in tenths of a degree.
    assert_eq!(raw(pmm, id(0x3111, 3)), Some(-200));
    // The feather position, 90°.
    assert_eq!(raw(pmc, id(0x567A, 0)), Some(9000));
    // Controller parameters are locked, and their factory values stay out of the EDS.
    for sub in 1..=6 {
        let entry = pmm.entry(id(0x30F0, sub)).unwrap();
        assert!(entry.locked && !entry.eds.default && entry.eds.access == Access::Ro && entry.eds.no_write);
    }
    // Volts from millivolts.
    let alias = pmc.entry(id(0x5079, 0)).unwrap().alias.clone().unwrap();
    assert_eq!((alias.target, alias.factor.to_string().as_str()), (id(0x6079, 0), "0.001"));
}

#[test]
fn every_16_bit_view_follows_its_target() {
    let system = pitch();
    let pmc = system.device("pmc").unwrap();
    let aliases: Vec<u16> =
        pmc.entries().filter(|(.., entry)| entry.alias.is_some()).map(|(at, ..)| at.index.0).collect();
    assert_eq!(
        aliases,
        [
            0x5064, 0x506C, 0x5079, 0x507A, 0x5081, 0x5083, 0x5084, 0x50B0, 0x50B1, 0x50F4, 0x50FF, 0x5864,
            0x58F4
        ]
    );
    for (at, _, entry) in pmc.entries() {
        let Some(alias) = &entry.alias else { continue };
        let target = pmc.entry(alias.target).unwrap();
        assert_eq!(alias.target.index.0, at.index.0 + 0x1000, "{at}");
        assert_eq!((entry.access, entry.pdo), (target.access, target.pdo), "{at}");
        assert_eq!(entry.data_type.is_signed(), target.data_type.is_signed(), "{at}");
        assert_eq!((entry.data_type.bits(), target.data_type.bits()), (Some(16), Some(32)), "{at}");
        assert_eq!(entry.stored, Storage::No, "{at}");
        assert_eq!(entry.eds.default, target.eds.default, "{at}");
    }
}

/// What a view gives outside its range is a choice, and the documents say so of each.
#[test]
fn saturation_of_every_view_is_an_erratum() {
    let system = pitch();
    let views = system.device("pmc").unwrap().entries().filter(|(.., entry)| entry.alias.is_some());
    for (view, ..) in views {
        let chosen = |erratum: &Erratum| {
            erratum.reads.get("en").is_some_and(|reads| reads.contains("saturates"))
                && erratum.at.iter().any(|at| at.index() == view.index)
        };
        assert!(system.errata.iter().any(chosen), "{view}");
    }
}

/// Table 35: X14.3 is 0004h, X14.4 is 0008h; the example above it adds other numbers.
#[test]
fn two_outputs_in_parallel_are_the_sum_of_their_masks() {
    let system = pitch();
    let mask = &system.types["PMM output mask"];
    let TypeKind::Bits(fields) = &mask.kind else { panic!("bits") };
    let together: u32 = ["output X14.3", "output X14.4"]
        .map(|name| 1 << fields.iter().find(|field| field.name == name).unwrap().first)
        .into_iter()
        .sum();
    assert_eq!(together, 0x000C);
    assert!(mask.about.get("en").unwrap().contains(&format!("X14.3 and X14.4: {together:04X}h")));
}

#[test]
fn default_pdos_of_tables_74_and_75() {
    let system = pitch();
    let pmc = system.device("pmc").unwrap();
    let parameters = |index: u16| -> Vec<i128> {
        let object = &pmc.objects[&Index(index)];
        let count = object.entries[0].default.as_ref().and_then(Value::integer).unwrap();
        let mapped =
            object.entries[1..].iter().map(|entry| entry.default.as_ref().and_then(Value::integer).unwrap());
        mapped.take(usize::try_from(count).unwrap()).collect()
    };
    let cob_id = |index: u16| pmc.objects[&Index(index)].entries[1].default.clone().unwrap();
    for (index, id, mapped) in [
        (0x1400, 0x200, vec![0x6040_0010]),
        (0x1401, 0x8000_0300, vec![0x6040_0010, 0x607A_0020]),
        (0x1402, 0x8000_0400, vec![0x6040_0010, 0x60FF_0020]),
        (0x1403, 0x8000_0500, vec![0x607A_0020, 0x6081_0020]),
        (0x1800, 0x4000_0180, vec![0x6041_0010]),
        (0x1801, 0xC000_0280, vec![0x6041_0010, 0x6064_0020]),
        (0x1802, 0xC000_0380, vec![0x6041_0010, 0x606C_0020]),
        (0x1803, 0xC000_0480, vec![0x6064_0020, 0x606C_0020]),
    ] {
        assert_eq!(cob_id(index), Value::NodeId(id), "{index:04X}h");
        assert_eq!(parameters(index + 0x200), mapped, "{index:04X}h");
    }
}

#[test]
fn arrays_and_records_are_complete() {
    let system = pitch();
    for device in &system.devices {
        for object in device.objects.values().filter(|object| object.is_structured()) {
            let subs: Vec<u8> = object.entries.iter().map(|entry| entry.sub.0).collect();
            if object.origin == Origin::Manual {
                let highest = *subs.last().unwrap();
                assert_eq!(subs, (0..=highest).collect::<Vec<u8>>(), "{}", object.index);
            }
            if object.kind == ObjectKind::Array {
                let types: BTreeSet<_> = object.entries[1..].iter().map(|entry| entry.data_type).collect();
                assert_eq!(types.len(), 1, "{}", object.index);
            }
        }
    }
}
