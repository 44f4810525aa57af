//! Tries mutants of EDS and DCF files: `cargo xtask help fuzz`.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command talks to its user")]

mod arguments;
#[cfg(test)]
mod growth;
mod seeds;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use arguments::Options;
use od_tests::fuzz::{Caught, EdsFiles, Hunt, Outcome, Seed, Used, hunt};
use od_tests::{Failure, root};

/// The command line cannot be understood.
const USAGE: u8 = 2;
/// How long one mutant may take. The slowest take a second or two on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let options = match arguments::parse(&arguments) {
        Ok(options) => options,
        Err(problem) => {
            eprintln!("error: {problem}; `cargo xtask help fuzz` lists the arguments");
            return ExitCode::from(USAGE);
        }
    };
    match run(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), Failure> {
    let seeds = seeds::read(&options.paths)?;
    println!("{} seeds, mutants from {}", seeds.len(), options.seed);
    // What panics is told with its mutant; the usual report would stand between the lines.
    std::panic::set_hook(Box::new(|_| {}));
    let plan = Hunt {
        seeds: &seeds,
        first: options.seed,
        time: options.time,
        mutants: options.mutants,
        failures: options.failures,
        patience: PATIENCE,
    };
    let Outcome { tried, caught } = hunt(&EdsFiles::new(meter), plan, stuck);
    drop(std::panic::take_hook());
    println!("{tried} mutants, {} failures", caught.len());
    for (at, one) in caught.iter().enumerate() {
        let path = write(&format!("{}-{at}", one.number), &one.name, &one.bytes)?;
        let Caught { number, complaint, .. } = one;
        println!("--seed {number}: {}: {}\n    smallest: {}", complaint.step, complaint.what, path.display());
    }
    if caught.is_empty() {
        Ok(())
    } else {
        Err("a mutant does not meet what is demanded of every file".into())
    }
}

/// What a step uses of the heap, in the thread that runs it.
fn meter(step: &mut dyn FnMut()) -> Used {
    let info = allocation_counter::measure(step);
    Used { peak: info.bytes_max, total: info.bytes_total }
}

/// Ends the program: the thread cannot be ended alone.
fn stuck(number: u64, seed: &Seed) {
    let place = write(&number.to_string(), &seed.name, &seed.bytes)
        .map_or_else(|error| error.to_string(), |path| path.display().to_string());
    eprintln!("error: --seed {number} has taken more than {} s: {place}", PATIENCE.as_secs());
    std::process::exit(1);
}

fn write(stem: &str, name: &str, bytes: &[u8]) -> Result<PathBuf, Failure> {
    let directory = root().join("target/fuzz");
    std::fs::create_dir_all(&directory)?;
    let ending = name.rsplit('.').next().unwrap_or("eds");
    let path = directory.join(format!("{stem}.{ending}"));
    std::fs::write(&path, bytes)?;
    Ok(path)
}
