//! The names in the C of a device: constants are what the JSON dump says, as the compiler computes them, and functions read and write
//! what the table says.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::Command;

use od_spec::ascii::transliterate;
use od_tests::c_dictionary::{Compiler, Written, write, write_text};
use serde_json::Value as Json;

const SPECIFICATIONS: [&str; 6] = [
    "od-spec/devices/pitch-control-system.od.yaml",
    "od-spec/devices/fullmo-drive.od.yaml",
    "tests/readers/everything.od.yaml",
    "tests/readers/limits.od.yaml",
    "tests/readers/scales.od.yaml",
    "tests/c/conditions.od.yaml",
];

fn directory(name: &str) -> PathBuf {
    let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("c-names").join(name);
    let _ = std::fs::remove_dir_all(&directory);
    std::fs::create_dir_all(&directory).unwrap();
    directory
}

/// The words of a name in upper case.
fn upper(name: &str) -> String {
    let ascii = transliterate(name);
    let words: Vec<&str> =
        ascii.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let joined = words.join("_").to_uppercase();
    if joined.starts_with(|c: char| c.is_ascii_digit()) { format!("N{joined}") } else { joined }
}

/// A number as another generator would write it.
fn number(value: i128) -> String {
    match value {
        _ if value == i128::from(i64::MIN) => "(-9223372036854775807LL - 1)".to_owned(),
        _ if value > i128::from(i64::MAX) => format!("{value}ULL"),
        _ if i32::try_from(value).is_err() => format!("({value}LL)"),
        _ => format!("({value})"),
    }
}

fn integer(json: &Json) -> Option<i128> {
    json.to_string().parse().ok()
}

/// Bits of a data type, and whether it has a sign.
fn integer_type(data_type: &str) -> Option<(u32, bool)> {
    let (digits, signed) = match (data_type.strip_prefix("unsigned"), data_type.strip_prefix("integer")) {
        (Some(digits), _) => (digits, false),
        (_, Some(digits)) => (digits, true),
        _ => return None,
    };
    Some((digits.parse().ok()?, signed))
}

/// What the compiler has to find true of constants.
#[derive(Default)]
struct Claims {
    text: String,
    count: usize,
}

impl Claims {
    fn claim(&mut self, claim: &str) {
        self.count += 1;
        let _ = writeln!(self.text, "typedef char claim_{}[({claim}) ? 1 : -1];", self.count);
    }

    fn equal(&mut self, name: &str, value: i128) {
        self.claim(&format!("{name} == {}", number(value)));
    }
}

/// The macros of a header: their names and values.
fn macros(header: &str) -> BTreeMap<&str, &str> {
    let lines = header.lines().filter_map(|line| line.strip_prefix("#define ")?.split_once(' '));
    lines.collect()
}

/// The number in `(0x2000U)`.
fn value_of(value: &str) -> u32 {
    let digits = value.trim_matches(['(', ')']).trim_end_matches(['U', 'L']);
    match digits.strip_prefix("0x") {
        Some(digits) => u32::from_str_radix(digits, 16).unwrap(),
        None => digits.parse().unwrap(),
    }
}

fn value_json(value: i128) -> Json {
    serde_json::from_str(&value.to_string()).unwrap()
}

fn mask_and_value(pattern: &str) -> (i128, i128) {
    pattern.chars().fold((0, 0), |(mask, value), bit| {
        let (matters, level) = match bit {
            '0' => (1, 0),
            '1' => (1, 1),
            'x' => (0, 0),
            'r' | 'R' | '↑' => (1, 1),
            _ => (1, 0),
        };
        (mask << 1 | matters, value << 1 | level)
    })
}

