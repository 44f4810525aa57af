//! The JSON Schema accepts what the compiler accepts and refuses what it calls misshapen; the language reference
//! and its examples are right.

use std::fs;
use std::path::{Path, PathBuf};

use jsonschema::Validator;
use od_reference::Page;
use od_spec::diag::Diagnostics;
use od_spec::keys::{ENTRY, Need};
use od_spec::plant::plant;
use od_spec::source::SourceMap;
use od_spec::{Loader, NoFiles, assign_layers, compile, is_parameter_file, parameter_file};
use od_tests::shipped::in_one_file;
use serde_json::Value;

use crate::typed_yaml::json;

/// Codes of mistakes that the schema sees: unknown key, wrong kind, missing key, number out of range, unknown word.
const SHAPE_CODES: [&str; 5] = ["od0201", "od0202", "od0203", "od0205", "od0207"];

/// Cases under `tests/ui` with one of those codes that no schema can refuse, and why.
const BEYOND_SCHEMA: &[(&str, &str)] = &[
    ("err_od0203_array", "`count` may follow from `elements`, and both may come from a library"),
    ("err_od0203_like", "a name may come from a library"),
    ("err_od0203_not_from_the_library", "whether a library has an object is for the compiler to say"),
    ("err_od0203_defaults_of_some", "which devices have an object is for the compiler to say"),
    ("err_od0203_channels", "which features have channels is for the libraries to say"),
    ("err_od0205_consumers", "a map may as well be one of defaults by device"),
    ("err_od0207_allow", "which codes there are is for the rules to say"),
    ("err_od0203_cob_id", "`cob-id` is needed for some PDO numbers only, and only by valid PDOs"),
    ("err_od0203_entry", "`name`, `type` and `access` may come from the object or a library"),
    ("err_od0203_empty_enum", "a map may be empty where nothing is listed yet"),
    ("err_od0203_table_without_content", "of many alternatives, editors would name the first"),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn validator() -> Validator {
    let schema: Value = serde_json::from_str(&od_reference::json_schema()).expect("JSON");
    jsonschema::draft7::new(&schema).expect("a schema")
}

fn problems(validator: &Validator, yaml: &str) -> Vec<String> {
    validator.iter_errors(&json(yaml)).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

fn diagnostics(yaml: &str) -> Diagnostics {
    let mut sources = SourceMap::new();
    let file = sources.add("test.od.yaml", yaml);
    compile(&mut sources, file, &mut NoFiles).diagnostics
}

/// Specifications under a directory whose names start with one of these words.
fn specifications(directory: &str, starts: &[&str]) -> Vec<(String, String)> {
    let Ok(entries) = fs::read_dir(root().join(directory)) else { return Vec::new() };
    let mut found: Vec<(String, String)> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter_map(|path| {
            let name = path.file_name()?.to_str()?.to_lowercase();
            let fits = name.ends_with(".od.yaml") && starts.iter().any(|start| name.starts_with(start));
            fits.then(|| (name, fs::read_to_string(&path)))
        })
        .filter_map(|(name, text)| Some((name, text.ok()?)))
        .collect();
    found.sort();
    found
}

/// Puts something under `objects:` of a small specification.
fn with_object(object: &str) -> String {
    format!(
        "od-spec: 1\ntitle: t\ndevices: {{d: {{name: d, bit-rates: [125]}}}}\nobjects:\n  0x2000: {object}\n"
    )
}

#[test]
fn every_valid_specification_is_accepted() {
    let validator = validator();
    let mut all = specifications("od-spec/devices", &[""]);
    all.extend(specifications("od-spec/profiles", &[""]));
    assert!(all.len() >= 2);
    all.extend(specifications("tests/ui", &["ok", "warn"]));
    for (name, text) in all {
        assert_eq!(problems(&validator, &text), Vec::<String>::new(), "{name}");
    }
}

#[test]
fn every_notation_of_a_valid_value_is_accepted() {
    let validator = validator();
    for object in [
        "{name: 1.10, type: unsigned8, access: rw locked, default: 0x10, min: 1_0, max: \"0x20\"}",
        "{name: no, type: boolean, access: rw, default: yes, about: {en: a, de: true}}",
        "{name: a, type: 402, access: ro, special: {-1: none, 0x7F: {name: all}, \"1_0\": ten}}",
        "{name: a, type: unsigned8, access: rw, default: $NODEID + 1, writable-when: \"0x6060 == 6\"}",
        "{name: a, type: unsigned8, access: ro, bit-errors: {0: 0x4420, 1..3: [1, \"0b10\"]}}",
        "{alias: 0x6064.0x0A, devices: [d], type: integer16, rounding: nearest, outside: wrap}",
        "{from: cia301, omit: [4], sub0: {access: rw, default: 0}}",
        "{name: a, array: {count: \"0x0_2\", name: \"b {n}\", type: real32, access: ro, elements: {0x02: {default: 1e3}}}}",
        "{name: a, record: {1: {name: b, type: unsigned8, access: ro}, \"0o2\": {name: c, type: t, access: wo}}}",
        "{name: a, record: }",
    ] {
        assert_eq!(problems(&validator, &with_object(object)), Vec::<String>::new(), "{object}");
    }
    for rest in [
        "types: {t: {base: unsigned8, rest: unused, bits: {0: a, 1..2: {name: b, values: {0: off, 1: on}}, \"4 .. 5\": reserved}}}",
        "units: {a: {symbol: V, scale: 0.1}, b: {symbol: V, scale: 1 / 10, base: 1/1000 V}, c: {symbol: 1, base: 60 s}}",
        "pdos: {pump: {receive: {0x1: {map: [0x6040, a.b, 8192.1, unsigned8]}}, transmit: }}",
        "errors: {0x1000..0x1FFF: {name: 1}, 8192: {name: b}, \"0xFF_00\": {name: c}}",
        "document: [{title: a, content: [{errors: all}, {errors: [0x1000, 4096]}, {rows: {columns: [1], rows: [[0], [{de: b}]]}}]}]",
        "state-machines: {m: {status: a, command: 0x6040, states: {s: {pattern: 00000001}}, transitions: {0x0: {from: start, to: s, event: e}}}}",
        "history: [{number: 1.00, date: 2008-02-29}]\nerrata:",
    ] {
        let text = format!("od-spec: 1\ntitle: 1.0\n{rest}\n");
        let found = problems(&validator, &text);
        // An empty list is not a list; an empty map is a map.
        let expected = usize::from(rest.ends_with("errata:"));
        assert_eq!(found.len(), expected, "{rest}: {found:?}");
    }
}

#[test]
fn misshapen_specifications_are_refused() {
    let validator = validator();
    let objects = [
        ("OD0201", "{name: a, type: unsigned8, acces: ro}"),
        ("OD0201", "{name: a, record: {1: {name: b, type: unsigned8, access: ro, count: 3}}}"),
        ("OD0202", "[]"),
        ("OD0202", "{name: [a], type: unsigned8, access: ro}"),
        ("OD0202", "{name: , type: unsigned8, access: ro}"),
        ("OD0202", "{name: a, array: 3}"),
        ("OD0202", "{name: a, type: unsigned8, access: ro, special: none}"),
        ("OD0202", "{name: a, from: x, omit: 3}"),
        ("OD0203", "{name: a, type: unsigned8, access: ro, special: {1: {about: b}}}"),
        ("OD0205", "{name: a, array: {count: 255, name: \"b {n}\", type: unsigned8, access: ro}}"),
        ("OD0206", "{name: a, type: unsigned8, access: ro, bit-errors: {0: 0x10000}}"),
        ("OD0207", "{name: a, type: unsigned8, access: r}"),
        ("OD0207", "{name: a, type: unsigned8, access: ro, stored: yes}"),
        ("OD0207", "{name: a, type: unsigned8, access: rw, eds: {access: rw locked}}"),
        ("OD0112", "{name: a, record: {b: {name: b, type: unsigned8, access: ro}}}"),
        ("OD0204", "{name: a, array: {count: b, name: \"b {n}\", type: unsigned8, access: ro}}"),
        ("OD0206", "{alias: 0xG, type: unsigned8}"),
    ];
    let whole = [
        ("OD0203", "od-spec: 1\n"),
        ("OD0205", "od-spec: 2\ntitle: t\n"),
        ("OD0112", "od-spec: 1\ntitle: t\nobjects: {a: {}}\n"),
        ("OD0206", "od-spec: 1\ntitle: t\nrevision: {number: 1, date: 27.05.2009}\n"),
        ("OD0206", "od-spec: 1\ntitle: t\nunits: {a: {symbol: V, base: V}}\n"),
        ("OD0207", "od-spec: 1\ntitle: t\ndevices: {pump: {name: Pump, lss: 1}}\n"),
    ];
    let objects = objects.map(|(code, object)| (code, with_object(object)));
    for (code, text) in objects.into_iter().chain(whole.map(|(code, text)| (code, text.to_owned()))) {
        let codes: Vec<&str> = diagnostics(&text).iter().map(|diagnostic| diagnostic.code.id).collect();
        assert!(codes.contains(&code), "expected {code}, found {codes:?}:\n{text}");
        assert!(!problems(&validator, &text).is_empty(), "{code} is accepted:\n{text}");
    }
}

#[test]
fn misshapen_cases_are_refused() {
    let validator = validator();
    let cases = specifications("tests/ui", &["err"]);
    for (name, _) in BEYOND_SCHEMA {
        assert!(
            cases.iter().any(|(case, _)| case.starts_with(name)),
            "{name} is gone; remove it from the list"
        );
    }
    for (name, text) in cases {
        let is_known = BEYOND_SCHEMA.iter().any(|(known, _)| name.starts_with(known));
        if SHAPE_CODES.iter().any(|code| name.contains(code)) && !is_known {
            assert!(
                !problems(&validator, &text).is_empty(),
                "{name} is accepted; if no schema can refuse it, say so in BEYOND_SCHEMA"
            );
        }
    }
}

/// The pieces of YAML on a page of the language reference.
fn examples(page: &Page) -> Vec<&str> {
    let pieces = page.text.split("```yaml\n").skip(1);
    pieces.filter_map(|rest| Some(rest.split_once("```")?.0)).collect()
}

/// Reads the part among the examples of a page.
struct PartOf<'a>(&'a [&'a str]);

impl Loader for PartOf<'_> {
    fn load(&mut self, _: &str, _: &str) -> Result<Vec<u8>, String> {
        let part = self.0.iter().find(|piece| is_part(piece)).ok_or("no part")?;
        Ok(part.as_bytes().to_vec())
    }
}

fn is_part(piece: &str) -> bool {
    piece.contains("\npart-of:")
}

#[test]
fn the_examples_of_the_reference_compile_without_a_message() {
    let head = "od-spec: 1\ntitle: t\nvendor: {name: v, number: 1}\nuses: [cia301, cia401, cia402]\n";
    let drive = "devices: {pump: {name: Pump, bit-rates: [125], device-type: 0x0002_0192, features: [heartbeat producer, drive, profile position mode]}}\n";
    let validator = validator();
    let mut count = 0;
    for page in od_reference::language_pages() {
        let pieces = examples(&page);
        assert!(!pieces.is_empty(), "{}", page.file);
        for piece in &pieces {
            count += 1;
            if is_parameter_file(piece) {
                check_parameters(piece);
                continue;
            }
            if piece.starts_with("od-plant:") {
                check_plant(piece);
                continue;
            }
            let is_whole = piece.starts_with("od-spec:");
            // A drive's objects can be mapped, so that it has PDOs.
            let has_devices = piece.lines().any(|line| line.starts_with("devices:"));
            let devices = if has_devices { "" } else { drive };
            let pdos = if has_devices || piece.contains("pdos:") {
                ""
            } else {
                "pdos: {pump: {receive: {1: {valid: no, map: []}}, transmit: {1: {valid: no, map: []}}}}\n"
            };
            let text = if is_whole { (*piece).to_owned() } else { format!("{head}{devices}{pdos}{piece}") };
            assert_eq!(problems(&validator, &text), Vec::<String>::new(), "{}: {piece}", page.file);
            if is_part(piece) {
                continue;
            }
            let mut sources = SourceMap::new();
            let file = sources.add("pump.od.yaml", &*text);
            let found = compile(&mut sources, file, &mut PartOf(&pieces)).diagnostics.without_notes();
            let found: Vec<String> =
                found.iter().map(|one| format!("{} {}", one.code, one.message)).collect();
            assert_eq!(found, Vec::<String>::new(), "{}: {piece}", page.file);
        }
    }
    assert!(count > 30, "{count}");
}

/// A piece that is a plant file is one of the pitch system.
fn check_plant(piece: &str) {
    struct Pitch;
    impl Loader for Pitch {
        fn load(&mut self, path: &str, _from: &str) -> Result<Vec<u8>, String> {
            let stem = path.strip_suffix(".od.yaml").ok_or("no specification")?;
            Ok(in_one_file(stem).into_bytes())
        }
    }
    let mut sources = SourceMap::new();
    let file = sources.add("plant.yaml", piece);
    let read = plant(&mut sources, file, &mut Pitch);
    assert!(read.diagnostics.is_empty(), "{piece}: {:?}", read.diagnostics);
    assert!(read.plant.is_some_and(|plant| plant.nodes.len() == 1200));
    let schema = serde_json::from_str(&od_reference::plant_schema()).expect("JSON");
    assert_eq!(problems(&jsonschema::draft7::new(&schema).expect("a schema"), piece), Vec::<String>::new());
}

/// A piece that is a parameter file is one of the oven.
fn check_parameters(piece: &str) {
    let mut sources = SourceMap::new();
    let spec = sources.add("oven.od.yaml", include_str!("../../shared/oven.od.yaml"));
    let system = compile(&mut sources, spec, &mut NoFiles).system.expect("no errors");
    let file = sources.add("parameters", piece);
    let mut diagnostics = Diagnostics::new();
    let read = parameter_file(&sources, file, &mut diagnostics).expect("a parameter file");
    let oven = system.device("oven").expect("the oven");
    read.check_device(&system, oven, &mut diagnostics);
    let count = assign_layers(&system, oven, 5, &[read.layer], &mut diagnostics).values.len();
    assert!(diagnostics.is_empty() && count > 5, "{count} of {piece}: {diagnostics:?}");
    let schema = serde_json::from_str(&od_reference::parameter_schema(&system, oven)).expect("JSON");
    assert_eq!(problems(&jsonschema::draft7::new(&schema).expect("a schema"), piece), Vec::<String>::new());
}

#[test]
fn an_entry_needs_the_keys_that_its_table_says() {
    let needed: Vec<&str> =
        ENTRY.keys.iter().filter(|key| key.need == Need::Inherited).map(|key| key.name).collect();
    let written = [("name", "a"), ("type", "unsigned8"), ("access", "ro")];
    assert_eq!(needed, written.map(|(key, _)| key));
    let is_missing = |left_out: &str| {
        let keys = written.iter().filter(|(key, _)| *key != left_out);
        let keys: Vec<String> = keys.map(|(key, value)| format!("{key}: {value}")).collect();
        let found = diagnostics(&with_object(&format!("{{{}}}", keys.join(", "))));
        found.iter().any(|one| one.code.id == "OD0203")
    };
    assert!(!is_missing(""));
    assert!(needed.into_iter().all(is_missing));
}

#[test]
fn examples_of_keys_fit_them() {
    let schema: Value = serde_json::from_str(&od_reference::json_schema()).unwrap();
    check_examples(&schema, &schema);
    for table in schema["definitions"].as_object().unwrap().values() {
        check_examples(table, &schema);
    }
}

/// Checks the examples of one table's keys, which are texts of YAML, by the schema of each key.
fn check_examples(table: &Value, schema: &Value) {
    for (name, key) in table["properties"].as_object().into_iter().flatten() {
        for example in key["examples"].as_array().into_iter().flatten() {
            // Next to `$ref`, draft-07 validators ignore everything, so that definitions need a level of their own.
            let of_key = serde_json::json!({"allOf": [key], "definitions": schema["definitions"]});
            let validator = jsonschema::draft7::new(&of_key).expect("a schema");
            let value = json(example.as_str().expect("a text"));
            assert!(validator.is_valid(&value), "{name}: {example}");
        }
    }
}
