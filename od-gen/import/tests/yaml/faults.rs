//! Models with facts that the language refuses: the text compiles all the same, and states what the model says.

use od_import::yaml::{Place, Specification};
use od_spec::model::{
    Access, DataType, Entry, EntryId, Fact, Index, Mapped, ObjectKind, PdoMapping, Storage, SubIndex, System,
    Value,
};

use super::{model, written};

const DEVICE: &str = "
od-spec: 1
title: Lamp
vendor: {name: Example, number: 0x10}
uses: [cia301]
devices:
  lamp:
    name: Lamp
    bit-rates: [125]
    product: 7
    features: [heartbeat producer, emergency, error history, heartbeat consumer, device name]
types:
  mode: {base: unsigned8, values: {0: off, 1: on}}
objects:
  0x2000: {name: level, type: unsigned8, access: rw, pdo: receive, default: 4, min: 2, max: 6}
  0x2001: {name: hours, type: unsigned32, access: ro, pdo: transmit}
  0x2002: {name: label, type: visible-string, access: const, default: Lamp}
  0x2003: {name: mode, type: mode, access: rw, default: on}
  0x2004: {name: steps, array: {count: 3, name: 'step {n}', type: unsigned8, access: rw}}
  0x2005:
    name: supply
    record:
      1: {name: voltage, type: unsigned64, access: ro, pdo: transmit}
      2: {name: current, type: unsigned16, access: rw, default: 1}
      3: {name: power, type: unsigned8, access: rw, pdo: both}
pdos:
  lamp:
    receive: {1: {map: [level, 0x2005.3]}, 2: {map: [level]}}
    transmit: {1: {map: [hours]}}
";

fn lamp() -> System {
    model(DEVICE)
}

fn entry(system: &mut System, index: u16, sub: u8) -> &mut Entry {
    let object = system.devices[0].objects.get_mut(&Index(index)).unwrap();
    object.entries.iter_mut().find(|entry| entry.sub == SubIndex(sub)).unwrap()
}

const fn at(index: u16, sub: u8) -> Place {
    Place::Entry(EntryId { index: Index(index), sub: SubIndex(sub) })
}

/// What a repair is about: its place, the fact, what the model says.
type Reported<'a> = (Place, Option<Fact>, &'a str);

