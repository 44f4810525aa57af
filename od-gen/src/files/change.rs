//! A file whose contents are to change.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

use super::disk::{Disk, Durability, put};
use super::{WriteError, mark};

/// A file that is to have other contents.
pub(super) struct Change<'a> {
    /// As its user names it.
    pub(super) path: PathBuf,
    /// Where it is.
    target: PathBuf,
    pieces: Vec<&'a [u8]>,
    old: Option<Old>,
}

/// What exists before.
struct Old {
    metadata: Metadata,
    is_marked: bool,
}

impl<'a> Change<'a> {
    /// The change of a file, unless it has these contents already.
    pub(super) fn of(path: &Path, pieces: Vec<&'a [u8]>) -> Result<Option<Self>, WriteError> {
        let failed = |error| WriteError::io(path, error);
        let target = target(path).map_err(failed)?;
        let old = match existing(&target).map_err(failed)? {
            Some((_, contents)) if is_made_of(&contents, &pieces) => return Ok(None),
            Some((metadata, contents)) => Some(Old { metadata, is_marked: mark::is_marked(&contents) }),
            None => None,
        };
        Ok(Some(Self { path: path.to_owned(), target, pieces, old }))
    }

    /// Whether there is no file yet.
    pub(super) const fn replaces_none(&self) -> bool {
        self.old.is_none()
    }

    /// Whether the file says that it is generated.
    pub(super) fn replaces_generated(&self) -> bool {
        self.old.as_ref().is_some_and(|old| old.is_marked)
    }

    /// Writes the file.
    pub(super) fn make(&self, durability: Durability, disk: &impl Disk) -> io::Result<()> {
        let like = self.old.as_ref().map(|old| &old.metadata);
        put(&self.target, &self.pieces, like, durability, disk)
    }
}

/// A file and its contents, if there is one.
fn existing(target: &Path) -> io::Result<Option<(Metadata, Vec<u8>)>> {
    let metadata = match fs::metadata(target) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    if metadata.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "a directory of this name is in the way"));
    }
    if !metadata.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    Ok(Some((metadata, fs::read(target)?)))
}

/// Where a file is: what a link leads to, so that the link stays.
pub(super) fn target(path: &Path) -> io::Result<PathBuf> {
    let is_link = path.symlink_metadata().is_ok_and(|metadata| metadata.is_symlink());
    if is_link { fs::canonicalize(path) } else { Ok(path.to_owned()) }
}

/// Whether contents are these pieces, one after the other.
fn is_made_of(mut contents: &[u8], pieces: &[&[u8]]) -> bool {
    for piece in pieces {
        match contents.strip_prefix(*piece) {
            Some(rest) => contents = rest,
            None => return false,
        }
    }
    contents.is_empty()
}
