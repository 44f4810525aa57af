//! The JSON Schema of a device's parameter files accepts what is right and refuses what it can see to be wrong.

#![expect(clippy::unwrap_used, clippy::expect_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::Path;

use jsonschema::Validator;
use od_import::parameters::{About, write};
use od_reference::{parameter_schema, plant_schema_of};
use od_spec::Commissioning;
use od_spec::model::{Dictionary, System, TypeKind, Value};
use od_tests::{compile_clean, compile_with_sources, root};

use crate::typed_yaml::json;

/// Cases that are wrong in a way that no schema can see, and why.
const BEYOND_SCHEMA: &[(&str, &str)] = &[
    ("err_od0319", "which characters a line of a DCF can hold is for the writer to say"),
    ("err_od0406", "a limit of a value in a unit is compared after it was scaled"),
    ("err_od0412", "so is a step"),
    ("err_od0606", "a condition is about several entries"),
    ("err_od0704", "whether a locked entry is unlocked may be in another file"),
    ("err_od0708", "one entry has many names"),
];

/// Cases that no reader of YAML reads.
const NOT_YAML: &[&str] = &["err_od0105", "err_od0110"];

/// Right files that an editor marks.
const ONLY_COMPILER: &[(&str, &str)] = &[("ok_capitals", "an editor completes names as they are spelled")];

fn validator(system: &System, device: &Dictionary) -> Validator {
    let schema = serde_json::from_str(&parameter_schema(system, device)).expect("JSON");
    assert!(jsonschema::meta::is_valid(&schema));
    jsonschema::draft7::new(&schema).expect("a schema")
}

fn problems(validator: &Validator, yaml: &str) -> Vec<String> {
    validator.iter_errors(&json(yaml)).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

fn oven() -> Validator {
    let system = compile_clean("tests/shared/oven.od.yaml").unwrap();
    validator(&system, system.device("oven").unwrap())
}

fn listed(name: &str, list: &[(&str, &str)]) -> bool {
    list.iter().any(|(known, _)| name.starts_with(known))
}

#[test]
fn right_files_pass_and_each_wrong_one_fails() {
    let validator = oven();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("ui/parameters");
    let (mut right, mut wrong) = (0, 0);
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() || NOT_YAML.iter().any(|known| name.starts_with(known)) {
            continue;
        }
        let found = problems(&validator, &fs::read_to_string(&path).unwrap());
        let is_wrong =
            name.starts_with("err_") && !listed(&name, BEYOND_SCHEMA) || listed(&name, ONLY_COMPILER);
        assert_eq!(!found.is_empty(), is_wrong, "{name}: {found:#?}");
        if is_wrong { wrong += 1 } else { right += 1 }
    }
    assert!(right > 8 && wrong > 20, "{right} and {wrong}");
}

#[test]
fn every_notation_of_an_index_is_known() {
    let validator = oven();
    let says = |key: &str, value: &str| {
        let text = format!("od-parameters: 1\nparameters: {{{key}: {value}}}\n");
        problems(&validator, &text).is_empty()
    };
    for key in ["0x2003", "2003", "2003h", "0x2003h", "2003.0", "2003sub0", "\"2003:0\"", "position"] {
        assert!(says(key, "5") && !says(key, "none"), "{key}");
    }
    for key in ["0x2006.2", "2006.2", "2006sub2", "2006Sub02", "2006.0x02", "\"2006:2\"", "supply.nominal"] {
        assert!(says(key, "231 V") && says(key, "231") && !says(key, "231 A"), "{key}");
    }
    for key in ["0x2006", "2006", "supply"] {
        assert!(says(key, "{2: 231 V, lowest: 1}") && !says(key, "231 V") && !says(key, "{4: 1}"), "{key}");
    }
    for key in ["0x2007.1", "2004.1", "2006.4", "2006.0", "0x1000", "8197.1", "temperature.measured"] {
        assert!(!says(key, "1"), "{key}");
    }
}

