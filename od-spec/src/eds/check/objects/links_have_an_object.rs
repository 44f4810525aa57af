//! Links lead from an object that is described. Where they lead is judged by the rules over the model.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::view::{ObjectPart, View};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "EDS427",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "links from nothing",
    explanation: "`[xxxxObjectLinks]` names objects that belong together with the object xxxx. That has to be described itself; \
        otherwise the links belong to no object, and are left out.",
    clause: Some("CiA 306 4.6.4"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[2001ObjectLinks]\nObjectLinks=1\n1=0x2000",
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[2000ObjectLinks]\nObjectLinks=1\n1=0x2001\n\n[2001]\nParameterName=limit\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    // An object of which only sub-indices are described keeps its links; that it is not described itself is said of these.
    let is_nothing = |object: &ObjectPart<'_>| object.object.is_none() && object.subs.is_empty();
    for (index, object) in view.objects.iter().filter(|(_, object)| is_nothing(object)) {
        let Some(links) = &object.links else { continue };
        let place = links.place();
        found.add(place, [], || {
            Diagnostic::new(
                CODE,
                place,
                format!("the links of {index} are there, but no section describes it"),
            )
            .help("describe the object, or remove the links")
        });
    }
    found.finish("links", diagnostics);
}
