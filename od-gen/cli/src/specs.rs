//! Which specifications a command reads: those that the command line names, or else those of a directory.

use std::path::{Path, PathBuf};

use od_gen::source::{files_of_specifications_in, specifications_in, whole};
use od_spec::diag::{Diagnostic, codes};
use od_spec::eds::has_eds_name;
use od_spec::visible::visible;
use od_spec::xdd::has_xdd_name;

use crate::exit::USAGE;
use crate::report::{Report, shown};

/// The specifications of a command line that may name several: those it names, or all of `directory`, by name. The exit
/// code after a message when there are none.
pub(crate) fn all(named: &[PathBuf], directory: &Path, report: &Report) -> Result<Vec<PathBuf>, u8> {
    if !named.is_empty() {
        let mut wholes: Vec<PathBuf> = Vec::new();
        for path in named {
            let whole = whole_of(path, report);
            // A specification is named once, however many of its parts are.
            if whole == *path || !named.contains(&whole) && !wholes.contains(&whole) {
                wholes.push(whole);
            }
        }
        return Ok(wholes);
    }
    let found = find(directory, report)?;
    report.note(&format!("no SPEC is named: taking {} of {}", list(&found), describe(directory)));
    Ok(found)
}

/// The specification of a command line that may name one: the one it names, or the only one of `directory`. The exit code
/// after a message when there is none, or more than one to choose from.
pub(crate) fn one(named: Option<&Path>, directory: &Path, report: &Report) -> Result<PathBuf, u8> {
    if let Some(path) = named {
        return Ok(whole_of(path, report));
    }
    let found = find(directory, report)?;
    match found.as_slice() {
        [only] => {
            report.note(&format!("no SPEC is named: taking {} of {}", list(&found), describe(directory)));
            Ok(only.clone())
        }
        several => Err(refuse(
            format!("no SPEC is named, and there are {} in {}", several.len(), describe(directory)),
            format!("name one of them: {}", list(several)),
            report,
        )),
    }
}

/// The specification of a file, which may be a part of it.
fn whole_of(path: &Path, report: &Report) -> PathBuf {
    let whole = whole(path);
    if whole != path {
        report.note(&format!("{} is a part of {}: taking that", shown(path), shown(&whole)));
    }
    whole
}

/// `pitch.od.yaml` → `pitch`, `drive.EDS` → `drive`.
pub(crate) fn stem(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    if has_eds_name(&name) || has_xdd_name(&name) {
        // All these endings have four characters.
        return name[..name.len() - 4].to_owned();
    }
    let name = name.strip_suffix(".yaml").or_else(|| name.strip_suffix(".yml")).unwrap_or(&name);
    name.strip_suffix(".od").unwrap_or(name).to_owned()
}

/// The files of a command line that may name several, with parts as they are: those it names, or all of `directory`.
pub(crate) fn files(named: &[PathBuf], directory: &Path, report: &Report) -> Result<Vec<PathBuf>, u8> {
    if !named.is_empty() {
        return Ok(named.to_vec());
    }
    let found = some(files_of_specifications_in(directory), directory, report)?;
    report.note(&format!("no FILE is named: taking {} of {}", list(&found), describe(directory)));
    Ok(found)
}

/// At least one specification.
fn find(directory: &Path, report: &Report) -> Result<Vec<PathBuf>, u8> {
    some(specifications_in(directory), directory, report)
}

/// What was found in a directory, if it is not nothing.
fn some(found: std::io::Result<Vec<PathBuf>>, directory: &Path, report: &Report) -> Result<Vec<PathBuf>, u8> {
    const HELP: &str =
        "name a specification, go to the directory where yours lie, or start one with `odgen new NAME`";
    match found {
        Ok(found) if found.is_empty() => Err(refuse(
            format!("no SPEC is named, and there is no `*.od.yaml` in {}", describe(directory)),
            HELP.to_owned(),
            report,
        )),
        Ok(found) => Ok(found),
        Err(error) => Err(refuse(
            format!("no SPEC is named, and {} cannot be read: {error}", describe(directory)),
            HELP.to_owned(),
            report,
        )),
    }
}

fn refuse(message: String, help: String, report: &Report) -> u8 {
    report.refuse(Diagnostic::without_place(codes::UNREADABLE, message).help(help));
    USAGE
}

fn describe(directory: &Path) -> String {
    if directory == Path::new(".") { "the current directory".to_owned() } else { shown(directory) }
}

/// File names, as they lie in one directory.
fn list(paths: &[PathBuf]) -> String {
    let names = paths
        .iter()
        .map(|path| visible(&path.file_name().unwrap_or_default().to_string_lossy()).into_owned());
    names.collect::<Vec<_>>().join(", ")
}
