//! PDOs under `pdos:` keep the names of their parameter objects, and what else these have of their own.

use od_spec::model::{Access, Entry, Index, ObjectKind, Origin, Storage, SubIndex, System, Value};
use proptest::prelude::*;

use super::likeness::difference;
use super::{model, written};

/// A device with so many PDOs of each direction, of which each maps two entries and has room for three.
fn device(count: u16) -> System {
    let list = |keys: fn(u16) -> String| {
        let lines = (1..=count).map(|number| format!("      {number}: {{{}}}", keys(number)));
        lines.collect::<Vec<_>>().join("\n")
    };
    let receive =
        list(|number| format!("map: [unsigned8, level], capacity: 3, cob-id: $NODEID + {}", 0x180 + number));
    let transmit = list(|number| {
        format!("map: [hours], event-timer: 7, valid: no, cob-id: $NODEID + {}", 0x300 + number)
    });
    let system = model(&format!(
        "
od-spec: 1
title: Lamp
devices: {{lamp: {{name: Lamp, bit-rates: [125], granularity: 8, dummies: [unsigned8], features: [store parameters]}}}}
uses: [cia301]
allow: {{OD0503: numbers that follow each other}}
objects:
  0x2000: {{name: level, type: unsigned8, access: rw, pdo: receive}}
  0x2001: {{name: hours, type: unsigned32, access: ro, pdo: transmit}}
pdos:
  lamp:
    receive:
{receive}
    transmit:
{transmit}
"
    ));
    // As if another tool had written it: no texts, and nothing about storage.
    let mut foreign = system;
    for object in foreign.devices[0].objects.values_mut().filter(|object| object.origin == Origin::Pdo) {
        object.entries.iter_mut().for_each(|entry| {
            entry.about = od_spec::model::Text::default();
            entry.stored = Storage::No;
        });
    }
    foreign
}

/// Gives every parameter object and entry a name, of PDO, index and sub-index (`None` for the object).
fn name(system: &mut System, of: impl Fn(u16, u16, Option<u8>) -> String) {
    for object in system.devices[0].objects.values_mut().filter(|object| object.origin == Origin::Pdo) {
        let (index, pdo) = (object.index.0, object.index.0 % 0x200 + 1);
        object.name = of(pdo, index, None);
        object.entries.iter_mut().for_each(|entry| entry.name = of(pdo, index, Some(entry.sub.0)));
    }
}

/// The text from `pdos:` on, after it was seen to say the same as the system, and to be said again by what it says.
fn kept(system: &System) -> String {
    let specification = written(system);
    assert_eq!(specification.repairs, []);
    let again = model(&specification.text);
    assert_eq!(difference(system, &again), None, "{}", specification.text);
    assert_eq!(written(&again).text, specification.text);
    let at = specification.text.find("\npdos:\n").map_or(specification.text.len(), |at| at + 1);
    specification.text[at..].to_owned()
}

fn object(system: &mut System, index: u16) -> &mut od_spec::model::Object {
    system.devices[0].objects.get_mut(&Index(index)).unwrap()
}

fn entry(system: &mut System, index: u16, sub: u8) -> &mut Entry {
    object(system, index).entries.iter_mut().find(|entry| entry.sub == SubIndex(sub)).unwrap()
}

/// Names of RPDOs and TPDOs, objects and entries, in the manner of one maker.
fn regular(pdo: u16, index: u16, sub: Option<u8>, number: &str) -> String {
    let direction = if index < 0x1800 { "Receive" } else { "Transmit" };
    let part = if index & 0x200 == 0 { "Parameter" } else { "Mapping" };
    match sub {
        None => format!("{direction} {{PDO}} {number} {part}"),
        Some(sub) if part == "Mapping" && sub > 0 => format!("{sub}. object of {number}"),
        Some(sub) => format!("Parameter {sub} of {}", pdo.min(1)),
    }
}

#[test]
fn regular_names_are_said_once() {
    type Number = fn(u16) -> String;
    let numbers: [(&str, Number); 4] = [
        ("{pdo}", |pdo| pdo.to_string()),
        ("{pdo-1}", |pdo| (pdo - 1).to_string()),
        ("{pdo:X}", |pdo| format!("{pdo:X}")),
        ("{pdo-1:x}", |pdo| format!("{:x}", pdo - 1)),
    ];
    for (placeholder, number) in numbers {
        let mut system = device(18);
        name(&mut system, |pdo, index, sub| regular(pdo, index, sub, &number(pdo)));
        let text = kept(&system);
        for line in [
            format!("name: \"Receive {{{{PDO}}}} {placeholder} Parameter\""),
            format!("name: \"Transmit {{{{PDO}}}} {placeholder} Mapping\""),
            format!("entry: \"{{n}}. object of {placeholder}\""),
            "cob-id: Parameter 1 of 1".to_owned(),
        ] {
            assert!(text.contains(&line), "{line}:\n{text}");
        }
        assert_eq!(text.matches("parameters:").count(), 1, "{text}");
        assert_eq!(text.matches("stored: no").count(), 1, "{text}");
    }
}

