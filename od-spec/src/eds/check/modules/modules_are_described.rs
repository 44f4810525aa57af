//! Every module is described, and counted.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::names::{ModuleTopic, Topic};
use crate::eds::number::{help, lenient_integer};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS601",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a module that is not described, or not counted",
    explanation: "`[SupportedModules]` says how many kinds of modules the bus coupler takes, and `[MxModuleInfo]` describes each, \
        x from 1 to that number. A PLC offers those that it finds.",
    clause: Some("CiA 306 6.3"),
    example: Some(Example::eds(
        "[SupportedModules]\nNrOfEntries=2\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M1Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
        "[SupportedModules]\nNrOfEntries=1\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n\n[M1Fixed2000]\nParameterName=state\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let part = view.section(Topic::SupportedModules);
    let value = part.and_then(|part| part.value("NrOfEntries"));
    let declared = match (part, value) {
        (None, _) => Some(0),
        (Some(part), None) => {
            let message = "`[SupportedModules]` does not say how many modules there are";
            diagnostics
                .push(Diagnostic::new(CODE, part.place(), message).help("write the number as `NrOfEntries`"));
            return;
        }
        (Some(_), Some(value)) => lenient_integer(value.value).and_then(|number| u16::try_from(number).ok()),
    };
    let place = value.map(|value| value.span);
    let Some(declared) = declared else {
        if let Some(value) = value {
            let message = format!("found `{}`, expected the number of modules", shorten(value.value));
            diagnostics
                .push(Diagnostic::new(CODE, value.span, message).help(help(value.value, "write a number")));
        }
        return;
    };
    let described = |number: u32| {
        view.modules.get(&number).is_some_and(|module| module.contains_key(&ModuleTopic::ModuleInfo))
    };
    let missing = (1..=u32::from(declared)).find(|number| !described(*number));
    if let (Some(number), Some(place)) = (missing, place) {
        let message = format!("there are {declared} modules, but no section `[M{number}ModuleInfo]`");
        diagnostics
            .push(Diagnostic::new(CODE, place, message).help("describe the module, or correct the number"));
    }
    for (number, module) in
        view.modules.iter().filter(|(number, _)| !(1..=u32::from(declared)).contains(*number))
    {
        let Some(section) = module.values().next() else { continue };
        let message = format!("module {number} is described, but `[SupportedModules]` counts {declared}");
        diagnostics.push(
            Diagnostic::new(CODE, section.place(), message)
                .help("correct `NrOfEntries`, or the number of the module"),
        );
    }
}
