//! The examples of the README and of the book: each is made anew from the example that the tests compile.

use std::collections::BTreeMap;
use std::fs;

use od_c as c;
use od_diff::{Question, Scope, compare, human};
use od_documents::Format as Pages;
use od_formats::dbc;
use od_gen::rust::{self, Provenance};
use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{Compiled, NoFiles, compile};
use od_st as st;

use crate::editor::{hover, mistyped};
use crate::generate::{GeneratedFile, documents};
use crate::pictures;
use crate::{Failure, compile_with_sources, root};

/// The example.
const VALVE: &str = "tests/book/valve.od.yaml";
/// Page, mark, and what is between the marks.
type Example = (&'static str, &'static str, String);

/// The pages with their examples made anew, and the pictures.
///
/// # Errors
/// The example does not compile, or a page cannot be read or lacks a mark.
pub(crate) fn pages() -> Result<Vec<GeneratedFile>, Failure> {
    let spec = fs::read_to_string(root().join(VALVE))?;
    let (system, sources) = compile_with_sources(VALVE)?;
    let mut pages = BTreeMap::new();
    for (page, mark, content) in examples(&spec, &system, &sources)? {
        let text = match pages.remove(page) {
            Some(text) => text,
            None => fs::read_to_string(root().join(page))?,
        };
        pages.insert(page, block(page, &text, mark, &content)?);
    }
    let mut files: Vec<GeneratedFile> =
        pages.into_iter().map(|(page, text)| (page.to_owned(), text.into_bytes())).collect();
    let html = documents(&system, "valve", Pages::Html)?;
    let page =
        html.iter().find(|file| file.path.ends_with("/valve.html")).ok_or("the example has no page")?;
    let page = pictures::page(std::str::from_utf8(&page.bytes)?)?;
    files.push(("docs/book/images/page.svg".to_owned(), page.into_bytes()));
    let message = pictures::screen(&mistake(&spec)?);
    files.push(("docs/book/images/message.svg".to_owned(), message.into_bytes()));
    Ok(files)
}

fn examples(spec: &str, system: &System, sources: &SourceMap) -> Result<Vec<Example>, Failure> {
    let written = |name: &str| fs::read_to_string(root().join("tests/book").join(name));
    let fenced = |language: &str, text: &str| format!("```{language}\n{}\n```", text.trim_end());
    let firmware = written("firmware.rs")?.replace("book/", "");
    let in_editor = [mistyped(spec, "decibar, access", "decibr, access")?, hover(spec, "set pressure")?];
    let provenance = Provenance::of(sources);
    Ok(vec![
        ("README.md", "spec", fenced("yaml", spec)),
        ("README.md", "eds", fenced("ini", &eds(system)?)),
        ("README.md", "api", fenced("rust", &accessors(system, &provenance)?)),
        ("docs/book/tutorial.md", "spec", fenced("sh", &format!("cat > valve.od.yaml <<'END'\n{spec}END"))),
        ("docs/book/guides/specification.md", "drive", fenced("yaml", &written("lift.od.yaml")?)),
        ("docs/book/guides/specification.md", "mistake", fenced("text", &mistake(spec)?)),
        ("docs/book/guides/rust.md", "firmware", fenced("rust", &firmware)),
        ("docs/book/guides/ci.md", "diff", fenced("text", &changes(spec, system)?)),
        ("docs/book/guides/canopennode.md", "canopennode", fenced("c", &stack(system, sources)?)),
        ("docs/book/guides/c.md", "c", fenced("c", &written("valve.c")?)),
        ("docs/book/guides/c.md", "c-sdo", fenced("c", &written("sdo_server.c")?)),
        ("docs/book/guides/c.md", "c-entry", fenced("c", &c_entry(system, &provenance)?)),
        ("docs/book/guides/writer.md", "docs", tables(system)?),
        ("docs/book/formats/dbc.md", "dbc", fenced("text", &frames(system))),
        ("docs/book/formats/structured-text.md", "st", fenced("text", &structured_text(system)?)),
        ("docs/book/editor.md", "editor", fenced("text", &in_editor.join("\n\n"))),
    ])
}

/// Some sections of the example's EDS.
fn eds(system: &System) -> Result<String, Failure> {
    const SECTIONS: [&str; 4] = ["[1600sub1]", "[1800sub1]", "[2000]", "[2001]"];
    let device = system.devices.first().ok_or("the example has no device")?;
    let text = String::from_utf8(od_formats::eds::write_eds(system, device))?.replace("\r\n", "\n");
    let is_shown = |part: &&str| part.lines().any(|line| SECTIONS.contains(&line));
    Ok(text.split("\n\n").filter(is_shown).map(str::trim_end).collect::<Vec<_>>().join("\n\n"))
}

/// The accessors of the example.
fn accessors(system: &System, provenance: &Provenance) -> Result<String, Failure> {
    let device = system.devices.first().ok_or("the example has no device")?;
    let module = rust::file(system, device, provenance, &mut Diagnostics::new())
        .ok_or("the example has no Rust module")?;
    let found: Option<Vec<&str>> =
        ["set_pressure", "actual_pressure"].into_iter().map(|name| function(&module, name)).collect();
    let found = found.ok_or("the example lacks an accessor")?;
    Ok(format!("impl Valve {{\n{}\n    // …\n}}", found.join("\n\n")))
}

/// What `odgen check` prints about a default that is no whole number of steps.
fn mistake(spec: &str) -> Result<String, Failure> {
    let text = spec.replace("default: 2.5 bar", "default: 2.55 bar");
    let mut sources = SourceMap::new();
    let root = sources.add("valve.od.yaml", text);
    let diagnostics = compile(&mut sources, root, &mut NoFiles).diagnostics;
    let text = render(&diagnostics, &sources, Format::Human, false);
    if text.contains("error[") { Ok(text) } else { Err("the example has no mistake".into()) }
}

/// What the files for CANopenNode say of an entry of the example.
fn stack(system: &System, sources: &SourceMap) -> Result<String, Failure> {
    let mut diagnostics = Diagnostics::new();
    let provenance = Provenance::of(sources);
    let set = c::artifacts(
        system,
        system.devices.iter(),
        &provenance,
        &c::Kind::CanopenNode.into(),
        &mut diagnostics,
    );
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
    let set =
        c::artifacts(system, system.devices.iter(), provenance, &c::Kind::Plain.into(), &mut diagnostics);
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
    let files = documents(system, "valve", Pages::Markdown)?;
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

/// Replaces what is between `<!-- mark -->` and `<!-- /mark -->` in a page.
fn block(page: &str, text: &str, mark: &str, content: &str) -> Result<String, Failure> {
    let (open, close) = (format!("<!-- {mark} -->"), format!("<!-- /{mark} -->"));
    let (before, rest) = text.split_once(&open).ok_or_else(|| format!("{page} lacks {open}"))?;
    let (_, after) = rest.split_once(&close).ok_or_else(|| format!("{page} lacks {close}"))?;
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
