//! The example of each rule, tried: what it refuses is refused by this rule and no other, what it accepts is accepted.

use std::collections::BTreeSet;

use crate::check::{RULES, Rule};

use crate::compile::compile_with;
use crate::diag::{Diagnostics, Example};
use crate::files::NoFiles;
use crate::parameters::assign_with;
use crate::source::{SourceMap, Spanned};
use crate::standard;

/// What is said about a text of an example; its lines `# --set ENTRY=VALUE` are settings of node 1.
pub(crate) fn said(rules: &[&Rule], text: &str) -> Diagnostics {
    let mut sources = SourceMap::new();
    let root = sources.add("example.od.yaml", Example::whole_specification(text));
    let compiled = compile_with(standard::rules(rules), &mut sources, root, &mut NoFiles);
    let mut diagnostics = compiled.diagnostics;
    let settings: Vec<_> = text
        .lines()
        .filter_map(|line| line.strip_prefix("# --set "))
        .map(|setting| {
            let file = sources.add("--set", setting);
            Spanned::new(setting.to_owned(), sources.whole(file))
        })
        .collect();
    if let Some(system) = compiled.system.filter(|_| !settings.is_empty()) {
        assign_with(standard::rules(rules), &system, &system.devices[0], 1, &settings, &mut diagnostics);
    }
    diagnostics
}

fn codes(diagnostics: &Diagnostics) -> Vec<&'static str> {
    diagnostics.iter().map(|diagnostic| diagnostic.code.id).collect()
}

#[test]
fn the_example_of_a_rule_is_refused_by_it_and_accepted_when_put_right() {
    let all: Vec<&Rule> = RULES.iter().collect();
    for rule in RULES {
        let id = rule.code.id;
        let example = rule.code.example.unwrap_or_else(|| panic!("{id} has no example"));
        assert_eq!(codes(&said(&all, example.before)), [id], "before:\n{}", example.before);
        let after = said(&all, example.after);
        assert!(after.is_empty(), "{id}, after: {:?}\n{}", codes(&after), example.after);
    }
}

/// Switched off, a rule says nothing more: no other rule covers for it, and no other code says the same.
#[test]
fn a_rule_that_is_switched_off_lets_its_example_pass() {
    for rule in RULES {
        let id = rule.code.id;
        let others: Vec<&Rule> = RULES.iter().filter(|one| !std::ptr::eq(*one, rule)).collect();
        let Some(example) = rule.code.example else { continue };
        let found = codes(&said(&others, example.before));
        assert!(!found.contains(&id), "{id} is said by something else, too: {found:?}");
    }
}

#[test]
fn rules_have_codes_of_their_own_and_are_explained() {
    let ids: Vec<&str> = RULES.iter().map(|rule| rule.code.id).collect();
    let distinct: BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(distinct.len(), ids.len(), "a code has one home: {ids:?}");
    for rule in RULES {
        let explanation = rule.code.explanation;
        assert!(explanation.ends_with('.'), "{}: {explanation}", rule.code.id);
        // What is wrong, why it matters, what to do.
        assert!(explanation.matches(['.', ':', ';']).count() >= 2, "{}: {explanation}", rule.code.id);
    }
}
