//! Every name that Rust or generated code has itself, as every kind of name of a specification: the code compiles.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;

use od_gen::rust::{self, Provenance};
use od_spec::ascii::letters;
use od_spec::diag::render::{Format, render};
use od_spec::diag::{Diagnostics, Severity};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};
use od_tests::root;

use crate::generated_rust::Scratch;

/// Words that are kept for Rust, in any edition, or mean something in places.
const KEYWORDS: &str = "abstract as async auto await become box break const continue crate default do dyn else enum extern \
    false final fn for gen if impl in let loop macro macro_rules match mod move mut override priv pub raw ref return safe Self \
    self static struct super trait true try type typeof union unsafe unsized use virtual where while yield static_lifetime";

/// Types of the language.
const PRIMITIVES: &str = "bool char f16 f32 f64 f128 i8 i16 i32 i64 i128 isize str u8 u16 u32 u64 u128 usize never unit slice array tuple";

/// The preludes of all editions, with and without the standard library, and crates that have a name everywhere.
const PRELUDE: &str = "Option Some None Result Ok Err String Vec Box ToString ToOwned Copy Clone Send Sync Sized Unpin Drop Fn FnMut \
    FnOnce AsyncFn AsyncFnMut AsyncFnOnce drop size_of size_of_val align_of align_of_val AsMut AsRef From Into TryFrom TryInto \
    Default Iterator IntoIterator Extend DoubleEndedIterator ExactSizeIterator FromIterator Future IntoFuture Eq PartialEq Ord \
    PartialOrd Hash Debug assert cfg column compile_error concat env file format_args include line module_path option_env \
    stringify panic derive test bench global_allocator println format vec core std alloc proc_macro Display Formatter";

/// All words of the code that prints, and of the macros that printed code calls: more than it prints.
fn words_of_the_generator() -> Vec<String> {
    let printer =
        fs::read_dir(root().join("od-gen/src/rust/print")).unwrap().map(|file| file.unwrap().path());
    let macros = ["named", "quantity"].map(|file| root().join(format!("firmware-glue/src/value/{file}.rs")));
    let mut words = Vec::new();
    for path in printer.chain(macros) {
        let text = fs::read_to_string(path).unwrap();
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            let of_line = line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            words.extend(
                of_line.filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic())).map(str::to_owned),
            );
        }
    }
    words
}

/// The names: all, and those that can be names of types. A name that begins or ends as something that is printed with
/// another one, such as a setter, would clash with that one; these are for specifications of their own.
struct Names {
    all: Vec<String>,
    beside: Vec<String>,
    types: Vec<String>,
}

fn names() -> Names {
    let of_language =
        [KEYWORDS, PRIMITIVES, PRELUDE].into_iter().flat_map(str::split_whitespace).map(str::to_owned);
    // The library has an object of this name.
    let mut seen = BTreeSet::from([letters("error register")]);
    let mut names = Names { all: Vec::new(), beside: Vec::new(), types: Vec::new() };
    let language = of_language.map(|name| (name, true));
    for (name, is_type) in language.chain(words_of_the_generator().into_iter().map(|name| (name, false))) {
        if !seen.insert(letters(&name)) {
            continue;
        }
        if is_type || name.starts_with(|c: char| c.is_ascii_uppercase()) {
            names.types.push(name.clone());
        }
        let beside = ["set_", "with_"].iter().any(|start| name.starts_with(start))
            || ["mut", "iter"].iter().any(|end| name.ends_with(end));
        if beside { names.beside.push(name) } else { names.all.push(name) }
    }
    names
}

/// A specification with one device.
fn of_one_device(sections: &str) -> String {
    format!(
        "od-spec: 1\ntitle: Names\nuses: [cia301]\ndevices:\n  names: {{name: Names, bit-rates: [125], granularity: 1, \
         features: [heartbeat producer]}}\n{sections}"
    )
}

/// A line for each of some names, with its number.
fn lines(names: &[String], line: impl Fn(usize, &str) -> String) -> String {
    names.iter().enumerate().fold(String::new(), |mut lines, (at, name)| {
        let _ = writeln!(lines, "{}", line(at, name));
        lines
    })
}

/// Objects from 2000h on, one for each name.
fn objects(names: &[String], rest: impl Fn(usize, &str) -> String) -> String {
    format!("objects:\n{}", lines(names, |at, name| format!("  0x{:X}: {{{}}}", 0x2000 + at, rest(at, name))))
}

fn variables(names: &[String]) -> String {
    of_one_device(&objects(names, |_, name| {
        format!("name: \"{name}\", type: unsigned8, access: rw, default: 1, max: 100")
    }))
}

