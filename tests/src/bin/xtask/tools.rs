//! The tools of others that parts of the tests need.

use std::collections::BTreeSet;
use std::env;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use od_tests::root;

/// The target of the firmware in tests/thumb.
const TARGET: &str = "thumbv7em-none-eabi";
/// The target of the command on Windows, as the compiler from Debian builds it.
pub(crate) const WINDOWS_TARGET: &str = "x86_64-pc-windows-gnu";
/// The target of the command in a page.
pub(crate) const PAGE_TARGET: &str = "wasm32-wasip1";
/// How long rustup may take to fetch it: a few megabytes, or a network that never answers.
const FETCH_LIMIT: Duration = Duration::from_secs(120);
/// Names of Chromium; the variable `CHROMIUM` names another program.
const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// What may be missing on a machine that has Rust.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Tool {
    Python,
    Node,
    Chromium,
    Pdftotext,
    /// The library that sets the text of what WeasyPrint prints.
    Pango,
    /// The core library of the firmware's target: rustup's, or its sources for Debian's Rust.
    ThumbTarget,
    ThumbLinker,
    Qemu,
    Make,
    /// A second compiler of C, which compiles for other platforms, too; the first is the one that Rust links with.
    Clang,
    WindowsTarget,
    PageTarget,
    /// The linker and the C compiler for Windows.
    Mingw,
    /// Runs programs for Windows.
    Wine,
    /// With eglot and yaml-mode.
    Emacs,
    /// Reads C by the rules of MISRA.
    Cppcheck,
    /// Counts instructions.
    Valgrind,
}

impl Tool {
    pub(crate) const ALL: [Tool; 17] = [
        Tool::Python,
        Tool::Node,
        Tool::Chromium,
        Tool::Pdftotext,
        Tool::Pango,
        Tool::ThumbTarget,
        Tool::ThumbLinker,
        Tool::Qemu,
        Tool::Make,
        Tool::Clang,
        Tool::WindowsTarget,
        Tool::PageTarget,
        Tool::Mingw,
        Tool::Wine,
        Tool::Emacs,
        Tool::Cppcheck,
        Tool::Valgrind,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Tool::Python => "Python 3.10 or newer with venv",
            Tool::Node => "Node.js 18 or newer with npm",
            Tool::Chromium => "Chromium",
            Tool::Pdftotext => "pdftotext",
            Tool::Pango => "Pango",
            Tool::ThumbTarget => "Rust's target thumbv7em-none-eabi",
            Tool::ThumbLinker => "a linker for it: rust-lld, which rustup's Rust has, or arm-none-eabi-ld",
            Tool::Qemu => "qemu-system-arm",
            Tool::Make => "make",
            Tool::Clang => "clang",
            Tool::WindowsTarget => "Rust's target x86_64-pc-windows-gnu",
            Tool::PageTarget => "Rust's target wasm32-wasip1",
            Tool::Mingw => "mingw-w64",
            Tool::Wine => "Wine",
            Tool::Emacs => "Emacs with eglot and yaml-mode",
            Tool::Cppcheck => "cppcheck with its addon misra",
            Tool::Valgrind => "Valgrind",
        }
    }

    /// The lines of which one installs it, on Debian where it is no matter of rustup.
    pub(crate) const fn install(self) -> &'static [&'static str] {
        match self {
            Tool::Python => &["apt-get install python3 python3-venv"],
            Tool::Node => &["apt-get install nodejs npm"],
            Tool::Chromium => &["apt-get install chromium fonts-dejavu"],
            Tool::Pdftotext => &["apt-get install poppler-utils"],
            Tool::Pango => {
                &["apt-get install libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz-subset0 fonts-dejavu"]
            }
            Tool::ThumbTarget => &[
                "rustup target add thumbv7em-none-eabi",
                "apt-get install rustc-web cargo-web rust-web-src    (without rustup)",
            ],
            Tool::ThumbLinker => &["apt-get install binutils-arm-none-eabi"],
            Tool::Qemu => &["apt-get install qemu-system-arm"],
            Tool::Make => &["apt-get install make"],
            Tool::Clang => &["apt-get install clang"],
            Tool::WindowsTarget => &["rustup target add x86_64-pc-windows-gnu"],
            Tool::PageTarget => &["rustup target add wasm32-wasip1"],
            Tool::Mingw => &["apt-get install gcc-mingw-w64-x86-64"],
            Tool::Wine => &["apt-get install wine wine64"],
            Tool::Emacs => &["apt-get install emacs-nox elpa-eglot elpa-yaml-mode"],
            Tool::Cppcheck => &["apt-get install cppcheck"],
            Tool::Valgrind => &["apt-get install valgrind"],
        }
    }

    pub(crate) fn is_here(self) -> bool {
        match self {
            Tool::Python => {
                let check = "import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 10))";
                succeeds(Command::new("python3").args(["-c", check]))
            }
            Tool::Node => {
                let check = "process.exit(process.versions.node.split('.')[0] < 18 ? 1 : 0)";
                succeeds(Command::new("node").args(["-e", check])) && is_in_path("npm")
            }
            Tool::Chromium => env::var_os("CHROMIUM").is_some() || BROWSERS.into_iter().any(is_in_path),
            Tool::Pdftotext => is_in_path("pdftotext"),
            Tool::Pango => {
                let check = "import sys, ctypes.util as c; sys.exit(not all(map(c.find_library, ['pango-1.0', 'pangoft2-1.0', 'harfbuzz-subset'])))";
                succeeds(Command::new("python3").args(["-c", check]))
            }
            Tool::ThumbTarget => has_target(),
            Tool::ThumbLinker => has_linker(),
            Tool::Qemu => is_in_path("qemu-system-arm"),
            Tool::Make => is_in_path("make"),
            Tool::Clang => is_in_path("clang"),
            Tool::WindowsTarget => has_target_of_rustc(WINDOWS_TARGET),
            Tool::PageTarget => has_target_of_rustc(PAGE_TARGET),
            Tool::Mingw => is_in_path("x86_64-w64-mingw32-gcc"),
            Tool::Wine => is_in_path("wine"),
            Tool::Valgrind => is_in_path("valgrind"),
            Tool::Emacs => {
                let check = "(progn (package-initialize) (require 'eglot) (require 'yaml-mode))";
                is_in_path("emacs") && succeeds(Command::new("emacs").args(["--batch", "--eval", check]))
            }
            Tool::Cppcheck => is_in_path("cppcheck"),
        }
    }
}

