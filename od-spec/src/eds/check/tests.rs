//! The example of each rule over texts, tried: what it refuses is refused by this rule and no other, what it accepts is
//! accepted.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::{FormatRule, RULES, document_with};
use crate::diag::{Diagnostics, Example};
use crate::eds::view::{FileFacts, View};
use crate::eds::{Document, file_name, is_dcf};
use crate::encoding::Encoding;
use crate::source::SourceMap;
use crate::wording::FileFormat;

/// What some rules say about a text of an example.
fn said<'r>(rules: impl Iterator<Item = &'r FormatRule>, example: Example, text: &str) -> Diagnostics {
    let mut sources = SourceMap::new();
    let file = sources.add(example.language.file_name(), example.language.whole(text));
    let source = sources.file(file);
    let name = file_name(source.name());
    let document = Document::scan(file, source.text());
    let facts = FileFacts { name, encoding: Encoding::Ascii, format: FileFormat::Eds };
    let mut diagnostics = Diagnostics::new();
    document_with(rules, &View::new(&document, file, is_dcf(name), facts), &mut diagnostics);
    diagnostics.sort();
    diagnostics
}

fn codes(diagnostics: &Diagnostics) -> BTreeSet<&'static str> {
    diagnostics.iter().map(|diagnostic| diagnostic.code.id).collect()
}

fn example(rule: &FormatRule) -> Example {
    rule.code.example.unwrap_or_else(|| panic!("{} has no example", rule.code))
}

/// What is said, in a form that people can read.
fn reported(diagnostics: &Diagnostics) -> String {
    let lines: Vec<String> =
        diagnostics.iter().map(|one| format!("\n  {}: {}", one.code, one.message)).collect();
    lines.concat()
}

#[test]
fn the_example_of_a_rule_is_refused_by_it_and_accepted_when_fixed() {
    let mut wrong = String::new();
    for rule in RULES.iter().copied() {
        let (id, example) = (rule.code.id, example(rule));
        let before = said(RULES.iter().copied(), example, example.before);
        if codes(&before) != BTreeSet::from([id]) {
            let _ = write!(wrong, "\n{id}, before:{}", reported(&before));
        }
        let after = said(RULES.iter().copied(), example, example.after);
        if !after.is_empty() {
            let _ = write!(wrong, "\n{id}, after:{}", reported(&after));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// Switched off, a rule says nothing more: no other rule covers for it, and no other code says the same.
#[test]
fn a_rule_that_is_switched_off_lets_its_example_pass() {
    for rule in RULES.iter().copied() {
        let example = example(rule);
        let others = RULES.iter().copied().filter(|one| !std::ptr::eq(*one, rule));
        let found = said(others, example, example.before);
        assert!(found.is_empty(), "{} is said by something else, too:{}", rule.code, reported(&found));
    }
}

#[test]
fn rules_have_codes_of_their_own_and_are_explained() {
    let ids: Vec<&str> = RULES.iter().map(|rule| rule.code.id).collect();
    let distinct: BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(distinct.len(), ids.len(), "a code has one home: {ids:?}");
    assert!(ids.is_sorted(), "{ids:?}");
    for rule in RULES.iter().copied() {
        let explanation = rule.code.explanation;
        assert!(explanation.ends_with('.'), "{}: {explanation}", rule.code);
        assert!(explanation.matches(['.', ':', ';']).count() >= 2, "{}: {explanation}", rule.code);
        assert!(
            rule.code.severity <= rule.code.foreign,
            "{}: a foreign file is read more leniently",
            rule.code
        );
    }
}
