//! What is missing, before the tests; what passed, failed and was left out, after them.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::time::Duration;

use crate::arguments::Gaps;
use crate::parts::{Area, Part, Readiness, needed_for};
use crate::runner::Counts;
use crate::tools::Tool;

/// What became of a part.
#[derive(Debug)]
pub(crate) enum Outcome {
    Passed,
    /// What ran has passed; what did not run, and why.
    Partly(String),
    Failed(String),
    LeftOut(String),
    /// The user did not want it.
    Unwanted,
}

/// A part, and what became of it.
#[derive(Debug)]
pub(crate) struct Row {
    pub(crate) part: &'static Part,
    pub(crate) outcome: Outcome,
    /// What its programs counted.
    pub(crate) counts: Option<Counts>,
    /// How long it ran.
    pub(crate) time: Duration,
}

/// What is to be said at the end.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Summary {
    pub(crate) text: String,
    pub(crate) verdict: Verdict,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    Passed,
    Failed,
}

/// The tools that wanted parts lack, each with what needs it and what installs it; empty when nothing is missing.
pub(crate) fn missing(parts: &[&Part], found: &BTreeSet<Tool>) -> String {
    let mut text = String::new();
    for tool in Tool::ALL.into_iter().filter(|tool| !found.contains(tool)) {
        let areas = needed_for(tool, parts);
        if areas.is_empty() {
            continue;
        }
        let areas: Vec<&str> = areas.into_iter().map(Area::title).collect();
        let _ = writeln!(text, "  {}, for {}:", tool.name(), areas.join(", "));
        let lines = tool.install().iter().map(|line| format!("      {line}\n"));
        text.push_str(&lines.collect::<Vec<_>>().join("    or\n"));
    }
    text
}

/// Why a part is not ready; `None` when it is.
pub(crate) fn reason(readiness: &Readiness) -> Option<String> {
    let names = |tools: &[Tool]| tools.iter().map(|tool| tool.name()).collect::<Vec<_>>().join("; ");
    match readiness {
        Readiness::Whole => None,
        Readiness::Partly(tools) | Readiness::Lacks(tools) => Some(format!("missing: {}", names(tools))),
    }
}

/// How long something took: minutes, or seconds where it is less than one.
pub(crate) fn time(time: Duration) -> String {
    if time.as_secs() < 60 {
        format!("{} s", time.as_secs())
    } else {
        format!("{:.1} min", time.as_secs_f64() / 60.0)
    }
}

