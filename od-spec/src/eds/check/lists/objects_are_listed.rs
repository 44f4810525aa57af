//! Every object stands in a list.

use super::super::numbered;
use super::super::repeated::Repeated;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::List;
use crate::eds::view::View;
use crate::model::Index;
use std::collections::BTreeSet;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS307",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an object that stands in no list",
    explanation: "A section describes an object, and no list names it. Readers that go by the lists, lely's C tools among them, \
        lose the object without a word. `odgen fix` adds it to the list that its index belongs to.",
    clause: Some("CiA 306 4.6.3.1"),
    example: Some(Example::eds(
        "[ManufacturerObjects]\nSupportedObjects=0\n\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
        "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let lists = numbered::of_objects(view);
    let entries = lists.iter().flat_map(|(_, list)| &list.entries);
    let listed: BTreeSet<Index> = entries.filter_map(|(_, entry)| numbered::index(entry)).collect();
    let mut found = Repeated::new();
    for list in List::ALL {
        // Data types below 1000h are in no list.
        let missing: Vec<(Index, _)> = view
            .objects
            .range(Index(0x1000)..)
            .filter(|(index, _)| List::of(**index) == list && !listed.contains(index))
            .filter_map(|(index, object)| Some((*index, object.object.as_ref()?.place())))
            .collect();
        let indices: Vec<Index> = missing.iter().map(|(index, _)| *index).collect();
        let own = lists.iter().find(|(other, _)| *other == list).filter(|_| !missing.is_empty());
        let mut edits =
            own.map(|(_, own)| own.rewritten(view, &BTreeSet::new(), &indices)).unwrap_or_default();
        for (index, place) in missing {
            found.add(place, std::mem::take(&mut edits), || {
                Diagnostic::new(CODE, place, format!("{index} stands in no list of objects"))
                    .help(format!("add it to `[{}]`; `odgen fix` does", list.section()))
            });
        }
    }
    found.finish("objects", diagnostics);
}
