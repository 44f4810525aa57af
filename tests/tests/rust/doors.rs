//! Three ways to the same code: macro, build script, file.

use std::path::Path;
use std::process::Command;

use firmware_glue::Dictionary;
use od_generated::{fullmo, pmc, pmm};
use od_tests::compiler::{Product, compile, messages};
use od_tests::root;

mod by_builder {
    include!(concat!(env!("OUT_DIR"), "/pmc.rs"));
}

mod fullmo_by_builder {
    include!(concat!(env!("OUT_DIR"), "/fullmo.rs"));
}

mod pmc_by_macro {
    od_macros::object_dictionary!("../od-spec/devices/pitch-control-system.od.yaml", device = "pmc");
}

mod pmm_by_macro {
    od_macros::object_dictionary!("../od-spec/devices/pitch-control-system.od.yaml", device = "pmm");
}

mod fullmo_by_macro {
    od_macros::object_dictionary!("../od-spec/devices/fullmo-drive.od.yaml");
}

const SPECIFICATION: &str = "od-spec/devices/pitch-control-system.od.yaml";
const FULLMO: &str = "od-spec/devices/fullmo-drive.od.yaml";

#[test]
fn the_macro_has_the_tokens_of_the_file() {
    for (specification, key) in [(SPECIFICATION, "pmc"), (SPECIFICATION, "pmm"), (FULLMO, "fullmo")] {
        // What the macro puts out, apart from the lines that make the compiler watch the files.
        let expansion = od_gen::expand(&root().join(specification), Some(key));
        assert!(expansion.errors.is_empty() && expansion.warnings.is_empty());
        let macros = prettyplease::unparse(&syn::parse2(expansion.tokens.unwrap()).unwrap());
        let text = std::fs::read_to_string(root().join(format!("generated/src/{key}.rs"))).unwrap();
        let file = prettyplease::unparse(&syn::parse_file(&text).unwrap());
        assert_eq!(first_difference(&macros, &file), None);
    }
}

fn first_difference(one: &str, other: &str) -> Option<(String, String)> {
    let (mut one, mut other) = (one.lines(), other.lines());
    loop {
        match (one.next(), other.next()) {
            (None, None) => return None,
            (left, right) if left == right => {}
            (left, right) => {
                return Some((left.unwrap_or("(end)").to_owned(), right.unwrap_or("(end)").to_owned()));
            }
        }
    }
}

#[test]
fn the_builder_writes_the_same_code_in_short_lines() {
    for (key, built) in [
        ("pmc", include_str!(concat!(env!("OUT_DIR"), "/pmc.rs"))),
        ("fullmo", include_str!(concat!(env!("OUT_DIR"), "/fullmo.rs"))),
    ] {
        assert!(built.lines().count() > 1000, "{key}: each item has a line");
        let file = std::fs::read_to_string(root().join(format!("generated/src/{key}.rs"))).unwrap();
        let again = |code: &str| prettyplease::unparse(&syn::parse_file(code).unwrap());
        assert_eq!(first_difference(&again(built), &again(&file)), None);
    }
}

#[test]
fn a_formatted_module_is_the_file_of_the_command() {
    let out = std::env::temp_dir().join(format!("od-formatted-{}", std::process::id()));
    let builder = od_gen::Builder::new(root().join(SPECIFICATION)).device("pmc").out_dir(&out).formatted();
    let written = builder.try_generate().unwrap();
    let code = std::fs::read_to_string(&written[0]).unwrap();
    std::fs::remove_dir_all(&out).unwrap();
    let file = std::fs::read_to_string(root().join("generated/src/pmc.rs")).unwrap();
    assert_eq!(first_difference(&code, &file), None);
}

