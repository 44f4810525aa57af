//! Keys have the standard's case.

use std::collections::BTreeMap;

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::view::{Part, View};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS122",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a key in another case",
    explanation: "Keys mean the same in upper and lower case. But python-canopen and gocanopen compare them letter by letter: they miss \
        `NodeId` and `NrOfRxPDO`, and python-canopen stops at `line5` among `Line1` to `Line4`. Write keys as the \
        standard has them.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments]\nlines=0", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (topic, part) in view.topics() {
        let Some(known) = keys::of(topic) else { continue };
        // How often each key is there; only for the few sections in which one is not as it should be.
        let mut counts: Option<BTreeMap<String, usize>> = None;
        for entry in part.entries().filter(|entry| !known.is_standard(entry.key.value)) {
            let Some(meant) = known.spelling(entry.key.value) else { continue };
            if meant == entry.key.value {
                continue;
            }
            let counts = counts.get_or_insert_with(|| count(part));
            let is_single = counts.get(&meant.to_ascii_lowercase()) == Some(&1);
            let edit = is_single.then(|| Edit { span: entry.key.span, text: meant.clone() });
            found.add(entry.key.span, edit, || {
                Diagnostic::new(
                    CODE,
                    entry.key.span,
                    format!("`{}` is written `{meant}` in the standard", shorten(entry.key.value)),
                )
                .help(if is_single {
                    format!("write `{meant}`; `odgen fix` does")
                } else {
                    format!("write `{meant}`, once")
                })
            });
        }
    }
    found.finish("keys", diagnostics);
}

fn count(part: &Part<'_>) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for entry in part.entries() {
        *counts.entry(entry.key.value.to_ascii_lowercase()).or_default() += 1;
    }
    counts
}