fn claims_of_types(claims: &mut Claims, dump: &Json, device: &Json, prefix: &str) {
    let entries =
        device["objects"].as_array().unwrap().iter().flat_map(|object| object["entries"].as_array().unwrap());
    let entries: Vec<&Json> = entries.collect();
    let used: BTreeSet<&str> = entries.iter().filter_map(|entry| entry["named-type"].as_str()).collect();
    for named in dump["types"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|named| used.contains(named["name"].as_str().unwrap()))
    {
        let name = upper(named["name"].as_str().unwrap());
        let c_type = format!("{}_{}_t", prefix.to_lowercase(), name.to_lowercase());
        let (bits, signed) = integer_type(named["base"].as_str().unwrap()).unwrap();
        claims.claim(&format!("sizeof({c_type}) == {}", bits.next_power_of_two() / 8));
        let is_unsigned = !signed || named.get("bits").is_some();
        claims.claim(&format!("{}(({c_type})(-1) > 0)", if is_unsigned { "" } else { "!" }));
        for value in named.get("values").and_then(Json::as_array).into_iter().flatten() {
            let value_name = upper(value["name"].as_str().unwrap());
            claims.equal(&format!("{prefix}_{name}_{value_name}"), integer(&value["value"]).unwrap());
        }
        for field in named.get("bits").and_then(Json::as_array).into_iter().flatten() {
            let label = field["name"].as_str().unwrap_or_default();
            if field["usage"] != "used" || label.is_empty() {
                continue;
            }
            let (first, last) = (field["first"].as_u64().unwrap(), field["last"].as_u64().unwrap());
            let of = format!("{prefix}_{name}_{}", upper(label));
            claims.equal(&format!("{of}_MASK"), ((1i128 << (last - first + 1)) - 1) << first);
            claims.equal(&format!("{of}_SHIFT"), first.into());
            for value in
                field.get("values").and_then(Json::as_array).into_iter().flatten().filter(|_| first != last)
            {
                let value_name = value["name"].as_str().unwrap();
                claims.equal(
                    &format!("{prefix}_{name}_{}", upper(&format!("{label} {value_name}"))),
                    integer(&value["value"]).unwrap(),
                );
            }
        }
    }
    let used: BTreeSet<&str> = entries
        .iter()
        .filter(|entry| integer_type(entry["type"].as_str().unwrap()).is_some())
        .filter_map(|entry| entry["unit"].as_str())
        .collect();
    for unit in
        dump["units"].as_array().unwrap().iter().filter(|unit| used.contains(unit["name"].as_str().unwrap()))
    {
        let of = format!("{prefix}_UNIT_{}", upper(unit["name"].as_str().unwrap()));
        for (kind, fraction) in [("", &unit["scale"]), ("OFFSET_", &unit["offset"])] {
            let Some(fraction) = fraction.as_array() else { continue };
            claims.equal(&format!("{of}_{kind}NUMERATOR"), integer(&fraction[0]).unwrap());
            claims.equal(&format!("{of}_{kind}DENOMINATOR"), integer(&fraction[1]).unwrap());
        }
    }
}

fn is_on(of: &Json, key: &Json) -> bool {
    of["on"].as_array().is_none_or(|on| on.contains(key))
}

fn claims_of_errors_and_machines(claims: &mut Claims, dump: &Json, device: &Json, prefix: &str) {
    let of_device = |key: &str| {
        let list = dump.get(key).and_then(Json::as_array).cloned().unwrap_or_default();
        list.into_iter().filter(|one| is_on(one, &device["key"])).collect::<Vec<_>>()
    };
    for error in of_device("errors") {
        let code =
            i128::from_str_radix(error["code"].as_str().unwrap().trim_start_matches("0x"), 16).unwrap();
        claims.equal(&format!("{prefix}_ERROR_{}", upper(error["name"].as_str().unwrap())), code);
    }
    for machine in of_device("state-machines") {
        let of = format!("{prefix}_{}", upper(machine["name"].as_str().unwrap()));
        for (kind, list) in [("STATE", &machine["states"]), ("COMMAND", &machine["commands"])] {
            for one in list.as_array().into_iter().flatten() {
                let name = format!("{of}_{kind}_{}", upper(one["name"].as_str().unwrap()));
                let (mask, value) = mask_and_value(one["pattern"].as_str().unwrap());
                claims.equal(&format!("{name}_MASK"), mask);
                claims.equal(&format!("{name}_VALUE"), value);
            }
        }
    }
}

