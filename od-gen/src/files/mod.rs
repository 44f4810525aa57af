//! Writing files: all of a set or none, nothing that would not change, and nothing that is not ours.
//!
//! A set is written under other names first; a journal beside it says what is going on. When everything is on the disk, the files get
//! their names, one after the other. A process that is killed before that has changed nothing; one that is killed
//! in between leaves a journal, with which the next one completes the set before it does anything else ([`recover`], [`write_set`]). Who reads in
//! between sees each file whole, old or new, and knows by `.odgen-journal` that they need not belong together.

mod disk;
mod exchange;
mod journal;
mod left;
mod lock;
mod mark;
mod names;

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub use self::disk::Watch;
pub use self::exchange::Recovered;
pub use self::left::{left_over, left_over_of_folders, remove};
pub use self::names::{clash, name_problem};

use self::disk::{Disk, Real, Watched};
use self::exchange::{Change, exchange};
use self::journal::target;
use self::lock::Lock;
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

/// Why files could not be written; no file of the set was changed.
#[derive(Debug)]
#[non_exhaustive]
pub struct WriteError {
    /// The file, or the first of several.
    pub path: PathBuf,
    /// Why.
    pub reason: Reason,
}

/// Why a file could not be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum Reason {
    /// The system says so.
    Io(io::Error),
    /// It is there with other contents, and so are these.
    Exists(Vec<PathBuf>),
    /// It is there with other contents, and no generator made it, nor these.
    NotGenerated(Vec<PathBuf>),
    /// Not every system takes its name.
    Name(String),
    /// On systems that do not tell capitals from small letters this is the same file.
    Clash(PathBuf),
}

impl std::fmt::Display for WriteError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        /// So many files are named.
        const NAMED: usize = 5;
        write!(f, "cannot write {}", self.path.display())?;
        let others = |f: &mut std::fmt::Formatter<'_>, others: &[PathBuf]| {
            others.iter().take(NAMED - 1).try_for_each(|path| write!(f, ", {}", path.display()))?;
            match others.len().saturating_sub(NAMED - 1) {
                0 => Ok(()),
                more => write!(f, " and {more} more"),
            }
        };
        match &self.reason {
            Reason::Io(error) => write!(f, ": {error}"),
            Reason::Exists(more) => {
                others(f, more)?;
                f.write_str(if more.is_empty() {
                    ": it is there already"
                } else {
                    ": they are there already"
                })
            }
            Reason::NotGenerated(more) => {
                others(f, more)?;
                f.write_str(if more.is_empty() {
                    ": it is there, and nothing in it says that odgen made it"
                } else {
                    ": they are there, and nothing in them says that odgen made them"
                })
            }
            Reason::Name(problem) => write!(f, ": {problem}"),
            Reason::Clash(other) => {
                write!(f, " beside {}: some systems take both names for one", other.display())
            }
        }
    }
}

impl std::error::Error for WriteError {}

impl WriteError {
    fn io(path: impl Into<PathBuf>, error: io::Error) -> Self {
        Self { path: path.into(), reason: Reason::Io(error) }
    }
}

/// [`write_set`], over files that a generator made and no others.
///
/// # Errors
/// As there.
pub fn write_all(directory: &Path, artifacts: &[Artifact]) -> Result<Vec<Outcome>, WriteError> {
    write_set(directory, artifacts, Existing::Generated)
}

/// Writes the files below `directory`, all or none. Waits while another process writes there, and completes what a killed one left. Files
/// keep their mode and their owner. Directories that were made for the files stay, whatever happens.
///
/// # Errors
/// The first file that cannot be written: it is one that must not be replaced, its name is none on every system or leads out of the directory,
/// its directory cannot be made, a directory is in its way, the disk is full or write-protected.
pub fn write_set<F: OutputFile>(
    directory: &Path,
    artifacts: &[F],
    existing: Existing,
) -> Result<Vec<Outcome>, WriteError> {
    write_with(directory, artifacts, existing, &Real)
}

/// [`write_set`], for a set that takes a while: `watch` is told how many files are written.
///
/// # Errors
/// As there.
pub fn write_set_watched<F: OutputFile>(
    directory: &Path,
    artifacts: &[F],
    existing: Existing,
    watch: &Watch<'_>,
) -> Result<Vec<Outcome>, WriteError> {
    write_with(directory, artifacts, existing, &Watched { watch })
}

/// Replaces files by name, wherever they are. On an error all are as they were; a process that is killed leaves each file whole, and
/// what else it leaves is removed by the next that writes there.
///
/// # Errors
/// The first file that cannot be written.
pub fn replace(files: &[(PathBuf, Vec<u8>)]) -> Result<(), WriteError> {
    replace_with(files, &Real)
}

