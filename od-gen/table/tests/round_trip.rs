//! What is exported is imported again without a difference.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::{Path, PathBuf};

use od_gen::source::{FileLoader, compile_file};
use od_import::yaml::{Options, specification};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_table::{Notation, as_held, csv, import, xlsx};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn compiled(path: &Path) -> Option<System> {
    let mut sources = SourceMap::new();
    compile_file(path, &mut sources, &mut FileLoader::default()).system
}

/// A specification without the comments at its top.
fn facts(text: &str) -> String {
    let lines: Vec<&str> = text.lines().skip_while(|line| line.starts_with('#')).collect();
    lines.join("\n")
}

/// The devices of a specification that come back otherwise than they were, with what differs.
fn differences(path: &Path) -> Vec<String> {
    let mut found = Vec::new();
    let system = compiled(path).unwrap();
    for device in &system.devices {
        let (held, of_device) = as_held(&system, device);
        let wanted = facts(&specification(&held, &of_device, &Options::default()).unwrap().text);
        for (notation, bytes) in [
            (Notation::Separated, csv(&system, device).bytes),
            (Notation::Excel, xlsx(&system, device).unwrap().bytes),
        ] {
            let mut sources = SourceMap::new();
            let place = format!("{} {} {notation:?}", path.display(), device.key);
            let made = match import(&mut sources, "table", bytes, notation, None, "table") {
                Ok(made) => made,
                Err(diagnostics) => {
                    let all = diagnostics.iter().map(|one| format!("{place}: {}", one.message));
                    found.extend(all);
                    continue;
                }
            };
            found.extend(made.diagnostics.iter().map(|one| format!("{place}: {}", one.message)));
            let text = facts(&made.specification.text);
            let lines = wanted.lines().zip(text.lines()).find(|(one, other)| one != other);
            if let Some((wanted, made)) = lines {
                found.push(format!("{place}:\n  wanted: {wanted}\n  made:   {made}"));
            } else if text != wanted {
                found.push(format!("{place}: one is longer"));
            }
        }
    }
    found
}

#[test]
fn a_device_comes_back_from_its_tables() {
    let folders = ["od-spec/devices", "tests/shared", "tests/book"];
    let mut paths: Vec<PathBuf> = folders
        .into_iter()
        .flat_map(|folder| od_gen::source::specifications_in(&root().join(folder)).unwrap())
        .filter(|path| compiled(path).is_some())
        .collect();
    paths.sort();
    assert!(paths.len() > 10);
    let found: Vec<String> = paths.iter().flat_map(|path| differences(path)).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}
