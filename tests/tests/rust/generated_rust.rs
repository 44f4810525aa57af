//! Generated modules, as the compiler, clippy and a reader see them.

#![expect(clippy::unwrap_used, clippy::expect_used, reason = "a test fails by panicking")]

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use od_gen::rust::{self, Layout, Provenance};
use od_spec::diag::Diagnostics;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};
use od_tests::generate::SPECS;
use od_tests::root;
use od_tests::shipped::in_one_file;

/// The modules of a specification, by the keys of its devices.
fn modules(name: &str, text: &str, layout: Layout) -> Vec<(String, String)> {
    let mut sources = SourceMap::new();
    let id = sources.add(name, text);
    let system = compile(&mut sources, id, &mut NoFiles).system.expect(name);
    let devices = system.devices.iter().map(|device| {
        let mut diagnostics = Diagnostics::new();
        let module = layout(&system, device, &Provenance::of(&sources), &mut diagnostics);
        (device.key.replace('-', "_"), module.expect(name))
    });
    devices.collect()
}

/// Modules of all kinds of devices: the shipped ones, and what the tests are made of.
fn all_modules(layout: Layout) -> Vec<(String, String)> {
    let mut paths: Vec<PathBuf> = ["tests/readers", "tests/shared", "tests/book"]
        .into_iter()
        .flat_map(|directory| fs::read_dir(root().join(directory)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.to_string_lossy().ends_with(".od.yaml"))
        .collect();
    let cases = ["everything", "minimal", "notations", "pdo_parameters", "run_of_objects"];
    paths.extend(cases.map(|case| root().join(format!("tests/ui/ok_{case}.od.yaml"))));
    let texts = paths.iter().map(|path| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (name, fs::read_to_string(path).unwrap())
    });
    let shipped = SPECS.iter().map(|stem| (format!("{stem}.od.yaml"), in_one_file(stem)));
    let modules = shipped.chain(texts).flat_map(|(name, text)| {
        let stem = name.replace(".od.yaml", "").replace('-', "_");
        let modules = modules(&name, &text, layout);
        modules.into_iter().map(move |(key, module)| (format!("{stem}_{key}"), module))
    });
    modules.collect()
}

/// A directory of its own for one test, removed at the end.
pub(crate) struct Scratch(pub(crate) PathBuf);