fn replace_with(files: &[(PathBuf, Vec<u8>)], disk: &impl Disk) -> Result<(), WriteError> {
    let mut directories = BTreeSet::new();
    let mut targets = Vec::new();
    for (path, bytes) in files {
        let file = target(Path::new(""), path).map_err(|error| WriteError::io(path, error))?;
        directories.insert(parent(&file));
        targets.push((file, bytes));
    }
    let _lock = Lock::take(&directories).map_err(|(path, error)| WriteError::io(path, error))?;
    for directory in &directories {
        exchange::sweep(directory, disk)?;
    }
    let mut changes = Vec::new();
    for (file, bytes) in targets {
        changes.extend(
            Change::of(String::new(), file.clone(), vec![bytes])
                .map_err(|error| WriteError::io(file, error))?,
        );
    }
    exchange(None, &changes, disk)
}

/// Completes or undoes what a process that was killed began in a directory, if there is such a thing.
///
/// # Errors
/// A file cannot be written. The journal stays, for another try.
pub fn recover(directory: &Path) -> Result<Option<Recovered>, WriteError> {
    let directory = of_path(directory);
    let failed = |(path, error)| WriteError::io(path, error);
    if !journal::is_there(directory) {
        return Ok(None);
    }
    // Of a process that lives, the lock tells.
    let _lock = Lock::take(&BTreeSet::from([directory.to_owned()])).map_err(failed)?;
    exchange::recover(directory, &Real)
}

fn write_with<F: OutputFile>(
    directory: &Path,
    artifacts: &[F],
    existing: Existing,
    disk: &impl Disk,
) -> Result<Vec<Outcome>, WriteError> {
    let directory = of_path(directory);
    check_names(directory, artifacts)?;
    let mut directories = BTreeSet::from([directory.to_owned()]);
    let mut targets = Vec::new();
    for artifact in artifacts {
        let path = directory.join(artifact.path());
        let failed = |error| WriteError::io(&path, error);
        fs::create_dir_all(parent(&path)).map_err(failed)?;
        let file = target(directory, Path::new(artifact.path())).map_err(failed)?;
        directories.extend([parent(&path), parent(&file)]);
        targets.push(file);
    }
    let _lock = Lock::take(&lockable(&directories, directory))
        .map_err(|(path, error)| WriteError::io(path, error))?;
    for directory in &directories {
        exchange::sweep(directory, disk)?;
        exchange::recover(directory, disk)?;
    }
    let listed = mark::listed(directory);
    let (mut changes, mut outcomes, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    for (artifact, file) in artifacts.iter().zip(targets) {
        let failed = |error| WriteError::io(directory.join(artifact.path()), error);
        let change = Change::of(artifact.path().to_owned(), file, artifact.pieces()).map_err(failed)?;
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
            refused.push(directory.join(artifact.path()));
        }
        changes.push(change);
    }
    if !refused.is_empty() {
        let path = refused.remove(0);
        let reason =
            if existing == Existing::None { Reason::Exists(refused) } else { Reason::NotGenerated(refused) };
        return Err(WriteError { path, reason });
    }
    let list = if existing == Existing::None { None } else { mark::list(directory, artifacts, &listed) };
    if let Some(list) = &list {
        let file = directory.join(&list.path);
        let change = Change::of(list.path.clone(), file.clone(), vec![list.bytes.as_slice()]);
        changes.extend(change.map_err(|error| WriteError::io(file, error))?);
    }
    exchange(Some(directory), &changes, disk)?;
    Ok(outcomes)
}

/// The directories that are locked: each, or where there are more than a process may have open files, that of the set, and those that
/// links lead to outside of it. Whoever writes anywhere below waits for it, too: see [`Lock::take`].
fn lockable(directories: &BTreeSet<PathBuf>, of_set: &Path) -> BTreeSet<PathBuf> {
    const MOST: usize = 200;
    if directories.len() <= MOST {
        return directories.clone();
    }
    let top = fs::canonicalize(of_set).unwrap_or_else(|_| of_set.to_owned());
    let is_outside =
        |directory: &&PathBuf| !fs::canonicalize(directory).is_ok_and(|path| path.starts_with(&top));
    directories.iter().filter(is_outside).cloned().chain([of_set.to_owned()]).collect()
}

/// No file has a name that leads elsewhere, or that some system does not take or takes for another's.
fn check_names<F: OutputFile>(directory: &Path, artifacts: &[F]) -> Result<(), WriteError> {
    for artifact in artifacts {
        if let Some(problem) = name_problem(artifact.path()) {
            return Err(WriteError { path: directory.join(artifact.path()), reason: Reason::Name(problem) });
        }
    }
    match clash(artifacts.iter().map(OutputFile::path)) {
        Some((first, second)) => {
            Err(WriteError { path: directory.join(second), reason: Reason::Clash(directory.join(first)) })
        }
        None => Ok(()),
    }
}

/// A directory as a path that systems take: without a name it is the current one.
fn of_path(directory: &Path) -> &Path {
    if directory.as_os_str().is_empty() { Path::new(".") } else { directory }
}

fn parent(file: &Path) -> PathBuf {
    of_path(file.parent().unwrap_or(Path::new(""))).to_owned()
}

#[cfg(test)]
mod tests;
