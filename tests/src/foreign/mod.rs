//! Takes an EDS, DCF, XDD or XDC that others wrote through everything that the project does with one, and reports what
//! went wrong.

mod comparing;
mod exceptions;
mod facts;
mod files;
mod steps;

use std::any::Any;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

pub use facts::{Difference, Stated, differences};
pub use files::{EDS, XDD, find};

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
    /// Comparing it with copies of itself in which one key has another value.
    Comparing,
}

impl Step {
    /// All steps in order.
    pub const ALL: [Self; 6] =
        [Self::Bytes, Self::Reading, Self::Import, Self::Again, Self::Fixing, Self::Comparing];

    /// Whether it is taken with an XDD: the others are about the lines of an EDS.
    const fn is_for_xdd(self) -> bool {
        match self {
            Self::Reading | Self::Import | Self::Again => true,
            Self::Bytes | Self::Fixing | Self::Comparing => false,
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Step::Bytes => "bytes",
            Step::Reading => "reading",
            Step::Import => "import",
            Step::Again => "import again",
            Step::Fixing => "fix",
            Step::Comparing => "compare",
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
    /// Changes that fix it.
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

/// Takes a file through everything that there is for its kind. A panic is a problem of the step that it is in.
pub fn check(name: &str, bytes: &[u8]) -> Checked {
    let mut checked = Checked::default();
    let is_xdd = files::is_xdd(name);
    for step in Step::ALL.into_iter().filter(|step| !is_xdd || step.is_for_xdd()) {
        guarded(step, &mut checked, |checked| steps::run(step, name, bytes, checked));
    }
    checked
}

/// Takes a step; a panic becomes a problem of it.
fn guarded(step: Step, checked: &mut Checked, run: impl FnOnce(&mut Checked)) {
    if let Err(panic) = catch_unwind(AssertUnwindSafe(|| run(checked))) {
        checked.problem(step, format!("panicked: {}", message(panic.as_ref())));
    }
}

pub(crate) fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a message")
}

#[cfg(test)]
mod tests {
    use od_spec::model::Dictionary;
    use od_spec::source::SourceMap;
    use od_spec::{NoFiles, compile};

    use super::*;

    /// The device of an EDS.
    pub(super) fn device(text: &str) -> Dictionary {
        let mut sources = SourceMap::new();
        let root = sources.add("lamp.eds", text);
        compile(&mut sources, root, &mut NoFiles).system.unwrap().devices.remove(0)
    }

    #[test]
    fn a_panic_is_a_problem_of_its_step() {
        let mut checked = Checked::default();
        guarded(Step::Fixing, &mut checked, |_| panic!("out of {}", "range"));
        assert_eq!(checked.problems[0].what, "panicked: out of range");
        assert!(!checked.passed(Step::Fixing) && checked.passed(Step::Import));
    }
}
