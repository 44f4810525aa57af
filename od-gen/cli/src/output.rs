//! What a command has made goes to the disk: all files that differ, each as a whole.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use od_gen::Artifact;
use od_gen::files::{Existing, Outcome, Reason, WriteError, write_durable, write_set};
use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;

use crate::report::{Report, print, shown};

/// Writes the files and prints `summary`, then their list.
pub(crate) fn write(out: &Path, set: &[Artifact], existing: Existing, summary: &str, report: &Report) -> u8 {
    match save(out, set, existing) {
        Ok(outcomes) => print(&format!("{summary}{}", list(out, set, &outcomes))),
        Err(diagnostic) => report.refuse(diagnostic),
    }
}

/// Writes the files.
pub(crate) fn save(out: &Path, set: &[Artifact], existing: Existing) -> Result<Vec<Outcome>, Diagnostic> {
    write_set(out, set, existing).map_err(|error| not_written(&error))
}

/// Writes files that nothing can make again: what a node had.
pub(crate) fn keep(out: &Path, set: &[Artifact], existing: Existing) -> Result<Vec<Outcome>, Diagnostic> {
    write_durable(out, set, existing).map_err(|error| not_written(&error))
}

/// What is to be replaced: with `--force` anything, else only what is ours.
pub(crate) const fn forced(force: bool, otherwise: Existing) -> Existing {
    if force { Existing::Any } else { otherwise }
}

/// The message about files that could not be written, with a way out.
pub(crate) fn not_written(error: &WriteError) -> Diagnostic {
    let help = match &error.reason {
        Reason::Exists(_) | Reason::NotGenerated(_) => {
            "nothing was changed; choose another directory with `--out`, rename what is there, or replace it with `--force`"
        }
        Reason::Name(_) => {
            "files are named after the specification and the keys of its devices: rename what this name comes from"
        }
        Reason::Clash(_) => {
            "give devices and specifications names that differ by more than upper and lower case, or write into different directories with `--out`"
        }
        _ => error.advice(),
    };
    Diagnostic::without_place(codes::WRITE_FAILED, error.to_string()).help(help)
}

/// Two files of a set that are one, in words: those of two `owners`.
pub(crate) fn clash(set: &[Artifact], owners: &str) -> Option<String> {
    let (first, second) = od_gen::files::clash(set.iter().map(|artifact| artifact.path.as_str()))?;
    Some(if first == second {
        format!("two {owners} would both write {first}")
    } else {
        format!("two {owners} would write {first} and {second}, which some systems take for one file")
    })
}

/// The first path at which something that was read would be written over.
pub(crate) fn overwritten(out: &Path, set: &[Artifact], read: &[PathBuf]) -> Option<String> {
    let read: Vec<PathBuf> = read.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
    let paths = set.iter().map(|artifact| out.join(&artifact.path));
    paths
        .into_iter()
        .find(|path| fs::canonicalize(path).is_ok_and(|path| read.contains(&path)))
        .map(file_name::shown)
}

fn list(out: &Path, set: &[Artifact], outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    let paths: Vec<String> = set.iter().map(|artifact| shown(&out.join(&artifact.path))).collect();
    let width = paths.iter().map(|path| path.chars().count()).max().unwrap_or(0);
    for (artifact, path) in set.iter().zip(&paths) {
        let size = artifact.bytes.len().div_ceil(1024);
        let _ = writeln!(text, "  {path:<width$}  {size:>4} kB  {}", artifact.purpose);
    }
    let changed = outcomes.iter().filter(|outcome| **outcome == Outcome::Changed).count();
    let _ = writeln!(text, "  {changed} files changed, {} unchanged", outcomes.len() - changed);
    text
}

/// The name of the file to write, which is not one of those that were read.
pub(crate) fn file_name(path: &Path, what: &str, read: &[PathBuf]) -> Result<String, Diagnostic> {
    let refuse = |problem: &str, help: &str| {
        let message = format!("cannot write `{}`: {problem}", file_name::shown(path));
        Err(Diagnostic::without_place(codes::WRITE_FAILED, message).help(help.to_owned()))
    };
    let Some(name) = path.file_name() else {
        return refuse("it names no file", "write the file's name after the directory");
    };
    let Some(name) = name.to_str() else {
        return refuse("its name is not Unicode", "choose another name");
    };
    let same = |file: &PathBuf| match (fs::canonicalize(path), fs::canonicalize(file)) {
        (Ok(target), Ok(file)) => target == file,
        _ => false,
    };
    if read.iter().any(same) {
        return refuse(&format!("{what} is made from this file"), "write it to another file");
    }
    Ok(name.to_owned())
}
