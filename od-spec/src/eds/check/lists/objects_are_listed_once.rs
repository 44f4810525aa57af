//! Every object is listed once.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::List;
use crate::eds::view::{Entry, View};
use std::collections::{BTreeMap, BTreeSet};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS305",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an object that is listed twice",
    explanation: "An object is in one list, and there once. Readers that make a list of objects from the lists get it twice, \
        and those that compare the number of objects with the number of sections refuse the file.",
    clause: Some("CiA 306 4.6.3.1"),
    example: Some(Example::eds(
        "[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x2000\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
        "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let lists = numbered::of_objects(view);
    let mut first: BTreeMap<_, (List, &Entry<'_>)> = BTreeMap::new();
    // The superfluous ones of each list, with what is said about them.
    let mut superfluous: BTreeMap<List, (BTreeSet<u32>, Vec<Diagnostic>)> = BTreeMap::new();
    for (list, entries) in &lists {
        for (_, entry) in &entries.entries {
            let Some(index) = numbered::index(entry) else { continue };
            let Some((first_list, first_entry)) = first.get(&index).copied() else {
                first.insert(index, (*list, entry));
                continue;
            };
            // In two lists, the one that is not its own is wrong.
            let is_wrong_first = first_list != List::of(index) && *list == List::of(index);
            let (wrong, place, other) =
                if is_wrong_first { (first_list, first_entry, entry) } else { (*list, entry, first_entry) };
            if is_wrong_first {
                first.insert(index, (*list, entry));
            }
            let diagnostic = Diagnostic::new(CODE, place.value.span, format!("{index} is listed twice"))
                .label("again here")
                .with(other.value.span, "listed here")
                .help("remove one of the two; `odgen fix` does");
            let (places, said) = superfluous.entry(wrong).or_default();
            places.insert(place.key.span.start);
            said.push(diagnostic);
        }
    }
    for (list, (places, mut said)) in superfluous {
        // They are fixed together: each removal changes the numbers of the others.
        let entries = lists.iter().find(|(other, _)| *other == list);
        if let (Some((_, entries)), Some(last)) = (entries, said.first_mut()) {
            last.edits = entries.rewritten(view, &places, &[]);
        }
        for diagnostic in said {
            diagnostics.push(diagnostic);
        }
    }
}
