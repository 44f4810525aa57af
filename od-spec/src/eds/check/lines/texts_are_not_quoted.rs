//! Names and texts are without quotation marks.

use super::super::keys::TEXTS;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity, shorten};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS115",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "quotation marks around a text",
    explanation: "Texts are written as they are, without quotation marks. What is in quotation marks has them in its name: \
        tools show them, or make them part of a variable's name. Remove them, unless they are meant.",
    clause: Some("CiA 306 4.3"),
    example: Some(Example::eds(
        "[DeviceInfo]\nVendorName=\"Example\"\n; ...",
        "[DeviceInfo]\nVendorName=Example\n; ...",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for entry in view.parts().flat_map(super::super::super::view::Part::entries) {
        let value = entry.value.value;
        let is_quoted = value.len() > 1 && value.starts_with('"') && value.ends_with('"');
        if is_quoted && TEXTS.iter().any(|key| key.eq_ignore_ascii_case(entry.key.value)) {
            found.add(entry.value.span, [], || {
                Diagnostic::new(CODE, entry.value.span, format!("`{}` is in quotation marks", shorten(value)))
                    .help("remove the quotation marks, unless they are part of the text")
            });
        }
    }
    found.finish("texts", diagnostics);
}
