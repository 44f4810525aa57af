//! Links lead from one object to others.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS427",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "a link to nothing",
    explanation: "`[xxxxObjectLinks]` names objects that belong together with the object xxxx. Both ends have to be there; a link \
        to an object that the file does not describe leads nowhere.",
    clause: Some("CiA 306 4.6.4"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[2000ObjectLinks]\nObjectLinks=1\n1=0x2001",
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[2000ObjectLinks]\nObjectLinks=1\n1=0x2001\n\n[2001]\nParameterName=limit\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (topic, list) in numbered::all(view) {
        let Topic::ObjectLinks(index) = topic else { continue };
        if view.objects.get(&index).is_none_or(|object| object.object.is_none()) {
            let place = list.part.place();
            found.add(place, [], || {
                Diagnostic::new(
                    CODE,
                    place,
                    format!("the links of {index} are there, but no section describes it"),
                )
                .help("describe the object, or remove the links")
            });
        }
        for (_, entry) in &list.entries {
            let Some(linked) = numbered::index(entry).filter(|linked| !view.objects.contains_key(linked))
            else {
                continue;
            };
            found.add(entry.value.span, [], || {
                Diagnostic::new(
                    CODE,
                    entry.value.span,
                    format!("{index} is linked to {linked}, which no section describes"),
                )
                .help("correct the index, or remove the link")
            });
        }
    }
    found.finish("links", diagnostics);
}
