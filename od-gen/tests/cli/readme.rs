//! What the README shows of the command is what the command says.

use std::fs;
use std::path::Path;

use crate::{FAN, Scratch, odgen, stderr};

#[test]
fn the_screens_of_a_check_are_what_it_says() {
    let scratch = Scratch::new("readme");
    scratch.file("fan.eds", FAN);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let readme = fs::read_to_string(root.join("README.md")).unwrap();
    for (mark, arguments) in [("check", "check fan.eds"), ("for", "check fan.eds --for python-canopen")] {
        let said = stderr(&odgen(&scratch.0, &arguments.split(' ').collect::<Vec<_>>()));
        let indented = |line: &str| if line.is_empty() { String::new() } else { format!("    {line}") };
        let command = format!("$ odgen {arguments}");
        let screen: Vec<String> = [command.as_str()].into_iter().chain(said.lines()).map(indented).collect();
        let (_, rest) = readme.split_once(&format!("<!-- {mark} -->\n")).unwrap();
        let (block, _) = rest.split_once(&format!("\n<!-- /{mark} -->")).unwrap();
        assert_eq!(block.trim(), screen.join("\n").trim());
    }
}
