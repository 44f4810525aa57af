//! Old files give way to new ones, all or none.

use std::collections::BTreeSet;
use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

use super::disk::{Disk, New};
use super::journal::{self, Journal, Names, Phase, Step, fingerprint, fingerprint_of, target};
use super::{WriteError, mark, parent};

/// A file that is to have other contents.
pub(super) struct Change<'a> {
    /// As the journal names it.
    path: String,
    /// Where it lies.
    target: PathBuf,
    pieces: Vec<&'a [u8]>,
    old: Option<Old>,
}

/// What is there before.
struct Old {
    metadata: Metadata,
    fingerprint: u64,
    is_marked: bool,
}

/// What became of a set whose process was killed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Recovered {
    /// It is complete now.
    Completed,
    /// The old files are there.
    Undone,
}

impl<'a> Change<'a> {
    /// Nothing if the file has these contents already.
    pub(super) fn of(path: String, target: PathBuf, pieces: Vec<&'a [u8]>) -> io::Result<Option<Self>> {
        let metadata = match fs::metadata(&target) {
            Ok(metadata) => metadata,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Ok(Some(Self { path, target, pieces, old: None }));
            }
            Err(error) => return Err(error),
        };
        if metadata.is_dir() {
            return Err(io::Error::new(
                io::ErrorKind::IsADirectory,
                "a directory of this name is in the way",
            ));
        }
        if !metadata.is_file() {
            return Err(io::Error::other("it is no regular file"));
        }
        let old = fs::read(&target)?;
        if is_made_of(&old, &pieces) {
            return Ok(None);
        }
        let old = Old { metadata, fingerprint: fingerprint(&old), is_marked: mark::is_marked(&old) };
        Ok(Some(Self { path, target, pieces, old: Some(old) }))
    }

    /// Whether there is no file yet.
    pub(super) const fn replaces_none(&self) -> bool {
        self.old.is_none()
    }

    /// Whether the file says that a generator made it.
    pub(super) fn replaces_generated(&self) -> bool {
        self.old.as_ref().is_some_and(|old| old.is_marked)
    }

    fn step(&self) -> Step {
        let old = self.old.as_ref().map(|old| old.fingerprint);
        Step { path: self.path.clone(), old, new: fingerprint_of(&self.pieces) }
    }
}

/// Whether contents are these pieces, one behind the other.
fn is_made_of(mut contents: &[u8], pieces: &[&[u8]]) -> bool {
    for piece in pieces {
        match contents.strip_prefix(*piece) {
            Some(rest) => contents = rest,
            None => return false,
        }
    }
    contents.is_empty()
}

