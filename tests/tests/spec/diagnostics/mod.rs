//! Every message to the user: the cases in `tests/ui` with what the compiler says about them, what is said about bytes,
//! libraries and settings, and rules that hold for every message.
//!
//! The name of a case says what comes out of it: `err_` errors, `warn_` warnings only, `note_` notes only, `ok_`
//! nothing at all; the code in the name is among its messages.

#![expect(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod bytes_and_libraries;
mod cases;
mod changes;
mod codes;
mod commissioning_examples;
mod other_yaml_reader;
mod parameter_files;
mod parts;
mod plants;
mod random;
mod settings;
mod settings_by_kind;
mod short_forms;
mod wording_rules;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use od_spec::diag::render::{Format, render};
use od_spec::diag::{Code, Diagnostic, Diagnostics};
use od_spec::source::{FileId, SourceMap};
use od_spec::{Compiled, NoFiles, compile, read_text};

fn ui() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("ui")
}

/// Name and text of every case.
fn cases() -> Vec<(String, String)> {
    let mut cases: Vec<(String, String)> = fs::read_dir(ui())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter_map(|path| {
            let name = path.file_name()?.to_str()?.to_owned();
            name.ends_with(".od.yaml").then(|| (name, read(&path)))
        })
        .collect();
    cases.sort();
    assert!(!cases.is_empty());
    cases
}

/// Name and text of a case, and what is said about it.
type Said = (String, String, (SourceMap, FileId, Compiled));

fn said_of_cases() -> &'static [Said] {
    static SAID: LazyLock<Vec<Said>> = LazyLock::new(|| {
        let said = cases().into_iter().map(|(name, text)| {
            let said = run(&name, &text);
            (name, text, said)
        });
        said.collect()
    });
    &SAID
}

fn read(path: &Path) -> String {
    let name = path.file_name().unwrap().to_string_lossy();
    read_text(&name, fs::read(path).unwrap()).unwrap()
}

fn run(name: &str, text: &str) -> (SourceMap, FileId, Compiled) {
    let mut sources = SourceMap::new();
    let root = sources.add(name, text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    (sources, root, compiled)
}

fn human(diagnostics: &Diagnostics, sources: &SourceMap) -> String {
    render(diagnostics, sources, Format::Human, false)
}

fn codes(diagnostics: &Diagnostics) -> BTreeSet<&'static Code> {
    diagnostics.iter().map(|diagnostic| diagnostic.code).collect()
}

/// What is said about one diagnostic that has no `Diagnostics` around it.
fn human_one(diagnostic: Diagnostic, sources: &SourceMap) -> String {
    let mut list = Diagnostics::new();
    list.push(diagnostic);
    human(&list, sources)
}
