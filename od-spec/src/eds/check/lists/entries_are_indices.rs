//! The entries of a list of objects are indices.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity, shorten};
use crate::eds::names::{ModuleTopic, Topic};
use crate::eds::number::{help, integer};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "EDS304",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an entry of a list that is not an index",
    explanation: "An entry of a list of objects is an index, a number of 0x0000 to 0xFFFF. What cannot be read names no object: \
        readers stop, or lose it.",
    clause: Some("CiA 306 4.6.3.1"),
    example: Some(Example::eds(
        "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000x",
        "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (topic, list) in numbered::all(view) {
        let is_of_indices = matches!(
            topic,
            Topic::Objects(_)
                | Topic::ObjectLinks(_)
                | Topic::Module(_, ModuleTopic::FixedObjects | ModuleTopic::SubExtends)
        );
        for (_, entry) in list.entries.iter().filter(|_| is_of_indices) {
            let number = integer(entry.value.value);
            if number
                .is_some_and(|number| number.deviations.is_empty() && (0..=0xFFFF).contains(&number.value))
            {
                continue;
            }
            let value = entry.value;
            found.add(value.span, [], || {
                let message = match value.value {
                    "" => format!("`{}` is empty, expected an index", shorten(entry.key.value)),
                    text => format!("found `{}`, expected an index such as 0x2000", shorten(text)),
                };
                Diagnostic::new(
                    CODE,
                    if value.value.is_empty() { entry.key.span } else { value.span },
                    message,
                )
                .help(help(value.value, "write the index of an object"))
            });
        }
    }
    found.finish("entries", diagnostics);
}
