//! Writing files: each whole or not at all, only what differs, and only over what is ours.
//!
//! A set is checked before its first byte is written. Then each file whose contents differ gets
//! them under a temporary name in its folder, and is renamed. A run that is killed leaves every
//! file whole, old or new; the next run finds what still differs, and completes the set.

mod change;
mod disk;
mod left;
mod mark;
mod names;

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

pub use self::left::{left_over, left_over_of_folders, remove};
pub use self::names::{clash, name_problem};

use self::change::{Change, target};
use self::disk::{Disk, Durability, Real, sweep};
use od_spec::file_name;

use crate::artifact::{Artifact, OutputFile};

/// What happened to one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It was new or had other contents.
    Changed,
    /// It had these contents already and was not touched.
    Unchanged,
}

/// Which files may be replaced by others. One that has the contents already always may stay.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Those that generators made: they say so in their first lines, or the list `.odgen-files` of the directory does.
    Generated,
    /// None: what is written belongs to the user from then on.
    None,
    /// Any.
    Any,
}

/// Why not every file could be written.
#[derive(Debug)]
#[non_exhaustive]
pub struct WriteError {
    /// The file, or the first of several.
    pub path: PathBuf,
    /// Why.
    pub reason: Reason,
    /// The files that were replaced before it, each of them whole. All others are as they were.
    pub written: Vec<PathBuf>,
}

/// Why a file could not be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum Reason {
    /// The system reports an error.
    Io(io::Error),
    /// It is left from an earlier run, and the system cannot read or remove it.
    Left(io::Error),
    /// It is there with other contents, and so are these.
    Exists(Vec<PathBuf>),
    /// It is there with other contents, and no generator made it, nor these.
    NotGenerated(Vec<PathBuf>),
    /// Not every system takes its name.
    Name(String),
    /// On systems that do not distinguish upper and lower case this is the same file.
    Clash(PathBuf),
}

impl std::fmt::Display for WriteError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let path = file_name::shown(&self.path);
        let all = |more: &[PathBuf]| named(std::iter::once(&self.path).chain(more));
        match &self.reason {
            Reason::Io(error) if self.written.is_empty() => write!(f, "cannot write {path}: {error}"),
            Reason::Io(error) => {
                write!(f, "cannot write {path}: {error}; written before it: {}", named(&self.written))
            }
            Reason::Left(error) => write!(f, "cannot read or remove {path}: {error}"),
            Reason::Exists(more) => {
                let they_are = if more.is_empty() { "it is" } else { "they are" };
                write!(f, "cannot write {}: {they_are} there already", all(more))
            }
            Reason::NotGenerated(more) => {
                let why = if more.is_empty() {
                    "it is there, and nothing in it says that odgen made it"
                } else {
                    "they are there, and nothing in them says that odgen made them"
                };
                write!(f, "cannot write {}: {why}", all(more))
            }
            Reason::Name(problem) => write!(f, "cannot write {path}: {problem}"),
            Reason::Clash(other) => {
                let other = file_name::shown(other);
                write!(f, "cannot write both {path} and {other}: some systems take both names for one")
            }
        }
    }
}

/// The first files by name, and how many more there are.
fn named<'a>(files: impl IntoIterator<Item = &'a PathBuf>) -> String {
    /// So many files are named.
    const NAMED: usize = 5;
    let mut names: Vec<String> = files.into_iter().map(file_name::shown).collect();
    let more = names.len().saturating_sub(NAMED);
    names.truncate(NAMED);
    let names = names.join(", ");
    if more == 0 { names } else { format!("{names} and {more} more") }
}

impl std::error::Error for WriteError {}

impl WriteError {
    fn new(path: impl Into<PathBuf>, reason: Reason) -> Self {
        Self { path: path.into(), reason, written: Vec::new() }
    }

    fn io(path: impl Into<PathBuf>, error: io::Error) -> Self {
        Self::new(path, Reason::Io(error))
    }

    /// What to do about an error of the system, and what its files are like until then.
    pub const fn advice(&self) -> &'static str {
        match self.reason {
            Reason::Left(_) => "all files of this run are written; check the permissions, and run it again",
            _ if self.written.is_empty() => {
                "nothing was changed; check the directory, its permissions and the free space"
            }
            _ => {
                "every file is whole, old or new; check the permissions and the free space, and run it again: it writes the rest"
            }
        }
    }
}

/// [`write_set`], over files that a generator made and no others.
///
/// # Errors
/// As there.
pub fn write_all(directory: &Path, artifacts: &[Artifact]) -> Result<Vec<Outcome>, WriteError> {
    write_set(directory, artifacts, Existing::Generated)
}

/// Writes the files below `directory`. Files keep their mode and their owner.
///
/// # Errors
/// The first file that cannot be written. Before anything is changed: it must not be replaced, its
/// name is not one on every system or leads out of the directory, or something is in its way. After
/// others were written: the disk is full or write-protected.
pub fn write_set<F: OutputFile>(
    directory: &Path,
    artifacts: &[F],
    existing: Existing,
) -> Result<Vec<Outcome>, WriteError> {
    write_set_watched(directory, artifacts, existing, &mut |_, _| {})
}