#[test]
fn a_pdo_has_names_of_its_own() {
    let mut system = device(4);
    name(&mut system, |pdo, index, sub| regular(pdo, index, sub, &pdo.to_string()));
    object(&mut system, 0x1602).name = "{pdo} of mine".to_owned();
    entry(&mut system, 0x1602, 2).name = "second {n}".to_owned();
    entry(&mut system, 0x1401, 2).name = "kind}".to_owned();
    for sub in 1..=3 {
        entry(&mut system, 0x1603, sub).name = format!("line {sub} }}");
    }
    let text = kept(&system);
    for own in [
        "parameters: {communication: {transmission: \"kind}}\"}}",
        "parameters: {mapping: {name: \"{{pdo}} of mine\", entries: {2: \"second {{n}}\"}}}",
        "parameters: {mapping: {entry: \"line {n} }}\"}}",
    ] {
        assert!(text.contains(own), "{own}:\n{text}");
    }
}

#[test]
fn names_that_several_have_stay_and_get_identifiers() {
    let mut system = device(3);
    name(&mut system, |_, index, sub| match sub {
        None => format!("PDO {:X}", index >> 9),
        Some(0) => "count".to_owned(),
        Some(sub) if index & 0x200 == 0 => format!("p{sub}"),
        Some(_) => "mapped".to_owned(),
    });
    let specification = written(&system);
    assert_eq!(specification.repairs, []);
    assert!(!specification.text.contains("in full"), "{}", specification.text);
    for line in [
        "name: PDO A",
        "identifier: \"rpdo_{pdo}_communication_parameter\"",
        "entry: {name: mapped, identifier: \"mapped_{n}\"}",
    ] {
        assert!(specification.text.contains(line), "{line}:\n{}", specification.text);
    }
    let again = model(&specification.text);
    for index in [0x1400, 0x1402, 0x1600, 0x1602, 0x1800, 0x1802, 0x1A00, 0x1A02] {
        assert_eq!(again.devices[0].objects[&Index(index)].name, format!("PDO {:X}", index >> 9));
    }
    assert_eq!(written(&again).text, specification.text);
}

#[test]
fn identifiers_of_parameter_objects_are_kept() {
    let mut system = device(2);
    object(&mut system, 0x1401).identifier = Some("mine".to_owned());
    entry(&mut system, 0x1400, 2).identifier = Some("kind".to_owned());
    for sub in 1..=3 {
        entry(&mut system, 0x1601, sub).identifier = Some(format!("line_{sub}"));
    }
    let text = kept(&system);
    for own in [
        "parameters: {communication: {transmission: {identifier: kind}}}",
        "parameters: {communication: {identifier: mine}, mapping: {entry: {identifier: \"line_{n}\"}}}",
    ] {
        assert!(text.contains(own), "{own}:\n{text}");
    }
}

#[test]
fn what_else_the_objects_have_is_kept() {
    let mut system = device(2);
    for index in [0x1400, 0x1401] {
        entry(&mut system, index, 0).access = Access::Const;
        entry(&mut system, index, 0).eds.access = Access::Const;
        entry(&mut system, index, 1).low = Some(1);
        entry(&mut system, index, 1).high = Some(0xFFFF_FFFF);
    }
    entry(&mut system, 0x1601, 0).high = Some(64);
    entry(&mut system, 0x1801, 2).access = Access::Ro;
    entry(&mut system, 0x1801, 2).eds.access = Access::Ro;
    let text = kept(&system);
    for line in [
        "sub0: {access: const}, cob-id: {min: 1, max: 0xFFFF_FFFF}",
        "parameters: {mapping: {sub0: {max: 64}}}",
        "parameters: {communication: {transmission: {access: ro}}}",
    ] {
        assert!(text.contains(line), "{line}:\n{text}");
    }
}

#[test]
fn a_reserved_parameter_is_said_of_all_or_of_one() {
    let reserved = |value: Option<i128>| {
        let mut system = device(2);
        let timer = entry(&mut system, 0x1800, 5).clone();
        let mut reserved = timer;
        reserved.sub = SubIndex(4);
        reserved.name = "Compatibility entry".to_owned();
        reserved.data_type = od_spec::model::DataType::Unsigned8;
        reserved.default = value.map(Value::Integer);
        (system, reserved)
    };
    let (mut system, one) = reserved(Some(3));
    object(&mut system, 0x1801).entries.insert(3, one);
    let own = "parameters: {communication: {reserved: {name: Compatibility entry, access: rw, default: 3}}}";
    assert!(kept(&system).contains(own), "{}", kept(&system));
    let (mut system, one) = reserved(None);
    for index in [0x1800, 0x1801] {
        object(&mut system, index).entries.insert(3, one.clone());
    }
    let text = kept(&system);
    assert!(text.contains("reserved: {name: Compatibility entry, access: rw}"), "{text}");
    assert_eq!(text.matches("reserved").count(), 1);
}