fn arrays(names: &[String]) -> String {
    of_one_device(&objects(names, |_, name| {
        format!("name: \"{name}\", array: {{count: 2, name: \"x {{n}}\", type: unsigned8, access: rw}}")
    }))
}

/// Records; each has a member of its own, as equal ones have one type.
fn records(names: &[String]) -> String {
    of_one_device(&objects(names, |at, name| {
        let members = format!(
            "1: {{name: \"m {at}\", type: unsigned8, access: rw}}, 2: {{name: z, type: real32, access: rw}}"
        );
        format!("name: \"{name}\", record: {{{members}}}")
    }))
}

fn members(names: &[String]) -> String {
    let records = names.chunks(200).enumerate().fold(String::new(), |mut text, (at, names)| {
        let members = lines(names, |at, name| {
            format!(
                "      {}: {{name: \"{name}\", type: unsigned16, access: rw, default: 1, max: 9}}",
                at + 1
            )
        });
        let _ = write!(text, "  0x{:X}:\n    name: record {at}\n    record:\n{members}", 0x2000 + at);
        text
    });
    of_one_device(&format!("objects:\n{records}"))
}

/// Entries of PDOs: each is a bit.
fn fields(names: &[String]) -> String {
    let objects = objects(names, |_, name| format!("name: \"{name}\", type: boolean, access: rw, pdo: both"));
    let pdos = |first: usize| {
        names.chunks(64).enumerate().fold(String::new(), |mut text, (pdo, names)| {
            let mapped: Vec<String> =
                (0..names.len()).map(|at| format!("0x{:X}", 0x2000 + pdo * 64 + at)).collect();
            let _ = writeln!(
                text,
                "      {}: {{cob-id: 0x{:X}, transmission: 255, map: [{}]}}",
                pdo + 1,
                first + pdo,
                mapped.join(", ")
            );
            text
        })
    };
    let (receive, transmit) = (pdos(0x200), pdos(0x300));
    of_one_device(&format!("{objects}pdos:\n  names:\n    receive:\n{receive}    transmit:\n{transmit}"))
}

fn enums(names: &[String]) -> String {
    let types =
        lines(names, |_, name| format!("  \"{name}\": {{base: unsigned8, values: {{0: off, 1: \"on\"}}}}"));
    let objects = objects(names, |at, name| format!("name: o{at}, type: \"{name}\", access: rw, default: 1"));
    of_one_device(&format!("types:\n{types}{objects}"))
}

fn bit_fields(names: &[String]) -> String {
    let types = lines(names, |_, name| {
        format!(
            "  \"{name}\": {{base: integer16, bits: {{0: flag, 1..3: run, 4..7: {{name: kind, values: {{1: one}}}}}}, rest: unused}}"
        )
    });
    let objects = objects(names, |at, name| format!("name: o{at}, type: \"{name}\", access: rw"));
    of_one_device(&format!("types:\n{types}{objects}"))
}

fn enum_values(names: &[String]) -> String {
    let values = lines(names, |at, name| format!("      {at}: \"{name}\""));
    let objects = "objects:\n  0x2000: {name: o, type: t, access: rw}\n";
    of_one_device(&format!("types:\n  t:\n    base: unsigned16\n    values:\n{values}{objects}"))
}

/// Single bits and runs of three.
fn bits(names: &[String]) -> String {
    let (mut types, mut used) = (String::from("types:\n"), Vec::new());
    for (at, names) in names.chunks(20).enumerate() {
        for (kind, width) in [("flags", 1), ("runs", 3)] {
            let bits = lines(names, |at, name| match width {
                1 => format!("      {at}: \"{name}\""),
                _ => format!("      {}..{}: \"{name}\"", at * width, at * width + width - 1),
            });
            let name = format!("{kind} {at}");
            let _ = write!(types, "  {name}:\n    base: unsigned64\n    rest: unused\n    bits:\n{bits}");
            used.push(name);
        }
    }
    of_one_device(&(types + &objects(&used, |at, name| format!("name: o{at}, type: {name}, access: rw"))))
}

fn values_of_bits(names: &[String]) -> String {
    let values = lines(names, |at, name| format!("          {at}: \"{name}\""));
    let objects = "objects:\n  0x2000: {name: o, type: t, access: rw}\n";
    let bits = format!("    bits:\n      0..15:\n        name: b\n        values:\n{values}");
    of_one_device(&format!("types:\n  t:\n    base: unsigned32\n    rest: unused\n{bits}{objects}"))
}

/// Each alone, which makes it the name of a type.
fn special_values(names: &[String]) -> String {
    of_one_device(&objects(names, |at, name| {
        format!("name: o{at}, type: integer16, access: rw, special: {{-1: \"{name}\"}}")
    }))
}

