//! The project's own tasks: `cargo xtask help` lists them.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command talks to its user")]

use std::process::{Command, ExitCode};

use od_gen::files::write_all;
use od_gen::{Selection, artifacts};
use od_tests::{Failure, compile_clean, generate, root};

const HELP: &str = "\
cargo xtask TASK

  test               run every test; puts what the foreign readers need into target/
  generate [--check] rewrite everything that is generated and checked in, or tell what is not current
  bench              measure odgen beside other tools
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match arguments.as_slice() {
        ["test"] => test(),
        ["generate"] => write(),
        ["generate", "--check"] => check(),
        ["bench", rest @ ..] => python("tests/bench/run.py", rest),
        ["help" | "--help"] => {
            print!("{HELP}");
            Ok(())
        }
        _ => {
            eprint!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}

/// All Rust tests, then the foreign readers.
fn test() -> Result<(), Failure> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    run(Command::new(cargo).args(["test", "--workspace", "--no-fail-fast"]))?;
    python("tests/readers/selftest/selftest.py", &[])?;
    // A device with every feature and data type, which the shipped devices do not have.
    let system = compile_clean("tests/readers/everything.od.yaml")?;
    let set = artifacts(&system, "everything", &Selection { devices: &[], node: Some(5) });
    write_all(&root().join("target/everything"), &set)?;
    let everything =
        ["--eds-dir", "target/everything/eds", "--dump", "target/everything/everything.json", "--node", "5"];
    python("tests/readers/run.py", &everything)?;
    python("tests/readers/run.py", &[])
}

fn write() -> Result<(), Failure> {
    for (path, changed) in generate::write_all()? {
        println!("{} {path}", if changed { "wrote" } else { "     " });
    }
    Ok(())
}

fn check() -> Result<(), Failure> {
    match generate::first_difference()? {
        None => Ok(()),
        Some(difference) => Err(difference.into()),
    }
}

fn python(script: &str, arguments: &[&str]) -> Result<(), Failure> {
    run(Command::new("python3").arg(script).args(arguments))
}

/// Runs a command at the root of the workspace.
fn run(command: &mut Command) -> Result<(), Failure> {
    let status =
        command.current_dir(root()).status().map_err(|error| format!("cannot run {command:?}: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?} failed ({status})").into()) }
}
