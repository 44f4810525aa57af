//! What is done to the disk, one step each: so that a test can stop the process between any two of them.

use std::fs::{self, File, Metadata};
use std::io::{self, Write as _};
use std::path::Path;

/// The steps that change a disk.
pub(super) trait Disk {
    /// Writes a file that is on the disk when this returns, with mode and owner of an old one.
    fn write(&self, path: &Path, bytes: &[u8], like: Option<&Metadata>) -> io::Result<()>;
    /// Gives a file a second name.
    fn keep(&self, file: &Path, name: &Path) -> io::Result<()>;
    /// Gives a file another name, which may be taken.
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;
    /// Removes a file; one that is not there is fine.
    fn remove(&self, path: &Path) -> io::Result<()>;
    /// Brings the names of a directory to the disk.
    fn settle(&self, directory: &Path) -> io::Result<()>;
}

/// The disk of this machine.
pub(super) struct Real;

impl Disk for Real {
    fn write(&self, path: &Path, bytes: &[u8], like: Option<&Metadata>) -> io::Result<()> {
        written(path, bytes, like)?.sync_all()
    }

    fn keep(&self, file: &Path, name: &Path) -> io::Result<()> {
        self.remove(name)?;
        // A second name costs nothing; where links do not exist, a copy does.
        fs::hard_link(file, name).or_else(|_| fs::copy(file, name).map(drop))
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

    #[cfg(unix)]
    fn settle(&self, directory: &Path) -> io::Result<()> {
        match File::open(directory)?.sync_all() {
            // Some file systems have nothing to do here, and say so as an error.
            Err(error)
                if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) =>
            {
                Ok(())
            }
            result => result,
        }
    }

    #[cfg(not(unix))]
    fn settle(&self, _: &Path) -> io::Result<()> {
        Ok(())
    }
}

/// A file with its contents, which need not be on the disk yet.
pub(super) fn written(path: &Path, bytes: &[u8], like: Option<&Metadata>) -> io::Result<File> {
    // What a killed process left there may be a link, or write-protected.
    Real.remove(path)?;
    let mut file = File::create_new(path)?;
    if let Some(like) = like {
        keep_owner(&file, like)?;
        file.set_permissions(like.permissions())?;
    }
    file.write_all(bytes)?;
    Ok(file)
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
