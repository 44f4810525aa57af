//! Everything that is generated and checked in.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use od_documents::{self as docs, Templates};
use od_formats::{Selection, artifacts};
use od_gen::Artifact;
use od_gen::files::{left_over, remove};
use od_gen::rust::{self, Provenance};
use od_reference::Page;
use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::yaml::packed::pack;
use od_spec::yaml::parse;

use crate::examples::pages;
use crate::{Failure, compile_with_sources, root};

/// The shipped specifications.
pub const SPECS: [&str; 2] = ["fullmo-drive", "pitch-control-system"];
/// The command that brings a stale file up to date.
const COMMAND: &str = "cargo xtask generate";

/// A generated file: path below the root, and contents.
pub type GeneratedFile = (String, Vec<u8>);

/// All generated files.
///
/// # Errors
/// A specification does not compile, or a file that examples are put into cannot be read.
pub fn all() -> Result<Vec<GeneratedFile>, Failure> {
    Ok(shipped()?.into_iter().chain(texts()?).collect())
}

/// What the shipped specifications become: what `odgen build --node 1 --rust --docs md` writes.
fn shipped() -> Result<Vec<GeneratedFile>, Failure> {
    let mut files = Vec::new();
    for stem in SPECS {
        let (system, sources) = compile_with_sources(&format!("od-spec/devices/{stem}.od.yaml"))?;
        let set = artifacts(&system, stem, &Selection { node: Some(1), ..Selection::default() });
        let set = set.into_iter().chain(modules(&system, &sources)?);
        let set = set.chain(documents(&system, stem, docs::Format::Markdown)?);
        files.extend(set.map(|Artifact { path, bytes, .. }| (format!("generated/{path}"), bytes)));
    }
    Ok(files)
}

/// What is generated from the compiler itself, and the pages with examples.
///
/// # Errors
/// As [`all`].
pub fn texts() -> Result<Vec<GeneratedFile>, Failure> {
    let schema = ("od-spec/schema/od.schema.json".to_owned(), od_reference::json_schema().into_bytes());
    Ok([schema].into_iter().chain(reference_pages()).chain(pages()?).chain(trees()?).collect())
}

/// The texts that are part of the compiler, with the files of their packed trees.
const TREES: [(&str, &str); 5] = [
    ("od-spec/profiles/cia301.od.yaml", "od-spec/profiles/cia301.tree"),
    ("od-spec/profiles/cia302.od.yaml", "od-spec/profiles/cia302.tree"),
    ("od-spec/profiles/cia401.od.yaml", "od-spec/profiles/cia401.tree"),
    ("od-spec/profiles/cia402.od.yaml", "od-spec/profiles/cia402.tree"),
    ("od-spec/src/standard/runs.od.yaml", "od-spec/src/standard/runs.tree"),
];

fn trees() -> Result<Vec<GeneratedFile>, Failure> {
    let tree = |(text, packed): &(&str, &str)| {
        let mut sources = SourceMap::new();
        let file = sources.add(*text, fs::read_to_string(root().join(text))?);
        let source = sources.file(file);
        let tree = parse(file, source, &mut Diagnostics::new());
        let bytes = tree.and_then(|tree| pack(source.text(), &tree)).ok_or(format!("{text} is broken"))?;
        Ok(((*packed).to_owned(), bytes))
    };
    TREES.iter().map(tree).collect()
}

/// The folders of the book that contain nothing but generated pages.
const LANGUAGE: &str = "docs/book/language";
const MESSAGES: &str = "docs/book/messages";

/// The pages of the book that consist of what the compiler knows.
fn reference_pages() -> impl Iterator<Item = GeneratedFile> {
    let folders = [(LANGUAGE, od_reference::language_pages()), (MESSAGES, od_reference::message_pages())];
    folders.into_iter().flat_map(|(folder, pages)| {
        pages.into_iter().map(move |Page { file, text }| (format!("{folder}/{file}"), text.into_bytes()))
    })
}