impl Scratch {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("od-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// A crate of modules and a text.
    pub(crate) fn program(&self, modules: &[(String, String)], text: &str) -> PathBuf {
        let mut program = String::new();
        for (name, module) in modules {
            fs::write(self.0.join(format!("{name}.rs")), module).unwrap();
            let _ = writeln!(program, "pub mod {name};");
        }
        let path = self.0.join("program.rs");
        fs::write(&path, program + text).unwrap();
        path
    }

    /// What a compiler says about a crate.
    pub(crate) fn compile(&self, compiler: &str, path: &Path, arguments: &[&str]) -> (bool, String) {
        let mut command = Command::new(compiler);
        command.arg(path).args(["--edition", "2024", "--crate-type", "lib", "--emit", "metadata"]);
        command.args(arguments).arg("--out-dir").arg(&self.0);
        let output = command.output().expect("rustup installs rustc and clippy with the toolchain");
        (output.status.success(), String::from_utf8(output.stderr).unwrap())
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn clippy_has_nothing_to_say_under_its_own_lints() {
    let scratch = Scratch::new("clippy");
    let glue = root().join("firmware-glue/src/lib.rs");
    let (compiled, said) = scratch.compile("rustc", &glue, &["--crate-name", "firmware_glue"]);
    assert!(compiled, "{said}");
    let glue = format!("firmware_glue={}", scratch.0.join("libfirmware_glue.rmeta").display());
    let run = |program: &Path| {
        scratch.compile("clippy-driver", program, &["--crate-name", "program", "--extern", &glue])
    };
    for layout in od_tests::sample([rust::file as Layout, rust::plain_file]) {
        let modules = all_modules(layout);
        assert!(modules.len() > 10);
        assert_eq!(run(&scratch.program(&modules, "")), (true, String::new()));
    }
    // The same way shows what clippy does mind.
    let (compiled, said) = run(&scratch.program(&[], "pub fn f(x: u8) -> u8 { return x; }"));
    assert!(compiled && said.contains("needless_return"), "{said}");
}

#[test]
fn without_firmware_glue_there_is_one_error_which_says_what_to_add() {
    let scratch = Scratch::new("no-glue");
    for (number, (name, module)) in all_modules(rust::file).into_iter().enumerate() {
        if !od_tests::is_tried(number, 4) {
            continue;
        }
        let program = scratch.program(&[(name.clone(), module)], "");
        let (compiled, said) = scratch.compile("rustc", &program, &["--crate-name", "program"]);
        let errors = said.lines().filter(|line| line.starts_with("error") && !line.contains("aborting"));
        assert_eq!((compiled, errors.count()), (false, 1), "{name}: {said}");
        assert!(said.contains("Add `firmware-glue` to the dependencies."), "{name}: {said}");
    }
}

#[test]
fn a_text_that_ends_like_a_line_with_a_hint_gets_none() {
    let text = "od-spec: 1
title: Lamp
uses: [cia301]
devices: {lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}}
objects:
  0x2000: {name: level, type: unsigned8, access: rw, about: the same as firmware}
  0x2001: {name: step, type: unsigned8, access: rw, about: \"type it as glue;\"}
";
    for layout in [rust::file as Layout, rust::plain_file] {
        let (_, module) = modules("lamp.od.yaml", text, layout).pop().unwrap();
        let hints = module.lines().filter(|line| line.contains("// An error here?"));
        assert_eq!(hints.filter(|line| !line.starts_with("use ")).collect::<Vec<_>>(), [""; 0]);
        assert_eq!(module.matches("// An error here?").count(), 2);
    }
}

/// The documentation of a method.
fn documentation(module: &str, method: &str) -> Vec<String> {
    let at = module.find(&format!("fn {method}(")).expect("a method of that name");
    let lines = module[..at].lines().rev().skip_while(|line| !line.trim_start().starts_with("///"));
    let lines = lines.map_while(|line| Some(line.trim_start().strip_prefix("///")?.trim().to_owned()));
    let mut lines: Vec<_> = lines.filter(|line| !line.is_empty()).collect();
    lines.reverse();
    lines
}

#[test]
fn what_elements_have_in_common_is_said_once_and_the_rest_for_each() {
    let text = "od-spec: 1
title: Cells
uses: [cia301]
devices:
  pack: {name: Pack, bit-rates: [125], features: [heartbeat producer]}
units:
  millivolt: {symbol: mV, base: 1/1000 V}
objects:
  0x2000:
    name: voltages
    about: What the cells have.
    array: {count: 6, name: \"cell {n}\", type: unsigned16, unit: millivolt, access: ro, pdo: transmit}
  0x2001:
    name: limits
    array: {count: 3, name: \"limit {n}\", type: unsigned8, access: rw, default: 7, elements: {2: {max: 9}}}
pdos:
  pack:
    transmit:
      1: {map: [0x2000.1, 0x2000.2, 0x2000.3, 0x2000.4]}
      2: {map: [0x2000.5]}
";
    let (_, module) = modules("cells.od.yaml", text, rust::file).pop().unwrap();
    assert_eq!(
        documentation(&module, "voltages"),
        [
            "`2000h` voltages: What the cells have. `sub` is the sub-index, 1 to 6; `None` for any other.",
            "UNSIGNED16, ro, TPDO, in mV.",
            "- Sub-index 1 to 4: In TPDO 1 ([`Tpdo1`](pdos::Tpdo1)).",
            "- Sub-index 5: In TPDO 2 ([`Tpdo2`](pdos::Tpdo2)).",
        ]
    );
    assert_eq!(
        documentation(&module, "limits"),
        [
            "`2001h` limits. `sub` is the sub-index, 1 to 3; `None` for any other.",
            "UNSIGNED8, rw, default 7.",
            "- Sub-index 2: ≤ 9.",
        ]
    );
}

#[test]
fn a_macro_is_at_the_item_that_it_completes() {
    for (name, module) in all_modules(rust::file) {
        let lines: Vec<&str> = module.lines().collect();
        let alone =
            |pair: &&[&str]| pair[0].is_empty() && pair[1].contains("firmware::") && pair[1].contains('!');
        assert_eq!(lines.windows(2).find(alone), None, "{name}");
    }
}
