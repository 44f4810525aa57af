//! What the README shows of the command is what the command says.

use std::fs;
use std::path::Path;

use crate::{FAN, Scratch, odgen, stderr};

#[test]
fn the_screen_of_a_check_is_what_it_says() {
    let scratch = Scratch::new("readme");
    scratch.file("fan.eds", FAN);
    let said = stderr(&odgen(&scratch.0, &["check", "fan.eds"]));
    let indented = |line: &str| if line.is_empty() { String::new() } else { format!("    {line}") };
    let screen: Vec<String> =
        ["$ odgen check fan.eds"].into_iter().chain(said.lines()).map(indented).collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let readme = fs::read_to_string(root.join("README.md")).unwrap();
    let (_, rest) = readme.split_once("<!-- check -->\n").unwrap();
    let (block, _) = rest.split_once("\n<!-- /check -->").unwrap();
    assert_eq!(block.trim(), screen.join("\n").trim());
}