/// A line for each part, what to install for the rest, and the numbers.
pub(crate) fn summarize(rows: &[Row], missing: &str, gaps: Gaps) -> Summary {
    let mut text = String::from("\n== summary\n");
    let (mut passed, mut failed, mut left_out) = (0, 0, 0);
    for row in rows {
        let (word, why) = match &row.outcome {
            Outcome::Passed => ("passed", None),
            Outcome::Partly(why) => ("in part", Some(why.as_str())),
            Outcome::Failed(why) => ("FAILED", Some(why.as_str())),
            Outcome::LeftOut(why) => ("left out", Some(why.as_str())),
            Outcome::Unwanted => ("left out", Some("not wanted")),
        };
        match &row.outcome {
            Outcome::Passed => passed += 1,
            Outcome::Failed(_) => failed += 1,
            Outcome::Partly(_) | Outcome::LeftOut(_) | Outcome::Unwanted => left_out += 1,
        }
        let counts = row.counts.map(|counts| format!("{} passed, {} failed", counts.passed, counts.failed));
        let time = (row.time.as_secs() > 0).then(|| time(row.time));
        let facts: Vec<&str> = counts.as_deref().into_iter().chain(time.as_deref()).chain(why).collect();
        let line = format!("{word:<8}  {:<40}  {}", row.part.title, facts.join("; "));
        let _ = writeln!(text, "{}", line.trim_end());
    }
    if !missing.is_empty() {
        let _ = write!(text, "\nmissing on this machine:\n{missing}");
    }
    let refused = gaps == Gaps::Refused && left_out > 0;
    if refused {
        text.push_str("\nerror: nothing may be left out\n");
    }
    let _ = write!(
        text,
        "\nparts of the tests: {left_out} left out or run in part\n{passed} passed, {failed} failed\n"
    );
    Summary { text, verdict: if failed > 0 || refused { Verdict::Failed } else { Verdict::Passed } }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parts::{PARTS, named};

    fn all() -> Vec<&'static Part> {
        PARTS.iter().collect()
    }

    /// As the tests would go on a machine that has these tools, when all that runs passes.
    fn rows(found: &BTreeSet<Tool>) -> Vec<Row> {
        let row = |part: &'static Part| {
            let readiness = part.readiness(found);
            let why = reason(&readiness).unwrap_or_default();
            let outcome = match readiness {
                Readiness::Whole => Outcome::Passed,
                Readiness::Partly(_) => Outcome::Partly(why),
                Readiness::Lacks(_) => Outcome::LeftOut(why),
            };
            Row { part, outcome, counts: None, time: Duration::ZERO }
        };
        all().into_iter().map(row).collect()
    }

    fn summary(found: &[Tool], gaps: Gaps) -> Summary {
        let found = found.iter().copied().collect();
        summarize(&rows(&found), &missing(&all(), &found), gaps)
    }

    #[test]
    fn a_machine_with_rust_alone_passes_and_says_what_was_left_out() {
        let Summary { text, verdict } = summary(&[], Gaps::Reported);
        assert_eq!(verdict, Verdict::Passed, "{text}");
        assert!(text.contains("passed    Rust tests\n"), "{text}");
        assert!(
            text.contains("left out  SDO client                                missing: Python"),
            "{text}"
        );
        for tool in Tool::ALL {
            assert!(text.contains(&format!("  {}, for the ", tool.name())), "{tool:?}: {text}");
            assert!(tool.install().iter().all(|line| text.contains(&format!("      {line}\n"))), "{text}");
        }
        let passed = PARTS.iter().filter(|part| part.area == Area::Rust).count();
        let left_out = PARTS.len() - passed;
        let end =
            format!("parts of the tests: {left_out} left out or run in part\n{passed} passed, 0 failed\n");
        assert!(text.ends_with(&end), "{text}");
    }

    #[test]
    fn a_machine_without_node_reads_with_the_other_readers() {
        let found: Vec<Tool> = Tool::ALL.into_iter().filter(|&tool| tool != Tool::Node).collect();
        let Summary { text, verdict } = summary(&found, Gaps::Reported);
        assert_eq!(verdict, Verdict::Passed);
        let line = "in part   EDS readers: shipped devices              missing: Node.js";
        assert!(text.contains(line), "{text}");
        assert!(
            text.contains("with npm, for the foreign readers of EDS files, the documents in a browser:\n")
        );
    }

    #[test]
    fn where_gaps_are_refused_nothing_may_be_left_out() {
        assert_eq!(summary(&Tool::ALL, Gaps::Refused).verdict, Verdict::Passed);
        let Summary { text, verdict } = summary(&Tool::ALL[..7], Gaps::Refused);
        assert_eq!(verdict, Verdict::Failed);
        assert!(text.contains("error: nothing may be left out"), "{text}");
        let line = "left out  firmware in an emulator                   missing: qemu-system-arm";
        assert!(text.contains(line), "{text}");
        assert!(!text.contains("Chromium"), "{text}");
    }

    #[test]
    fn a_failure_fails_and_counts_and_time_are_in_its_line() {
        let found = Tool::ALL.into_iter().collect();
        let mut rows = rows(&found);
        let row = rows.iter_mut().find(|row| row.part.name == "rust").unwrap();
        row.outcome = Outcome::Failed("`cargo test` failed (exit status: 101)".to_owned());
        row.counts = Some(Counts { passed: 600, failed: 2 });
        row.time = Duration::from_secs(150);
        let Summary { text, verdict } = summarize(&rows, "", Gaps::Reported);
        assert_eq!(verdict, Verdict::Failed);
        let line = "FAILED    Rust tests                                600 passed, 2 failed; 2.5 min; `cargo test` failed (exit";
        assert!(text.contains(line), "{text}");
        assert!(text.ends_with(&format!("\n{} passed, 1 failed\n", PARTS.len() - 1)), "{text}");
    }

    #[test]
    fn tools_that_no_wanted_part_needs_are_not_asked_for() {
        let missing = |name| missing(&[named(name).unwrap()], &BTreeSet::new());
        let text = missing("browser");
        assert!(text.contains("Chromium") && !text.contains("qemu"), "{text}");
        assert_eq!(missing("rust"), "");
    }
}