fn claims_of_entries(claims: &mut Claims, device: &Json, prefix: &str, header: &str) {
    let macros = macros(header);
    let begin = format!("{prefix}_INDEX_");
    let mut names: BTreeMap<(u32, u32), &str> = BTreeMap::new();
    for (name, index) in macros.iter().filter_map(|(name, value)| Some((name.strip_prefix(&begin)?, value))) {
        let sub = macros[format!("{prefix}_SUB_{name}").as_str()];
        assert!(names.insert((value_of(index), value_of(sub)), name).is_none(), "{name}");
    }
    let mut row = 0;
    for object in device["objects"].as_array().unwrap() {
        let index = value_of(object["index"].as_str().unwrap());
        for entry in object["entries"].as_array().unwrap() {
            let name =
                names.remove(&(index, u32::try_from(entry["sub"].as_u64().unwrap()).unwrap())).unwrap();
            claims.equal(&format!("{prefix}_ENTRY_{name}"), row);
            row += 1;
            let data_type = entry["type"].as_str().unwrap();
            // Of a number of entries and of the parameters of PDOs there are no constants.
            for (kind, value) in
                [("DEFAULT", &entry["default"]["raw"]), ("LOW", &entry["low"]), ("HIGH", &entry["high"])]
            {
                let name = format!("{prefix}_{kind}_{name}");
                let is_there = macros.contains_key(name.as_str());
                let value = value.get("raw").unwrap_or(value);
                match (integer_type(data_type), integer(value)) {
                    (Some((bits, signed)), Some(value)) if is_there => {
                        // The bits of a word have no sign.
                        let is_word = signed && value < 0 && !macros[name.as_str()].contains('-');
                        // The limits of the dump take in the special values, as those of an EDS do.
                        let is_special = kind != "DEFAULT"
                            && entry["special"]
                                .as_array()
                                .into_iter()
                                .flatten()
                                .any(|one| one["value"] == value_json(value));
                        match (is_special, kind) {
                            (true, "LOW") => claims.claim(&format!("{name} >= {}", number(value))),
                            (true, _) => claims.claim(&format!("{name} <= {}", number(value))),
                            (false, _) => {
                                claims.equal(&name, if is_word { value + (1 << bits) } else { value });
                            }
                        }
                    }
                    (Some(_), None) => assert!(!is_there, "{name}"),
                    _ => {}
                }
            }
        }
    }
    assert!(names.is_empty(), "{names:?}");
}

#[test]
fn constants_are_what_the_dump_says() {
    let mut count = 0;
    for path in SPECIFICATIONS {
        let directory = directory(&upper(path));
        let Written { system, devices } = write(path, &directory).unwrap();
        let dump: Json = serde_json::from_slice(&od_formats::json::dump(&system, &[])).unwrap();
        for device in dump["devices"].as_array().unwrap() {
            let key = device["key"].as_str().unwrap();
            assert!(devices.iter().any(|device| device == key));
            let prefix = key.to_uppercase();
            let header = directory.join("c").join(key).join(format!("{key}_od.h"));
            let header = std::fs::read_to_string(header).unwrap();
            let mut claims = Claims::default();
            claims_of_types(&mut claims, &dump, device, &prefix);
            claims_of_errors_and_machines(&mut claims, &dump, device, &prefix);
            claims_of_entries(&mut claims, device, &prefix, &header);
            let source = directory.join(format!("{key}_claims.c"));
            std::fs::write(&source, format!("#include \"{key}_od.h\"\n{}", claims.text)).unwrap();
            Compiler::new("cc", &[]).object(&source, &directory, key, &[]).unwrap();
            count += claims.count;
        }
    }
    assert!(count > 3_000, "{count} claims only");
}

