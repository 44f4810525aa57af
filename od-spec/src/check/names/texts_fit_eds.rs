//! A text or octet string that is written into an EDS or DCF is on one line and is read back as it is.

use std::ops::ControlFlow;

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Entry, Fact, Value};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0319",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a value that a line of an EDS cannot hold",
    explanation: "A string or octet string that an EDS or DCF shows is on one line of 255 characters, without quotes and in ASCII. Spaces at its ends \
        are lost, `;`, `#` and `=` are misread by several readers, an empty text reads as no value, and `$NODEID`, which is a formula of an integer alone, as \
        the node-ID: a PLC would write something else than what is meant. Choose another value, or withhold the default from the EDS with `eds: {default: withheld}`.",
    clause: Some("CiA 306, 4.2"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: label, type: visible-string, access: rw, default: a;b}",
        "objects:\n  0x2000: {name: label, type: visible-string, access: rw, default: a;b, eds: {default: withheld}}",
    )),
};

/// Longest line of an EDS (CiA 306 4.2).
const LINE: usize = 255;

/// Why a line with room for `longest` characters cannot hold a text: `has 250 characters, a line holds 246`.
pub(crate) fn problem(text: &str, longest: usize) -> Option<String> {
    let written = crate::ascii::transliterate(text);
    // Some characters are transcribed with others that readers misread: `≤` as `<=`.
    let unfit = text.chars().chain(written.chars()).try_for_each(|c| match unfit(c) {
        Some(unfit) => ControlFlow::Break(unfit),
        None => ControlFlow::Continue(()),
    });
    if let ControlFlow::Break(unfit) = unfit {
        return Some(format!("holds {unfit}, which EDS readers misread"));
    }
    if written.len() > longest {
        return Some(format!("has {} characters, a line holds {longest}", written.len()));
    }
    (text.trim() != text).then(|| "has spaces at its ends, which are lost".to_owned())
}

/// How a message names a character that several readers do not take as part of a value.
pub(in crate::check) fn unfit(c: char) -> Option<String> {
    if c.is_control() {
        Some("a control character".to_owned())
    } else if matches!(c, ';' | '#' | '=') {
        Some(format!("`{c}`"))
    } else {
        None
    }
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values() {
        let Some(key) = written_as(entry) else { continue };
        let longest = LINE - key.len();
        let problem = match value {
            Value::Text(text) if text.is_empty() => {
                entry.is_set().then(|| "is empty, which reads as no value".to_owned())
            }
            Value::Text(text) => problem(text, longest)
                .or_else(|| {
                    is_formula(text)
                        .then(|| "holds `$NODEID`, which EDS readers take for the node-ID".to_owned())
                })
                .or_else(|| (!text.is_ascii()).then(|| "has characters that an EDS cannot hold".to_owned())),
            Value::Bytes(bytes) if bytes.is_empty() => {
                entry.is_set().then(|| "is empty, which reads as no value".to_owned())
            }
            Value::Bytes(bytes) if 2 * bytes.len() > longest => {
                Some(format!("has {} bytes, a line holds {}", bytes.len(), longest / 2))
            }
            Value::Bytes(_) | Value::Integer(_) | Value::NodeId(_) | Value::Real(_) => None,
        };
        if let Some(problem) = problem {
            let message = format!("{id} ({}): the value {problem}", entry.name);
            let set = "choose another value, or write it over the bus";
            let help = if entry.is_set() {
                set.to_owned()
            } else {
                subject.help(Help {
                    specification: "choose another text, or withhold the default from the EDS with `eds: {default: withheld}`",
                    eds: &format!("choose another text, or leave {} out", subject.format.key(Key::Default)),
                    setting: set,
                })
            };
            findings.push(subject.finding(CODE, id, entry, Fact::Default, message).help(help));
        }
    }
}

/// Whether a text reads as a formula: only an integer has one, and a text is as it is.
fn is_formula(text: &str) -> bool {
    text.to_ascii_uppercase().contains("$NODEID")
}

/// The key under which a value is written; `None` for one that no file shows.
fn written_as(entry: &Entry) -> Option<&'static str> {
    if entry.is_set() {
        Some("ParameterValue=")
    } else if entry.eds.default {
        Some("DefaultValue=")
    } else {
        None
    }
}
