//! Every connected module is one that the bus coupler takes.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity, shorten};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "EDS606",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a connected module that the bus coupler does not know",
    explanation: "`[ConnectedModules]` names the modules of a node in their order, each by the number of its description. A number \
        without a description names no module, and the objects after it cannot be known.",
    clause: Some("CiA 306 6.4"),
    example: Some(Example::dcf(
        "[SupportedModules]\nNrOfEntries=1\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M1Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[ConnectedModules]\nNrOfEntries=1\n1=2",
        "[SupportedModules]\nNrOfEntries=1\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M1Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[ConnectedModules]\nNrOfEntries=1\n1=1",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    let lists = numbered::all(view).filter(|(topic, _)| *topic == Topic::ConnectedModules);
    for (_, entry) in lists.flat_map(|(_, list)| list.entries) {
        let number = lenient_integer(entry.value.value).and_then(|number| u32::try_from(number).ok());
        if number.is_some_and(|number| view.modules.contains_key(&number)) {
            continue;
        }
        found.add(entry.value.span, [], || {
            let message = format!("found `{}`, expected the number of a module", shorten(entry.value.value));
            Diagnostic::new(CODE, entry.value.span, message)
                .help("write the number of a module that is described")
        });
    }
    found.finish("modules", diagnostics);
}
