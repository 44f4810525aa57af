//! The stable code of a kind of message, with everything that `odgen explain` prints about it.

use std::cmp::Ordering;
use std::fmt;

use super::{Severity, commissioning};

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
    /// A text that is wrong, and the same one corrected.
    pub example: Option<Example>,
}

/// Two short texts: one that a rule refuses, and one that it accepts. Lines that every such text has are left out; see
/// [`Language::whole`].
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct Example {
    /// What the texts are.
    pub language: Language,
    /// What the rule refuses.
    pub before: &'static str,
    /// The same, corrected.
    pub after: &'static str,
}

/// What the texts of an example are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// A specification.
    Specification,
    /// An EDS.
    Eds,
    /// A DCF.
    Dcf,
    /// A parameter file for the drive of [`Example::DEVICES`].
    Parameters,
    /// A plant with devices of [`Example::DEVICES`].
    Plant,
    /// An XDD.
    Xdd,
    /// A concise DCF: its bytes as hexadecimal digits, with remarks after `#`.
    Concise,
}

impl Language {
    /// The name under which the text is highlighted in Markdown.
    pub const fn highlighting(self) -> &'static str {
        match self {
            Language::Specification | Language::Parameters | Language::Plant => "yaml",
            Language::Eds | Language::Dcf => "ini",
            Language::Xdd => "xml",
            Language::Concise => "text",
        }
    }

    /// The name of a file with such a text.
    pub const fn file_name(self) -> &'static str {
        match self {
            Language::Specification => "example.od.yaml",
            Language::Eds => "example.eds",
            Language::Dcf => "example.dcf",
            Language::Parameters => "parameters.yaml",
            Language::Plant => "plant.yaml",
            Language::Xdd => "example.xdd",
            Language::Concise => "example.bin",
        }
    }

    /// A text of an example as a whole one, with everything that such a text has.
    pub fn whole(self, text: &str) -> String {
        match self {
            Language::Specification => whole_specification(text),
            Language::Eds | Language::Dcf => crate::eds::example::whole(self, text),
            Language::Parameters => commissioning::parameters(text),
            Language::Plant => commissioning::plant(text),
            Language::Xdd => commissioning::xdd(text),
            Language::Concise => text.to_owned(),
        }
    }
}

impl Example {
    /// The two specifications of an example.
    pub(crate) const fn new(before: &'static str, after: &'static str) -> Self {
        Self { language: Language::Specification, before, after }
    }

    /// The two EDS texts of an example.
    pub(crate) const fn eds(before: &'static str, after: &'static str) -> Self {
        Self { language: Language::Eds, before, after }
    }

    /// The two DCF texts of an example.
    pub(crate) const fn dcf(before: &'static str, after: &'static str) -> Self {
        Self { language: Language::Dcf, before, after }
    }

    /// The two parameter files of an example.
    pub(crate) const fn parameters(before: &'static str, after: &'static str) -> Self {
        Self { language: Language::Parameters, before, after }
    }

    /// The two plants of an example.
    pub(crate) const fn plant(before: &'static str, after: &'static str) -> Self {
        Self { language: Language::Plant, before, after }
    }

    /// The two XDD texts of an example.
    pub(crate) const fn xdd(before: &'static str, after: &'static str) -> Self {
        Self { language: Language::Xdd, before, after }
    }

    /// The two concise DCFs of an example.
    pub(crate) const fn concise(before: &'static str, after: &'static str) -> Self {
        Self { language: Language::Concise, before, after }
    }
}

/// With a version, a title, and a device where the text has none.
fn whole_specification(text: &str) -> String {
    let has = |key: &str| text.lines().any(|line| line.starts_with(key));
    let mut whole = String::from("od-spec: 1\ntitle: Example\n");
    if !has("uses:") {
        whole.push_str("uses: [cia301]\n");
    }
    if !has("devices:") {
        whole.push_str("devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer]}\n");
    }
    whole.push_str(text);
    whole.push('\n');
    whole
}

impl Code {
    /// Whether it is about what a text says of a device, and not about how it is written: the series of codes differ in that.
    pub fn is_about_facts(&self) -> bool {
        ["EDS40", "EDS41", "EDS5", "OD", "XDD2"].iter().any(|series| self.id.starts_with(series))
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
