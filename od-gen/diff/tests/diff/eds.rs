//! Comparison with an EDS, which states fewer facts.

use std::collections::BTreeMap;

use od_diff::{Question, Scope, Unpaired, compare, human, short};
use od_spec::ascii::transliterate;
use od_spec::model::{Dictionary, Entry, Storage, System, Text, Value};

use crate::shipped::PITCH;
use crate::{FULLMO, PITCH_SYSTEM, system};

/// What is left of a device in its EDS: what the keys of the format say.
fn as_eds(system: &System, key: &str) -> System {
    let mut eds = system.clone();
    eds.devices.retain(|device| device.key == key);
    (eds.units, eds.types, eds.machines) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    eds.errors.clear();
    eds.constraints.clear();
    eds.errata.clear();
    eds.document = od_spec::model::Document::default();
    "an EDS".clone_into(&mut eds.title);
    eds.vendor.name = transliterate(&eds.vendor.name);
    for device in &mut eds.devices {
        device.about = Text::default();
        device.name.clone_from(&device.info.product_name);
        for object in device.objects.values_mut() {
            object.name = transliterate(&object.name);
            object.about = Text::default();
            (object.category, object.since, object.identifier) = (None, None, None);
            object.entries.iter_mut().for_each(strip);
        }
    }
    eds
}

fn strip(entry: &mut Entry) {
    let (low, high) = entry.hull();
    (entry.low, entry.high) = (low, high);
    (entry.access, entry.locked) = (entry.eds.access, false);
    entry.name = transliterate(&entry.name);
    entry.about = Text::default();
    (entry.named_type, entry.unit, entry.alias, entry.writable_when) = (None, None, None, None);
    (entry.category, entry.since, entry.identifier, entry.capacity) = (None, None, None, None);
    entry.special.clear();
    entry.bit_errors.clear();
    entry.stored = Storage::No;
    if !entry.eds.default {
        entry.default = None;
    }
    entry.eds.default = true;
}

fn ask<'a>(old: &'a System, new: &'a System, scope: Scope) -> Question<'a> {
    Question { old, new, scope, device: None, nodes: None }
}

#[test]
fn a_specification_does_not_differ_from_its_own_eds() {
    for (text, keys) in [(&PITCH, &["pmm", "pmc"][..]), (&FULLMO, &["fullmo"])] {
        let spec = system(text);
        let keys = if keys == ["fullmo"] {
            vec![spec.devices[0].key.clone()]
        } else {
            keys.iter().map(ToString::to_string).collect()
        };
        for key in keys {
            let eds = as_eds(&spec, &key);
            for question in
                [ask(&spec, &eds, Scope::WhatAnEdsStates), ask(&eds, &spec, Scope::WhatAnEdsStates)]
            {
                let found = compare(&question).unwrap();
                assert_eq!(short(&found), "", "{key}");
                assert_eq!(found.devices.len(), 1);
            }
            // With all facts, they differ; so the comparison above can fail.
            let all = compare(&Question { device: Some(&key), ..ask(&spec, &eds, Scope::Everything) });
            assert!(all.unwrap().changes().count() > 100);
        }
    }
}

#[test]
fn a_dcf_has_the_node_id_as_a_number() {
    let spec = &*PITCH_SYSTEM;
    let mut dcf = as_eds(spec, "pmc");
    let resolve = |device: &mut Dictionary| {
        for entry in device.objects.values_mut().flat_map(|object| &mut object.entries) {
            if let Some(Value::NodeId(offset)) = entry.default {
                entry.default = Some(Value::Integer(i128::from(offset) + 5));
            }
        }
    };
    dcf.devices.iter_mut().for_each(resolve);
    let found = compare(&ask(spec, &dcf, Scope::WhatADcfStates)).unwrap();
    assert_eq!(short(&found), "");
    let found = compare(&ask(spec, &dcf, Scope::WhatAnEdsStates)).unwrap();
    assert!(short(&found).contains("1400h.1"), "{}", short(&found));
}

#[test]
fn what_an_eds_states_is_compared() {
    let spec = &*PITCH_SYSTEM;
    let changed = PITCH
        // An EDS says nothing of these …
        .replacen("decicelsius: {symbol: °C, scale: 1/10", "decicelsius: {symbol: °C, scale: 1/5", 1)
        .replacen("name: test active", "name: test running", 1)
        // … and states these.
        .replacen("default: 0 min\n    min: 60 min", "default: 0 min\n    min: 0 min\n    max: 600 min", 1)
        .replacen("    name: battery test voltage\n", "    name: test voltage\n", 1);
    let eds = as_eds(&system(&changed), "pmm");
    let found = compare(&ask(spec, &eds, Scope::WhatAnEdsStates)).unwrap();
    let lines = short(&found);
    // Defaults of stored entries are withheld, raw limits did not change.
    assert_eq!(
        lines.lines().collect::<Vec<_>>(),
        [
            "pmm: ~ 3068h test voltage: name: battery test voltage -> test voltage [plc]",
            "pmm: ~ 30E3h selftest time: max: none -> 600 [plc]",
        ]
    );
    let text = human(&found, false);
    assert!(
        text.ends_with("and nothing that follows from them for firmware and stored parameters\n"),
        "{text}"
    );
}