/// The pages below a root that nothing makes any more, such as that of a code that is gone.
///
/// # Errors
/// A folder cannot be read.
pub fn left_pages(root: &Path) -> Result<Vec<String>, Failure> {
    let made: BTreeSet<String> = reference_pages().map(|(path, _)| path).collect();
    let mut left = Vec::new();
    for folder in [LANGUAGE, MESSAGES] {
        for entry in fs::read_dir(root.join(folder))? {
            let path = format!("{folder}/{}", entry?.file_name().to_string_lossy());
            if !made.contains(&path) {
                left.push(path);
            }
        }
    }
    left.sort();
    Ok(left)
}

/// The reference documentation of a specification.
pub(crate) fn documents(system: &System, stem: &str, format: docs::Format) -> Result<Vec<Artifact>, Failure> {
    let templates = [Templates::new(Some(format), &[])?];
    Ok(docs::artifacts(system, "docs/", stem, &docs::options(system, &[], None), &templates)?)
}

/// The Rust modules of a specification.
fn modules(system: &System, sources: &SourceMap) -> Result<Vec<Artifact>, Failure> {
    let mut diagnostics = Diagnostics::new();
    let modules = rust::artifacts(system, system.devices.iter(), &Provenance::of(sources), &mut diagnostics);
    if diagnostics.is_empty() {
        Ok(modules)
    } else {
        Err(render(&diagnostics, sources, Format::Human, false).into())
    }
}

/// Writes what changed; returns for each file whether it did.
///
/// # Errors
/// As [`all`], or a file cannot be written.
pub fn write_all() -> Result<Vec<(String, bool)>, Failure> {
    let mut report = Vec::new();
    for (path, bytes) in all()? {
        let target = root().join(&path);
        let changed = !fs::read(&target).is_ok_and(|old| old == bytes);
        if changed {
            if let Some(parent) = target.parent() {
                fs::create_dir_all(parent)?;
            }
            fs::write(&target, bytes)?;
        }
        report.push((path, changed));
    }
    Ok(report)
}

/// Generated files that nothing makes any more, below the root.
///
/// # Errors
/// As [`all`], or a file cannot be read.
pub fn left() -> Result<Vec<String>, Failure> {
    let below = |path: String| format!("generated/{path}");
    let left = left_files()?.into_iter().map(below);
    Ok(left.chain(left_pages(&root())?).collect())
}

/// Those below `generated/`.
fn left_files() -> Result<Vec<String>, Failure> {
    let files = shipped()?.into_iter().map(|(path, bytes)| {
        let path = path.trim_start_matches("generated/").to_owned();
        Artifact { path, bytes, purpose: String::new() }
    });
    Ok(left_over(&root().join("generated"), &files.collect::<Vec<_>>())?)
}

/// Removes the files of [`left`], and returns them.
///
/// # Errors
/// As [`left`], or a file cannot be removed.
pub fn prune() -> Result<Vec<String>, Failure> {
    let left = left()?;
    remove(&root().join("generated"), &left_files()?)?;
    for page in left_pages(&root())? {
        fs::remove_file(root().join(page))?;
    }
    Ok(left)
}

/// The first of these files that is not current, with its first differing line.
pub fn first_difference(files: Vec<GeneratedFile>) -> Option<String> {
    for (path, bytes) in files {
        let old = fs::read(root().join(&path)).unwrap_or_default();
        if old != bytes {
            let (Ok(old), Ok(new)) = (str::from_utf8(&old), str::from_utf8(&bytes)) else {
                return Some(format!("{path} is not current: run `{COMMAND}`"));
            };
            let line = old.lines().zip(new.lines()).take_while(|(old, new)| old == new).count();
            return Some(format!(
                "{path} is not current from line {}:\n  - {}\n  + {}\nrun `{COMMAND}`",
                line + 1,
                old.lines().nth(line).unwrap_or("(end of file)"),
                new.lines().nth(line).unwrap_or("(end of file)"),
            ));
        }
    }
    None
}
