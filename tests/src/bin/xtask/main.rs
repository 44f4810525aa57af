//! The project's own tasks: `cargo xtask help` lists them.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command talks to its user")]

mod arguments;
mod browser;
mod configured;
mod corpus;
mod english;
mod form;
mod hostile;
mod installed;
mod manuals;
mod misra;
mod package;
mod parts;
mod plain_c;
mod readers;
mod runner;
mod rust_tests;
mod summary;
mod tools;
mod virtual_nodes;
mod web;
mod workbench;

use std::collections::BTreeSet;
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use arguments::{Choice, Gaps, Task, TestOptions, parse};
use od_tests::{Failure, generate};
use parts::{Area, PARTS, Part, Readiness, Tier, Turn};
use runner::{Output, Runner};
use summary::{Outcome, Row, Verdict};
use tools::Tool;

/// The command line cannot be understood.
const USAGE: u8 = 2;

/// How many parts run at the same time as those of cargo: a browser and an emulator wait for each other's answers half of the time.
const BESIDE: usize = 2;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match parse(&arguments) {
        Ok(Task::Check) => {
            return test(&in_tier(|tier| tier == Tier::Check), Gaps::Refused, &BTreeSet::new());
        }
        Ok(Task::Test(TestOptions { choice, gaps, unwanted })) => {
            return test(&chosen(&choice), gaps, &unwanted);
        }
        Ok(Task::Generate) => write(),
        Ok(Task::CheckGenerated) => check(),
        Ok(Task::Corpus(directory, every)) => corpus::corpus(&directory, every),
        Ok(Task::Fuzz(rest)) => fuzz(&rest),
        Ok(Task::Bench(rest)) => bench("tests/bench/run.py", &rest),
        Ok(Task::BenchReading(rest)) => bench("tests/bench/eds/reading.py", &rest),
        Ok(Task::Web) => web::build(&mut Runner::default()).map(drop),
        Ok(Task::Help(text)) => {
            print!("{text}");
            Ok(())
        }
        Err(problem) => {
            eprint!("error: {problem}\n\n{}", arguments::HELP);
            return ExitCode::from(USAGE);
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

fn fuzz(arguments: &[String]) -> Result<(), Failure> {
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    Runner::default().fuzz(&arguments)
}

fn bench(script: &str, arguments: &[String]) -> Result<(), Failure> {
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    Runner::default().python(script, &arguments)
}

/// The parts of the tiers that are wanted.
fn in_tier(is_wanted: impl Fn(Tier) -> bool) -> Vec<&'static Part> {
    PARTS.iter().filter(|part| is_wanted(part.tier)).collect()
}

/// The parts that a command line chooses.
fn chosen(choice: &Choice) -> Vec<&'static Part> {
    match choice {
        Choice::Gate => in_tier(|tier| matches!(tier, Tier::Check | Tier::Gate)),
        Choice::Long => in_tier(|tier| matches!(tier, Tier::Long(_))),
        Choice::Named(names) => {
            PARTS.iter().filter(|part| names.iter().any(|name| name == part.name)).collect()
        }
    }
}

