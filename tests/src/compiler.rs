//! The Rust compiler, called for a file of the tests with the crates that the tests themselves are linked with: nothing is compiled
//! once more for it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use serde_json::Value;

use crate::{Failure, root};

/// The crates that a file can name.
const CRATES: [&str; 3] = ["firmware_glue", "od_gen", "od_macros"];

/// What the compiler makes of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Product<'a> {
    /// Nothing: the file has mistakes.
    Messages,
    /// A program.
    Program(&'a Path),
}

/// Compiles a file, named from the directory `tests`, from which paths in macros start, too. Its messages are in `stderr`.
///
/// # Errors
/// Cargo does not report where the crates lie, or the compiler does not run. That the file has mistakes is not an
/// error.
pub fn compile(file: &Path, product: Product<'_>) -> Result<Output, Failure> {
    static FOUND: OnceLock<Result<Vec<(&str, PathBuf)>, String>> = OnceLock::new();
    let crates = FOUND
        .get_or_init(|| crates().map_err(|failure| failure.to_string()))
        .as_ref()
        .map_err(String::as_str)?;
    let tests = root().join("tests");
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut command = Command::new(rustc);
    command.current_dir(&tests).env("CARGO_MANIFEST_DIR", &tests).arg(file);
    command.args(["--edition", "2024", "--crate-type", "bin", "--color", "never"]);
    match product {
        Product::Messages => {
            command.args(["--emit", "metadata", "-o"]).arg(if cfg!(windows) { "NUL" } else { "/dev/null" })
        }
        Product::Program(path) => command.arg("-o").arg(path),
    };
    for (name, path) in crates {
        let directory = path.parent().unwrap_or(path).display().to_string();
        command.args(["-L".to_owned(), format!("dependency={directory}")]);
        command.args(["--extern".to_owned(), format!("{name}={}", path.display())]);
    }
    Ok(command.output()?)
}

/// Where cargo has put the crates, with the features of the tests.
fn crates() -> Result<Vec<(&'static str, PathBuf)>, Failure> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    // As in a run of all tests, where features are the sum of what all packages ask for.
    let arguments = [
        "test",
        "--quiet",
        "--workspace",
        "--exclude",
        "od-spec",
        "--lib",
        "--no-run",
        "--message-format",
        "json",
    ];
    let output = Command::new(cargo).args(arguments).current_dir(root()).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
    }
    let messages: Vec<Value> = output
        .stdout
        .split(|byte| *byte == b'\n')
        .filter_map(|line| serde_json::from_slice(line).ok())
        .collect();
    CRATES.into_iter().map(|name| Ok((name, library(&messages, name)?))).collect()
}

/// The library of a crate: of several, the one with the most features, as others are for build scripts.
fn library(messages: &[Value], name: &str) -> Result<PathBuf, Failure> {
    let of_crate = messages.iter().filter(|message| {
        message["reason"] == "compiler-artifact"
            && message["target"]["name"] == name
            && message["profile"]["test"] == false
    });
    let features = |message: &&Value| message["features"].as_array().map_or(0, Vec::len);
    let files = of_crate.max_by_key(features).and_then(|message| message["filenames"].as_array());
    let mut files = files.into_iter().flatten().filter_map(Value::as_str).map(PathBuf::from);
    let file = files.find(|file| file.extension().is_none_or(|extension| extension != "rmeta"));
    Ok(file.ok_or_else(|| format!("cargo reports no library of {name}"))?)
}

/// What a compiler says of mistakes, without the lines that count them.
pub fn messages(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr);
    let counts = |line: &&str| {
        ![
            "error: aborting due to",
            "For more information about",
            "Some errors have detailed",
            "error: could not compile",
        ]
        .iter()
        .any(|begin| line.starts_with(begin))
    };
    let lines: Vec<&str> = text.lines().filter(counts).map(str::trim_end).collect();
    format!("{}\n", lines.join("\n").trim_end())
}
