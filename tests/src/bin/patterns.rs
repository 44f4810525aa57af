//! Writes specifications with something in them so many times, for measurements: `patterns DIRECTORY NUMBER...`.

#![expect(clippy::print_stderr, reason = "a command talks to its user")]

use std::path::Path;
use std::process::ExitCode;

use od_tests::Failure;
use od_tests::patterns::{RIGHT, WRONG};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match write(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn write(arguments: &[String]) -> Result<(), Failure> {
    let (directory, numbers) = arguments.split_first().ok_or("no directory is named")?;
    for number in numbers {
        let n = number.parse()?;
        for (set, patterns) in [("right", RIGHT), ("wrong", WRONG)] {
            for pattern in patterns {
                let name = format!("{set} {}.{n}.od.yaml", pattern.name);
                std::fs::write(Path::new(directory).join(name), (pattern.make)(n))?;
            }
        }
    }
    Ok(())
}
