//! What there is to check: files, what lies in directories, standard input.

use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use od_gen::source::whole;
use od_spec::diag::{Diagnostic, codes};
use od_spec::eds::has_eds_name;
use od_spec::file_name;
use od_spec::xdd::has_xdd_name;

use super::args::{CheckArgs, CheckFormat};
use crate::report::Report;
use crate::specs;

/// Something to check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Input {
    /// A file.
    File(PathBuf),
    /// Standard input, under a name.
    Stdin(String),
    /// A directory in which nothing is found.
    Missing { name: String, diagnostic: Diagnostic },
}

impl Input {
    /// What messages call it.
    pub(super) fn name(&self) -> String {
        match self {
            Input::File(path) => file_name::shown(path),
            Input::Stdin(name) | Input::Missing { name, .. } => name.clone(),
        }
    }
}

/// What the command line names, in its order and each once; what lies in a directory ordered by path. The exit code after a
/// message when nothing is named and there is nothing to take.
pub(super) fn gather(
    args: &CheckArgs,
    format: CheckFormat,
    directory: &Path,
    report: &Report,
) -> Result<Vec<Input>, u8> {
    let named = specs::all(&args.files, directory, report)?;
    let mut inputs = Vec::new();
    for path in named {
        let found = if path == Path::new("-") {
            vec![Input::Stdin(args.stdin_name.clone())]
        } else if path.is_dir() {
            in_directory(&path)
        } else {
            vec![Input::File(path)]
        };
        for input in found {
            let input = match input {
                Input::File(path) => Input::File(named_for(format, &whole(&path))),
                input @ (Input::Stdin(_) | Input::Missing { .. }) => input,
            };
            if !inputs.contains(&input) {
                inputs.push(input);
            }
        }
    }
    Ok(inputs)
}

/// The path as a user would type it; for services, which know files by it, from where the command runs.
fn named_for(format: CheckFormat, path: &Path) -> PathBuf {
    let here = match format {
        CheckFormat::Sarif | CheckFormat::Github => std::env::current_dir().ok(),
        CheckFormat::Human | CheckFormat::Short | CheckFormat::Json => None,
    };
    let below = here.and_then(|here| path.strip_prefix(here).ok());
    below.unwrap_or(path).components().filter(|part| *part != Component::CurDir).collect()
}

/// Everything below a directory that is named like something to check.
fn in_directory(directory: &Path) -> Vec<Input> {
    let mut found = Vec::new();
    let mut inputs = Vec::new();
    if let Err((path, error)) = walk(directory, &mut found) {
        inputs.push(missing(
            directory,
            format!("cannot read {}: {error}", file_name::shown(path)),
            "check its permissions",
        ));
    }
    found.sort();
    if found.is_empty() && inputs.is_empty() {
        let message = format!(
            "there is no `*.od.yaml`, `*.eds`, `*.dcf`, `*.xdd` or `*.xdc` in {}",
            file_name::shown(directory)
        );
        inputs.push(missing(directory, message, "name files of other names one by one"));
    }
    inputs.extend(found.into_iter().map(Input::File));
    inputs
}

fn missing(directory: &Path, message: String, help: &str) -> Input {
    let diagnostic = Diagnostic::without_place(codes::UNREADABLE, message).help(help);
    Input::Missing { name: file_name::shown(directory), diagnostic }
}

/// Adds the files of a directory and of those in it. What is hidden is left out, and a link to a directory is not followed: it may
/// lead back.
fn walk(directory: &Path, found: &mut Vec<PathBuf>) -> Result<(), (PathBuf, io::Error)> {
    let of_directory = |error| (directory.to_owned(), error);
    for entry in fs::read_dir(directory).map_err(of_directory)? {
        let entry = entry.map_err(of_directory)?;
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        if name.starts_with('.') {
            continue;
        }
        if entry.file_type().map_err(of_directory)?.is_dir() {
            walk(&path, found)?;
        } else if is_named_so(&name) && path.is_file() {
            found.push(path);
        }
    }
    Ok(())
}

fn is_named_so(name: &str) -> bool {
    has_eds_name(name) || has_xdd_name(name) || name.to_ascii_lowercase().ends_with(".od.yaml")
}
