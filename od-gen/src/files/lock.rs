//! One process at a time writes into a directory; others wait.

use std::collections::{BTreeMap, BTreeSet};
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
    /// Waits until nobody else writes into these directories, which exist, nor holds one above them for all that lies below. Several
    /// may share what lies above theirs.
    pub(super) fn take(directories: &BTreeSet<PathBuf>) -> Result<Self, (PathBuf, io::Error)> {
        // Always in the same order: two that wait for each other would wait for ever.
        let mut wanted = BTreeMap::new();
        for directory in directories {
            let path = fs::canonicalize(directory).map_err(|error| (directory.clone(), error))?;
            for above in path.ancestors().skip(1) {
                wanted.entry(above.to_owned()).or_insert(Claim::Shared);
            }
            wanted.insert(path, Claim::Own);
        }
        let mut files = Vec::new();
        for (directory, claim) in wanted {
            match claim {
                Claim::Own => files.push(one(&directory).map_err(|error| (directory, error))?),
                Claim::Shared => files.extend(shared(&directory)),
            }
        }
        Ok(Self { _files: files })
    }
}

/// What a directory is wanted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Claim {
    /// To write into it, and below it where that is too much to lock one by one.
    Own,
    /// To write somewhere below it, as others may do at the same time.
    Shared,
}

/// Waits while somebody writes into a directory; what cannot be locked, such as one that may not be read, nobody of this user locks.
fn shared(directory: &Path) -> Vec<File> {
    let mut found = Vec::new();
    if cfg!(unix) {
        found.extend(File::open(directory));
    }
    // Where whoever writes has to make do with a file, it is there by then.
    found.extend(File::open(directory.join(LOCK)));
    found.retain(|file| file.lock_shared().is_ok());
    found
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
