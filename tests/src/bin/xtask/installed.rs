//! The command as it is installed elsewhere: on Windows, and from a Python package.

use std::path::Path;
use std::process::Command;

use od_tests::{Failure, root};

use crate::runner::{self, Runner};
use crate::tools::WINDOWS_TARGET;

/// The builder of Python packages, as in `.github/workflows/release.yml`.
const MATURIN: &str = "maturin==1.16.0";

/// Builds the command and its tests for Windows, and runs the tests in Wine.
pub(crate) fn windows(runner: &mut Runner) -> Result<(), Failure> {
    let target = root().join("target/windows");
    std::fs::create_dir_all(target.join("tmp"))?;
    // Wine 8 and older lack this library. Newer ones have their own, which they find first.
    let mut library = Command::new("x86_64-w64-mingw32-gcc");
    library.args(["-shared", "-O1", "-o"]).arg(target.join("bcryptprimitives.dll"));
    runner.run(library.args(["tests/windows/process_prng.c", "-ladvapi32"]))?;
    // The tests name files of the workspace without a drive, so their own have to be on the same one.
    let mut temporary = Command::new("wine");
    temporary.args(["reg", "add", r"HKCU\Environment", "/f", "/v", "TMP", "/d"]);
    runner.run(in_wine(temporary.arg(on_drive(&target.join("tmp"))), &target))?;
    let mut tests = runner::cargo();
    tests.args(["test", "--quiet", "--package", "odgen", "--target", WINDOWS_TARGET, "--no-fail-fast", "--"]);
    // Wine finds no git.
    tests.args(["--skip", "diff::a_specification_is_compared_with_its_own_past"]);
    tests.env("CARGO_TARGET_X86_64_PC_WINDOWS_GNU_RUNNER", "wine");
    // Wine finds no cargo, which would say where the snapshots are.
    tests.env("INSTA_WORKSPACE_ROOT", root()).env("INSTA_UPDATE", "no");
    // Some imports of the tests are for other systems only, which is no error here.
    tests.env_remove("RUSTC_WORKSPACE_WRAPPER").env_remove("CARGO_BUILD_RUSTFLAGS");
    runner.run(in_wine(&mut tests, &target))
}

/// What Wine needs to know: its own folder, where the library is, and that nothing has to be downloaded.
fn in_wine<'c>(command: &'c mut Command, target: &Path) -> &'c mut Command {
    command.env("WINEPREFIX", target.join("prefix")).env("WINEPATH", on_drive(target));
    command.env("WINEDEBUG", "-all").env("WINEDLLOVERRIDES", "mscoree,mshtml=")
}

/// A path as Windows programs see it in Wine.
fn on_drive(path: &Path) -> String {
    format!("Z:{}", path.display())
}

/// Builds the Python package, installs it into an environment of its own, and runs the command from there.
pub(crate) fn wheel(runner: &mut Runner) -> Result<(), Failure> {
    let target = root().join("target/wheel");
    if target.exists() {
        std::fs::remove_dir_all(&target)?;
    }
    let programs = |environment: &str| target.join(environment).join("bin");
    for environment in ["builder", "user"] {
        runner.run(Command::new("python3").args(["-m", "venv"]).arg(target.join(environment)))?;
    }
    let mut install = Command::new(programs("builder").join("pip"));
    if runner.run(install.args(["install", "--quiet", MATURIN])).is_err() {
        runner.gap = Some(format!("pip cannot install {MATURIN}"));
        return Ok(());
    }
    let dist = target.join("dist");
    let mut build = Command::new(programs("builder").join("maturin"));
    build.args([
        "build",
        "--quiet",
        "--locked",
        "--profile",
        "dev",
        "--manifest-path",
        "od-gen/cli/Cargo.toml",
    ]);
    runner.run(build.args(["--target-dir", "target", "--out"]).arg(&dist))?;
    let mut install = Command::new(programs("user").join("pip"));
    runner.run(install.args(["install", "--quiet", "--no-index", "--find-links"]).arg(&dist).arg("odgen"))?;
    runner.run(Command::new(programs("user").join("odgen")).arg("--version"))
}
