//! An object of a module is brought or extended, and it is not the bus coupler's.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::ModuleTopic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS603",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an object of a module in two roles",
    explanation: "Either a module brings an object, and nothing else has it, or it extends one that the bus coupler or \
        other modules have. An object that a module brings and extends, or brings although the bus coupler has it, is \
        described twice, and readers take one or the other.",
    clause: Some("CiA 306 6.3"),
    example: Some(Example::eds(
        "[SupportedModules]\nNrOfEntries=1\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M1Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
        "[SupportedModules]\nNrOfEntries=1\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M1Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for (number, module) in &view.modules {
        for (topic, part) in module {
            let ModuleTopic::Fixed(index, None) = topic else { continue };
            let extension = module.get(&ModuleTopic::SubExtension(*index));
            // A DCF describes the objects of the modules that are plugged in.
            let is_plugged_in = view
                .connected
                .iter()
                .any(|number| view.modules.get(number).is_some_and(|module| module.contains_key(topic)));
            let own = view.objects.get(index).and_then(|object| object.object.as_ref());
            let own = own.filter(|_| !is_plugged_in);
            let (other, message) = match (extension, own) {
                (Some(extension), _) => {
                    (extension, format!("module {number} both brings and extends {index}"))
                }
                (None, Some(own)) => {
                    (own, format!("module {number} brings {index}, which the bus coupler has"))
                }
                (None, None) => continue,
            };
            diagnostics.push(
                Diagnostic::new(CODE, part.place(), message)
                    .with(other.place(), "and here")
                    .help("describe the object in one of the two ways"),
            );
        }
    }
}