#[test]
fn storage_is_neither_added_nor_lost() {
    let mut system = device(2);
    assert!(kept(&system).contains("stored: no"));
    for object in system.devices[0].objects.values_mut().filter(|object| object.origin == Origin::Pdo) {
        let writable = object.entries.iter_mut().filter(|entry| entry.access.is_writable());
        writable.for_each(|entry| entry.stored = Storage::Communication);
    }
    assert!(!kept(&system).contains("stored"));
    // Of PDOs that disagree, some are written in full.
    entry(&mut system, 0x1401, 1).stored = Storage::No;
    let specification = written(&system);
    assert_eq!(difference(&system, &model(&specification.text)), None);
    assert!(specification.text.contains("RPDO 2 in full, not under `pdos:`"), "{}", specification.text);
}

#[test]
fn where_nothing_stores_only_storage_is_said() {
    let mut system = device(2);
    system.devices[0].objects.remove(&Index(0x1010));
    assert!(!kept(&system).contains("stored"));
    for object in system.devices[0].objects.values_mut().filter(|object| object.origin == Origin::Pdo) {
        let writable = object.entries.iter_mut().filter(|entry| entry.access.is_writable());
        writable.for_each(|entry| entry.stored = Storage::Communication);
    }
    assert!(kept(&system).contains("stored: communication"));
}

#[test]
fn what_has_no_key_is_in_full_and_says_why() {
    type Change = fn(&mut System);
    let changes: [(Change, &str); 10] = [
        (|s| object(s, 0x1401).kind = ObjectKind::Array, "no RECORD"),
        (|s| entry(s, 0x1401, 1).default = None, "sub-index 1 has no value"),
        (
            |s| entry(s, 0x1601, 3).default = Some(Value::Integer(0x2000_0008)),
            "not only the entries that are in use",
        ),
        (
            |s| entry(s, 0x1401, 2).data_type = od_spec::model::DataType::Unsigned16,
            "another type than UNSIGNED8",
        ),
        (|s| entry(s, 0x1401, 2).access = Access::Wo, "sub-index 2 is `wo`"),
        (|s| entry(s, 0x1401, 0).default = Some(Value::Integer(3)), "sub-index 0 is not the highest"),
        (|s| entry(s, 0x1401, 2).eds.no_write = true, "has flags"),
        (|s| entry(s, 0x1601, 1).default = Some(Value::Integer(0x2001_0010)), "which has another length"),
        (|s| entry(s, 0x1601, 2).identifier = Some("mine".to_owned()), "follow no pattern"),
        (|s| drop(object(s, 0x1401).entries.remove(2)), "sub-index 2 is missing"),
    ];
    for (change, reason) in changes {
        let mut system = device(2);
        change(&mut system);
        let text = written(&system).text;
        let said = text.lines().find(|line| line.contains("RPDO 2 in full, not under `pdos:`: "));
        assert!(said.is_some_and(|line| line.contains(reason)), "{reason}:\n{text}");
        assert!(text.contains("  0x1401: {") || text.contains("  0x1401:\n"), "{text}");
        model(&text);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if cfg!(debug_assertions) { 40 } else { 400 }))]

    #[test]
    fn any_names_are_kept(parts in prop::collection::vec("[{}0-4aPn ]{1,5}", 8), count in 1u16..5) {
        let mut system = device(count);
        name(&mut system, |pdo, index, sub| {
            let kind = usize::from(index >> 9 & 3);
            // Each is unique by what is in brackets, so that none has to be changed.
            match sub {
                None => format!("{}[{kind}.{pdo}]", parts[kind]),
                Some(sub) => format!("{}[{sub}]", parts[4 + (usize::from(pdo) + usize::from(sub)) % 4]),
            }
        });
        let specification = written(&system);
        let again = model(&specification.text);
        let names = |system: &System| -> Vec<(String, String)> {
            let trimmed = |name: &str| name.trim().to_owned();
            system.devices[0].entries().map(|(_, object, entry)| (trimmed(&object.name), trimmed(&entry.name))).collect()
        };
        prop_assert_eq!(names(&system), names(&again), "{}", specification.text);
        prop_assert!(!specification.text.contains("in full"), "{}", specification.text);
    }
}