/// An EDS describes one device; its name, or the user, says which of a system's it is.
#[test]
fn the_device_of_an_eds_has_to_be_known() {
    let spec = &*PITCH_SYSTEM;
    let mut eds = as_eds(spec, "pmc");
    eds.devices[0].key = "axis".to_owned();
    let question = ask(spec, &eds, Scope::WhatAnEdsStates);
    let keys = vec!["pmm".to_owned(), "pmc".to_owned()];
    assert_eq!(compare(&question), Err(Unpaired::WhichDevice { keys }));
    let found = compare(&Question { device: Some("pmc"), ..question }).unwrap();
    assert_eq!((found.devices.len(), short(&found).as_str()), (1, ""));
    let found = compare(&Question { device: Some("pmm"), ..question }).unwrap();
    assert!(found.changes().count() > 50, "the other device is another one");
}

/// What differs between an EDS and a copy in which one text replaces another.
fn changed(find: &str, replace: &str) -> Vec<String> {
    const COUPLER: &str = "[DeviceInfo]\nVendorNumber=7\nProductName=Coupler\nBaudRate_125=1\nCANopenSafetySupported=1\n\
        [Comments]\nLines=1\nLine1=old\n\
        [2000]\nParameterName=safe input\nDataType=5\nAccessType=ro\nSRDOMapping=1\nUnit=\u{b0}C\n\
        ;StorageLocation=RAM\n;CO_accessSRDO=rx\n\
        [SupportedModules]\nNrOfEntries=1\n\
        [M1ModuleInfo]\nProductName=8 inputs\nOrderCode=DI8\n[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n\
        [M1SubExt6000]\nParameterName=input\nDataType=5\nAccessType=ro\nCount=1\n[Vendor]\nColor=red\n";
    let read = |text: &str| {
        let mut sources = od_spec::source::SourceMap::new();
        let root = sources.add("coupler.eds", text);
        od_spec::compile(&mut sources, root, &mut od_spec::NoFiles).system.unwrap()
    };
    assert!(COUPLER.contains(find));
    let (old, new) = (read(COUPLER), read(&COUPLER.replace(find, replace)));
    let found = compare(&ask(&old, &new, Scope::WhatAnEdsStates)).unwrap();
    let reported = |change: &od_diff::Change| {
        let [before, after] = [&change.before, &change.after].map(|value| value.as_deref().unwrap_or("-"));
        let (part, class) = (change.part.as_deref().unwrap_or_default(), change.class().word());
        format!("{:?} {part} {}: {before} -> {after} [{class}]", change.place, change.fact.word())
    };
    found.changes().map(reported).collect()
}

#[test]
fn files_differ_in_what_they_say_in_their_own_words() {
    for (find, replace, expected) in [
        ("Unit=\u{b0}C", "Unit=degC", ""),
        ("SRDOMapping=1\n", "", "Object(Index(8192)) SRDOMapping key: 1 -> - [behaviour]"),
        (
            "CANopenSafetySupported=1",
            "CANopenSafetySupported=0",
            "Device [DeviceInfo] CANopenSafetySupported key: 1 -> 0 [behaviour]",
        ),
        ("Line1=old", "Line1=new", "Device comments eds: old -> new [documents]"),
        (
            ";StorageLocation=RAM\n",
            ";StorageLocation=PERSIST_MFR\n;TPDODetectCos=1\n",
            "Object(Index(8192)) CO_flagsPDO key: - -> true [firmware]; \
             Object(Index(8192)) CO_storageGroup key: - -> PERSIST_MFR [firmware]",
        ),
        (
            "CO_accessSRDO=rx",
            "CO_accessSRDO=trx",
            "Entries { index: Index(8192), first: SubIndex(0), last: SubIndex(0) } CO_accessSRDO key: rx -> trx [firmware]",
        ),
        ("Color=red", "Color=red\nShape=round", "Device [Vendor] Shape key: - -> round [behaviour]"),
        ("OrderCode=DI8", "OrderCode=DI9", "Device [M1ModuleInfo] OrderCode modules: DI8 -> DI9 [documents]"),
        ("Count=1", "Count=2", "Device [M1SubExt6000] Count modules: 1 -> 2 [plc]"),
        ("[Vendor]", "[M2ModuleInfo]\nOrderCode=X\n[Vendor]", "Device 2 modules: - ->  (X) [addition]"),
    ] {
        assert_eq!(changed(find, replace).join("; "), expected, "{find}");
    }
}

#[test]
fn a_specification_says_what_its_eds_has_in_addition_to_the_facts() {
    let with = |more: &str| {
        system(&format!(
            "od-spec: 1\ntitle: Lamp\nuses: [cia301]\ndevices:\n  lamp:\n    name: Lamp\n    bit-rates: [125]\n    \
             features: [heartbeat producer]\n    eds: {{created: 2024-02-29 00:05{more}}}\n"
        ))
    };
    let said = |old: &str, new: &str| {
        let (old, new) = (with(old), with(new));
        short(&compare(&ask(&old, &new, Scope::Everything)).unwrap())
    };
    let red = ", sections: {Vendor: {Color: red}}";
    assert_eq!(said(red, red), "");
    let found = said("", red);
    assert!(found.contains("[Vendor] Color") && found.contains("red"), "{found}");
    // Comments that are left to us are not compared: what they say follows.
    assert_eq!(said("", ", comments: [one]"), "");
    assert!(said(", comments: [one]", ", comments: [two]").contains("two"));
}
