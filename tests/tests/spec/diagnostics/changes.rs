//! The changes that messages bring with them: each fixes what its message is about.

use std::collections::BTreeSet;

use od_spec::diag::{Diagnostic, Edit};

use crate::diagnostics::{run, said_of_cases};

/// The text after a change.
fn changed(text: &str, edit: &Edit) -> String {
    let (start, end) = (edit.span.start as usize, edit.span.end as usize);
    [&text[..start], &edit.text, &text[end..]].concat()
}

/// What distinguishes a message from others of its kind.
fn said(diagnostic: &Diagnostic) -> (&'static str, String) {
    (diagnostic.code.id, diagnostic.message.clone())
}

/// So many different codes bring a change with them in the cases.
const CODES: usize = 15;

#[test]
fn every_change_puts_its_message_right() {
    let mut codes = BTreeSet::new();
    for (name, text, (_, root, compiled)) in said_of_cases() {
        for diagnostic in &compiled.diagnostics {
            // Changes that are made together would have to be tried together; a specification has none.
            assert!(diagnostic.edits.len() < 2, "{name}");
            for edit in diagnostic.edits.iter().chain(diagnostic.meant.as_deref()) {
                assert_eq!(edit.span.file, *root, "{name}");
                codes.insert(diagnostic.code.id);
                let new = changed(text, edit);
                let (_, _, again) = run(name, &new);
                let before = compiled.diagnostics.iter().filter(|one| said(one) == said(diagnostic)).count();
                let after = again.diagnostics.iter().filter(|one| said(one) == said(diagnostic)).count();
                assert!(after < before, "{name}: {} stays with {edit:?}", diagnostic.message);
                let not_yaml = again.diagnostics.iter().find(|one| one.code.id == "OD0104");
                assert_eq!(not_yaml, None, "{name}: {edit:?}");
            }
        }
    }
    assert!(codes.len() >= CODES, "{codes:?}");
}

/// Where a message asks whether one word was meant, this word is a change.
#[test]
fn the_word_that_a_help_asks_about_is_a_change() {
    let mut without = BTreeSet::new();
    for (_, _, (_, _, compiled)) in said_of_cases() {
        for diagnostic in &compiled.diagnostics {
            let help = diagnostic.help.as_deref().unwrap_or_default();
            if help.contains("did you mean `") && !help.contains("` or `") && diagnostic.meant.is_none() {
                without.insert((diagnostic.code.id, help.to_owned()));
            }
        }
    }
    assert_eq!(without, BTreeSet::new());
}
