//! The issues of the printed manual: each has a number of its own, and `since:` names one of them.

use std::collections::BTreeMap;

use crate::ast::{EntryDecl, Name, ObjectDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::model::Date;
use crate::source::{Span, Spanned};

pub(super) fn check(root: &Spec, diagnostics: &mut Diagnostics) {
    let mut listed: BTreeMap<&str, Span> = BTreeMap::new();
    for number in root.history.iter().filter_map(|issue| issue.number.as_ref()) {
        if let Some(before) = listed.insert(&number.value, number.span) {
            let message = format!("issue {} is listed twice", shorten(&number.value));
            diagnostics.push(
                Diagnostic::new(codes::DUPLICATE_VALUE, number.span, message)
                    .label("again here")
                    .with(before, "first here")
                    .help("give each issue a number of its own"),
            );
        }
    }
    check_order(root, diagnostics);
    // Without a history, only the newest issue is known.
    if listed.is_empty() {
        return;
    }
    if let Some(number) = root.revision.as_ref().and_then(|issue| issue.number.as_ref()) {
        listed.insert(&number.value, number.span);
    }
    for since in root.objects.iter().flat_map(sinces).filter(|since| !listed.contains_key(&*since.value)) {
        let message = format!("there is no issue {} of the manual", shorten(&since.value));
        let meant = diagnostics.suggestions.nearest(&since.value, listed.keys().copied());
        let diagnostic = Diagnostic::new(codes::NAMED_IN_TEXT, since.span, message);
        diagnostics.push(match meant {
            Some(issue) => {
                diagnostic.help(format!("add it to `history:`, or did you mean `{issue}`?")).meant(issue)
            }
            None => diagnostic.help("add it to `history:`, or correct the number"),
        });
    }
}

/// Checks that the dates of the history rise, or fall, all the way, and that no issue is younger than the newest one.
fn check_order(root: &Spec, diagnostics: &mut Diagnostics) {
    let dates: Vec<&Spanned<Date>> = root.history.iter().filter_map(|issue| issue.date.as_ref()).collect();
    let steps = || dates.windows(2).filter(|pair| pair[0].value != pair[1].value);
    let rises = |pair: &[&Spanned<Date>]| pair[0].value < pair[1].value;
    if let Some(first) = steps().next()
        && let Some(pair) = steps().find(|pair| rises(pair) != rises(first))
    {
        diagnostics.push(
            Diagnostic::new(codes::ISSUE_ORDER, pair[1].span, "the issues are out of order here")
                .with(pair[0].span, "before it")
                .help("correct the date, or put the issues into their order"),
        );
        return;
    }
    let newest = root.revision.as_ref().and_then(|issue| issue.date.as_ref());
    if let Some(newest) = newest
        && let Some(younger) = dates.iter().find(|date| date.value > newest.value)
    {
        diagnostics.push(
            Diagnostic::new(codes::ISSUE_ORDER, younger.span, "an issue younger than the specification")
                .with(newest.span, "the date of the specification")
                .help("correct one of the dates"),
        );
    }
}

/// The issues that brought an object and its entries.
fn sinces(object: &ObjectDecl) -> impl Iterator<Item = &Name> {
    object.written().chain([&object.entry]).filter_map(|entry: &EntryDecl| entry.since.as_ref())
}
