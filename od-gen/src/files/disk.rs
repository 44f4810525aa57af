//! The steps that change a disk, one by one: so that a test can stop a run between any two of them.

use std::fs::{self, File, Metadata};
use std::hash::{BuildHasher as _, RandomState};
use std::io::{self, Write as _};
use std::path::Path;

use super::parent;

/// Whether a file has to survive a power failure that follows at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Durability {
    /// No: the next run makes it again.
    Later,
    /// Yes: its contents are on the disk before it gets its name.
    Now,
}

/// The steps that change a disk.
pub(super) trait Disk {
    /// Makes a file that does not exist yet, with the mode and the owner of an old one.
    fn create(
        &self,
        path: &Path,
        pieces: &[&[u8]],
        like: Option<&Metadata>,
        durability: Durability,
    ) -> io::Result<()>;
    /// Gives a file the name of another one in its folder.
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;
    /// Removes a file, if it exists.
    fn remove(&self, path: &Path) -> io::Result<()>;
}

/// The disk of this machine.
pub(super) struct Real;

impl Disk for Real {
    fn create(
        &self,
        path: &Path,
        pieces: &[&[u8]],
        like: Option<&Metadata>,
        durability: Durability,
    ) -> io::Result<()> {
        let mut file = File::create_new(path)?;
        if let Some(like) = like {
            keep_owner(&file, like)?;
            keep_mode(&file, like)?;
        }
        match pieces {
            [piece] => file.write_all(piece)?,
            // One call of the system instead of one for each of a hundred pieces.
            pieces => file.write_all(&pieces.concat())?,
        }
        match durability {
            Durability::Later => Ok(()),
            Durability::Now => file.sync_all(),
        }
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        match fs::remove_file(path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }
}

/// How the temporary names begin. A random number follows, so that two runs never share one.
pub(super) const TEMPORARY: &str = ".odgen-new-";

/// Replaces a file as a whole: the contents get a temporary name in its folder first. Where that fails, folders that were made for it
/// do not stay.
pub(super) fn put(
    target: &Path,
    pieces: &[&[u8]],
    like: Option<&Metadata>,
    durability: Durability,
    disk: &impl Disk,
) -> io::Result<()> {
    let folder = parent(target);
    let missing: Vec<&Path> = folder.ancestors().take_while(|folder| !folder.exists()).collect();
    let temporary = target.with_file_name(format!("{TEMPORARY}{:016x}", RandomState::new().hash_one(())));
    let mut tries = 10;
    loop {
        tries -= 1;
        let done = fs::create_dir_all(folder)
            .and_then(|()| disk.create(&temporary, pieces, like, durability))
            .and_then(|()| disk.rename(&temporary, target));
        match done {
            // Another run that began meanwhile took it for one of a killed run: see `sweep`.
            Err(error) if error.kind() == io::ErrorKind::NotFound && tries > 0 => {}
            Err(error) => {
                let _ = disk.remove(&temporary);
                // Only what is empty goes: another run may have put its own files there.
                let _ = missing.into_iter().try_for_each(fs::remove_dir);
                return Err(error);
            }
            Ok(()) => return Ok(()),
        }
    }
}

/// Removes the temporary files that killed runs left in a folder.
pub(super) fn sweep(folder: &Path, disk: &impl Disk) {
    // A user who may write into a folder need not be allowed to list it.
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.file_name().to_str().is_some_and(|name| name.starts_with(TEMPORARY)) {
            let _ = disk.remove(&entry.path());
        }
    }
}

#[cfg(unix)]
fn keep_owner(file: &File, like: &Metadata) -> io::Result<()> {
    use std::os::unix::fs::{MetadataExt as _, fchown};
    let own = file.metadata()?;
    let other = |own: u32, like: u32| (own != like).then_some(like);
    let (user, group) = (other(own.uid(), like.uid()), other(own.gid(), like.gid()));
    if user.is_none() && group.is_none() {
        return Ok(());
    }
    fchown(file, user, group).map_err(|error| {
        io::Error::new(
            error.kind(),
            format!(
                "it belongs to user {} and group {}, and its owner cannot be kept; remove it first",
                like.uid(),
                like.gid()
            ),
        )
    })
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &Metadata) -> io::Result<()> {
    Ok(())
}

#[cfg(not(target_family = "wasm"))]
fn keep_mode(file: &File, like: &Metadata) -> io::Result<()> {
    file.set_permissions(like.permissions())
}

/// Files of a page have no mode.
#[cfg(target_family = "wasm")]
fn keep_mode(_: &File, _: &Metadata) -> io::Result<()> {
    Ok(())
}