#[test]
fn the_compiled_tables_are_equal() {
    fn table(dictionary: &impl Dictionary<'static>) -> String {
        format!("{:?}", dictionary.table())
    }
    let (pmc, fullmo) = (table(&pmc::Pmc::new(1)), table(&fullmo::Fullmo::new(1)));
    assert_eq!(table(&pmc_by_macro::Pmc::new(1)), pmc);
    assert_eq!(table(&by_builder::Pmc::new(1)), pmc);
    assert_eq!(table(&pmm_by_macro::Pmm::new(1)), table(&pmm::Pmm::new(1)));
    assert_eq!(table(&fullmo_by_macro::Fullmo::new(1)), fullmo);
    assert_eq!(table(&fullmo_by_builder::Fullmo::new(1)), fullmo);
    assert_eq!(pmc_by_macro::Pmc::new(7).image(), pmc::Pmc::new(7).image());
}

/// What the compiler says of a file that it must refuse.
fn refused(file: &Path) -> String {
    let output = compile(file, Product::Messages).expect("the compiler runs");
    assert_eq!(output.status.code(), Some(1), "{} is accepted", file.display());
    messages(&output)
}

#[test]
fn a_specification_with_mistakes_is_an_error_of_the_compiler() {
    insta::glob!("../../macros", "*.rs", |path| {
        let file = Path::new("macros").join(path.file_name().unwrap());
        insta::assert_snapshot!(refused(&file));
    });
}

/// A program with a generated file, which uses the traits of the dictionary.
const PROGRAM: &str = "
mod fullmo;

use firmware_glue::{Application, Constrained, Dictionary, pdo};
use fullmo::{Entry, Fullmo};

struct Hardware;

impl Application<Fullmo> for Hardware {
    fn changed(&mut self, od: &mut Fullmo, entry: Entry) {
        assert_eq!((entry, od.device_type().0), (Entry::ProducerHeartbeatTime, 0x2_0192));
    }
}

fn main() {
    let mut od = Fullmo::new(1);
    od.write(0x1017, 0, &[1, 0], &mut Hardware).unwrap();
    let _ = (od.broken_constraint(), pdo::pack(&mut od, 1, &mut Hardware));
}
";

#[test]
fn a_file_for_another_layout_is_one_error() {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR")).join("layouts");
    std::fs::create_dir_all(&scratch).unwrap();
    let (main, program) = (scratch.join("main.rs"), scratch.join("program"));
    std::fs::write(&main, PROGRAM).unwrap();
    let present = std::fs::read_to_string(root().join("generated/src/fullmo.rs")).unwrap();
    std::fs::write(scratch.join("fullmo.rs"), &present).unwrap();
    let output = compile(&main, Product::Program(&program)).unwrap();
    assert_eq!(messages(&output), "\n");
    assert!(Command::new(program).status().unwrap().success());
    let other = present.replacen("generated_for_layout_1", "generated_for_layout_0", 1);
    std::fs::write(scratch.join("fullmo.rs"), other).unwrap();
    let said = refused(&main).replace(&scratch.display().to_string(), "SCRATCH");
    insta::assert_snapshot!("other_layout", said);
}

#[test]
fn a_specification_with_mistakes_is_an_error_of_the_build() {
    let out = std::env::temp_dir().join(format!("od-builder-{}", std::process::id()));
    let run = |specification: &str, device: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_build-script"))
            .current_dir(root().join("tests/ui"))
            .args([specification, device])
            .arg(&out)
            .output()
            .unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let (code, reported, shown) = run("err_od0406_default.od.yaml", "");
    assert_eq!(code, Some(1));
    insta::assert_snapshot!("builder_error", format!("{reported}---\n{shown}"));
    assert!(!out.exists(), "nothing is written");
    let (code, reported, _) = run("ok_minimal.od.yaml", "stranger");
    assert_eq!(code, Some(1));
    insta::assert_snapshot!("builder_unknown_device", reported);
    let (code, reported, _) = run("missing.od.yaml", "");
    assert_eq!(code, Some(1));
    insta::assert_snapshot!("builder_missing_file", reported);
    assert!(!out.exists(), "nothing is written");
}