/// The tools that this machine has.
pub(crate) fn found() -> BTreeSet<Tool> {
    Tool::ALL.into_iter().filter(|tool| tool.is_here()).collect()
}

/// Tries to add the firmware's target with rustup, if there is one; whether it is there now.
///
/// `rust-toolchain.toml` does not list the target: rustup would fetch it before any other command of cargo, and without a
/// network not even the tool could be built.
pub(crate) fn add_target() -> bool {
    if !is_in_path("rustup") {
        return false;
    }
    let mut rustup = Command::new("rustup");
    rustup.args(["target", "add", TARGET]).current_dir(root());
    rustup.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    rustup.spawn().is_ok_and(|child| ends_well(child, FETCH_LIMIT)) && has_target()
}

/// Waits for a program, which is stopped when its time is over.
fn ends_well(mut child: Child, limit: Duration) -> bool {
    let end = Instant::now() + limit;
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) if Instant::now() < end => std::thread::sleep(Duration::from_millis(50)),
            Ok(None) | Err(_) => {
                let _ = child.kill();
                let _ = child.wait();
                return false;
            }
        }
    }
}

/// The same two ways as in tests/thumb/run.py.
fn has_target() -> bool {
    has_shipped_target() || debian_sysroot().is_some()
}

/// Whether the toolchain that compiles this workspace has the target's core library.
pub(crate) fn has_shipped_target() -> bool {
    has_target_of_rustc(TARGET)
}

fn has_target_of_rustc(target: &str) -> bool {
    sysroot("rustc").is_some_and(|root| root.join("lib/rustlib").join(target).is_dir())
}

/// Debian's Rust, if it can build the core library: it has its own cargo and the sources.
fn debian_sysroot() -> Option<PathBuf> {
    let root = sysroot("/usr/bin/rustc")?;
    let sources = root.join("lib/rustlib/src/rust/library/core");
    (Path::new("/usr/bin/cargo").exists() && sources.is_dir()).then_some(root)
}

fn has_linker() -> bool {
    thumb_linker().is_some()
}

/// The linker for a Cortex-M, and the option that states that it is a GNU linker: rust-lld or that of Debian.
pub(crate) fn thumb_linker() -> Option<Vec<String>> {
    let roots = [sysroot("rustc"), debian_sysroot()];
    let lld = roots.into_iter().flatten().find_map(|root| lld(&root));
    let lld = lld.map(|lld| vec![lld.display().to_string(), "-flavor".to_owned(), "gnu".to_owned()]);
    lld.or_else(|| is_in_path("arm-none-eabi-ld").then(|| vec!["arm-none-eabi-ld".to_owned()]))
}

/// `lib/rustlib/HOST/bin/rust-lld` of a toolchain.
fn lld(sysroot: &Path) -> Option<PathBuf> {
    let hosts = std::fs::read_dir(sysroot.join("lib/rustlib")).into_iter().flatten().flatten();
    hosts.into_iter().find_map(|host| {
        let programs = host.path().join("bin");
        ["rust-lld", "rust-lld.exe"].iter().map(|name| programs.join(name)).find(|path| path.is_file())
    })
}

fn sysroot(rustc: &str) -> Option<PathBuf> {
    let output = output(Command::new(rustc).args(["--print", "sysroot"]))?;
    Some(PathBuf::from(String::from_utf8(output.stdout).ok()?.trim()))
}

fn succeeds(command: &mut Command) -> bool {
    output(command).is_some()
}

/// What a program that ended well has said.
fn output(command: &mut Command) -> Option<Output> {
    let output = command.current_dir(root()).stdin(Stdio::null()).output().ok()?;
    output.status.success().then_some(output)
}

fn is_in_path(name: &str) -> bool {
    let folders = env::var_os("PATH").unwrap_or_default();
    let endings = if cfg!(windows) { &["exe", "cmd"][..] } else { &[""] };
    env::split_paths(&folders)
        .any(|folder| endings.iter().any(|ending| folder.join(name).with_extension(ending).is_file()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What every Unix has represents programs that hang, fail and end well.
    #[test]
    #[cfg(unix)]
    fn a_program_that_does_not_end_is_stopped() {
        let start = |text: &str| Command::new("sh").args(["-c", text]).spawn().unwrap();
        let begun = Instant::now();
        assert!(!ends_well(start("exec sleep 60"), Duration::from_millis(100)));
        assert!(begun.elapsed() < Duration::from_secs(30));
        assert!(ends_well(start("exit 0"), Duration::from_secs(30)));
        assert!(!ends_well(start("exit 1"), Duration::from_secs(30)));
    }

    #[test]
    #[cfg(unix)]
    fn programs_are_found_in_the_path() {
        assert!(is_in_path("sh"));
        assert!(!is_in_path("no-program-has-this-name"));
    }
}