fn sets_of_special_values(names: &[String]) -> String {
    let sets: Vec<String> = names
        .chunks(20)
        .map(|names| {
            let values = names.iter().enumerate().map(|(at, name)| format!("{at}: \"{name}\""));
            values.collect::<Vec<_>>().join(", ")
        })
        .collect();
    of_one_device(&objects(&sets, |at, set| {
        format!("name: o{at}, type: unsigned16, access: rw, special: {{{set}}}")
    }))
}

const WORDS: &str = "objects:\n  0x2000: {name: status, type: unsigned16, access: ro}\n  \
                     0x2001: {name: control, type: unsigned16, access: rw}\n";

/// `0000 0000 0001 0010`.
fn pattern(number: usize) -> String {
    let digits = format!("{number:016b}");
    [&digits[..4], &digits[4..8], &digits[8..12], &digits[12..]].join(" ")
}

fn states_and_commands(names: &[String]) -> String {
    let machines = names.chunks(100).enumerate().fold(String::new(), |mut text, (at, names)| {
        let patterns = lines(names, |at, name| format!("      \"{name}\": {{pattern: \"{}\"}}", pattern(at)));
        let transitions = lines(names, |at, name| {
            let from = at.checked_sub(1).map_or("start", |before| names[before].as_str());
            format!("      {at}: {{from: \"{from}\", to: \"{name}\", event: e, by-device: never}}")
        });
        let commands = lines(names, |at, name| {
            format!("      \"{name}\": {{pattern: \"{}\", transitions: [{at}]}}", pattern(at))
        });
        let _ = write!(
            text,
            "  machine {at}:\n    status: status\n    command: control\n    states:\n{patterns}    \
             transitions:\n{transitions}    commands:\n{commands}"
        );
        text
    });
    of_one_device(&format!("{WORDS}state-machines:\n{machines}"))
}

fn machines(names: &[String]) -> String {
    let machines = lines(names, |_, name| {
        let [low, high] = [0, 1].map(pattern);
        format!(
            "  \"{name}\":\n    status: status\n    command: control\n    \
             states: {{low: {{pattern: \"{low}\"}}, high: {{pattern: \"{high}\"}}}}\n    \
             transitions: {{0: {{from: start, to: low, event: e}}, 1: {{from: low, to: high, event: e}}}}\n    \
             commands: {{go: {{pattern: \"{high}\", transitions: [1]}}}}"
        )
    });
    of_one_device(&format!("{WORDS}state-machines:\n{machines}"))
}

fn errors(names: &[String]) -> String {
    let errors = lines(names, |at, name| {
        format!("  0x{:X}: {{name: \"{name}\", priority: \"{name}\", reaction: stop}}", 0x5000 + at)
    });
    of_one_device(&format!("objects:\n  0x2000: {{name: o, type: unsigned8, access: rw}}\nerrors:\n{errors}"))
}

fn units(names: &[String]) -> String {
    let units = lines(names, |_, name| format!("  \"{name}\": {{symbol: \"{name}\", offset: 1/2}}"));
    let objects =
        objects(names, |at, name| format!("name: o{at}, type: integer16, access: rw, unit: \"{name}\""));
    of_one_device(&format!("units:\n{units}{objects}"))
}

fn constraints(names: &[String]) -> String {
    let objects = "objects:\n  0x2000: {name: a, type: unsigned8, access: rw}\n  0x2001: {name: b, type: unsigned8, access: rw}\n";
    let constraints =
        lines(names, |at, name| format!("  \"{name}\": {{require: \"0x2000 <= 0x2001 + {at}\"}}"));
    of_one_device(&format!("{objects}constraints:\n{constraints}"))
}

/// A device for each name that a device can have.
fn devices(names: &[String]) -> String {
    let lower: BTreeSet<String> = names.iter().map(|name| name.to_lowercase().replace('_', "-")).collect();
    let devices = lower.iter().fold(String::new(), |mut text, key| {
        let _ = writeln!(text, "  {key}: {{name: Names, bit-rates: [125]}}");
        text
    });
    let object = "objects:\n  0x2000: {name: o, type: unsigned8, access: rw, default: 1, max: 9}\n";
    format!("od-spec: 1\ntitle: Names\ndevices:\n{devices}{object}")
}

