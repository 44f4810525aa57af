//! Copies of what comes with the compiler as files: every editor can open a file, and few can open anything else.
//!
//! They lie in the user's folder for what can be made again, in one of the version of the program, and are written when they
//! are first named. Without such a folder there are no copies.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};

use lsp_types::Uri;
use od_gen::Artifact;
use od_gen::files::{Existing, write_set};
use od_spec::LIBRARIES;
use od_spec::diag::Code;

use super::uri::uri_of;

/// The folder of the copies; empty until a process wants some.
static FOLDER: OnceLock<PathBuf> = OnceLock::new();

/// From now on there are copies, in the user's folder for what can be made again.
pub(super) fn make_them() {
    let of = |name: &str| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let in_home = if cfg!(target_os = "macos") { "Library/Caches" } else { ".cache" };
    let home = || Some(of("HOME")?.join(in_home));
    let folder = of("XDG_CACHE_HOME").or_else(|| of("LOCALAPPDATA")).or_else(home);
    if let Some(folder) = folder {
        FOLDER.get_or_init(|| folder.join("odgen").join(env!("CARGO_PKG_VERSION")));
    }
}

/// The built-in library that a file is a copy of.
pub(super) fn library_at(path: &Path) -> Option<&'static str> {
    let folder = FOLDER.get()?;
    LIBRARIES.iter().map(|(name, _)| *name).find(|name| folder.join(library_file(name)) == path)
}

fn library_file(name: &str) -> String {
    format!("libraries/{name}.od.yaml")
}

/// The URI of the copy of a library.
pub(super) fn library(name: &str) -> Option<Uri> {
    let (_, text) = LIBRARIES.iter().find(|(known, _)| *known == name)?;
    copy(library_file(name), || (*text).to_owned())
}

/// The URI of a file with what `odgen explain` says about a code.
pub(super) fn explained(code: &Code) -> Option<Uri> {
    copy(format!("messages/{code}.md"), || format!("# {}", od_reference::explained(code)))
}

/// The files that were looked at, each with its URI if it is there.
static LOOKED_AT: Mutex<BTreeMap<String, Option<Uri>>> = Mutex::new(BTreeMap::new());

/// The URI of a file of the folder, which is written the first time.
fn copy(name: String, text: impl FnOnce() -> String) -> Option<Uri> {
    let mut looked_at = LOOKED_AT.lock().unwrap_or_else(PoisonError::into_inner);
    looked_at.entry(name).or_insert_with_key(|name| written(name, &text())).clone()
}

/// Writes a file of the folder, unless it is there as it should be.
fn written(name: &str, text: &str) -> Option<Uri> {
    let path = FOLDER.get()?.join(name);
    if fs::read(&path).ok().is_none_or(|bytes| bytes != text.as_bytes()) {
        let file = path.file_name()?.to_str()?.to_owned();
        let artifact = Artifact { path: file, bytes: text.as_bytes().to_vec(), purpose: String::new() };
        write_set(path.parent()?, &[artifact], Existing::Any).ok()?;
        // What is changed there has no effect; editors say so of a file that cannot be written.
        let mut permissions = fs::metadata(&path).ok()?.permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&path, permissions).ok()?;
    }
    uri_of(&path)
}
