//! The issues of the printed manual: each has a number of its own, and `since:` names one of them.

use std::collections::BTreeMap;

use crate::ast::{EntryDecl, Name, ObjectDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::source::Span;

pub(super) fn check(root: &Spec, diagnostics: &mut Diagnostics) {
    let mut listed: BTreeMap<&str, Span> = BTreeMap::new();
    for number in root.history.iter().filter_map(|issue| issue.number.as_ref()) {
        if let Some(before) = listed.insert(&number.value, number.span) {
            let message = format!("issue {} stands twice", shorten(&number.value));
            diagnostics.push(
                Diagnostic::new(codes::DUPLICATE_VALUE, number.span, message)
                    .label("again here")
                    .with(before, "first here")
                    .help("each issue of the manual stands once"),
            );
        }
    }
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

/// The issues that brought an object and its entries.
fn sinces(object: &ObjectDecl) -> impl Iterator<Item = &Name> {
    object.written().chain([&object.entry]).filter_map(|entry: &EntryDecl| entry.since.as_ref())
}
