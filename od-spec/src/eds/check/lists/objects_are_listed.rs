//! Every object is in a list.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::names::{List, ModuleTopic};
use crate::eds::view::{Part, View};
use crate::model::Index;
use std::collections::BTreeSet;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS307",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an object that is in no list",
    explanation: "A section describes an object, and no list names it. Readers that go by the lists, lely's C tools \
        among them, lose the object silently. `odgen fix` adds it to the list that its index belongs to.",
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
                Diagnostic::new(CODE, place, format!("{index} is in no list of objects"))
                    .help(format!("add it to `[{}]`; `odgen fix` does", list.section()))
            });
        }
    }
    of_modules(view, &mut found);
    found.finish("objects", diagnostics);
}

/// Objects that a module brings or extends, and that its lists do not name.
fn of_modules(view: &View<'_>, found: &mut Repeated) {
    for (number, module) in &view.modules {
        let named = |list: ModuleTopic| -> BTreeSet<Index> {
            module
                .get(&list)
                .into_iter()
                .flat_map(Part::entries)
                .filter_map(|entry| numbered::index(&entry))
                .collect()
        };
        let (brought, extended) = (named(ModuleTopic::FixedObjects), named(ModuleTopic::SubExtends));
        for (topic, part) in module {
            let (index, list, name) = match topic {
                ModuleTopic::Fixed(index, None) => (index, &brought, "FixedObjects"),
                ModuleTopic::SubExtension(index) => (index, &extended, "SubExtends"),
                ModuleTopic::ModuleInfo
                | ModuleTopic::Comments
                | ModuleTopic::FixedObjects
                | ModuleTopic::SubExtends
                | ModuleTopic::Fixed(_, Some(_)) => continue,
            };
            if !list.contains(index) {
                found.add(part.place(), [], || {
                    let message = format!("{index} of module {number} is in no list of the module");
                    Diagnostic::new(CODE, part.place(), message)
                        .help(format!("add it to `[M{number}{name}]`"))
                });
            }
        }
    }
}
