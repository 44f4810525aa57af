//! Generation from a build script.

use std::env;
use std::fmt;
use std::path::PathBuf;

use od_spec::Compiled;
use od_spec::diag::render::{Format, render};
use od_spec::diag::{Diagnostic, Diagnostics, Severity, codes};
use od_spec::file_name;
use od_spec::model::Devices;
use od_spec::source::SourceMap;

use crate::expand::unknown_device;
use crate::files::{Reason, write_all};
use crate::foreign::condense;
use crate::rust::{self, Provenance};
use crate::source::{FileLoader, compile_file};

/// Makes Rust modules of a specification from a build script:
///
/// ```no_run
/// // build.rs
/// od_gen::Builder::new("pitch.od.yaml").device("pmc").generate();
/// ```
///
/// and in the crate
///
/// ```text
/// mod pmc {
///     include!(concat!(env!("OUT_DIR"), "/pmc.rs"));
/// }
/// ```
///
/// Outside of a build script, with a directory of one's own:
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let directory = std::env::temp_dir().join(format!("od-gen-builder-{}", std::process::id()));
/// std::fs::create_dir_all(&directory)?;
/// let specification = directory.join("lamp.od.yaml");
/// std::fs::write(&specification, "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices:
///   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
/// objects:
///   0x2000: {name: brightness, type: unsigned8, access: rw, default: 80, max: 100}
/// ")?;
/// let modules = od_gen::Builder::new(&specification).out_dir(&directory).try_generate()?;
/// assert_eq!(modules, [directory.join("lamp.rs")]);
/// assert!(std::fs::read_to_string(&modules[0])?.contains("pub fn brightness"));
/// # std::fs::remove_dir_all(&directory)?;
/// # Ok(())
/// # }
/// ```
///
/// Cargo runs the script again when the specification, or a library file that it uses, has changed, and for no other reason.
#[derive(Debug, Clone)]
#[must_use = "it makes nothing before `generate` or `try_generate` is called"]
pub struct Builder {
    specification: PathBuf,
    devices: Vec<String>,
    out: Option<PathBuf>,
    layout: rust::Layout,
}

/// Why nothing was generated: what [`Builder::try_generate`] found.
#[derive(Debug)]
pub struct BuildError {
    diagnostics: Diagnostics,
    sources: SourceMap,
}

/// All messages as `odgen check` prints them.
impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&render(&self.diagnostics, &self.sources, Format::Human, false))
    }
}

impl std::error::Error for BuildError {}

/// What a build script reports to cargo.
struct Outcome {
    read: Vec<PathBuf>,
    /// One line about an EDS or DCF, in place of its messages.
    in_short: Option<String>,
    diagnostics: Diagnostics,
    sources: SourceMap,
    written: Vec<PathBuf>,
}

impl Builder {
    /// Of a specification, EDS or DCF; the path is relative to the package that is built.
    pub fn new(specification: impl Into<PathBuf>) -> Self {
        Self { specification: specification.into(), devices: Vec::new(), out: None, layout: rust::plain_file }
    }

    /// Only this device, by its key; may be called for several. Without it, all.
    pub fn device(mut self, key: impl Into<String>) -> Self {
        self.devices.push(key.into());
        self
    }

    /// The directory for the modules; cargo's `OUT_DIR` unless given.
    pub fn out_dir(mut self, directory: impl Into<PathBuf>) -> Self {
        self.out = Some(directory.into());
        self
    }

    /// Lays the modules out for people. Without it, each statement is one line: laying out takes most of the time of a build
    /// script, which cargo compiles without optimisation.
    #[cfg(feature = "format")]
    pub fn formatted(mut self) -> Self {
        self.layout = rust::file;
        self
    }

    /// Writes `KEY.rs` for each device and reports them to cargo. Mistakes in the specification appear as errors of the
    /// build, with their places and with help, and end the process with exit code 1; warnings appear as warnings, notes
    /// not at all. Of an EDS or DCF, which is read whatever is wrong with it, one warning says how much that is.
    #[expect(clippy::print_stdout, clippy::print_stderr, reason = "cargo reads what a build script prints")]
    pub fn generate(&self) {
        let outcome = self.run();
        // A line break in a name would begin another instruction.
        let names = outcome.read.iter().map(file_name::shown);
        for name in names.filter(|name| !name.contains(['\n', '\r'])) {
            println!("cargo::rerun-if-changed={name}");
        }
        if let Some(line) = &outcome.in_short {
            println!("cargo::warning={line}");
        }
        for diagnostic in &outcome.diagnostics.clone().without_notes() {
            let mut one = Diagnostics::new();
            one.push(diagnostic.clone());
            let kind = if diagnostic.severity() == Severity::Error { "error" } else { "warning" };
            for line in render(&one, &outcome.sources, Format::Short, false).lines() {
                println!("cargo::{kind}={line}");
            }
        }
        if outcome.diagnostics.has_errors() {
            eprint!("{}", render(&outcome.diagnostics, &outcome.sources, Format::Human, false));
            std::process::exit(1);
        }
    }

    /// Writes `KEY.rs` for each device; returns the files.
    ///
    /// # Errors
    /// All mistakes of the specification: then nothing was written. Or a file cannot be written: those
    /// before it are, and the message names them.
    pub fn try_generate(&self) -> Result<Vec<PathBuf>, Box<BuildError>> {
        let Outcome { diagnostics, sources, written, .. } = self.run();
        if diagnostics.has_errors() {
            Err(Box::new(BuildError { diagnostics, sources }))
        } else {
            Ok(written)
        }
    }

    fn run(&self) -> Outcome {
        let (mut sources, mut loader) = (SourceMap::new(), FileLoader::default());
        let mut compiled = compile_file(&self.specification, &mut sources, &mut loader);
        let in_short = condense(&self.specification, &mut compiled);
        let Compiled { system, mut diagnostics, .. } = compiled;
        let mut read = loader.read;
        if !read.contains(&self.specification) {
            read.push(self.specification.clone());
        }
        let mut written = Vec::new();
        if let Some(system) = system {
            for key in self.devices.iter().filter(|key| system.device(key).is_none()) {
                diagnostics.push(unknown_device(key, &system.devices));
            }
            let wanted = Devices::listed(&self.devices);
            let devices = system.devices.iter().filter(|device| wanted.includes(&device.key));
            let provenance = Provenance::of(&sources);
            let mut files = rust::modules(&system, devices, &provenance, self.layout, &mut diagnostics);
            for file in &mut files {
                file.path = file.path.replacen("src/", "", 1);
            }
            let directory = self.out.clone().or_else(|| env::var_os("OUT_DIR").map(PathBuf::from));
            match directory {
                _ if diagnostics.has_errors() => {}
                Some(directory) => match write_all(&directory, &files) {
                    Ok(_) => written.extend(files.iter().map(|file| directory.join(&file.path))),
                    Err(error) => {
                        let help = match error.reason {
                            Reason::NotGenerated(_) => {
                                "generate into another directory, or remove what is there"
                            }
                            _ => error.advice(),
                        };
                        diagnostics.push(not_written(&error.to_string(), help));
                    }
                },
                None => diagnostics.push(not_written(
                    "there is no `OUT_DIR`, because this is not a build script",
                    "say where the modules go, with `out_dir`",
                )),
            }
        }
        Outcome { read, in_short, diagnostics, sources, written }
    }
}

fn not_written(reason: &str, help: &str) -> Diagnostic {
    Diagnostic::without_place(codes::WRITE_FAILED, reason).help(help)
}
