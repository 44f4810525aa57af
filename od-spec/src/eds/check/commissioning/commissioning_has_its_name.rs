//! The section about the node is spelled as in the standard.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Severity, shorten};
use crate::eds::names::{Topic, canonical};
use crate::eds::view::{View, name_place};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS702",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a second m in the name of the section about the node",
    explanation: "The standard spells the section `[DeviceComissioning]`, with one m, and so do the tools that follow it: \
        python-canopen and lely's find no node-ID in `[DeviceCommissioning]`. Few readers know both.",
    clause: Some("CiA 306 5.3"),
    example: Some(Example::dcf(
        "[DeviceCommissioning]\nNodeID=1\nBaudrate=125",
        "[DeviceComissioning]\nNodeID=1\nBaudrate=125",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::Commissioning) else { return };
    let Some(meant) = canonical(Topic::Commissioning) else { return };
    for section in part.sections.iter().filter(|section| section.name() != meant) {
        let place = name_place(section.header(), view.file);
        let is_single = part.sections.len() == 1;
        let mut diagnostic = Diagnostic::new(
            CODE,
            place,
            format!("`{}` is written `{meant}` in the standard", shorten(section.name())),
        )
        .help(if is_single {
            format!("write `{meant}`; `odgen fix` does")
        } else {
            format!("have one section `{meant}` only")
        });
        diagnostic.edits.extend(is_single.then(|| Edit { span: place, text: meant.clone() }));
        diagnostics.push(diagnostic);
    }
}