/// [`write_set`], for a set that takes a while: `watch` gets how many files are written, of how
/// many.
///
/// # Errors
/// As there.
pub fn write_set_watched<F: OutputFile>(
    directory: &Path,
    artifacts: &[F],
    existing: Existing,
    watch: Watch<'_>,
) -> Result<Vec<Outcome>, WriteError> {
    write_with(directory, artifacts, existing, Durability::Later, &Real, watch)
}

/// [`write_set`], for what nothing can make again: each file is on the disk before it gets its name.
///
/// # Errors
/// As there.
pub fn write_durable<F: OutputFile>(
    directory: &Path,
    artifacts: &[F],
    existing: Existing,
) -> Result<Vec<Outcome>, WriteError> {
    write_with(directory, artifacts, existing, Durability::Now, &Real, &mut |_, _| {})
}

/// Replaces files by name, wherever they are; each is on the disk before it gets its name.
///
/// # Errors
/// As those of [`write_set`].
pub fn replace(files: &[(PathBuf, Vec<u8>)]) -> Result<(), WriteError> {
    replace_with(files, &Real)
}

/// Gets how many files are written, of how many.
pub type Watch<'a> = &'a mut dyn FnMut(usize, usize);

fn replace_with(files: &[(PathBuf, Vec<u8>)], disk: &impl Disk) -> Result<(), WriteError> {
    let mut changes = Vec::new();
    for (path, bytes) in files {
        changes.extend(Change::of(path, vec![bytes])?);
    }
    make(files.iter().map(|(path, _)| path.clone()), &changes, Durability::Now, disk, &mut |_, _| {})
}

fn write_with<F: OutputFile>(
    directory: &Path,
    artifacts: &[F],
    existing: Existing,
    durability: Durability,
    disk: &impl Disk,
    watch: Watch<'_>,
) -> Result<Vec<Outcome>, WriteError> {
    let directory = of_path(directory);
    check_names(directory, artifacts)?;
    let listed = mark::listed(directory);
    let (mut changes, mut outcomes, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    for artifact in artifacts {
        let path = directory.join(artifact.path());
        let change = Change::of(&path, artifact.pieces())?;
        outcomes.push(if change.is_some() { Outcome::Changed } else { Outcome::Unchanged });
        let Some(change) = change else { continue };
        let may = match existing {
            Existing::Generated => {
                change.replaces_none() || change.replaces_generated() || listed.contains(artifact.path())
            }
            Existing::None => change.replaces_none(),
            Existing::Any => true,
        };
        if !may {
            refused.push(path);
        }
        changes.push(change);
    }
    if !refused.is_empty() {
        let path = refused.remove(0);
        let reason =
            if existing == Existing::None { Reason::Exists(refused) } else { Reason::NotGenerated(refused) };
        return Err(WriteError::new(path, reason));
    }
    let list = if existing == Existing::None { None } else { mark::list(directory, artifacts, &listed) };
    if let Some(list) = &list {
        // First of all: a run that is killed after it leaves no file that the next takes for another's.
        changes.splice(..0, Change::of(&directory.join(&list.path), vec![list.bytes.as_slice()])?);
    }
    let paths = artifacts.iter().map(|artifact| directory.join(artifact.path()));
    make(paths, &changes, durability, disk, watch)?;
    Ok(outcomes)
}

/// Makes the changes, in folders that are cleared of what killed runs left.
fn make(
    paths: impl Iterator<Item = PathBuf>,
    changes: &[Change<'_>],
    durability: Durability,
    disk: &impl Disk,
    watch: Watch<'_>,
) -> Result<(), WriteError> {
    let folders: BTreeSet<PathBuf> =
        paths.map(|path| parent(&target(&path).unwrap_or(path)).to_owned()).collect();
    for folder in &folders {
        sweep(folder, disk);
    }
    for (at, change) in changes.iter().enumerate() {
        change.make(durability, disk).map_err(|error| WriteError {
            written: changes.iter().take(at).map(|change| change.path.clone()).collect(),
            ..WriteError::io(&change.path, error)
        })?;
        watch(at + 1, changes.len());
    }
    Ok(())
}

/// No file has a name that leads elsewhere, or that some system does not take or takes for another's.
fn check_names<F: OutputFile>(directory: &Path, artifacts: &[F]) -> Result<(), WriteError> {
    for artifact in artifacts {
        if let Some(problem) = name_problem(artifact.path()) {
            return Err(WriteError::new(directory.join(artifact.path()), Reason::Name(problem)));
        }
    }
    if let Some((first, second)) = clash(artifacts.iter().map(OutputFile::path)) {
        return Err(WriteError::new(directory.join(second), Reason::Clash(directory.join(first))));
    }
    let folders: BTreeSet<&Path> =
        artifacts.iter().flat_map(|file| Path::new(file.path()).ancestors().skip(1)).collect();
    match artifacts.iter().find(|file| folders.contains(Path::new(file.path()))) {
        Some(file) => Err(WriteError::io(
            directory.join(file.path()),
            io::Error::new(io::ErrorKind::IsADirectory, "another file needs a directory of this name"),
        )),
        None => Ok(()),
    }
}

/// A directory as a path that systems take: without a name it is the current one.
fn of_path(directory: &Path) -> &Path {
    if directory.as_os_str().is_empty() { Path::new(".") } else { directory }
}

fn parent(file: &Path) -> &Path {
    of_path(file.parent().unwrap_or(Path::new("")))
}

#[cfg(test)]
mod tests;
