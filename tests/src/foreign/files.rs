//! Which files describe devices.

use std::path::{Path, PathBuf};

use crate::Failure;

/// The endings of EDS and DCF files.
pub const EDS: &[&str] = &["eds", "dcf"];
/// The endings of XDD and XDC files.
pub const XDD: &[&str] = &["xdd", "xdc"];

/// Adds the path of every file below a directory that has one of these endings.
///
/// # Errors
/// A directory that cannot be read.
pub fn find(directory: &Path, endings: &[&str], paths: &mut Vec<PathBuf>) -> Result<(), Failure> {
    let entries =
        std::fs::read_dir(directory).map_err(|error| format!("{}: {error}", directory.display()))?;
    for entry in entries {
        let path = entry?.path();
        let is_wanted =
            path.extension().is_some_and(|own| endings.iter().any(|ending| own.eq_ignore_ascii_case(ending)));
        if path.is_dir() {
            find(&path, endings, paths)?;
        } else if is_wanted {
            paths.push(path);
        }
    }
    Ok(())
}

/// Whether the name is that of an XDD or XDC.
pub(super) fn is_xdd(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|own| XDD.iter().any(|ending| own.eq_ignore_ascii_case(ending)))
}
