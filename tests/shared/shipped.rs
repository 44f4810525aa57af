//! The shipped specifications as one text each, for tests that change a text or read it without files.

#![allow(
    unreachable_pub,
    dead_code,
    reason = "several test programs have this file, and each takes what it needs"
)]

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// The pitch control system.
pub static PITCH: LazyLock<String> = LazyLock::new(|| in_one_file("pitch-control-system"));

/// The text of a shipped specification with its parts, as it would be in one file.
///
/// # Panics
/// If there is no such specification.
#[expect(clippy::unwrap_used, reason = "only tests ask, and fail by panicking")]
pub fn in_one_file(name: &str) -> String {
    // The packages with tests are not all at one depth.
    let above = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    let directory =
        above.map(|folder| folder.join("od-spec/devices")).find(|folder| folder.is_dir()).unwrap();
    let read = |file: &str| fs::read_to_string(directory.join(file)).unwrap();
    let main = read(&format!("{name}.od.yaml"));
    let (before, rest) = main.split_once("\nparts: [").unwrap();
    let (parts, after) = rest.split_once("]\n").unwrap();
    let sections = parts.split(", ").map(|part| {
        let text = read(part);
        let (_, section) = text.split_once(&format!("\npart-of: {name}.od.yaml\n")).unwrap();
        section.to_owned()
    });
    sections.fold(format!("{before}\n{after}"), |whole, section| whole + &section)
}
