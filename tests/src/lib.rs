//! What the project's tasks and its cross-crate tests share.

pub mod access_cases;
pub mod c_dictionary;
pub mod compiler;
pub mod documents;
pub mod editor;
mod examples;
pub mod foreign;
pub mod fuzz;
pub mod generate;
pub mod memo;
pub mod patterns;
mod pictures;
pub mod plant;

#[path = "../shared/shipped.rs"]
pub mod shipped;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use od_spec::diag::render::{Format, render};
use od_spec::diag::{Diagnostic, Severity};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{Compiled, Loader, compile, rule_codes};

use memo::Memo;

/// Why a task failed.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;

/// The root of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map_or_else(PathBuf::new, Path::to_owned)
}

/// The variable with which tests try everything; without it, those that take long try a sample.
pub const LONG: &str = "OD_TESTS_LONG";

/// Whether tests try everything: `cargo xtask test --long`.
pub fn is_long() -> bool {
    std::env::var_os(LONG).is_some()
}

/// Whether a test that tries many alike tries the one of this number: each of `step`, or all.
pub fn is_tried(number: usize, step: usize) -> bool {
    is_long() || number.is_multiple_of(step)
}

/// What a test tries of a few that are alike: the first, or all.
pub fn sample<const N: usize, T>(all: [T; N]) -> impl Iterator<Item = T> {
    all.into_iter().take(if is_long() { N } else { 1 })
}

/// How many cases a test with random values tries: the first quarter, or all.
pub fn cases(all: u32) -> u32 {
    if is_long() { all } else { all.div_ceil(4) }
}

/// Whether a message is about what the manuals of the shipped devices say: they name no vendor-ID, have an element that is read back
/// in an array of those that are written, and list modes of operation without all objects of CiA 402.
pub fn is_said_by_manuals(diagnostic: &Diagnostic) -> bool {
    let is_note = diagnostic.severity() == Severity::Note;
    let of_manuals = [rule_codes::NO_VENDOR_NUMBER, rule_codes::UNLIKE_ELEMENTS];
    is_note && of_manuals.contains(&diagnostic.code) || diagnostic.code == rule_codes::MODE_WITHOUT_OBJECTS
}

/// Compiles a file of the workspace that is expected to be without a message, except for notes.
///
/// # Errors
/// The file cannot be read, or the compiler has more to say than notes.
pub fn compile_clean(path: &str) -> Result<Arc<System>, Failure> {
    static COMPILED: Memo<String, Arc<System>> = Memo::empty();
    COMPILED.get(path.to_owned(), || Ok(Arc::new(compile_with_sources(path)?.0))).cloned()
}

fn read(path: &str) -> Result<String, Failure> {
    std::fs::read_to_string(root().join(path)).map_err(|error| format!("{path}: {error}").into())
}

/// [`compile_clean`], with the texts that were read.
///
/// # Errors
/// As [`compile_clean`].
pub fn compile_with_sources(path: &str) -> Result<(System, SourceMap), Failure> {
    let mut sources = SourceMap::new();
    let root = sources.add(path, read(path)?);
    let Compiled { system, diagnostics, .. } = compile(&mut sources, root, &mut OfWorkspace);
    match system {
        Some(system) if diagnostics.clone().without_notes().is_empty() => Ok((system, sources)),
        _ => Err(render(&diagnostics, &sources, Format::Human, false).into()),
    }
}

/// Reads files that specifications of the workspace name.
#[derive(Debug, Clone, Copy)]
pub struct OfWorkspace;

impl Loader for OfWorkspace {
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String> {
        let from = root().join(from);
        std::fs::read(from.parent().unwrap_or(&from).join(path)).map_err(|error| error.to_string())
    }
}

/// Breaks a text at one of its lines: takes it out, doubles it, puts another before it, replaces its value, or moves it.
pub fn break_lines(lines: &mut Vec<String>, at: usize, kind: u8, one: &str, other: &str) {
    match kind {
        0 => drop(lines.remove(at)),
        1 => lines.insert(at, lines[at].clone()),
        2 => lines.insert(at, format!("{one}{other}")),
        3 => {
            let key = lines[at].split('=').next().unwrap_or_default().to_owned();
            lines[at] = format!("{key}={one}");
        }
        _ => {
            let line = lines.remove(at);
            let to = (at * 7 + 3) % (lines.len() + 1);
            lines.insert(to, line);
        }
    }
}
