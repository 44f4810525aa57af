//! The cases of `tests/ui`: what is said about each was reviewed, and their names say it.

use std::collections::BTreeSet;
use std::fs;

use crate::diagnostics::{cases, codes, human, said_of_cases, ui};

#[test]
fn cases_say_what_was_reviewed() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../../ui/snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        insta::glob!("../../../ui", "*.od.yaml", |path| {
            let name = path.file_name().unwrap().to_str().unwrap();
            let (.., (sources, _, compiled)) =
                said_of_cases().iter().find(|(case, ..)| case == name).unwrap();
            insta::assert_snapshot!("said", human(&compiled.diagnostics, sources));
        });
    });
}

#[test]
fn names_of_cases_say_what_comes_out() {
    for (name, text, (_, _, compiled)) in said_of_cases() {
        let (errors, warnings) = compiled.diagnostics.count();
        let kind = name.split('_').next().unwrap();
        let is_of_kind = match kind {
            "err" => compiled.system.is_none() && errors > 0,
            "warn" => compiled.system.is_some() && errors == 0 && warnings > 0,
            "note" => compiled.system.is_some() && errors + warnings == 0 && !compiled.diagnostics.is_empty(),
            "ok" => compiled.system.is_some() && compiled.diagnostics.is_empty(),
            _ => panic!("{name}: a case is named err_, warn_, note_ or ok_"),
        };
        assert!(
            is_of_kind,
            "{name}: {errors} errors, {warnings} warnings, system: {}",
            compiled.system.is_some()
        );
        if let Some(code) = name.split('_').nth(1).and_then(od_spec::code) {
            assert!(codes(&compiled.diagnostics).contains(&code), "{name} does not provoke {code}");
        }
        assert!(text.starts_with("# "), "{name}: the first line says what is wrong");
    }
}

#[test]
fn snapshots_have_cases() {
    let names: BTreeSet<String> = cases().into_iter().map(|(name, _)| name).collect();
    for entry in fs::read_dir(ui().join("snapshots")).unwrap() {
        let file = entry.unwrap().file_name().into_string().unwrap();
        let case = file.strip_prefix("said@").and_then(|rest| rest.strip_suffix(".snap"));
        assert!(case.is_some_and(|case| names.contains(case)), "{file} belongs to no case");
    }
}
