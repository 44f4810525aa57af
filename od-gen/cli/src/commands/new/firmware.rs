//! A firmware together with the specification: those in Rust and in plain C run in QEMU at once.

use std::path::{Path, PathBuf};

use od_gen::Artifact;
use od_gen::plan::{Language, Role, ScopeKind, Words};
use od_gen::rust::{self, Rust};
use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;
use od_spec::model::System;

use super::args::Firmware;
use super::template::fill;

/// Where `firmware-glue` and `od-gen` lie where `--glue` does not say so.
const GLUE: &str = "../odgen";

/// A file of a project, and what it is made from.
type Template = (&'static str, &'static str);

const RUST: [Template; 6] = [
    ("Cargo.toml", include_str!("firmware/rust/Cargo.toml.txt")),
    (".cargo/config.toml", include_str!("firmware/rust/config.toml.txt")),
    ("build.rs", include_str!("firmware/rust/build.rs.txt")),
    ("memory.x", include_str!("firmware/rust/memory.x.txt")),
    ("src/main.rs", include_str!("firmware/rust/main.rs.txt")),
    ("src/can.rs", include_str!("firmware/rust/can.rs.txt")),
];

const C: [Template; 8] = [
    ("Makefile", include_str!("firmware/c/Makefile.txt")),
    ("board.ld", include_str!("firmware/c/board.ld.txt")),
    ("src/board.c", include_str!("firmware/c/board.c.txt")),
    ("src/can.c", include_str!("firmware/c/can.c.txt")),
    ("src/can.h", include_str!("firmware/c/can.h.txt")),
    ("src/main.c", include_str!("firmware/c/main.c.txt")),
    ("src/sdo.c", include_str!("firmware/c/sdo.c.txt")),
    ("src/sdo.h", include_str!("firmware/c/sdo.h.txt")),
];

const CANOPENNODE: [Template; 2] = [
    ("main.c", include_str!("firmware/canopennode/main.c.txt")),
    ("sources.mk", include_str!("firmware/canopennode/sources.mk.txt")),
];

/// The clone of odgen that was named, from anywhere.
pub(super) fn clone(glue: &Path) -> Result<PathBuf, Diagnostic> {
    let refused = |why: &str| {
        let message = format!("cannot take crates from `{}`: {why}", file_name::shown(glue));
        Diagnostic::without_place(codes::UNREADABLE, message).help("name a clone of odgen's repository")
    };
    if !["firmware-glue/Cargo.toml", "od-gen/Cargo.toml"].iter().all(|file| glue.join(file).is_file()) {
        return Err(refused("it has no `firmware-glue` and `od-gen`"));
    }
    std::path::absolute(glue).map_err(|error| refused(&error.to_string()))
}

/// The files of a project for a device.
///
/// # Errors
/// A template that is wrong.
pub(super) fn files(
    firmware: Firmware,
    key: &str,
    glue: Option<&Path>,
    system: &System,
) -> Result<Vec<Artifact>, Diagnostic> {
    let prefix = od_c::device_prefix(key);
    let dictionary = Rust.identifier(ScopeKind::Dictionary, Role::Type, &Words::of(key));
    let glue = glue.map_or_else(|| GLUE.to_owned(), in_toml);
    let count = |indices: std::ops::RangeInclusive<u16>| {
        let objects = system.devices.iter().flat_map(|device| device.objects.keys());
        objects.filter(|index| indices.contains(&index.0)).count().to_string()
    };
    let marks = [
        ("PREFIX", prefix.to_ascii_uppercase()),
        ("prefix", prefix),
        ("module", rust::module(key)),
        ("Dictionary", dictionary),
        ("glue", glue),
        ("rpdos", count(0x1400..=0x15FF)),
        ("tpdos", count(0x1800..=0x19FF)),
    ];
    let marks: Vec<(&str, &str)> = marks.iter().map(|(mark, text)| (*mark, text.as_str())).collect();
    let templates: &[Template] = match firmware {
        Firmware::Rust => &RUST,
        Firmware::C => &C,
        Firmware::Canopennode => &CANOPENNODE,
    };
    let artifact = |(path, template): &Template| {
        let bytes = fill(template, key, &marks)?.into_bytes();
        Ok(Artifact { path: (*path).to_owned(), bytes, purpose: String::new() })
    };
    templates.iter().map(artifact).collect()
}

/// A path as the text of a string in TOML.
fn in_toml(path: &Path) -> String {
    path.display().to_string().replace('\\', "/").replace('"', "\\\"")
}

/// What to do next.
pub(super) fn next(firmware: Firmware, directory: &str, key: &str, glue: Option<&Path>) -> String {
    let enter = format!("next: `cd {directory}`, then");
    let ask = format!("asks it in another terminal:\n  odgen node read {key}.od.yaml --node 5 1018.1\n");
    match (firmware, glue) {
        (Firmware::Rust, Some(_)) => {
            format!("{enter} `cargo run --release` starts the node in QEMU, and this {ask}")
        }
        (Firmware::Rust, None) => format!(
            "The crates are not published yet: Cargo.toml takes them from a clone of odgen in `{GLUE}`; `--glue DIR` names another.\n\
             {enter} `cargo run --release` starts the node in QEMU, and this {ask}"
        ),
        (Firmware::C, _) => format!("{enter} `make run` starts the node in QEMU, and this {ask}"),
        (Firmware::Canopennode, _) => format!(
            "{enter} `odgen build {key}.od.yaml --c canopennode --out generated` makes the dictionary;\n\
             sources.mk lists what is compiled with the stack\n"
        ),
    }
}
