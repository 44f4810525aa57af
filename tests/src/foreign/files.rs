//! Which files are EDS and DCF files.

use std::path::{Path, PathBuf};

use crate::Failure;

/// Adds the path of every EDS and DCF below a directory.
///
/// # Errors
/// A directory that cannot be read.
pub fn find(directory: &Path, paths: &mut Vec<PathBuf>) -> Result<(), Failure> {
    let entries =
        std::fs::read_dir(directory).map_err(|error| format!("{}: {error}", directory.display()))?;
    for entry in entries {
        let path = entry?.path();
        let is_eds = path
            .extension()
            .is_some_and(|ending| ending.eq_ignore_ascii_case("eds") || ending.eq_ignore_ascii_case("dcf"));
        if path.is_dir() {
            find(&path, paths)?;
        } else if is_eds {
            paths.push(path);
        }
    }
    Ok(())
}
