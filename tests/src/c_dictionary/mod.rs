//! Dictionaries in plain C: compiled without a warning, and asked the same as the Rust.

mod compilers;
mod emulated;
mod host;
mod protocol;
mod sdo;
mod trial;

use std::fs;
use std::path::Path;

use od_c::{self as c, Kind};
use od_gen::{Artifact, Provenance};
use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{Compiled, compile};

pub use self::compilers::{Compiler, LANGUAGE, WARNINGS, compile_header};
pub use self::emulated::emulate;
pub use self::host::{Host, compare};

/// Sources of the SDO server of the book, which answer frames.
pub const SDO_SERVER: [&str; 2] = ["tests/c/sdo_answer.c", "tests/book/sdo_server.c"];
/// Sources of the dictionary, which answer requests to it.
pub const DICTIONARY: [&str; 1] = ["tests/c/answer.c"];

pub use self::protocol::{Consistency, Recorder, Reference};
pub use self::sdo::SdoTrial;
pub use self::trial::{Exchange, Trial};
use crate::{Failure, OfWorkspace, root};

/// What was written.
#[derive(Debug)]
pub struct Written {
    /// What it was made from.
    pub system: System,
    /// The folders of the devices, with which their names begin.
    pub devices: Vec<String>,
}

/// Writes the C of a file of the workspace below a directory, with what all dictionaries include.
///
/// # Errors
/// The file cannot be read, its devices cannot be code, or a file cannot be written.
pub fn write(path: &str, directory: &Path) -> Result<Written, Failure> {
    let text = fs::read_to_string(root().join(path)).map_err(|error| format!("{path}: {error}"))?;
    write_text(path, text, directory)
}

/// [`write()`], of a text that no file has.
///
/// # Errors
/// As [`write()`].
pub fn write_text(path: &str, text: String, directory: &Path) -> Result<Written, Failure> {
    let mut sources = SourceMap::new();
    let root = sources.add(path, text);
    let Compiled { system, diagnostics, .. } = compile(&mut sources, root, &mut OfWorkspace);
    let Some(system) = system else {
        return Err(render(&diagnostics, &sources, Format::Human, false).into());
    };
    let mut found = Diagnostics::new();
    let set = c::artifacts(
        &system,
        system.devices.iter(),
        &Provenance::of(&sources),
        &Kind::Plain.into(),
        &mut found,
    );
    if found.has_errors() {
        return Err(render(&found, &sources, Format::Human, false).into());
    }
    let folder = |artifact: &Artifact| {
        let rest = artifact.path.strip_prefix("c/")?.strip_suffix("_od.c")?;
        rest.split_once('/').map(|(folder, _)| folder.to_owned())
    };
    let devices = set.iter().filter_map(folder).collect();
    for Artifact { path, bytes, .. } in set.into_iter().chain(c::shared(&[Kind::Plain])) {
        let target = directory.join(path);
        if let Some(parent) = target.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::write(target, bytes)?;
    }
    Ok(Written { system, devices })
}
