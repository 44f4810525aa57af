//! Every object is in the list that its index belongs to.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::List;
use crate::eds::view::View;
use crate::model::Index;
use std::collections::{BTreeMap, BTreeSet};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS308",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an object in the wrong list",
    explanation: "Objects of 2000h to 5FFFh are the manufacturer's and are in `[ManufacturerObjects]`; 1000h, 1001h and 1018h \
        are in `[MandatoryObjects]`, all others in `[OptionalObjects]`. lely's tools refuse a file that mixes them.",
    clause: Some("CiA 306 4.6.3.1"),
    example: Some(Example::eds(
        "[OptionalObjects]\nSupportedObjects=1\n1=0x2000\n\n[ManufacturerObjects]\nSupportedObjects=0\n\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
        "[OptionalObjects]\nSupportedObjects=0\n\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let lists = numbered::of_objects(view);
    let listed: BTreeMap<List, BTreeSet<Index>> = lists
        .iter()
        .map(|(list, own)| {
            (*list, own.entries.iter().filter_map(|(_, entry)| numbered::index(entry)).collect())
        })
        .collect();
    for (list, own) in &lists {
        // A list that also names further objects as mandatory is another rule's, and so is an object in two lists.
        let strays: Vec<_> = own
            .entries
            .iter()
            .filter_map(|(_, entry)| Some((numbered::index(entry)?, entry)))
            .filter(|(index, _)| index.0 >= 0x1000 && is_stray(*list, *index))
            .filter(|(index, _)| !listed.get(&List::of(*index)).is_some_and(|own| own.contains(index)))
            .collect();
        for right in List::ALL {
            let strays = || strays.iter().filter(|(index, _)| List::of(*index) == right);
            let Some((first, entry)) = strays().next() else { continue };
            let more = strays().count() - 1;
            let others = match more {
                0 => String::new(),
                1 => "; 1 more entry like this".to_owned(),
                _ => format!("; {more} more entries like this"),
            };
            let message = format!("{first} is in `[{}]`{others}", list.section());
            let mut diagnostic = Diagnostic::new(CODE, entry.value.span, message)
                .help(format!("move it to `[{}]`; `odgen fix` does", right.section()));
            let gone = strays().map(|(_, entry)| entry.key.span.start).collect();
            let moved: BTreeSet<Index> = strays().map(|(index, _)| *index).collect();
            let moved: Vec<Index> = moved.into_iter().collect();
            // Where the right list is missing, it is made first.
            if let Some((_, target)) = lists.iter().find(|(other, _)| *other == right) {
                diagnostic.edits = own.rewritten(view, &gone, &[]);
                diagnostic.edits.extend(target.rewritten(view, &BTreeSet::new(), &moved));
            }
            diagnostics.push(diagnostic);
        }
    }
}

fn is_stray(list: List, index: Index) -> bool {
    let right = List::of(index);
    list != right && (list, right) != (List::Mandatory, List::Optional)
}
