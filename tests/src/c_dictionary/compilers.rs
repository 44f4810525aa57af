//! Compilers of C, called with every warning that the C is promised to be without.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{Failure, root};

/// The language.
pub const LANGUAGE: &str = "-std=c99";

/// Warnings, each of which is an error.
pub const WARNINGS: [&str; 8] =
    ["-Wall", "-Wextra", "-Wconversion", "-Wsign-conversion", "-Wpedantic", "-Wshadow", "-Wundef", "-Werror"];

/// A compiler and what it compiles for.
#[derive(Debug, Clone)]
pub struct Compiler {
    /// The program.
    pub program: String,
    /// What chooses the platform.
    pub platform: Vec<String>,
}

impl Compiler {
    /// A compiler for this platform, or for the one that arguments choose.
    pub fn new(program: &str, platform: &[&str]) -> Self {
        Self {
            program: program.to_owned(),
            platform: platform.iter().map(|&argument| argument.to_owned()).collect(),
        }
    }

    /// Compiles all files of a device below a directory into object files next to them, which it returns.
    ///
    /// # Errors
    /// The compiler does not run, or has something to say.
    pub fn objects(&self, directory: &Path, device: &str) -> Result<Vec<PathBuf>, Failure> {
        let c = directory.join("c");
        let sources = [c.join("od_runtime.c"), c.join(device).join(format!("{device}_od.c"))];
        sources.into_iter().map(|source| self.object(&source, directory, device, &[])).collect()
    }

    /// The object file of a source.
    ///
    /// # Errors
    /// As [`objects`](Self::objects).
    pub fn object(
        &self,
        source: &Path,
        directory: &Path,
        device: &str,
        more: &[String],
    ) -> Result<PathBuf, Failure> {
        let stem = source.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let object = directory.join(format!("{stem}-{device}-{}.o", self.name()));
        let mut command = Command::new(&self.program);
        command.args(&self.platform).arg(LANGUAGE).args(WARNINGS).args(["-O1", "-c"]).args(more);
        for folder in [directory.join("c"), directory.join("c").join(device), root().join("tests/c")] {
            command.arg("-I").arg(folder);
        }
        run(command.arg(source).arg("-o").arg(&object))?;
        Ok(object)
    }

    /// Links objects into a program.
    ///
    /// # Errors
    /// As [`objects`](Self::objects).
    pub fn link(&self, objects: &[PathBuf], program: &Path) -> Result<(), Failure> {
        let mut command = Command::new(&self.program);
        run(command.args(&self.platform).args(objects).arg("-o").arg(program))
    }

    /// The arguments that describe a device to the program of [`answer.c`](../../c/answer.c).
    pub fn about(device: &str) -> [String; 3] {
        let upper = device.to_uppercase();
        [
            format!("-DDEVICE_HEADER=\"{device}_od.h\""),
            format!("-DTABLE={device}_od_table"),
            format!("-DSIZE={upper}_OD_SIZE"),
        ]
    }

    fn name(&self) -> String {
        let name: Vec<&str> =
            std::iter::once(self.program.as_str()).chain(self.platform.iter().map(String::as_str)).collect();
        name.join("").replace(|c: char| !c.is_ascii_alphanumeric(), "")
    }
}

/// Reads the headers of a device as C++ does.
///
/// # Errors
/// clang does not run, or has something to say.
pub fn compile_header(directory: &Path, device: &str) -> Result<(), Failure> {
    let source = directory.join(format!("{device}.cpp"));
    fs::write(&source, format!("#include \"{device}_od.h\"\n"))?;
    let mut command = Command::new("clang");
    command.args(["-x", "c++", "-std=c++11", "-ffreestanding", "-fsyntax-only"]);
    command.args(["-Wall", "-Wextra", "-Wpedantic", "-Werror"]);
    for folder in [directory.join("c"), directory.join("c").join(device)] {
        command.arg("-I").arg(folder);
    }
    run(command.arg(source))
}

fn run(command: &mut Command) -> Result<(), Failure> {
    let output = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    if output.status.success() && said.trim().is_empty() {
        return Ok(());
    }
    Err(format!("{command:?}\n{said}").into())
}