/// The plant of the book, whose devices the schema knows, and what is wrong with it in an editor's eyes.
#[test]
fn the_schema_of_a_plant_knows_its_devices() {
    let page = fs::read_to_string(root().join("docs/book/guides/plant.md")).unwrap();
    let (_, rest) = page.split_once("<!-- plant -->\n```yaml\n").unwrap();
    let plant = rest.split_once("```").unwrap().0;
    let system = compile_clean("tests/book/valve.od.yaml").unwrap();
    let schema = plant_schema_of(&[("valve", &system, system.device("valve").unwrap())]);
    let schema = serde_json::from_str(&schema).expect("JSON");
    assert!(jsonschema::meta::is_valid(&schema));
    let validator = jsonschema::draft7::new(&schema).expect("a schema");
    assert_eq!(problems(&validator, plant), Vec::<String>::new());
    let of_node = "right: {valve: {serial: 4711, parameters: {set pressure: 5.8 bar}}}";
    for (right, wrong) in [
        ("valve: {set pressure: 6.0 bar}", "valve: {set presure: 6.0 bar}"),
        ("valve: {set pressure: 6.0 bar}", "valve: {set pressure: 6.0 V}"),
        ("valve: {set pressure: 6.0 bar}", "valve: {0x2000: 161}"),
        // An actual value is not set.
        ("valve: {set pressure: 6.0 bar}", "valve: {actual pressure: 6.0 bar}"),
        ("valve: {set pressure: 6.0 bar}", "pump: {set pressure: 6.0 bar}"),
        ("left: {valve: 1}", "left: {valve: 128}"),
        ("left: {valve: 1}", "left: {pump: 1}"),
        (of_node, "right: {valve: {serial: 4711, parameters: {set presure: 5.8 bar}}}"),
        (of_node, "right: {valve: {serail: 4711}}"),
        (of_node, "right: {pump: {serial: 4711}}"),
        ("serial: \"2031-17\"", "serail: \"2031-17\""),
    ] {
        let changed = plant.replace(right, wrong);
        assert!(changed != plant && !problems(&validator, &changed).is_empty(), "{wrong}");
    }
    for (right, other) in [
        ("valve: {set pressure: 6.0 bar}", "valve: {0x2000: 160}"),
        ("left: {valve: 1}", "left: {valve: {node: 1, comment: new}}"),
        (of_node, "right: {valve: {unlock: [0x2000], parameters: {2000: 58}}}"),
    ] {
        let changed = plant.replace(right, other);
        assert!(changed != plant, "{other}");
        assert_eq!(problems(&validator, &changed), Vec::<String>::new(), "{other}");
    }
}

/// Every entry of the shipped devices, with the value that is written for it.
#[test]
fn what_is_written_for_a_node_passes() {
    for spec in ["od-spec/devices/pitch-control-system.od.yaml", "od-spec/devices/fullmo-drive.od.yaml"] {
        let (system, sources) = compile_with_sources(spec).unwrap();
        for device in &system.devices {
            let validator = validator(&system, device);
            let mut node = Commissioning::of_node(device, 5);
            for (id, _, entry) in device.entries() {
                // Another value than the default, and one that the entry may have.
                let listed = match entry.named_type.as_ref().map(|named| &named.kind) {
                    Some(TypeKind::Enum(values)) => values.iter().map(|value| value.value).collect(),
                    Some(TypeKind::Bits(_)) | None => Vec::new(),
                };
                let (low, high) = entry.data_type.range().unwrap_or((1, 0));
                let other = |raw: &i128| {
                    let is_default = entry.default.as_ref().and_then(Value::integer) == Some(*raw);
                    let is_listed = listed.is_empty() || listed.contains(raw);
                    entry.allows(*raw) && !is_default && is_listed && (low..=high).contains(raw)
                };
                let ends = [entry.high, entry.low, Some(2), Some(1), Some(0), Some(high), Some(low)];
                let value = ends.into_iter().flatten().chain(listed.clone()).find(other);
                if let (Some(raw), true) = (value, entry.access.is_writable() && entry.alias.is_none()) {
                    node.values.insert(id, Value::Integer(raw));
                }
            }
            let about =
                About { system: &system, sources: &sources, device, names_device: true, node_id: Some(5) };
            let written = write(about, &node, Vec::new());
            assert!(written.count > 20, "{}: {}", device.key, written.count);
            assert_eq!(problems(&validator, &written.text), Vec::<String>::new(), "{}", device.key);
        }
    }
}
