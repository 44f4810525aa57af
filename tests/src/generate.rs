//! Everything that is generated and checked in.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use od_c as c;
use od_diff::{Question, Scope, compare, human};
use od_documents::{self as docs, Templates};
use od_formats::{Selection, artifacts, dbc};
use od_gen::Artifact;
use od_gen::files::{left_over, remove};
use od_gen::rust::{self, Provenance};
use od_reference::Page;
use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, compile};
use od_st as st;

use crate::editor::{hover, mistyped};
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
        let set = set.chain(documents(&system, stem)?);
        files.extend(set.map(|Artifact { path, bytes, .. }| (format!("generated/{path}"), bytes)));
    }
    Ok(files)
}

/// What is generated from the compiler itself, and the README.
///
/// # Errors
/// As [`all`].
pub fn texts() -> Result<Vec<GeneratedFile>, Failure> {
    Ok(vec![
        ("od-spec/schema/od.schema.json".to_owned(), od_reference::json_schema().into_bytes()),
        ("README.md".to_owned(), readme()?.into_bytes()),
    ]
    .into_iter()
    .chain(pages())
    .collect())
}

/// The folders of the book that contain nothing but generated pages.
const LANGUAGE: &str = "docs/book/language";
const MESSAGES: &str = "docs/book/messages";

