//! The first steps of the README and of the tutorial, from an empty folder, with Rust, a C compiler and coreutils in the path.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::{Scratch, code, files, stderr, stdout};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap()
}

/// The commands between the marks of a page.
#[track_caller]
fn commands(page: &str, mark: &str) -> String {
    let (_, rest) = page.split_once(&format!("<!-- {mark} -->\n```sh\n")).expect(mark);
    rest.split_once(&format!("```\n<!-- /{mark} -->")).expect(mark).0.to_owned()
}

/// How many there are; the text of a file is no command.
fn count(commands: &str) -> usize {
    let mut is_text = false;
    let is_command = |line: &&str| {
        let was_text = is_text;
        is_text = if is_text { *line != "END" } else { line.ends_with("<<'END'") };
        !was_text
    };
    commands.lines().filter(is_command).count()
}

/// Programs by their names, as a path.
fn programs(scratch: &Scratch) -> PathBuf {
    let folder = scratch.0.join("bin");
    fs::create_dir(&folder).unwrap();
    let toolchain = Path::new(env!("CARGO")).parent().unwrap();
    symlink(env!("CARGO_BIN_EXE_odgen"), folder.join("odgen")).unwrap();
    for name in ["cargo", "rustc"] {
        symlink(toolchain.join(name), folder.join(name)).unwrap();
    }
    // The linker belongs to the compiler of C.
    let path = std::env::var_os("PATH").unwrap();
    for name in ["cc", "ld", "cat"] {
        let found = std::env::split_paths(&path).map(|folder| folder.join(name)).find(|path| path.is_file());
        symlink(found.expect(name), folder.join(name)).unwrap();
    }
    folder
}

fn run(scratch: &Scratch, script: &str) -> Output {
    let folder = scratch.0.join("empty");
    fs::create_dir(&folder).unwrap();
    let mut shell = Command::new("/bin/sh");
    shell.args(["-e", "-c", script]).current_dir(folder).env_clear();
    // Where the registry's crates are; the tests have fetched what firmware-glue can ask for.
    for name in ["HOME", "CARGO_HOME"] {
        if let Some(value) = std::env::var_os(name) {
            shell.env(name, value);
        }
    }
    shell.env("PATH", programs(scratch)).env("OD", root()).env("CARGO_NET_OFFLINE", "true");
    // What does not change is compiled once.
    shell.env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("tutorial"));
    shell.output().unwrap()
}

#[test]
fn the_first_device_of_the_readme_is_made() {
    let scratch = Scratch::new("first-device");
    let commands = commands(&fs::read_to_string(root().join("README.md")).unwrap(), "first-device");
    assert_eq!(count(&commands), 4);
    let output = run(&scratch, &commands);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let made = files(&scratch.0.join("empty"));
    for name in ["fan.od.yaml", "fan-5.dcf", "generated/eds/fan.eds", "generated/src/fan.rs"] {
        assert!(made.iter().any(|file| file == name), "{name} is not in {made:?}");
    }
}

#[test]
fn the_tutorial_leads_to_a_node_that_answers() {
    let scratch = Scratch::new("tutorial");
    let page = fs::read_to_string(root().join("docs/book/tutorial.md")).unwrap();
    let (install, steps) = (commands(&page, "install"), ["device", "spec", "build", "main", "run"]);
    let script: String = steps.iter().map(|mark| commands(&page, mark)).collect();
    assert!(count(&install) + count(&script) <= 10);
    let output = run(&scratch, &script);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let (_, rest) = page.split_once("<!-- answer -->\n```text\n").unwrap();
    let answer = rest.split_once("```\n<!-- /answer -->").unwrap().0;
    let said = stdout(&output);
    assert!(said.ends_with(answer), "{said}");
    // Generated code and the page's have no warning either.
    assert!(!stderr(&output).contains("warning"), "{}", stderr(&output));
    let made = files(&scratch.0.join("empty/valve"));
    for name in ["eds/valve.eds", "eds/valve.dcf", "docs/valve/index.html", "src/valve.rs"] {
        assert!(made.iter().any(|file| file == name), "{name} is not in {made:?}");
    }
}
