//! A module brings objects or extends some.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::ModuleTopic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS602",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a module that brings nothing",
    explanation: "A module brings objects of its own, `[MxFixedObjects]`, or sub-indices of objects of the bus coupler, \
        `[MxSubExtends]`. One that brings neither has nothing that a PLC could use.",
    clause: Some("CiA 306 6.3"),
    example: Some(Example::eds(
        "[SupportedModules]\nNrOfEntries=1\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2",
        "[SupportedModules]\nNrOfEntries=1\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M1Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for (number, module) in &view.modules {
        let Some(information) = module.get(&ModuleTopic::ModuleInfo) else { continue };
        if !module.contains_key(&ModuleTopic::FixedObjects) && !module.contains_key(&ModuleTopic::SubExtends)
        {
            let message = format!("module {number} brings no objects and extends none");
            diagnostics.push(
                Diagnostic::new(CODE, information.place(), message)
                    .help(format!("add `[M{number}FixedObjects]` or `[M{number}SubExtends]`")),
            );
        }
    }
}
