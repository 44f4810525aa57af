//! Writing files: all of a set or none, and nothing that would not change.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use crate::artifact::Artifact;

/// What happened to one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It was new or had other contents.
    Changed,
    /// It had these contents already and was not touched.
    Unchanged,
}

/// A file that could not be written; no file of the set was changed.
#[derive(Debug)]
#[non_exhaustive]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// Why.
    pub error: io::Error,
}

impl std::fmt::Display for WriteError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "cannot write {}: {}", self.path.display(), self.error)
    }
}

impl std::error::Error for WriteError {}

/// A file that waits beside its target to be renamed.
struct Staged {
    target: PathBuf,
    new: PathBuf,
    /// The old file under another name, so that it can come back.
    old: Option<PathBuf>,
}

/// Writes the files below `directory`. Each is first written completely under a temporary name beside its target; only
/// when all of them are on the disk, they are renamed. On an error every file is as it was before; directories that were
/// made for the files stay.
///
/// # Errors
/// The first file that cannot be written: its directory cannot be made, a directory is in its way, the disk is full or
/// write-protected.
pub fn write_all(directory: &Path, artifacts: &[Artifact]) -> Result<Vec<Outcome>, WriteError> {
    write_with(directory, artifacts, |from, to| fs::rename(from, to))
}

fn write_with(
    directory: &Path,
    artifacts: &[Artifact],
    rename: impl Fn(&Path, &Path) -> io::Result<()>,
) -> Result<Vec<Outcome>, WriteError> {
    let mut staged: Vec<Staged> = Vec::new();
    let mut outcomes = Vec::new();
    for artifact in artifacts {
        let target = directory.join(&artifact.path);
        if fs::read(&target).is_ok_and(|bytes| bytes == artifact.bytes) {
            outcomes.push(Outcome::Unchanged);
            continue;
        }
        match stage(&target, &artifact.bytes) {
            Ok(one) => staged.push(one),
            Err(error) => {
                discard(&staged);
                return Err(WriteError { path: target, error });
            }
        }
        outcomes.push(Outcome::Changed);
    }
    for (at, one) in staged.iter().enumerate() {
        if let Err(error) = rename(&one.new, &one.target) {
            roll_back(&staged[..at]);
            discard(&staged);
            return Err(WriteError { path: one.target.clone(), error });
        }
    }
    discard(&staged);
    Ok(outcomes)
}

fn stage(target: &Path, bytes: &[u8]) -> io::Result<Staged> {
    if target.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "a directory of this name is in the way"));
    }
    if let Some(parent) = target.parent() {
        fs::create_dir_all(parent)?;
    }
    let beside = |suffix: &str| {
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        target.with_file_name(format!(".{name}.{suffix}.{}", std::process::id()))
    };
    let (new, old) = (beside("new"), beside("old"));
    let written =
        fs::File::create(&new).and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()));
    let kept = written.and_then(|()| {
        if !target.exists() {
            return Ok(None);
        }
        // A second name for the old contents costs nothing; where links do not exist, a copy does.
        fs::hard_link(target, &old).or_else(|_| fs::copy(target, &old).map(drop))?;
        Ok(Some(old.clone()))
    });
    match kept {
        Ok(old) => Ok(Staged { target: target.to_owned(), new, old }),
        Err(error) => {
            let _ = fs::remove_file(&new);
            let _ = fs::remove_file(&old);
            Err(error)
        }
    }
}

/// Brings the old files back after a rename failed.
fn roll_back(done: &[Staged]) {
    for one in done {
        let _ = match &one.old {
            Some(old) => fs::rename(old, &one.target),
            None => fs::remove_file(&one.target),
        };
    }
}

/// Removes what is left of temporary files.
fn discard(staged: &[Staged]) {
    for one in staged {
        let _ = fs::remove_file(&one.new);
        if let Some(old) = &one.old {
            let _ = fs::remove_file(old);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn artifact(path: &str, text: &str) -> Artifact {
        Artifact { path: path.to_owned(), bytes: text.as_bytes().to_vec(), purpose: String::new() }
    }

    fn names(directory: &Path) -> Vec<String> {
        let entries = fs::read_dir(directory).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    struct Scratch(PathBuf);
    impl Scratch {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("odgen-files-{name}-{}", std::process::id()));
            let _ = fs::remove_dir_all(&path);
            fs::create_dir_all(&path).unwrap();
            Self(path)
        }
    }
    impl Drop for Scratch {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn files_are_written_once_and_left_alone_when_equal() {
        let scratch = Scratch::new("equal");
        let set = [artifact("a", "1"), artifact("sub/b", "2")];
        assert_eq!(write_all(&scratch.0, &set).unwrap(), [Outcome::Changed, Outcome::Changed]);
        assert_eq!(write_all(&scratch.0, &set).unwrap(), [Outcome::Unchanged, Outcome::Unchanged]);
        assert_eq!(names(&scratch.0), ["a", "sub"]);
    }

    #[test]
    fn one_failure_leaves_every_old_file_as_it_was() {
        let scratch = Scratch::new("failure");
        write_all(&scratch.0, &[artifact("a", "old")]).unwrap();
        fs::create_dir(scratch.0.join("b")).unwrap();
        let error = write_all(&scratch.0, &[artifact("a", "new"), artifact("b", "new")]).unwrap_err();
        assert!(error.path.ends_with("b"), "{error}");
        assert_eq!(fs::read_to_string(scratch.0.join("a")).unwrap(), "old");
        assert_eq!(names(&scratch.0), ["a", "b"]);
    }

    #[test]
    fn a_failing_rename_brings_the_old_files_back() {
        let scratch = Scratch::new("rename");
        write_all(&scratch.0, &[artifact("a", "old")]).unwrap();
        let refuse_c = |from: &Path, to: &Path| {
            if to.ends_with("c") { Err(io::Error::other("the disk is gone")) } else { fs::rename(from, to) }
        };
        let set = [artifact("a", "new"), artifact("b", "new"), artifact("c", "new")];
        let error = write_with(&scratch.0, &set, refuse_c).unwrap_err();
        assert!(error.path.ends_with("c"), "{error}");
        assert_eq!(fs::read_to_string(scratch.0.join("a")).unwrap(), "old");
        assert_eq!(names(&scratch.0), ["a"]);
    }
}
