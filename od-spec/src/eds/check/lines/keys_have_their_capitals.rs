//! Keys have the standard's capitals.

use super::super::keys;
use super::super::repeated::Repeated;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Severity, shorten};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS122",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a key in other capitals",
    explanation: "Keys mean the same in any capitals. But python-canopen and gocanopen compare them letter by letter: they miss \
        `NodeId` and `NrOfRxPDO`, and python-canopen stops at `line5` among `Line1` to `Line4`. Write keys as the \
        standard has them.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments]\nlines=0", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (topic, part) in view.topics() {
        let Some(known) = keys::of(topic) else { continue };
        for entry in part.entries().filter(|entry| !known.is_standard(entry.key.value)) {
            let Some(meant) = known.spelling(entry.key.value) else { continue };
            if meant == entry.key.value {
                continue;
            }
            found.add(entry.key.span, [Edit { span: entry.key.span, text: meant.clone() }], || {
                Diagnostic::new(
                    CODE,
                    entry.key.span,
                    format!("`{}` is written `{meant}` in the standard", shorten(entry.key.value)),
                )
                .help(format!("write `{meant}`; `odgen fix` does"))
            });
        }
    }
    found.finish("keys", diagnostics);
}
