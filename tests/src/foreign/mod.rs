//! Takes an EDS or DCF that others wrote through everything that the project does with one, and tells what went wrong.

mod exceptions;
mod facts;
mod steps;

use std::any::Any;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

pub use exceptions::unused as unused_exceptions;
pub use facts::{Difference, Stated, differences};

/// What is done with a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Step {
    /// Bytes to text, text to lines, and back.
    Bytes,
    /// Compiling it as a foreign file, and as one that is held to the standard.
    Reading,
    /// Importing it; the EDS of the import has the same facts.
    Import,
    /// Importing that EDS gives the same specification.
    Again,
    /// Putting it right; the result has the same facts.
    Fixing,
}

impl Step {
    /// All steps in order.
    pub const ALL: [Self; 5] = [Self::Bytes, Self::Reading, Self::Import, Self::Again, Self::Fixing];
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Step::Bytes => "bytes",
            Step::Reading => "reading",
            Step::Import => "import",
            Step::Again => "import again",
            Step::Fixing => "fix",
        })
    }
}

/// Something that is not as it has to be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Where.
    pub step: Step,
    /// What, in a line.
    pub what: String,
}

/// How many findings of each severity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Findings {
    /// Errors of the file as the standard takes it.
    pub errors: usize,
    /// Warnings.
    pub warnings: usize,
    /// Notes.
    pub notes: usize,
}

/// What became of a file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Checked {
    /// What is wrong, by step.
    pub problems: Vec<Problem>,
    /// Findings when it is held to the standard.
    pub findings: Findings,
    /// Changes that put it right.
    pub changes: usize,
    /// Reasons of the differences that are as they should be, each with their number.
    pub excepted: Vec<(&'static str, usize)>,
}

impl Checked {
    /// Whether a step is without a problem.
    pub fn passed(&self, step: Step) -> bool {
        self.problems.iter().all(|problem| problem.step != step)
    }

    fn problem(&mut self, step: Step, what: impl Into<String>) {
        self.problems.push(Problem { step, what: what.into() });
    }
}

/// Takes a file through everything. A panic is a problem of the step that it is in.
pub fn check(name: &str, bytes: &[u8]) -> Checked {
    let mut checked = Checked::default();
    for step in Step::ALL {
        let mut part = Checked::default();
        let outcome = catch_unwind(AssertUnwindSafe(|| steps::run(step, name, bytes, &mut part)));
        checked.problems.append(&mut part.problems);
        checked.excepted.append(&mut part.excepted);
        checked.changes += part.changes;
        if step == Step::Reading {
            checked.findings = part.findings;
        }
        if let Err(panic) = outcome {
            checked.problem(step, format!("panicked: {}", message(panic.as_ref())));
        }
    }
    checked
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a message")
}
