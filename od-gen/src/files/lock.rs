//! One process at a time writes into a directory; others wait.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

/// Where a directory itself cannot be locked (Windows, some network drives): an empty file, which stays.
pub(super) const LOCK: &str = ".odgen-lock";

/// Directories in which nobody else writes, until this is dropped or the process ends.
#[derive(Debug)]
pub(super) struct Lock {
    _files: Vec<File>,
}

impl Lock {
    /// Waits until nobody else writes into these directories, which exist.
    pub(super) fn take(directories: &BTreeSet<PathBuf>) -> Result<Self, (PathBuf, io::Error)> {
        // Always in the same order: two that wait for each other would wait for ever.
        let unique: Result<BTreeSet<PathBuf>, _> = directories
            .iter()
            .map(|directory| fs::canonicalize(directory).map_err(|error| (directory.clone(), error)))
            .collect();
        let files = unique?.into_iter().map(|directory| one(&directory).map_err(|error| (directory, error)));
        Ok(Self { _files: files.collect::<Result<_, _>>()? })
    }
}

fn one(directory: &Path) -> io::Result<File> {
    #[cfg(unix)]
    if let Ok(file) = File::open(directory)
        && file.lock().is_ok()
    {
        return Ok(file);
    }
    let file = OpenOptions::new().create(true).append(true).open(directory.join(LOCK))?;
    match file.lock() {
        // A file system without locks: better to write alone than not at all.
        Err(error) if error.kind() == io::ErrorKind::Unsupported => {}
        result => result?,
    }
    Ok(file)
}