/// The modules of a specification, or what is wrong with it.
fn modules(kind: &str, text: &str) -> Result<Vec<(String, String)>, String> {
    let mut sources = SourceMap::new();
    let root = sources.add(format!("{kind}.od.yaml"), text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let mut diagnostics = compiled.diagnostics;
    let modules = compiled.system.map(|system| {
        let module = |(at, device)| {
            let module = rust::plain_file(&system, device, &Provenance::of(&sources), &mut diagnostics)?;
            Some((format!("{kind}_{at}"), module))
        };
        (0..).zip(&system.devices).map(module).collect::<Option<Vec<_>>>()
    });
    modules.flatten().ok_or_else(|| {
        let mut errors = Diagnostics::new();
        for error in diagnostics.iter().filter(|one| one.severity() == Severity::Error).take(20) {
            errors.push(error.clone());
        }
        render(&errors, &sources, Format::Human, false)
    })
}

/// A kind of name: what it is called, and the specification with names of it.
type Kind = (&'static str, fn(&[String]) -> String);

const KINDS: [Kind; 12] = [
    ("variables", variables),
    ("arrays", arrays),
    ("members", members),
    ("fields", fields),
    ("enum_values", enum_values),
    ("bits", bits),
    ("values_of_bits", values_of_bits),
    ("sets_of_special_values", sets_of_special_values),
    ("states_and_commands", states_and_commands),
    ("errors", errors),
    ("constraints", constraints),
    ("special_values", special_values),
];

/// Kinds that are names of types.
const TYPES: [Kind; 6] = [
    ("records", records),
    ("enums", enums),
    ("bit_fields", bit_fields),
    ("machines", machines),
    ("units", units),
    ("devices", devices),
];

#[test]
fn every_name_of_rust_can_be_a_name_of_every_kind() {
    let names = names();
    assert!(names.all.len() > 500 && names.types.len() > 150 && !names.beside.is_empty());
    // With all tests, each name is of every kind; otherwise, of an eighth of the kinds.
    let step = if od_tests::is_long() { 1 } else { 8 };
    let some = |names: &[String], kind: usize| -> Vec<String> {
        names.iter().skip(kind % step).step_by(step).cloned().collect()
    };
    let of_all =
        KINDS.iter().enumerate().map(|(at, (kind, text))| ((*kind).to_owned(), text(&some(&names.all, at))));
    let beside = KINDS.iter().map(|(kind, text)| (format!("{kind}_beside"), text(&names.beside)));
    let of_types = TYPES
        .iter()
        .enumerate()
        .map(|(at, (kind, text))| ((*kind).to_owned(), text(&some(&names.types, at))));
    let (mut all, mut wrong) = (Vec::new(), String::new());
    for (kind, text) in of_all.chain(beside).chain(of_types) {
        match modules(&kind, &text) {
            Ok(modules) => all.extend(modules),
            Err(errors) => wrong += &errors,
        }
    }
    assert_eq!(wrong, "");
    let scratch = Scratch::new("names");
    let glue = root().join("firmware-glue/src/lib.rs");
    let (compiled, said) = scratch.compile("rustc", &glue, &["--crate-name", "firmware_glue"]);
    assert!(compiled, "{said}");
    let glue = format!("firmware_glue={}", scratch.0.join("libfirmware_glue.rmeta").display());
    let program = scratch.program(&all, "");
    let (compiled, said) =
        scratch.compile("rustc", &program, &["--crate-name", "program", "--extern", &glue]);
    assert!(compiled && said.is_empty(), "{}", said.chars().take(20_000).collect::<String>());
}

#[test]
fn a_keyword_among_special_values_leaves_no_underscore_in_the_name_of_their_type() {
    let text = "objects:\n  0x2000: {name: level, type: unsigned16, access: rw, special: {0: \"self\", 1: \"other\"}}\n  \
                0x2001: {name: one, type: unsigned16, access: rw, special: {0: \"self\"}}\n";
    let module = modules("special", &of_one_device(text)).unwrap().remove(0).1;
    for name in ["SelfOrOther", "Self_"] {
        assert!(module.contains(&format!("pub enum {name} ")), "{name}");
    }
}

/// A type of many special values has the name of the first entry that has them: each use of a value repeats it.
#[test]
fn many_special_values_take_as_much_code_as_they_are() {
    let code = |count: usize| {
        let values = |first: usize| {
            let values = (0..count).map(|at| format!("{}: \"value {at}\"", first + at));
            values.collect::<Vec<_>>().join(", ")
        };
        let text = format!(
            "objects:\n  0x2000: {{name: level, type: unsigned16, access: rw, special: {{{}}}}}\n  \
             0x2001: {{name: other level, type: unsigned16, access: rw, special: {{{}}}}}\n  \
             0x2002: {{name: few, type: unsigned16, access: rw, special: {{0: \"off\"}}}}\n",
            values(0),
            values(7)
        );
        let module = modules("special", &of_one_device(&text)).unwrap().remove(0).1;
        assert_eq!(module.matches("pub enum LevelSpecialValues").count(), 1);
        assert!(module.contains("specials :: Off") && !module.contains("OtherLevelSpecialValues"));
        module.len()
    };
    let (one, two, four) = (code(100), code(200), code(400));
    assert!(four - two < 3 * (two - one), "{one}, {two} and {four} bytes");
}
