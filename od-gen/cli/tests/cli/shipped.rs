//! The README's first command gives the files that are checked in.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::{Scratch, code, files, odgen, stderr};

/// Files that users wrote, next to the generated ones.
const WRITTEN_BY_HAND: [&str; 2] = ["Cargo.toml", "src/lib.rs"];

#[test]
fn the_first_command_gives_the_checked_in_files() {
    let scratch = Scratch::new("shipped");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
    let readme = fs::read_to_string(root.join("README.md")).unwrap();
    let command = readme.lines().find_map(|line| line.strip_prefix("    cargo odgen ")).unwrap();
    // What the alias `cargo odgen` adds, and another place for the output.
    let out = scratch.0.to_str().unwrap();
    let arguments: Vec<&str> = ["--specs", "od-spec/devices"]
        .into_iter()
        .chain(command.split_whitespace())
        .chain(["--out", out])
        .collect();
    let output = odgen(root, &arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));

    let checked_in = root.join("generated");
    let mut kept: BTreeSet<String> = files(&checked_in).into_iter().collect();
    kept.retain(|name| !WRITTEN_BY_HAND.contains(&name.as_str()));
    let made: BTreeSet<String> = files(&scratch.0).into_iter().collect();
    assert_eq!(made, kept, "run `cargo xtask generate`; delete what nothing makes");
    for name in made {
        let text = |directory: &Path| fs::read_to_string(directory.join(&name)).unwrap();
        let (new, old) = (text(&scratch.0), text(&checked_in));
        if new != old {
            let line = new.lines().zip(old.lines()).take_while(|(new, old)| new == old).count();
            let at = |text: &str| text.lines().nth(line).unwrap_or("(end of file)").to_owned();
            panic!(
                "generated/{name} is not current from line {}:\n  - {}\n  + {}\nrun `cargo xtask generate`",
                line + 1,
                at(&old),
                at(&new)
            );
        }
    }
}
