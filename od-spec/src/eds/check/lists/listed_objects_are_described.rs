//! Every listed object has a section.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::names::{ModuleTopic, Topic};
use crate::eds::number::lenient_integer;
use crate::eds::view::View;
use crate::model::Index;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS306",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a listed object without a section",
    explanation: "The list names an object, and no section describes it. lely's tools refuse the file, and it is unknown what the object is. Describe the object, or remove it from the list if the device does not have it.",
    clause: Some("CiA 306 4.6.3.1"),
    example: Some(Example::eds(
        "[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x2001\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
        "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    let implied = view.section(Topic::DeviceInfo).and_then(|part| part.value("CompactPDO"));
    let has_implied = implied.and_then(|value| lenient_integer(value.value)).is_some_and(|mask| mask != 0);
    for (topic, list) in numbered::all(view) {
        for (_, entry) in &list.entries {
            let Some(index) = numbered::index(entry) else { continue };
            let is_missing = match topic {
                // Data types are another rule's.
                Topic::Objects(_) => {
                    index.0 >= 0x1000
                        && !view.objects.contains_key(&index)
                        && !(has_implied && is_of_pdo(index))
                }
                Topic::Module(number, ModuleTopic::FixedObjects) => {
                    is_missing_in_module(view, number, ModuleTopic::Fixed(index, None))
                }
                Topic::Module(number, ModuleTopic::SubExtends) => {
                    is_missing_in_module(view, number, ModuleTopic::SubExtension(index))
                }
                _ => false,
            };
            if is_missing {
                found.add(entry.value.span, [], || {
                    Diagnostic::new(
                        CODE,
                        entry.value.span,
                        format!("{index} is listed, but no section describes it"),
                    )
                    .help("describe the object, or take it out of the list")
                });
            }
        }
    }
    found.finish("objects", diagnostics);
}

/// PDOs that `CompactPDO` implies are listed, and not described.
const fn is_of_pdo(index: Index) -> bool {
    matches!(index.0, 0x1400..=0x1BFF)
}

fn is_missing_in_module(view: &View<'_>, number: u32, topic: ModuleTopic) -> bool {
    view.modules.get(&number).is_none_or(|module| !module.contains_key(&topic))
}
