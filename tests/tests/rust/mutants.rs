//! What `odgen check --rust` accepts of mutants of specifications compiles, without a warning.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fmt::Write as _;
use std::path::Path;

use od_gen::rust::{Provenance, file};
use od_spec::diag::render::{Format, render};
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, compile};
use od_tests::compiler::{self, Product, messages};
use od_tests::fuzz::{Random, Seed, YAML, mutant};
use od_tests::root;
use od_tests::shipped::in_one_file;

/// So many modules are compiled, as one crate.
const MODULES: usize = 24;

/// What has nothing to give away, and what has names that mean something in Rust.
const RARE: [&str; 4] = [
    "pdos:\n  lamp: {receive: {1: {valid: no, map: []}}, transmit: {1: {valid: no, map: []}}}\n",
    "objects:\n  0x2000: {name: self, type: unsigned8, access: rw}\n  0x2001: {name: super, record: {1: {name: crate, type: boolean, access: ro}, 2: {name: gen, type: real64, access: rw}}}\n",
    "types:\n  type: {base: unsigned8, values: {0: try, 1: fn, 2: Self}}\nobjects:\n  0x2000: {name: match, type: type, access: rw}\n",
    "objects:\n  0x2000: {name: \"*/ }} [x] //! \\\\\", type: visible-string, capacity: 3, access: rw, about: \"*/ ``` [x](y) \\\\\"}\n",
];

fn seeds() -> Vec<Seed> {
    let directories = ["tests/ui", "tests/shared"].map(|directory| root().join(directory));
    let entries = directories.iter().flat_map(|directory| std::fs::read_dir(directory).unwrap());
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| {
        let name = path.file_name().unwrap().to_str().unwrap();
        name.ends_with(".od.yaml") && !name.starts_with("err_")
    });
    paths.sort();
    let seed = |path: &std::path::PathBuf| Seed { name: String::new(), bytes: std::fs::read(path).unwrap() };
    let shipped = ["pitch-control-system", "fullmo-drive"].map(in_one_file);
    let shipped = shipped.into_iter().map(|text| Seed { name: String::new(), bytes: text.into_bytes() });
    paths.iter().map(seed).chain(shipped).collect()
}

/// The module of the first device of a specification, or why there is none.
fn module(text: &str) -> Result<String, String> {
    let mut sources = SourceMap::new();
    let root = sources.add("mutant.od.yaml", text);
    let Compiled { system, mut diagnostics, .. } = compile(&mut sources, root, &mut NoFiles);
    let module = system.and_then(|system| {
        let device = system.devices.first()?;
        file(&system, device, &Provenance::of(&sources), &mut diagnostics)
    });
    module.ok_or_else(|| render(&diagnostics, &sources, Format::Short, false))
}

/// The mutants are the same in every run.
fn modules() -> Vec<String> {
    let head = "od-spec: 1\ntitle: Lamp\nuses: [cia301]\ndevices:\n  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}\n";
    let rare = RARE.iter().map(|rest| module(&format!("{head}{rest}")).unwrap());
    let mut modules: Vec<String> = rare.collect();
    let seeds = seeds();
    let mutants = (0..2000).filter_map(|number| mutant(&seeds, &YAML, &mut Random::new(number)));
    let texts = mutants.filter_map(|mutant| String::from_utf8(mutant.bytes).ok());
    modules.extend(texts.filter_map(|text| module(&text).ok()).take(MODULES - RARE.len()));
    modules
}

#[test]
fn what_is_accepted_compiles_without_a_warning() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mutants");
    std::fs::create_dir_all(&directory).unwrap();
    let modules = modules();
    assert_eq!(modules.len(), MODULES, "too few mutants are accepted");
    let mut main = "#![deny(warnings)]\n".to_owned();
    for (number, text) in modules.iter().enumerate() {
        std::fs::write(directory.join(format!("m{number}.rs")), text).unwrap();
        writeln!(main, "mod m{number};").unwrap();
    }
    main.push_str("fn main() {}\n");
    let path = directory.join("main.rs");
    std::fs::write(&path, main).unwrap();
    let output = compiler::compile(&path, Product::Program(&directory.join("main"))).unwrap();
    assert!(output.status.success(), "{}", messages(&output));
}
