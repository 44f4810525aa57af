//! Every section is written once.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Severity, shorten};
use crate::eds::document::SectionRef;
use crate::eds::view::{View, name_place};
use std::collections::BTreeMap;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS110",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a section that is written twice",
    explanation: "Readers disagree about a section that is written twice: Python's configparser refuses the file, others take the last \
        one, the first one, or both together. Names are compared without regard to case, and `[1018sub1]` and `[1018sub01]` are \
        one section. Where both say the same, one is superfluous; where they do not, decide which is right.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments]\nLines=0\n\n[Comments]\nLines=0", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for part in view.parts() {
        compare(view, &part.sections, diagnostics);
    }
    let mut unknown: BTreeMap<String, Vec<SectionRef<'_, '_>>> = BTreeMap::new();
    for section in &view.unknown {
        unknown.entry(section.name().to_ascii_lowercase()).or_default().push(*section);
    }
    for sections in unknown.values() {
        compare(view, sections, diagnostics);
    }
}

fn compare<'d>(view: &View<'d>, sections: &[SectionRef<'d, 'd>], diagnostics: &mut Diagnostics) {
    let [first, others @ ..] = sections else { return };
    if others.is_empty() {
        return;
    }
    let first_keys = keys(first);
    let mut are_equal = true;
    for other in others {
        let place = name_place(other.header(), view.file);
        let name = shorten(other.name());
        let mut diagnostic = Diagnostic::new(CODE, place, format!("section `{name}` is written twice"))
            .label("again here")
            .with(name_place(first.header(), view.file), "first here");
        let is_empty = other.keys().next().is_none();
        are_equal &= is_empty || first_keys == keys(other);
        // Readers take the last: after another section, an equal one is not superfluous.
        if is_empty || are_equal {
            diagnostic = diagnostic.help("remove one of the two, they say the same; `odgen fix` does");
            diagnostic.edits = removal(view, other);
        } else {
            diagnostic = diagnostic.help("decide which of the two is right, and remove the other");
        }
        diagnostics.push(diagnostic);
    }
}

fn keys<'d>(section: &SectionRef<'d, 'd>) -> BTreeMap<String, Vec<&'d str>> {
    let mut keys: BTreeMap<String, Vec<&'d str>> = BTreeMap::new();
    for line in section.keys() {
        let key = line.key().unwrap_or_default().to_ascii_lowercase();
        keys.entry(key).or_default().push(line.value().unwrap_or_default());
    }
    keys
}

/// Takes header and keys out; comments stay.
fn removal(view: &View<'_>, section: &SectionRef<'_, '_>) -> Vec<Edit> {
    let lines = std::iter::once(section.header()).chain(section.keys());
    lines.map(|line| edits::remove(view, line)).collect()
}
