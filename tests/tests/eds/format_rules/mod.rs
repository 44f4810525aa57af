//! The rules over the text of an EDS or DCF, and what `odgen fix` makes of them.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod agreement;
mod messy;
mod own_files;
mod planted;
mod random;

use std::collections::BTreeSet;
use std::path::PathBuf;

use od_spec::diag::{Diagnostics, Severity};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, Strictness, add_source, compile_as};
use od_tests::root;

/// What is said about the bytes of a file.
fn said(name: &str, bytes: &[u8]) -> (Diagnostics, SourceMap) {
    let mut sources = SourceMap::new();
    let file = add_source(&mut sources, name, bytes.to_vec()).unwrap();
    let compiled = compile_as(Strictness::Standard, &mut sources, file, &mut NoFiles);
    (compiled.diagnostics, sources)
}

fn codes(diagnostics: &Diagnostics) -> BTreeSet<&'static str> {
    diagnostics.iter().map(|diagnostic| diagnostic.code.id).collect()
}

fn errors(diagnostics: &Diagnostics) -> usize {
    diagnostics.iter().filter(|one| one.severity() == Severity::Error).count()
}

/// The files with one of the endings in a directory of the repository.
fn files(directory: &str, endings: &[&str]) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join(directory)).unwrap();
    let has_ending = |path: &PathBuf| {
        path.extension().is_some_and(|ending| endings.iter().any(|known| ending.eq_ignore_ascii_case(known)))
    };
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).filter(has_ending).collect();
    files.sort();
    assert!(!files.is_empty(), "{directory}");
    files
}
