//! What the project's tasks and its cross-crate tests share.

pub mod access_cases;
pub mod foreign;
pub mod fuzz;
pub mod generate;

use std::path::{Path, PathBuf};

use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, compile};

/// Why a task failed.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;

/// The root of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map_or_else(PathBuf::new, Path::to_owned)
}

/// Compiles a file of the workspace that is expected to be without any message.
///
/// # Errors
/// The file cannot be read, or the compiler has something to say.
pub fn compile_clean(path: &str) -> Result<System, Failure> {
    compile_with_sources(path).map(|(system, _)| system)
}

/// [`compile_clean`], with the texts that were read.
///
/// # Errors
/// As [`compile_clean`].
pub fn compile_with_sources(path: &str) -> Result<(System, SourceMap), Failure> {
    let text = std::fs::read_to_string(root().join(path)).map_err(|error| format!("{path}: {error}"))?;
    let mut sources = SourceMap::new();
    let root = sources.add(path, text);
    let Compiled { system, diagnostics, .. } = compile(&mut sources, root, &mut NoFiles);
    match system {
        Some(system) if diagnostics.is_empty() => Ok((system, sources)),
        _ => Err(render(&diagnostics, &sources, Format::Human, false).into()),
    }
}
