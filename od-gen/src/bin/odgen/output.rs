//! What a command has made goes to the disk, all of it or nothing.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use od_gen::Artifact;
use od_gen::files::{Outcome, write_all};
use od_spec::diag::{Diagnostic, codes};

use super::report::{Report, print};

/// Writes the files and prints `summary`, then their list.
pub(crate) fn write(out: &Path, set: &[Artifact], summary: &str, report: &Report) -> u8 {
    match save(out, set) {
        Ok(outcomes) => print(&format!("{summary}{}", list(out, set, &outcomes))),
        Err(diagnostic) => report.refuse(diagnostic),
    }
}

/// Writes the files: all of them or, with a message, none.
pub(crate) fn save(out: &Path, set: &[Artifact]) -> Result<Vec<Outcome>, Diagnostic> {
    write_all(out, set).map_err(|error| {
        Diagnostic::without_place(codes::WRITE_FAILED, error.to_string())
            .help("nothing was changed; check the directory, its permissions and the free space")
    })
}

/// The first path that two artifacts share.
pub(crate) fn clash(set: &[Artifact]) -> Option<&str> {
    let mut seen = BTreeSet::new();
    // Some file systems do not tell capitals from small letters.
    set.iter()
        .find(|artifact| !seen.insert(artifact.path.to_lowercase()))
        .map(|artifact| artifact.path.as_str())
}

/// The first path at which something that was read would be written over.
pub(crate) fn overwritten(out: &Path, set: &[Artifact], read: &[PathBuf]) -> Option<String> {
    let read: Vec<PathBuf> = read.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
    let paths = set.iter().map(|artifact| out.join(&artifact.path));
    paths
        .into_iter()
        .find(|path| fs::canonicalize(path).is_ok_and(|path| read.contains(&path)))
        .map(|path| path.display().to_string())
}

fn list(out: &Path, set: &[Artifact], outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    let paths: Vec<String> =
        set.iter().map(|artifact| out.join(&artifact.path).display().to_string()).collect();
    let width = paths.iter().map(|path| path.chars().count()).max().unwrap_or(0);
    for (artifact, path) in set.iter().zip(&paths) {
        let size = artifact.bytes.len().div_ceil(1024);
        let _ = writeln!(text, "  {path:<width$}  {size:>4} kB  {}", artifact.purpose);
    }
    let changed = outcomes.iter().filter(|outcome| **outcome == Outcome::Changed).count();
    let _ = writeln!(text, "  {changed} files changed, {} unchanged", outcomes.len() - changed);
    text
}
