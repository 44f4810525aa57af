//! The stable code of a kind of message, with everything that `odgen explain` prints about it.

use std::cmp::Ordering;
use std::fmt;

use super::Severity;

/// A kind of message. Two codes are the same when their ids are.
#[derive(Debug)]
#[non_exhaustive]
pub struct Code {
    /// The code as printed: `OD0301`. It never changes its meaning.
    pub id: &'static str,
    /// How serious it is in a specification, and in an EDS that is held to the standard.
    pub severity: Severity,
    /// How serious it is in an EDS that was written by others and is only read.
    pub foreign: Severity,
    /// What it is about, in a few words.
    pub title: &'static str,
    /// What is wrong, why it matters and what to do, in a few sentences.
    pub explanation: &'static str,
    /// The clause of the standard that the rule follows.
    pub clause: Option<&'static str>,
    /// A specification that is wrong, and the same one put right.
    pub example: Option<Example>,
}

/// Two short specifications: one that a rule refuses, and one that it accepts. Lines that every specification has are left
/// out; see [`Example::whole`].
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct Example {
    /// What the rule refuses.
    pub before: &'static str,
    /// The same, put right.
    pub after: &'static str,
}

impl Example {
    /// The two texts of an example.
    pub(crate) const fn new(before: &'static str, after: &'static str) -> Self {
        Self { before, after }
    }

    /// A text of an example as a whole specification: with a version, a title, and a device where the text has none.
    pub fn whole(text: &str) -> String {
        let has = |key: &str| text.lines().any(|line| line.starts_with(key));
        let mut whole = String::from("od-spec: 1\ntitle: Example\n");
        if !has("uses:") {
            whole.push_str("uses: [cia301]\n");
        }
        if !has("devices:") {
            whole.push_str(
                "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer]}\n",
            );
        }
        whole.push_str(text);
        whole.push('\n');
        whole
    }
}

impl PartialEq for Code {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for Code {}

impl PartialOrd for Code {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Code {
    fn cmp(&self, other: &Self) -> Ordering {
        self.id.cmp(other.id)
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id)
    }
}
