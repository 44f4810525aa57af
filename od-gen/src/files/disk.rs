//! What is done to the disk, one step each: so that a test can stop the process between any two of them.

use std::fs::{self, File, Metadata};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

/// The steps that change a disk.
pub(super) trait Disk {
    /// Writes a file that is on the disk when this returns, with mode and owner of an old one.
    fn write(&self, path: &Path, pieces: &[&[u8]], like: Option<&Metadata>) -> io::Result<()>;
    /// Writes files; all are on the disk when this returns. On an error, which is that of a position, some may be.
    fn write_each(&self, files: &[New<'_>]) -> Result<(), (usize, io::Error)> {
        files.iter().enumerate().try_for_each(|(at, new)| {
            self.write(&new.path, new.pieces, new.like).map_err(|error| (at, error))
        })
    }
    /// Brings the names of directories to the disk.
    fn settle_each(&self, directories: &[PathBuf]) -> Result<(), (usize, io::Error)> {
        let settled =
            |(at, directory): (usize, &PathBuf)| self.settle(directory).map_err(|error| (at, error));
        directories.iter().enumerate().try_for_each(settled)
    }
    /// Gives a file a second name.
    fn keep(&self, file: &Path, name: &Path) -> io::Result<()>;
    /// Gives a file another name, which may be taken.
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;
    /// Removes a file; one that is not there is fine.
    fn remove(&self, path: &Path) -> io::Result<()>;
    /// Brings the names of a directory to the disk.
    fn settle(&self, directory: &Path) -> io::Result<()>;
}

/// A file to be written.
pub(super) struct New<'a> {
    pub path: PathBuf,
    pub pieces: &'a [&'a [u8]],
    /// The old one.
    pub like: Option<&'a Metadata>,
}

/// The disk of this machine.
pub(super) struct Real;

/// So many files are brought to the disk at the same time. It waits for most of the time, and takes what comes together at once.
const AT_ONCE: usize = 8;

/// Does something with each item, several at a time; the first error by position.
fn at_once<T: Sync>(
    items: &[T],
    act: impl Fn(&T) -> io::Result<()> + Sync,
) -> Result<(), (usize, io::Error)> {
    let next = AtomicUsize::new(0);
    let failed = AtomicBool::new(false);
    let worker = || {
        while !failed.load(Ordering::Relaxed) {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(at) else { break };
            if let Err(error) = act(item) {
                failed.store(true, Ordering::Relaxed);
                return Some((at, error));
            }
        }
        None
    };
    let errors: Vec<(usize, io::Error)> = thread::scope(|scope| {
        let workers: Vec<_> = (0..AT_ONCE.min(items.len())).map(|_| scope.spawn(worker)).collect();
        // A worker does not panic; one that did has not said that its files are there.
        let lost = || Some((0, io::Error::other("a thread was lost")));
        workers.into_iter().filter_map(|worker| worker.join().unwrap_or_else(|_| lost())).collect()
    });
    errors.into_iter().min_by_key(|(at, _)| *at).map_or(Ok(()), Err)
}

impl Disk for Real {
    fn write(&self, path: &Path, pieces: &[&[u8]], like: Option<&Metadata>) -> io::Result<()> {
        written(path, pieces, like)?.sync_all()
    }

    fn write_each(&self, files: &[New<'_>]) -> Result<(), (usize, io::Error)> {
        at_once(files, |new| self.write(&new.path, new.pieces, new.like))
    }

    fn settle_each(&self, directories: &[PathBuf]) -> Result<(), (usize, io::Error)> {
        at_once(directories, |directory| self.settle(directory))
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

/// The disk of this machine, and who wants to know how many of the files are on it.
pub(super) struct Watched<'a> {
    /// Gets how many are, of how many.
    pub watch: &'a Watch<'a>,
}

/// Is told how many files are written, of how many; by several threads.
pub type Watch<'a> = dyn Fn(usize, usize) + Sync + 'a;

impl Disk for Watched<'_> {
    fn write(&self, path: &Path, pieces: &[&[u8]], like: Option<&Metadata>) -> io::Result<()> {
        Real.write(path, pieces, like)
    }

    fn write_each(&self, files: &[New<'_>]) -> Result<(), (usize, io::Error)> {
        let written = AtomicUsize::new(0);
        at_once(files, |new| {
            Real.write(&new.path, new.pieces, new.like)?;
            (self.watch)(written.fetch_add(1, Ordering::Relaxed) + 1, files.len());
            Ok(())
        })
    }

    fn settle_each(&self, directories: &[PathBuf]) -> Result<(), (usize, io::Error)> {
        Real.settle_each(directories)
    }

    fn keep(&self, file: &Path, name: &Path) -> io::Result<()> {
        Real.keep(file, name)
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        Real.rename(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        Real.remove(path)
    }

    fn settle(&self, directory: &Path) -> io::Result<()> {
        Real.settle(directory)
    }
}

/// A file with its contents, which need not be on the disk yet.
pub(super) fn written(path: &Path, pieces: &[&[u8]], like: Option<&Metadata>) -> io::Result<File> {
    // What a killed process left there may be a link, or write-protected.
    Real.remove(path)?;
    let mut file = File::create_new(path)?;
    if let Some(like) = like {
        keep_owner(&file, like)?;
        file.set_permissions(like.permissions())?;
    }
    match pieces {
        [piece] => file.write_all(piece)?,
        // One call of the system instead of one for each of a hundred pieces.
        pieces => file.write_all(&pieces.concat())?,
    }
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