/// A function of a header: what it gives, its name, and its parameters.
fn functions(header: &str) -> Vec<(String, String, Vec<String>)> {
    let heads = header.split("static inline ").skip(1).filter_map(|rest| rest.split_once('{'));
    let heads = heads.map(|(head, _)| head.split_whitespace().collect::<Vec<_>>().join(" "));
    let functions = heads.map(|head| {
        let (name, parameters) = head.split_once('(').unwrap();
        let (returned, name) = name.rsplit_once([' ', '*']).unwrap();
        let parameters =
            parameters.trim_end_matches(')').split(", ").map(|one| one.trim().to_owned()).collect();
        (returned.trim().to_owned(), name.to_owned(), parameters)
    });
    functions.collect()
}

/// A program that calls every function of a header that reads or writes an entry.
fn calls(key: &str, header: &str) -> (String, usize) {
    let prefix = key.to_uppercase();
    let (mut text, mut count) = (String::new(), 0);
    let functions = functions(header);
    let macros = macros(header);
    let setters: BTreeMap<&str, &(String, String, Vec<String>)> =
        functions.iter().map(|function| (function.1.as_str(), function)).collect();
    for (returned, function, parameters) in &functions {
        let Some(name) = function.strip_prefix(&format!("{key}_get_")) else { continue };
        count += 1;
        let row = format!("{prefix}_ENTRY_{}", name.to_uppercase());
        let setter = setters.get(format!("{key}_set_{name}").as_str());
        if let Some(object) = name.strip_prefix("element_of_") {
            let value = parameters[2].rsplit_once(" *").unwrap().0;
            let begin = format!("{prefix}_INDEX_{}_", object.to_uppercase());
            let element = macros.keys().find(|name| {
                let sub = name
                    .strip_prefix(&begin)
                    .map(|rest| format!("{prefix}_SUB_{}_{rest}", object.to_uppercase()));
                sub.is_some_and(|sub| macros.get(sub.as_str()) == Some(&"(1U)"))
            });
            let index = element.unwrap();
            let _ = writeln!(text, "ELEMENTS({value}, {function}, {key}_set_{name}, {index})");
            continue;
        }
        match returned.as_str() {
            "od_bytes_t" => {
                let _ = writeln!(text, "STRING({function}, {row})");
                if setter.is_some() {
                    let _ = writeln!(text, "SET_STRING({function}, {key}_set_{name}, {row})");
                }
            }
            "float" | "double" | "od_time_t" => {
                if setter.is_some() {
                    let _ = writeln!(text, "SAME({function}, {key}_set_{name}, {row})");
                }
            }
            "bool" if parameters.len() == 2 => {
                let value = parameters[1].rsplit_once(" *").unwrap().0;
                let _ = writeln!(text, "SHOWN({value}, {function}, {row})");
            }
            _ => {
                let _ = writeln!(text, "NUMBER({function}, {row})");
                if let Some((returned, _, parameters)) = setter {
                    let value = parameters[1].rsplit_once(' ').unwrap().0;
                    let kind = if returned == "void" { "SET" } else { "TRY" };
                    let _ = writeln!(text, "{kind}({value}, {function}, {key}_set_{name}, {row})");
                }
            }
        }
    }
    (text, count)
}

#[test]
fn functions_read_and_write_what_the_table_says() {
    let mut count = 0;
    for path in SPECIFICATIONS {
        let directory = directory(&format!("{}_CALLS", upper(path)));
        for key in write(path, &directory).unwrap().devices {
            let header = directory.join("c").join(&key).join(format!("{key}_od.h"));
            let (text, calls) = calls(&key, &std::fs::read_to_string(header).unwrap());
            std::fs::write(directory.join("c").join(&key).join("calls.inc"), text).unwrap();
            let cc = Compiler::new("cc", &[]);
            let source = od_tests::root().join("tests/c/accessors.c");
            let mut about = Compiler::about(&key).to_vec();
            about.push(format!("-DDICTIONARY={key}_od_t"));
            let mut objects = cc.objects(&directory, &key).unwrap();
            objects.push(cc.object(&source, &directory, &key, &about).unwrap());
            let program = directory.join(&key);
            cc.link(&objects, &program).unwrap();
            let output = Command::new(&program).output().unwrap();
            let said = String::from_utf8_lossy(&output.stdout);
            assert!(output.status.success(), "{key}: {said}");
            count += calls;
        }
    }
    assert!(count > 800, "{count} functions only");
}

