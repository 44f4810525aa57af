//! The form of the sources: format and lints; the documentation made of them.

use std::path::{Path, PathBuf};
use std::process::Command;

use od_tests::{Failure, root};

use crate::runner::{self, Runner};
use crate::tools::has_shipped_target;

/// A call of clippy for which a finding is an error.
const CLIPPY: [&str; 2] = ["clippy", "--quiet"];
const DENY: [&str; 3] = ["--", "-D", "warnings"];

/// An example that has a feature of its own.
const EXAMPLE: &str = "firmware-glue/examples/pitch-controller";
/// Firmware that is built for a Cortex-M, outside the workspace.
const FIRMWARE: [&str; 2] = [EXAMPLE, "tests/thumb/node"];

/// Folders whose files are declared by a macro.
const RULES: [&str; 3] = ["od-spec/src/check", "od-spec/src/eds/check", "od-spec/src/plant/rules"];

/// Features of which each is also tried alone.
const FEATURES: [(&str, &[&str]); 4] = [
    ("od-gen", &["", "format"]),
    ("firmware-glue", &["critical-section", "defmt", "embedded-can", "sdo-block", "storage"]),
    ("od-generated", &["defmt"]),
    ("od-spec", &["", "xdd"]),
];

/// Format and lints, as they have to be. `firmware-glue` without features is looked at in addition to the workspace, which has
/// those that its members ask for.
pub(crate) fn check(runner: &mut Runner) -> Result<(), Failure> {
    runner.cargo(&["fmt", "--all", "--check"])?;
    format_of_rules(runner)?;
    if !clippy_compiles() {
        clippy(runner, &["--workspace", "--all-targets"])?;
        clippy(runner, &["--package", "firmware-glue", "--all-targets", "--all-features"])?;
    }
    clippy(runner, &["--package", "firmware-glue", "--lib", "--no-default-features"])?;
    for directory in FIRMWARE {
        let manifest = root().join(directory).join("Cargo.toml");
        runner.cargo(&["fmt", "--check", "--manifest-path", &manifest.to_string_lossy()])?;
        firmware(runner, directory, "")?;
    }
    Ok(())
}

/// Whether every compilation is one by clippy, as `.ci/run` asks for: a finding has stopped it then.
fn clippy_compiles() -> bool {
    std::env::var_os("RUSTC_WORKSPACE_WRAPPER").is_some_and(|wrapper| wrapper == "clippy-driver")
}

/// The documentation of every item, also of private ones, without a warning.
pub(crate) fn documentation(runner: &mut Runner) -> Result<(), Failure> {
    let mut doc = cargo(&["doc", "--quiet", "--workspace", "--no-deps", "--document-private-items"]);
    runner.run(doc.env("RUSTDOCFLAGS", "-D warnings"))?;
    // What a registry shows has all features.
    let mut doc = cargo(&["doc", "--quiet", "--no-deps", "--package", "firmware-glue", "--all-features"]);
    runner.run(doc.env("RUSTDOCFLAGS", "-D warnings"))
}

/// Rules are declared by a macro, where `cargo fmt` does not find their files.
fn format_of_rules(runner: &mut Runner) -> Result<(), Failure> {
    let mut files = Vec::new();
    for folder in RULES {
        rust_files(&root().join(folder), &mut files)?;
    }
    files.sort();
    runner.run(Command::new("rustfmt").args(["--check", "--edition", "2024"]).args(files))
}

/// Adds the Rust files below a folder.
fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Failure> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            rust_files(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

/// Where clippy can: Debian's Rust builds `core` without it.
fn firmware(runner: &mut Runner, directory: &str, features: &str) -> Result<(), Failure> {
    if !has_shipped_target() {
        return Ok(());
    }
    // There the target and the linker's script are named.
    let mut command = cargo(&CLIPPY);
    command.args(["--release", "--locked", "--features", features]).args(DENY);
    runner.run_in(&root().join(directory), &mut command)
}

/// Each feature alone: a user who needs one compiles no other.
pub(crate) fn features(runner: &mut Runner) -> Result<(), Failure> {
    for (package, features) in FEATURES {
        for feature in features {
            clippy(runner, &["--package", package, "--lib", "--no-default-features", "--features", feature])?;
        }
    }
    firmware(runner, EXAMPLE, "names")
}

fn clippy(runner: &mut Runner, what: &[&str]) -> Result<(), Failure> {
    runner.cargo(&[&CLIPPY, what, &DENY].concat())
}

fn cargo(arguments: &[&str]) -> Command {
    let mut command = runner::cargo();
    command.args(arguments);
    command
}