/// Puts new files in place of old ones. With a directory, a journal in it lets the next process finish what a killed one began.
pub(super) fn exchange(
    directory: Option<&Path>,
    changes: &[Change<'_>],
    disk: &impl Disk,
) -> Result<(), WriteError> {
    if changes.is_empty() {
        return Ok(());
    }
    let names = if directory.is_some() { Names::OfSet } else { Names::Alone };
    let steps: Vec<Step> = changes.iter().map(Change::step).collect();
    let note = |phase: Phase| match directory {
        Some(directory) => {
            journal::write(phase, &steps, directory, disk).map_err(|error| WriteError::io(directory, error))
        }
        None => Ok(()),
    };
    let close = || match directory {
        Some(directory) => Journal::close(directory, disk).map_err(|error| WriteError::io(directory, error)),
        None => Ok(()),
    };
    let prepared = note(Phase::Prepare)
        .and_then(|()| prepare(changes, names, disk))
        .and_then(|()| settle(changes, disk))
        .and_then(|()| note(Phase::Replace));
    if let Err(error) = prepared {
        // A journal that could not be written may still be the one before.
        if discard(changes, names, disk).is_ok() {
            let _ = close();
        }
        return Err(error);
    }
    let replaced = (0..).zip(changes).try_for_each(|(number, change)| {
        disk.rename(&names.waiting(&change.target, number), &change.target)
            .map_err(|error| WriteError::io(&change.target, error))
    });
    if let Err(error) = replaced {
        let _ = note(Phase::Undo);
        let undone = (0..)
            .zip(changes.iter().zip(&steps))
            .try_for_each(|(number, (change, step))| undo(step, &change.target, number, names, disk));
        if undone.is_ok() {
            let _ = close();
        }
        return Err(error);
    }
    settle(changes, disk)?;
    discard(changes, names, disk).map_err(|(path, error)| WriteError::io(path, error))?;
    close()
}

/// Brings all new files to the disk, and second names for the old ones.
fn prepare(changes: &[Change<'_>], names: Names, disk: &impl Disk) -> Result<(), WriteError> {
    let files: Vec<New<'_>> = (0..)
        .zip(changes)
        .map(|(number, change)| New {
            path: names.waiting(&change.target, number),
            pieces: &change.pieces,
            like: change.old.as_ref().map(|old| &old.metadata),
        })
        .collect();
    disk.write_each(&files).map_err(|(at, error)| {
        WriteError::io(changes.get(at).map(|change| change.target.clone()).unwrap_or_default(), error)
    })?;
    (0..).zip(changes).filter(|(_, change)| change.old.is_some()).try_for_each(|(number, change)| {
        let target = &change.target;
        disk.keep(target, &names.kept(target, number)).map_err(|error| WriteError::io(target, error))
    })
}

fn settle(changes: &[Change<'_>], disk: &impl Disk) -> Result<(), WriteError> {
    let directories: BTreeSet<PathBuf> = changes.iter().map(|change| parent(&change.target)).collect();
    let directories: Vec<PathBuf> = directories.into_iter().collect();
    disk.settle_each(&directories)
        .map_err(|(at, error)| WriteError::io(directories.get(at).cloned().unwrap_or_default(), error))
}

/// Removes what is left of other names.
fn discard(changes: &[Change<'_>], names: Names, disk: &impl Disk) -> Result<(), (PathBuf, io::Error)> {
    (0..).zip(changes).try_for_each(|(number, change)| {
        [names.waiting(&change.target, number), names.kept(&change.target, number)]
            .into_iter()
            .try_for_each(|path| disk.remove(&path).map_err(|error| (path, error)))
    })
}

/// Completes or undoes what the journal of a directory tells of.
pub(super) fn recover(directory: &Path, disk: &impl Disk) -> Result<Option<Recovered>, WriteError> {
    let failed = |error| WriteError::io(directory, error);
    let Some(journal) = Journal::read(directory).map_err(failed)? else {
        if journal::is_there(directory) {
            Journal::close(directory, disk).map_err(failed)?;
        }
        return Ok(None);
    };
    let mut directories = BTreeSet::new();
    for (number, step) in (0..).zip(&journal.steps) {
        let failed = |error| WriteError::io(directory.join(&step.path), error);
        let target = target(directory, Path::new(&step.path)).map_err(failed)?;
        match journal.phase {
            Phase::Prepare => discard_one(&target, number, Names::OfSet, disk),
            Phase::Replace => complete(step, &target, number, disk),
            Phase::Undo => undo(step, &target, number, Names::OfSet, disk),
        }
        .map_err(failed)?;
        directories.extend(Some(parent(&target)).filter(|directory| directory.is_dir()));
    }
    for directory in &directories {
        disk.settle(directory).map_err(|error| WriteError::io(directory, error))?;
    }
    Journal::close(directory, disk).map_err(failed)?;
    Ok(Some(match journal.phase {
        Phase::Replace => Recovered::Completed,
        Phase::Prepare | Phase::Undo => Recovered::Undone,
    }))
}

/// Removes what a process left that was killed while it exchanged files that stand for themselves. Nobody else writes here now.
pub(super) fn sweep(directory: &Path, disk: &impl Disk) -> Result<(), WriteError> {
    // Who may write into a directory need not be allowed to list it.
    let Ok(entries) = fs::read_dir(directory) else { return Ok(()) };
    for name in entries.flatten().map(|entry| entry.file_name()) {
        if name.to_str().is_some_and(|name| Names::Alone.has(name)) {
            let path = directory.join(name);
            disk.remove(&path).map_err(|error| WriteError::io(path, error))?;
        }
    }
    Ok(())
}

fn discard_one(target: &Path, number: usize, names: Names, disk: &impl Disk) -> io::Result<()> {
    disk.remove(&names.waiting(target, number))?;
    disk.remove(&names.kept(target, number))
}

/// Gives a new file its name, unless somebody has changed the old one since.
fn complete(step: &Step, target: &Path, number: usize, disk: &impl Disk) -> io::Result<()> {
    let new = Names::OfSet.waiting(target, number);
    if new.exists() && contents(target)? == step.old {
        disk.rename(&new, target)?;
    }
    discard_one(target, number, Names::OfSet, disk)
}

/// Brings an old file back, unless somebody has changed the new one since.
fn undo(step: &Step, target: &Path, number: usize, names: Names, disk: &impl Disk) -> io::Result<()> {
    if contents(target)? == Some(step.new) {
        let old = names.kept(target, number);
        if old.exists() {
            disk.rename(&old, target)?;
        } else if step.old.is_none() {
            disk.remove(target)?;
        }
    }
    discard_one(target, number, names, disk)
}

fn contents(path: &Path) -> io::Result<Option<u64>> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(fingerprint(&bytes))),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}
