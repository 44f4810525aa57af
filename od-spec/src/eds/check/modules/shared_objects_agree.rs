//! An object that several modules bring is the same in all of them.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::names::ModuleTopic;
use crate::eds::view::{Part, View};
use std::collections::BTreeMap;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS604",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an object that differs from module to module",
    explanation: "Several modules may bring the same object; it exists once if one of them is there. So its type, access and the \
        like are the same in all of them, or what the device has depends on the module that a reader looks at first.",
    clause: Some("CiA 306 6.3"),
    example: Some(Example::eds(
        "[SupportedModules]\nNrOfEntries=2\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M1Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[M2ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M2FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M2Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0006\nAccessType=ro",
        "[SupportedModules]\nNrOfEntries=2\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M1Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[M2ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M2FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M2Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

const KEYS: [&str; 5] = ["ObjectType", "DataType", "AccessType", "PDOMapping", "SubNumber"];

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut first: BTreeMap<ModuleTopic, (u32, &Part<'_>)> = BTreeMap::new();
    for (number, module) in &view.modules {
        for (topic, part) in module.iter().filter(|(topic, _)| matches!(topic, ModuleTopic::Fixed(..))) {
            let (other_number, other) = *first.entry(*topic).or_insert((*number, part));
            let value =
                |part: &Part<'_>, key: &str| part.value(key).map(|value| value.value.to_ascii_lowercase());
            let Some(key) = KEYS.into_iter().find(|key| value(part, key) != value(other, key)) else {
                continue;
            };
            let name = shorten(part.name().value);
            let message = format!("`{key}` of `{name}` differs from that of module {other_number}");
            diagnostics.push(
                Diagnostic::new(CODE, part.place(), message)
                    .with(other.place(), "the other one")
                    .help("describe the object alike in all modules"),
            );
        }
    }
}