/// The generated pages of the book.
fn pages() -> impl Iterator<Item = GeneratedFile> {
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
    let made: BTreeSet<String> = pages().map(|(path, _)| path).collect();
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

/// The reference documentation of a specification, as Markdown.
fn documents(system: &System, stem: &str) -> Result<Vec<Artifact>, Failure> {
    let templates = [Templates::new(Some(docs::Format::Markdown), &[])?];
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

/// Writes what changed; tells for each file whether it did.
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
            let (old, new) = (String::from_utf8_lossy(&old), String::from_utf8_lossy(&bytes));
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

/// The README with its examples made anew.
fn readme() -> Result<String, Failure> {
    let path = "tests/readme/valve.od.yaml";
    let spec = fs::read_to_string(root().join(path))?;
    let (system, sources) = compile_with_sources(path)?;
    let device = system.devices.first().ok_or("the example has no device")?;
    let eds = String::from_utf8(od_formats::eds::write_eds(&system, device))?.replace("\r\n", "\n");
    let sections = ["2000", "2001", "1600sub1", "1800sub1"];
    let excerpt: Vec<&str> = eds
        .split("\n\n")
        .filter(|part| sections.iter().any(|name| part.lines().any(|line| line == format!("[{name}]"))))
        .map(str::trim_end)
        .collect();
    let firmware = fs::read_to_string(root().join("tests/readme/firmware.rs"))?.replace("readme/", "");
    let mut diagnostics = Diagnostics::new();
    let module = rust::file(&system, device, &Provenance::of(&sources), &mut diagnostics)
        .ok_or("the example has no Rust module")?;
    let api: Vec<&str> = ["set_pressure", "actual_pressure"]
        .into_iter()
        .map(|name| function(&module, name).ok_or("the example lacks an accessor"))
        .collect::<Result<_, _>>()?;
    let text = fs::read_to_string(root().join("README.md"))?;
    let text = block(&text, "spec", &format!("```yaml\n{spec}```"))?;
    let text = block(&text, "eds", &format!("```ini\n{}\n```", excerpt.join("\n\n")))?;
    let text =
        block(&text, "api", &format!("```rust\nimpl Valve {{\n{}\n    // …\n}}\n```", api.join("\n\n")))?;
    let drive = fs::read_to_string(root().join("tests/readme/lift.od.yaml"))?;
    let text = block(&text, "drive", &format!("```yaml\n{drive}```"))?;
    let text = block(&text, "firmware", &format!("```rust\n{firmware}```"))?;
    let text = block(&text, "diff", &format!("```text\n{}```", changes(&spec, &system)?))?;
    let text = block(&text, "canopennode", &format!("```c\n{}\n```", stack(&system, &sources)?))?;
    let c = fs::read_to_string(root().join("tests/readme/valve.c"))?;
    let text = block(&text, "c", &format!("```c\n{c}```"))?;
    let entry = c_entry(&system, &Provenance::of(&sources))?;
    let text = block(&text, "c-entry", &format!("```c\n{entry}\n```"))?;
    let text = block(&text, "dbc", &format!("```text\n{}\n```", frames(&system)))?;
    let text = block(&text, "st", &format!("```text\n{}\n```", structured_text(&system)?))?;
    let in_editor = [mistyped(&spec, "decibar, access", "decibr, access")?, hover(&spec, "set pressure")?];
    let text = block(&text, "editor", &format!("```text\n{}\n```", in_editor.join("\n\n")))?;
    block(&text, "docs", &tables(&system)?)
}

/// What the files for CANopenNode say of an entry of the example.
fn stack(system: &System, sources: &SourceMap) -> Result<String, Failure> {
    let mut diagnostics = Diagnostics::new();
    let provenance = Provenance::of(sources);
    let set =
        c::artifacts(system, system.devices.iter(), &provenance, &[c::Kind::CanopenNode], &mut diagnostics);
    let lines = |name: &str, begin: &str, end: &str| -> Result<String, Failure> {
        let file = set.iter().find(|file| file.path.ends_with(name)).ok_or_else(|| format!("no {name}"))?;
        let text = std::str::from_utf8(&file.bytes)?;
        let from = text.find(begin).ok_or_else(|| format!("{name} lacks `{begin}`"))?;
        let to = text[from..].find(end).ok_or_else(|| format!("{name} lacks `{end}`"))? + from + end.len();
        let start = text[..from].rfind('\n').map_or(0, |at| at + 1);
        Ok(text[start..to].to_owned())
    };
    Ok([
        lines("/OD.h", "/**\n     * 2000h", "x2000_setPressure;")?,
        lines("/OD.c", ".o_2000_setPressure = {", "},")?,
        lines("/OD_rules.c", "/* 2000h", "},")?,
    ]
    .join("\n"))
}

/// Some constants of the example in Structured Text, a conversion and the block of a PDO.
fn structured_text(system: &System) -> Result<String, Failure> {
    let [device] = system.devices.as_slice() else {
        return Err("the example has another number of devices".into());
    };
    let files = st::write(system, device, Some(5), None).artifacts;
    let file = |path: &str| {
        let file = files.iter().find(|file| file.path == path).ok_or_else(|| format!("no {path}"))?;
        Ok::<_, Failure>(String::from_utf8(file.bytes.clone())?)
    };
    let (constants, code) = (file("valve-constants.st")?, file("valve.st")?);
    let constants = constants.lines().filter(|line| {
        let line = line.trim_start();
        ["VALVE_ACTUAL_PRESSURE_INDEX", "VALVE_ACTUAL_PRESSURE_SENSOR", "VALVE_RPDO1_CAN_ID"]
            .iter()
            .any(|name| line.starts_with(name))
    });
    let mut parts = vec![constants.map(str::trim_start).collect::<Vec<_>>().join("\n")];
    for (begin, end) in [
        ("FUNCTION valve_actual_pressure_to_value", "END_FUNCTION\n"),
        ("FUNCTION_BLOCK VALVE_RPDO1_OUT", "END_FUNCTION_BLOCK\n"),
    ] {
        let from = code.find(begin).ok_or_else(|| format!("the example lacks `{begin}`"))?;
        let item = code.get(from..).unwrap_or_default();
        let to = item.find(end).ok_or_else(|| format!("`{begin}` does not end"))? + end.len();
        parts.push(item.get(..to).unwrap_or_default().trim_end().to_owned());
    }
    Ok(parts.join("\n\n"))
}

/// A unit, a special value and an entry of the example in plain C.
fn c_entry(system: &System, provenance: &Provenance) -> Result<String, Failure> {
    let mut diagnostics = Diagnostics::new();
    let set = c::artifacts(system, system.devices.iter(), provenance, &[c::Kind::Plain], &mut diagnostics);
    let part = |path: &str, start: &str| -> Result<String, Failure> {
        let file = set.iter().find(|artifact| artifact.path == path).ok_or("the example has no such file")?;
        let text = std::str::from_utf8(&file.bytes)?;
        let start = text.find(start).ok_or_else(|| format!("{path} lacks {start}"))?;
        let rest = text.get(start..).unwrap_or_default();
        Ok(rest.get(..rest.find("\n\n").unwrap_or(rest.len())).unwrap_or_default().to_owned())
    };
    Ok([
        part("c/valve/OD_types.h", "/** decibar")?,
        part("c/valve/OD_types.h", "/** 2001h actual pressure")?,
        part("c/valve/valve_od.h", "/**\n * 2000h set pressure")?,
    ]
    .join("\n\n"))
}

/// The PDOs of the example in its DBC.
fn frames(system: &System) -> String {
    let nodes = system.devices.iter().map(|device| dbc::Node { id: 5, system, device }).collect::<Vec<_>>();
    // The example has nothing but ASCII.
    let text = String::from_utf8_lossy(&dbc::write(&nodes).bytes).into_owned();
    let (mut is_pdo, mut lines) = (false, Vec::new());
    for line in text.lines() {
        if line.starts_with("BO_ ") {
            is_pdo = line.contains("PDO");
        }
        if is_pdo && (line.starts_with("BO_ ") || line.starts_with(" SG_ ")) || line.contains("sensor broken")
        {
            lines.push(line);
        }
    }
    lines.join("\n")
}

/// What `odgen diff` says about a few changes of the example.
fn changes(spec: &str, old: &System) -> Result<String, Failure> {
    let changed = [
        ("max: 16.0 bar}", "max: 12.0 bar}"),
        ("type: unsigned16, unit: decibar, access: ro", "type: integer16, unit: decibar, access: ro"),
        ("special: {0xFFFF: sensor broken}", "special: {0x7FFF: sensor broken}"),
        ("\npdos:", "\n  0x2002: {name: travel, type: unsigned8, access: ro}\npdos:"),
    ];
    let mut text = spec.to_owned();
    for (from, to) in changed {
        if !text.contains(from) {
            return Err(format!("the example lacks `{from}`").into());
        }
        text = text.replacen(from, to, 1);
    }
    let mut sources = SourceMap::new();
    let root = sources.add("valve.od.yaml", text);
    let Compiled { system, diagnostics, .. } = compile(&mut sources, root, &mut NoFiles);
    let new = system.ok_or_else(|| render(&diagnostics, &sources, Format::Human, false))?;
    let found = compare(&Question { old, new: &new, scope: Scope::Everything, device: None, nodes: None })?;
    Ok(format!("$ odgen diff --git v1.0 valve.od.yaml\n{}", human(&found, false)))
}

/// The detail tables of the example's own objects, from its Markdown.
fn tables(system: &System) -> Result<String, Failure> {
    let files = documents(system, "valve")?;
    let page = files.iter().find(|file| file.path.ends_with("valve.md")).ok_or("the example has no page")?;
    let page = std::str::from_utf8(&page.bytes)?;
    let objects = page.split("\n### ").filter(|part| part.starts_with("200"));
    let parts = objects.map(|part| {
        let part = part.split("\n<a id=").next().unwrap_or(part);
        format!("#### {}", without_links(part.trim()))
    });
    Ok(parts.collect::<Vec<_>>().join("\n\n"))
}

/// A method with its documentation.
fn function<'a>(module: &'a str, name: &str) -> Option<&'a str> {
    let at = module.find(&format!("    pub fn {name}("))?;
    let start = module[..at].rfind("\n\n")? + 2;
    let end = at + module[at..].find("\n    }\n")? + "\n    }".len();
    Some(&module[start..end])
}

/// Replaces what stands between `<!-- name -->` and `<!-- /name -->`.
fn block(text: &str, name: &str, content: &str) -> Result<String, Failure> {
    let (open, close) = (format!("<!-- {name} -->"), format!("<!-- /{name} -->"));
    let (before, rest) = text.split_once(&open).ok_or_else(|| format!("README.md lacks {open}"))?;
    let (_, after) = rest.split_once(&close).ok_or_else(|| format!("README.md lacks {close}"))?;
    Ok(format!("{before}{open}\n{content}\n{close}{after}"))
}

/// Markdown whose links are plain text: they lead into a document that the reader of an excerpt does not have.
fn without_links(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("](") {
        let (words, label) = before.rsplit_once('[').unwrap_or((before, ""));
        plain.push_str(words);
        plain.push_str(label);
        rest = after.split_once(')').map_or("", |(_, after)| after);
    }
    plain + rest
}