/// A program that fills frames with random bytes, takes them apart and puts them together again; and compares what a TPDO of the dictionary carries with
/// its entries.
fn frames(key: &str, header: &str) -> (String, usize) {
    let (mut text, mut count) = (String::new(), 0);
    let begin = "typedef struct {\n    /** ";
    for structure in header.split(begin).skip(1) {
        let Some((fields, rest)) = structure.split_once("\n} ") else { continue };
        let name = rest.split("_t;").next().unwrap();
        let Some(pdo) = name.strip_prefix(&format!("{key}_")) else { continue };
        let Some((direction, number)) = pdo.split_once("pdo_") else { continue };
        count += 1;
        let _ = writeln!(text, "FRAME({name}, {}_LENGTH)", name.to_uppercase());
        if direction == "t" {
            let fields = fields.lines().filter_map(|line| line.trim().strip_suffix(';')?.rsplit_once(' '));
            for (of, field) in fields {
                let is_read = header.contains(&format!(" {key}_get_{field}(const {key}_od_t *od)"));
                if is_read && of != "od_time_t" {
                    let _ = writeln!(text, "CARRIED({name}, {number}U, {field}, {key}_get_{field})");
                }
            }
        }
    }
    (text, count)
}

#[test]
fn structures_of_pdos_are_what_frames_carry() {
    let (mut count, mut carried) = (0, 0);
    for path in SPECIFICATIONS {
        let directory = directory(&format!("{}_FRAMES", upper(path)));
        for key in write(path, &directory).unwrap().devices {
            let header = directory.join("c").join(&key).join(format!("{key}_od.h"));
            let (text, frames) = frames(&key, &std::fs::read_to_string(header).unwrap());
            carried += text.matches("CARRIED").count();
            std::fs::write(directory.join("c").join(&key).join("frames.inc"), text).unwrap();
            let cc = Compiler::new("cc", &[]);
            let source = od_tests::root().join("tests/c/frames.c");
            let mut objects = cc.objects(&directory, &key).unwrap();
            let mut about = Compiler::about(&key).to_vec();
            about.push(format!("-DDICTIONARY={key}_od_t"));
            objects.push(cc.object(&source, &directory, &key, &about).unwrap());
            let program = directory.join(&key);
            cc.link(&objects, &program).unwrap();
            let output = Command::new(&program).output().unwrap();
            assert!(output.status.success(), "{key}: {}", String::from_utf8_lossy(&output.stdout));
            count += frames;
        }
    }
    assert!(count > 20 && carried > 10, "{count} PDOs, {carried} fields");
}

/// Names of the runtime, which all dictionaries include, begin as those of a device `od` would.
#[test]
fn a_device_may_be_called_as_the_runtime_begins() {
    let directory = directory("RUNTIME");
    let spec = "od-spec: 1\ntitle: OD\ndevices: {od: {name: OD, bit-rates: [125]}}\n\
                types: {flag: {base: unsigned8, values: {0: read, 1: write}}}\nobjects:\n\
                \x20 0x2000: {name: string, type: flag, access: rw}\n\
                \x20 0x2001: {name: time, type: unsigned32, access: rw}\n\
                \x20 0x2002: {name: u8, type: unsigned8, access: rw}\n";
    let written = write_text("od.od.yaml", spec.to_owned(), &directory).unwrap();
    let cc = Compiler::new("cc", &[]);
    for device in written.devices {
        cc.objects(&directory, &device).unwrap();
        let types = std::fs::read_to_string(directory.join("c").join(&device).join("OD_types.h")).unwrap();
        assert!(types.contains("#define DEVICE_OD_FLAG_READ (0U)"), "{types}");
    }
}

#[test]
fn the_example_of_the_book_compiles() {
    let directory = directory("BOOK");
    write("tests/book/valve.od.yaml", &directory).unwrap();
    let cc = Compiler::new("cc", &[]);
    let source = od_tests::root().join("tests/book/valve.c");
    cc.object(&source, &directory, "valve", &[]).unwrap();
}
