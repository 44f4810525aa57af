//! What cppcheck finds by the rules of MISRA C:2012 in generated C: no rule is broken more often than a list says, which the book explains.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;

use od_tests::c_dictionary::write;
use od_tests::{Failure, root};

use crate::runner::Runner;

/// Lines with a rule and how often it is broken.
const COUNTS: &str = "tests/c/misra.txt";
/// A device with values of many kinds.
const DEVICE: &str = "tests/c/valve.od.yaml";

/// Compares what is found with the list.
pub(crate) fn try_all(runner: &mut Runner) -> Result<(), Failure> {
    let directory = root().join("target/misra");
    let _ = std::fs::remove_dir_all(&directory);
    let written = write(DEVICE, &directory)?;
    let [device] = written.devices.as_slice() else {
        return Err(format!("{DEVICE} has several devices").into());
    };
    let c = directory.join("c");
    let found = counts(
        &[c.join("od_runtime.c"), c.join(device).join(format!("{device}_od.c"))],
        &[c.clone(), c.join(device)],
    )?;
    let text = std::fs::read_to_string(root().join(COUNTS))?;
    let known = text.lines().filter(|line| !line.starts_with('#')).filter_map(|line| line.split_once(' '));
    let known: BTreeMap<String, usize> =
        known.filter_map(|(rule, count)| Some((rule.to_owned(), count.trim().parse().ok()?))).collect();
    if known.is_empty() {
        return Err(format!("{COUNTS} lists nothing").into());
    }
    let mut more = Vec::new();
    for (rule, count) in &found {
        let most = known.get(rule).copied().unwrap_or_default();
        if *count > most {
            more.push(format!("rule {rule}: {count}, at most {most}"));
        }
    }
    for (rule, most) in &known {
        let count = found.get(rule).copied().unwrap_or_default();
        if count < *most {
            runner.print(&format!("rule {rule}: {count}, and {COUNTS} says {most}: lower it"));
        }
    }
    if more.is_empty() { Ok(()) } else { Err(format!("{COUNTS}: {}", more.join("; ")).into()) }
}

/// How often each rule is broken in some files and what they include.
fn counts(files: &[PathBuf], folders: &[PathBuf]) -> Result<BTreeMap<String, usize>, Failure> {
    let mut command = Command::new("cppcheck");
    command.args(["--std=c99", "--addon=misra", "--quiet", "--template={id}"]);
    for folder in folders {
        command.arg("-I").arg(folder);
    }
    let output = command.args(files).output().map_err(|error| format!("{command:?}: {error}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    let mut counts = BTreeMap::new();
    for rule in said.lines().filter_map(|line| line.trim().strip_prefix("misra-c2012-")) {
        *counts.entry(rule.to_owned()).or_default() += 1;
    }
    if counts.is_empty() {
        return Err(format!("{command:?} finds nothing at all: {said}").into());
    }
    Ok(counts)
}
