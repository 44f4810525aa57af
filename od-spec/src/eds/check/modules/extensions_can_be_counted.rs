//! An extension says how many sub-indices it adds.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::names::ModuleTopic;
use crate::eds::number::{help, lenient_integer};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS605",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an extension that cannot be counted",
    explanation: "`Count` says how many sub-indices a module adds to an object: a number, or `0;b` for a module that fills b bits \
        of a sub-index which it shares with its neighbours. `ObjExtend` is the highest sub-index before the next object \
        begins. Without them it is unknown which sub-index belongs to which module.",
    clause: Some("CiA 306 6.3"),
    example: Some(Example::eds(
        "[SupportedModules]\nNrOfEntries=1\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n\n[M1SubExt6000]\nParameterName=inputs\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nCount=some",
        "[SupportedModules]\nNrOfEntries=1\n\n[M1ModuleInfo]\nProductName=input\nProductVersion=1\nProductRevision=0\nOrderCode=A2\n\n[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n\n[M1SubExt6000]\nParameterName=inputs\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nCount=1",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for part in view
        .modules
        .values()
        .flatten()
        .filter_map(|(topic, part)| matches!(topic, ModuleTopic::SubExtension(_)).then_some(part))
    {
        match part.value("Count") {
            None => diagnostics.push(
                Diagnostic::new(CODE, part.place(), "the extension has no `Count`")
                    .help("write how many sub-indices it adds"),
            ),
            Some(count) if !is_count(count.value) => diagnostics.push(
                Diagnostic::new(
                    CODE,
                    count.span,
                    format!("found `{}`, expected a number of sub-indices", shorten(count.value)),
                )
                .help(help(count.value, "write a number of 0 to 255, or `0;` and a number of bits")),
            ),
            Some(_) => {}
        }
        if let Some(extend) = part.value("ObjExtend").filter(|extend| !is_byte(extend.value)) {
            diagnostics.push(
                Diagnostic::new(
                    CODE,
                    extend.span,
                    format!("found `{}`, expected the highest sub-index", shorten(extend.value)),
                )
                .help(help(extend.value, "write a number of 0 to 255")),
            );
        }
    }
}

fn is_count(text: &str) -> bool {
    match text.split_once(';') {
        Some((count, bits)) => is_byte(count.trim()) && is_byte(bits.trim()),
        None => is_byte(text),
    }
}

fn is_byte(text: &str) -> bool {
    lenient_integer(text).is_some_and(|number| (0..=0xFF).contains(&number))
}
