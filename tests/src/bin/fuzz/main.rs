//! Tries mutants of EDS, DCF, XDD and XDC files, specifications, settings and templates: `cargo xtask help fuzz`.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command talks to its user")]

mod arguments;
#[cfg(test)]
mod growth;
mod seeds;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use arguments::{Options, Texts};
use od_tests::fuzz::{
    Caught, EdsFiles, Hunt, Outcome, Seed, Settings, Specifications, Subject, TemplateFiles, Used, XddFiles,
    hunt,
};
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
    let mut caught = 0;
    for texts in Texts::ALL.into_iter().filter(|texts| options.texts.is_none_or(|wanted| wanted == *texts)) {
        let time = if options.texts.is_some() { options.time } else { options.time * texts.share() / 100 };
        caught += hunted(texts, time, options)?;
    }
    if caught == 0 { Ok(()) } else { Err("a mutant does not meet what is demanded of every text".into()) }
}

/// How many mutants of these texts fail.
fn hunted(texts: Texts, time: Duration, options: &Options) -> Result<usize, Failure> {
    let (subject, seeds): (Box<dyn Subject>, Vec<Seed>) = match texts {
        Texts::Eds => (Box::new(EdsFiles::new(meter)), seeds::eds(&options.paths)?),
        Texts::Xdd => (Box::new(XddFiles), seeds::xdd(&options.paths)?),
        Texts::Specifications => {
            (Box::new(Specifications::new(meter)?), seeds::specifications(&options.paths)?)
        }
        Texts::Settings => {
            let settings = Settings::new()?;
            let seeds = settings.seeds();
            (Box::new(settings), seeds)
        }
        Texts::Templates => (Box::new(TemplateFiles::new()?), TemplateFiles::seeds()),
    };
    let word = texts.word();
    println!("{word}: {} seeds, mutants from {}", seeds.len(), options.seed);
    // What panics is reported with its mutant; the usual report would be between the lines.
    std::panic::set_hook(Box::new(|_| {}));
    let plan = Hunt {
        seeds: &seeds,
        first: options.seed,
        time,
        mutants: options.mutants,
        failures: options.failures,
        patience: PATIENCE,
    };
    let Outcome { tried, caught } = hunt(&*subject, plan, stuck);
    drop(std::panic::take_hook());
    println!("{word}: {tried} mutants, {} failures", caught.len());
    for (at, one) in caught.iter().enumerate() {
        let path = write(&format!("{}-{at}", one.number), &one.name, &one.bytes)?;
        let Caught { number, complaint, .. } = one;
        println!(
            "--of {word} --seed {number}: {}: {}\n    smallest: {}",
            complaint.step,
            complaint.what,
            path.display()
        );
    }
    Ok(caught.len())
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
    let path = directory.join(format!("{stem}-{}", name.replace('/', "-")));
    std::fs::write(&path, bytes)?;
    Ok(path)
}
