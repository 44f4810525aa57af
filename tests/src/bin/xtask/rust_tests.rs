//! The tests of the workspace's crates.

use od_tests::{Failure, LONG};

use crate::parts::{Part, Turn};
use crate::runner::{self, Runner};

/// The crate that takes longest to compile, and whose unit tests end in a moment: these are compiled in a profile of their own.
const LANGUAGE: &str = "od-spec";

/// Compiles before anything runs what several parts run: what is compiled replaces programs that others would be using.
pub(crate) fn compile(runner: &mut Runner, parts: &[&Part]) -> Result<(), Failure> {
    if parts.iter().any(|part| part.name == "rust") {
        runner.cargo(&["test", "--quiet", "--workspace", "--exclude", LANGUAGE, "--no-run"])
    } else if parts.iter().any(|part| part.turn != Turn::First) {
        runner.cargo(&["build", "--quiet", "--workspace", "--bins"])
    } else {
        Ok(())
    }
}

/// The tests in the folders of the sources.
pub(crate) fn unit(runner: &mut Runner) -> Result<(), Failure> {
    let all_others = ["test", "--quiet", "--workspace", "--exclude", LANGUAGE, "--lib", "--bins"];
    runner.cargo(&[&all_others[..], &["--no-fail-fast"]].concat())?;
    runner.cargo(&["test", "--quiet", "--profile", "unit", "--package", LANGUAGE, "--all-features", "--lib"])
}

/// The tests in folders of their own.
pub(crate) fn integration(runner: &mut Runner) -> Result<(), Failure> {
    // Those of commands wait for answers half of the time.
    runner.cargo(&["test", "--workspace", "--test", "*", "--no-fail-fast", "--", "--test-threads", "4"])
}

/// The examples in the documentation, and what of `firmware-glue` no other package asks for.
pub(crate) fn examples(runner: &mut Runner) -> Result<(), Failure> {
    runner.cargo(&["test", "--quiet", "--workspace", "--doc", "--no-fail-fast"])?;
    runner.cargo(&["test", "--quiet", "--package", "firmware-glue", "--all-features", "--no-fail-fast"])
}

/// The same tests, which try everything.
pub(crate) fn long(runner: &mut Runner) -> Result<(), Failure> {
    let mut command = runner::cargo();
    command.args([
        "test",
        "--quiet",
        "--workspace",
        "--exclude",
        LANGUAGE,
        "--lib",
        "--test",
        "*",
        "--no-fail-fast",
    ]);
    runner.run(command.env(LONG, "1").env("PROPTEST_CASES", "100"))
}
