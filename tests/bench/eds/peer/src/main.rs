//! `read-eds time FILE ROUNDS STEP…`: a line `STEP SECONDS` for each step of each round, the steps in turn.
//! `read-eds once FILE STEP`: does one step once, and prints the largest resident set in kB (Linux).
//! `read-eds make SPEC EDS`: writes the EDS of a specification.

mod steps;

use std::fs;
use std::process::ExitCode;

use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};
use steps::Step;

const USAGE: &str = "read-eds time FILE ROUNDS STEP… | read-eds once FILE STEP | read-eds make SPEC EDS";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match arguments[..] {
        ["time", file, rounds, ref names @ ..] => time(file, rounds, names),
        ["once", file, name] => once(file, name),
        ["make", spec, eds] => make(spec, eds),
        _ => Err(USAGE.to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}

fn time(file: &str, rounds: &str, names: &[&str]) -> Result<(), String> {
    let bytes = read(file)?;
    let rounds: usize = rounds.parse().map_err(|_| USAGE.to_owned())?;
    let steps = names.iter().map(|name| step(name)).collect::<Result<Vec<_>, _>>()?;
    for round in 0..rounds {
        // The first one finds the machine as the last one left it; so each comes first in turn.
        for at in 0..steps.len() {
            let step = steps[(at + round) % steps.len()];
            let (time, _) = step.run(&bytes).map_err(|problem| format!("{}: {problem}", step.name()))?;
            println!("{} {:.9}", step.name(), time.as_secs_f64());
        }
    }
    Ok(())
}

fn once(file: &str, name: &str) -> Result<(), String> {
    let bytes = read(file)?;
    step(name)?.run(&bytes)?;
    let status = read("/proc/self/status").unwrap_or_default();
    let status = String::from_utf8_lossy(&status);
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    println!("{}", peak.map_or("", |peak| peak.trim_end_matches("kB").trim()));
    Ok(())
}

fn make(spec: &str, eds: &str) -> Result<(), String> {
    let text = String::from_utf8(read(spec)?).map_err(|error| error.to_string())?;
    let mut sources = SourceMap::new();
    let root = sources.add(spec, text);
    let system = compile(&mut sources, root, &mut NoFiles).system.ok_or("the specification has errors")?;
    let device = system.devices.first().ok_or("the specification has no device")?;
    fs::write(eds, od_formats::eds::write_eds(&system, device)).map_err(|error| format!("{eds}: {error}"))
}

fn read(file: &str) -> Result<Vec<u8>, String> {
    fs::read(file).map_err(|error| format!("{file}: {error}"))
}

fn step(name: &str) -> Result<Step, String> {
    let known = Step::ALL.into_iter().find(|step| step.name() == name);
    known.ok_or_else(|| format!("no step `{name}`"))
}
