//! What an earlier set left in a directory, and a later one no longer makes.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use super::disk::{Disk as _, Durability, Real, put};
use super::{Reason, WriteError, mark, of_path};
use crate::artifact::{Artifact, OutputFile};

/// The files below a directory that generators made and `set` does not have, by their paths. They are looked for among those of the
/// set's kinds: where it has `src/pump.rs`, in `src` and below it and called `.rs`. What else lies there may be another command's.
///
/// # Errors
/// A directory or a file cannot be read.
pub fn left_over<F: OutputFile>(directory: &Path, set: &[F]) -> Result<Vec<String>, WriteError> {
    look(directory, set, &set.iter().map(|file| kind(file.path())).collect())
}

/// [`left_over`], with the folders that earlier sets had, as the list of the directory states: what names folders may
/// be gone.
///
/// # Errors
/// A directory or a file cannot be read.
pub fn left_over_of_folders<F: OutputFile>(directory: &Path, set: &[F]) -> Result<Vec<String>, WriteError> {
    let listed = mark::listed(of_path(directory));
    let folders = listed
        .iter()
        .map(|path| kind(path).0)
        .filter(|folder| !folder.is_empty() && of_path(directory).join(folder).is_dir());
    let endings: BTreeSet<&str> = set.iter().map(|file| kind(file.path()).1).collect();
    let of_list = folders.flat_map(|folder| endings.iter().map(move |ending| (folder, *ending)));
    let of_set = set.iter().map(|file| kind(file.path()));
    look(directory, set, &of_list.chain(of_set).collect())
}

fn look<F: OutputFile>(
    directory: &Path,
    set: &[F],
    kinds: &BTreeSet<(&str, &str)>,
) -> Result<Vec<String>, WriteError> {
    let directory = of_path(directory);
    let folders: BTreeSet<&str> = kinds.iter().map(|(folder, _)| *folder).collect();
    let mut found = Vec::new();
    for folder in folders {
        list(directory, folder, &mut found).map_err(|error| left_error(directory.join(folder), error))?;
    }
    let made: BTreeSet<&str> = set.iter().map(OutputFile::path).collect();
    let listed = mark::listed(directory);
    let mut left = Vec::new();
    for path in found {
        let file = directory.join(&path);
        if made.contains(path.as_str()) || !kinds.contains(&kind(&path)) {
            continue;
        }
        if listed.contains(&path) || marked(&file).map_err(|error| left_error(file, error))? {
            left.push(path);
        }
    }
    left.sort();
    Ok(left)
}

/// Removes files that [`left_over`] found.
///
/// # Errors
/// The first that cannot be removed; those before it are gone.
pub fn remove(directory: &Path, left: &[String]) -> Result<(), WriteError> {
    let directory = of_path(directory);
    for path in left {
        let file = directory.join(path);
        Real.remove(&file).map_err(|error| left_error(file, error))?;
    }
    // A user who writes a file of such a name later is its owner.
    let (old, file) = (mark::listed(directory), directory.join(mark::LIST));
    if !old.iter().any(|path| left.contains(path)) {
        return Ok(());
    }
    let changed = match mark::list::<Artifact>(directory, &[], &old) {
        Some(list) => put(&file, &[&list.bytes], None, Durability::Later, &Real),
        None => Real.remove(&file),
    };
    changed.map_err(|error| left_error(file, error))
}

fn left_error(path: PathBuf, error: io::Error) -> WriteError {
    WriteError::new(path, Reason::Left(error))
}

/// The folder at the top and the ending of a path.
fn kind(path: &str) -> (&str, &str) {
    let folder = path.split_once('/').map_or("", |(folder, _)| folder);
    let name = path.rsplit('/').next().unwrap_or(path);
    (folder, name.rsplit_once('.').map_or("", |(_, ending)| ending))
}

/// The files in a folder and below it; at the top, only those in it. Links lead elsewhere.
fn list(directory: &Path, folder: &str, found: &mut Vec<String>) -> io::Result<()> {
    for entry in fs::read_dir(directory.join(folder))? {
        let entry = entry?;
        // What is not Unicode is not a name that a generator gives.
        let Some(name) = entry.file_name().to_str().map(ToOwned::to_owned) else { continue };
        let path = if folder.is_empty() { name } else { format!("{folder}/{name}") };
        let kind = entry.file_type()?;
        if kind.is_file() {
            found.push(path);
        } else if kind.is_dir() && !folder.is_empty() {
            list(directory, &path, found)?;
        }
    }
    Ok(())
}

/// Whether a file says that it is generated.
fn marked(file: &Path) -> io::Result<bool> {
    let mut head = Vec::new();
    fs::File::open(file)?.take(mark::HEAD as u64).read_to_end(&mut head)?;
    Ok(mark::is_marked(&head))
}