/// A way to break the device, and what is changed for it.
type Fault = (&'static str, fn(&mut System), &'static [Reported<'static>]);

const FAULTS: &[Fault] = &[
    (
        "outside the limits",
        |s| entry(s, 0x2000, 0).default = Some(Value::Integer(31)),
        &[(Place::Device, None, "OD0406")],
    ),
    ("limits in the wrong order", |s| entry(s, 0x2000, 0).low = Some(9), &[(Place::Device, None, "OD0407")]),
    (
        "too large",
        |s| entry(s, 0x2005, 2).default = Some(Value::Integer(70_000)),
        &[(at(0x2005, 2), Some(Fact::Default), "70000")],
    ),
    (
        "a node-ID that does not fit",
        |s| entry(s, 0x2000, 0).default = Some(Value::NodeId(0x180)),
        &[(at(0x2000, 0), Some(Fact::Default), "$NODEID + 0x180")],
    ),
    (
        "a text for a number",
        |s| entry(s, 0x2005, 2).default = Some(Value::Text("high: 1".to_owned())),
        &[(at(0x2005, 2), Some(Fact::Default), "\"high: 1\"")],
    ),
    (
        "a text that readers misread",
        |s| entry(s, 0x2002, 0).default = Some(Value::Text("a;b".to_owned())),
        &[(Place::Device, None, "OD0319")],
    ),
    (
        "no ASCII",
        |s| entry(s, 0x2002, 0).default = Some(Value::Text("Größe".to_owned())),
        &[(at(0x2002, 0), Some(Fact::Default), "Größe")],
    ),
    (
        "no value of the enum",
        |s| entry(s, 0x2003, 0).default = Some(Value::Integer(5)),
        &[(at(0x2003, 0), Some(Fact::Default), "5")],
    ),
    (
        "mapped against the access",
        |s| entry(s, 0x2001, 0).pdo = PdoMapping::Both,
        &[(Place::Device, None, "OD0417")],
    ),
    (
        "a string that can be mapped",
        |s| entry(s, 0x2002, 0).pdo = PdoMapping::Transmit,
        &[(Place::Device, None, "OD0416")],
    ),
    (
        "a mapped entry that is not there",
        |s| entry(s, 0x1600, 1).default = Some(Value::Integer(0x2222_0008)),
        &[(Place::Device, None, "OD0502")],
    ),
    (
        "a mapped length that is another",
        |s| entry(s, 0x1600, 2).default = Some(Value::Integer(0x2005_0310)),
        &[(Place::Device, None, "OD0502")],
    ),
    (
        "more than a frame",
        |s| {
            let parameter = Mapped::from_parameter(0x2005_0140).unwrap().parameter();
            entry(s, 0x1A00, 2).default = Some(Value::Integer(parameter.into()));
            entry(s, 0x1A00, 0).default = Some(Value::Integer(2));
        },
        &[(Place::Device, None, "OD0507")],
    ),
    (
        "more than is there",
        |s| entry(s, 0x1600, 0).default = Some(Value::Integer(9)),
        &[(Place::Device, None, "OD0508")],
    ),
    (
        "an empty parameter",
        |s| entry(s, 0x1600, 0).default = Some(Value::Integer(5)),
        &[(Place::Device, None, "OD0508")],
    ),
    (
        "two PDOs with one COB-ID",
        |s| entry(s, 0x1401, 1).default = Some(Value::NodeId(0x180)),
        &[(Place::Device, None, "OD0504")],
    ),
    (
        "a COB-ID of NMT",
        |s| entry(s, 0x1800, 1).default = Some(Value::Integer(0)),
        &[(Place::Device, None, "OD0503")],
    ),
    (
        "a reserved transmission type",
        |s| entry(s, 0x1800, 2).default = Some(Value::Integer(250)),
        &[(Place::Device, None, "OD0505")],
    ),
    (
        "another vendor",
        |s| entry(s, 0x1018, 1).default = Some(Value::Integer(0x11)),
        &[(Place::Device, None, "OD0611")],
    ),
    (
        "another product",
        |s| entry(s, 0x1018, 2).default = Some(Value::Integer(8)),
        &[(Place::Device, None, "OD0611")],
    ),
    (
        "errors from the start",
        |s| entry(s, 0x1003, 0).default = Some(Value::Integer(5)),
        &[(Place::Device, None, "OD0510")],
    ),
    (
        "node 200",
        |s| entry(s, 0x1016, 1).default = Some(Value::Integer(0x00C8_0001)),
        &[(Place::Device, None, "OD0510")],
    ),
    (
        "another count",
        |s| entry(s, 0x2005, 0).default = Some(Value::Integer(5)),
        &[(Place::Device, None, "OD0313")],
    ),
    (
        "elements of two types",
        |s| entry(s, 0x2004, 2).data_type = DataType::Unsigned16,
        &[(Place::Device, None, "OD0315")],
    ),
    (
        "a stored constant",
        |s| entry(s, 0x2002, 0).stored = Storage::Application,
        &[(Place::Device, None, "OD0415")],
    ),
    ("a lock without a door", |s| entry(s, 0x2001, 0).locked = true, &[(Place::Device, None, "OD0414")]),
    (
        "more access in the EDS",
        |s| entry(s, 0x2001, 0).eds.access = Access::Rww,
        &[(Place::Device, None, "OD0417")],
    ),
    ("no bit rate", |s| s.devices[0].info.bit_rates.clear(), &[(Place::Device, None, "OD0602")]),
    ("not a valid bit rate", |s| s.devices[0].info.bit_rates.push(333), &[(Place::Device, None, "OD0601")]),
    (
        "granularity 0 of mappings that can change",
        |s| s.devices[0].info.granularity = 0,
        &[(Place::Device, None, "OD0509")],
    ),
    ("granularity 64", |s| s.devices[0].info.granularity = 64, &[(Place::Device, None, "OD0508")]),
    (
        "a header that readers misread",
        |s| "a;b".clone_into(&mut s.devices[0].file.description),
        &[(Place::Device, None, "OD0318")],
    ),
    (
        "a vendor whom readers misread",
        |s| "a=b".clone_into(&mut s.vendor.name),
        &[(Place::Device, None, "OD0318")],
    ),
    (
        "an object of another area",
        |s| {
            let mut object = s.devices[0].objects[&Index(0x2001)].clone();
            object.index = Index(0xC000);
            s.devices[0].objects.insert(object.index, object);
            name(s, 0xC000, "far");
        },
        &[(Place::Device, None, "OD0316")],
    ),
    ("two objects of one name", |s| name(s, 0x2001, "level"), &[]),
    (
        "one name in ASCII",
        |s| {
            name(s, 0x2000, "Höhe");
            name(s, 0x2001, "Hoehe");
        },
        &[],
    ),
    ("the name of a data type", |s| name(s, 0x2001, "unsigned8"), &[]),
    ("the name of an entry", |s| name(s, 0x2001, "supply.current"), &[]),
    ("no name", |s| name(s, 0x2001, " "), &[(Place::Object(Index(0x2001)), Some(Fact::Name), "\" \"")]),
    ("a name that readers misread", |s| name(s, 0x2001, "a;b=c#d"), &[(Place::Device, None, "OD0318")]),
    (
        "a name without a form in ASCII",
        |s| name(s, 0x2001, "時間"),
        &[(Place::Object(Index(0x2001)), Some(Fact::Name), "\"時間\"")],
    ),
    ("two members of one name", |s| "voltage".clone_into(&mut entry(s, 0x2005, 2).name), &[]),
    (
        "elements of one name",
        |s| (1..=3).for_each(|sub| "step".clone_into(&mut entry(s, 0x2004, sub).name)),
        &[],
    ),
    (
        "a pattern as a name",
        |s| "step {n}".clone_into(&mut entry(s, 0x2004, 2).name),
        &[(at(0x2004, 2), Some(Fact::Name), "\"step {n}\"")],
    ),
];

fn name(system: &mut System, index: u16, name: &str) {
    let object = system.devices[0].objects.get_mut(&Index(index)).unwrap();
    name.clone_into(&mut object.name);
    if matches!(object.kind, ObjectKind::Var) {
        name.clone_into(&mut object.entries[0].name);
    }
}

/// The names of objects and entries.
fn names(system: &System) -> Vec<(&str, &str)> {
    let entries = system.devices[0].entries();
    entries.map(|(_, object, entry)| (object.name.as_str(), entry.name.as_str())).collect()
}

/// What is changed, and the rules that are allowed to be broken.
fn reported(written: &Specification) -> Vec<Reported<'_>> {
    let repairs = written.repairs.iter().map(|repair| (repair.place, repair.fact, repair.original.as_str()));
    repairs.chain(written.allowed.iter().map(|code| (Place::Device, None, *code))).collect()
}

/// The lamp with each fault alone, and with all of them.
pub(super) fn broken() -> Vec<(&'static str, System)> {
    let mut all = lamp();
    let mut broken: Vec<_> = FAULTS
        .iter()
        .map(|(what, fault, _)| {
            let mut system = lamp();
            fault(&mut system);
            fault(&mut all);
            (*what, system)
        })
        .collect();
    broken.push(("all of them", all));
    broken
}

#[test]
fn each_fault_is_allowed_or_costs_the_fact_that_is_wrong_and_nothing_else() {
    for (what, fault, expected) in FAULTS {
        let mut system = lamp();
        fault(&mut system);
        let specification = written(&system);
        let again = model(&specification.text);
        assert_eq!(reported(&specification), *expected, "{what}: {}", specification.text);
        if !expected.iter().any(|(_, fact, _)| *fact == Some(Fact::Name)) {
            assert_eq!(names(&again), names(&system), "{what}");
        }
        for repair in &specification.repairs {
            let line = repair.comment();
            let start: String = line.chars().take(40).collect();
            assert!(specification.text.contains(start.trim_end()), "{what}: {line}\n{}", specification.text);
        }
    }
}

#[test]
fn all_faults_at_once_leave_a_specification() {
    let mut system = lamp();
    for (_, fault, _) in FAULTS {
        fault(&mut system);
    }
    let specification = written(&system);
    let again = model(&specification.text);
    assert!(reported(&specification).len() > 20, "{:?}", reported(&specification));
    let indices =
        |system: &System| system.devices[0].objects.keys().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(indices(&again), indices(&system));
}

#[test]
fn a_mapping_keeps_an_entry_that_is_not_there() {
    let mut system = lamp();
    entry(&mut system, 0x1600, 1).default = Some(Value::Integer(0x2222_0008));
    let specification = written(&system);
    let rpdo = &model(&specification.text).devices[0].pdos[0];
    assert_eq!(rpdo.map.iter().map(Mapped::parameter).collect::<Vec<_>>(), [0x2222_0008, 0x2005_0308]);
    assert_eq!(specification.allowed, ["OD0502"]);
}

#[test]
fn what_the_device_fills_in_may_not_suit_the_entry() {
    let mut system = lamp();
    let name = entry(&mut system, 0x1008, 0);
    name.data_type = DataType::Integer8;
    name.high = Some(i128::from(i64::MAX));
    name.stored = Storage::Remanent;
    let specification = written(&system);
    let again = model(&specification.text);
    let expected = [
        (at(0x1008, 0), Some(Fact::HighLimit), "9223372036854775807"),
        (Place::Device, None, "OD0404"),
        (Place::Device, None, "OD0415"),
    ];
    assert_eq!(reported(&specification), expected);
    assert_eq!(again.devices[0].objects[&Index(0x1008)].entries[0].data_type, DataType::Integer8);
}