/// Runs every part that can run, and reports what became of each.
fn test(parts: &[&'static Part], gaps: Gaps, unwanted: &BTreeSet<Area>) -> ExitCode {
    let (left_out, parts): (Vec<_>, Vec<_>) =
        parts.iter().copied().partition(|part| unwanted.contains(&part.area));
    let found = find_tools(&parts);
    let missing = summary::missing(&parts, &found);
    if !missing.is_empty() {
        println!("missing on this machine; what needs it is left out, the rest runs:\n{missing}");
    }
    let mut rows = run_all(&parts, &found);
    rows.extend(left_out.into_iter().map(|part| Row {
        part,
        outcome: Outcome::Unwanted,
        counts: None,
        time: Duration::ZERO,
    }));
    rows.sort_by_key(|row| row.part.position());
    let summary = summary::summarize(&rows, &missing, gaps);
    print!("{}", summary.text);
    match summary.verdict {
        Verdict::Passed => ExitCode::SUCCESS,
        Verdict::Failed => ExitCode::FAILURE,
    }
}

/// The tools of this machine; where only the firmware's target is missing for its tests, rustup is asked for it.
fn find_tools(parts: &[&Part]) -> BTreeSet<Tool> {
    let mut found = tools::found();
    let wanted = parts.iter().any(|part| part.area == Area::Firmware);
    if wanted && found.contains(&Tool::Python) && !found.contains(&Tool::ThumbTarget) {
        println!("adding Rust's target for the firmware with rustup");
        if tools::add_target() {
            found.insert(Tool::ThumbTarget);
        }
    }
    found
}

/// Runs the parts: those of cargo one after the other, and at the same time, and then instead of them, the others; what waits most of the
/// time has a place of its own.
fn run_all(parts: &[&'static Part], found: &BTreeSet<Tool>) -> Vec<Row> {
    let of = |turn: Turn| parts.iter().copied().filter(move |part| part.turn == turn);
    prepare(parts);
    let beside = Mutex::new(of(Turn::Beside));
    let run_beside = |done: &mut dyn FnMut((Row, Output))| {
        // The lock is given back before the part runs.
        let next = || beside.lock().ok()?.next();
        while let Some(part) = next() {
            done(run(part, found, Output::Kept(Vec::new())));
        }
    };
    let (done, ended) = std::sync::mpsc::channel();
    std::thread::scope(|scope| {
        // There is no listener only when the other thread has panicked.
        let waiting = done.clone();
        scope.spawn(move || {
            for part in of(Turn::Waiting) {
                drop(waiting.send(run(part, found, Output::Kept(Vec::new()))));
            }
        });
        for _ in 0..BESIDE {
            let done = done.clone();
            let run_beside = &run_beside;
            scope.spawn(move || run_beside(&mut |row| drop(done.send(row))));
        }
        drop(done);
        let mut rows: Vec<Row> = of(Turn::First).map(|part| print(run(part, found, Output::Shown))).collect();
        run_beside(&mut |row| rows.push(print(row)));
        rows.extend(ended.iter().map(print));
        rows
    })
}

/// Compiles what the parts run, and installs what they need from registries at the same time. The parts themselves report what is wrong.
fn prepare(parts: &[&Part]) {
    let begin = Instant::now();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            for script in parts.iter().filter_map(|part| part.installer).collect::<BTreeSet<_>>() {
                let _ = Runner { output: Output::Kept(Vec::new()), ..Runner::default() }
                    .python(script, &["--install"]);
            }
        });
        let _ = rust_tests::compile(&mut Runner::default(), parts);
    });
    println!("compiled and installed in {}", summary::time(begin.elapsed()));
}

/// Prints what was kept of a part.
fn print((row, output): (Row, Output)) -> Row {
    if let Output::Kept(text) = output {
        print!("{}", String::from_utf8_lossy(&text));
    }
    row
}

fn run(part: &'static Part, found: &BTreeSet<Tool>, output: Output) -> (Row, Output) {
    let mut runner = Runner { output, ..Runner::default() };
    let begin = Instant::now();
    let readiness = part.readiness(found);
    let reason = summary::reason(&readiness);
    let outcome = if matches!(readiness, Readiness::Lacks(_)) {
        Outcome::LeftOut(reason.unwrap_or_default())
    } else {
        runner.print(&format!("\n== {}", part.title));
        match (part.run)(&mut runner) {
            Err(failure) => {
                runner.print(&format!("error: {failure}"));
                Outcome::Failed(failure.to_string())
            }
            Ok(()) => match reason.or(runner.gap) {
                None => Outcome::Passed,
                Some(gap) => Outcome::Partly(gap),
            },
        }
    };
    (Row { part, outcome, counts: runner.counts, time: begin.elapsed() }, runner.output)
}

fn write() -> Result<(), Failure> {
    for (path, changed) in generate::write_all()? {
        println!("{} {path}", if changed { "wrote" } else { "     " });
    }
    for path in generate::prune()? {
        println!("removed {path}");
    }
    Ok(())
}

fn check() -> Result<(), Failure> {
    if let Some(difference) = generate::first_difference(generate::all()?) {
        return Err(difference.into());
    }
    match generate::left()?.first() {
        None => Ok(()),
        Some(path) => Err(format!("nothing makes {path} any more\nrun `cargo xtask generate`").into()),
    }
}
