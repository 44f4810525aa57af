//! Keys are one word of letters, digits and underscores.

use std::collections::BTreeMap;

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::view::{Entry, Part, View};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS113",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a key of other characters",
    explanation: "A key consists of letters and digits; the standard itself uses `_` as well. `Supported Objects` with a space is \
        not a key for any program: editors of CANopen and PLC tools refuse files with it or find no objects.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nScale-Factor=10",
        "; scale factor: 10\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (topic, part) in view.topics() {
        let keys = keys::of(topic);
        // How often each key is there, without spaces; only for the few sections that have one with spaces.
        let mut counts: Option<BTreeMap<String, usize>> = None;
        for entry in part.entries().filter(|entry| !is_word(entry.key.value)) {
            let joined: String = entry.key.value.split_whitespace().collect();
            let meant = keys.as_ref().and_then(|keys| keys.spelling(&joined));
            // The reader takes it for a key with a name as well, unless that key is there.
            let is_free = meant.as_deref().is_some_and(|meant| {
                let counts = counts.get_or_insert_with(|| count(part));
                let is_named = keys.as_ref().is_some_and(|keys| keys.names().any(|name| name == meant));
                is_named && counts.get(&meant.to_ascii_lowercase()) == Some(&1)
            });
            let edit = meant.clone().filter(|_| is_free).map(|text| Edit { span: entry.key.span, text });
            let does = if is_free { "; `odgen fix` does" } else { "" };
            found.add(entry.key.span, edit, || message(&entry, meant.as_deref(), does));
        }
    }
    found.finish("keys", diagnostics);
}

fn message(entry: &Entry<'_>, meant: Option<&str>, does: &str) -> Diagnostic {
    let found = format!("`{}` is not one word of letters and digits", shorten(entry.key.value));
    let diagnostic = Diagnostic::new(CODE, entry.key.span, found);
    match meant {
        Some(meant) => diagnostic.help(format!("write `{meant}`{does}")),
        None => diagnostic.help("write it as one word; if it is meant as a comment, put `;` in front"),
    }
}

fn count(part: &Part<'_>) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for entry in part.entries() {
        let joined: String = entry.key.value.split_whitespace().collect();
        *counts.entry(joined.to_ascii_lowercase()).or_default() += 1;
    }
    counts
}

/// Whether a text is a key as the standard has them.
pub(super) fn is_word(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}
