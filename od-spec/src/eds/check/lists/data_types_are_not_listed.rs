//! Data types are in no list of objects.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS310",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a data type in a list of objects",
    explanation: "Indices below 1000h are data types, which the lists do not name; a device may still describe types of its own in sections. lely's tools refuse such entries.",
    clause: Some("CiA 306 4.6.3.1"),
    example: Some(Example::eds(
        "[OptionalObjects]\nSupportedObjects=1\n1=0x0005",
        "[OptionalObjects]\nSupportedObjects=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (_, list) in numbered::of_objects(view) {
        for (_, entry) in &list.entries {
            let Some(index) = numbered::index(entry).filter(|index| index.0 < 0x1000) else { continue };
            found.add(entry.value.span, [], || {
                Diagnostic::new(
                    CODE,
                    entry.value.span,
                    format!("{index} is a data type, and listed as an object"),
                )
                .help("take it out of the list")
            });
        }
    }
    found.finish("entries", diagnostics);
}
