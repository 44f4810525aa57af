//! Names of sections have the standard's case.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::names::{Topic, canonical};
use crate::eds::view::{View, name_place};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS120",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a section name in another case",
    explanation: "Names of sections mean the same in upper and lower case. But lely's dcfgen and gocanopen look for `[1A00sub1]` letter by \
        letter and do not find `[1a00Sub1]`. Write index and sub-index in upper case, `sub` in lower case, and the \
        other names as the standard has them.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[comments]\nLines=0", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (topic, part) in view.topics().filter(|(topic, _)| *topic != Topic::Commissioning) {
        let Some(meant) = canonical(topic) else { continue };
        for section in &part.sections {
            let name = section.name();
            if name == meant || !(meant.eq_ignore_ascii_case(name)) {
                continue;
            }
            let place = name_place(section.header(), view.file);
            // In one spelling two sections would be there that every reader takes for one.
            let is_single = part.sections.len() == 1;
            let edit = is_single.then(|| Edit { span: place, text: meant.clone() });
            found.add(place, edit, || {
                Diagnostic::new(
                    CODE,
                    place,
                    format!("`{}` is written `{meant}` in the standard", shorten(name)),
                )
                .help(help(&meant, is_single))
            });
        }
    }
    found.finish("sections", diagnostics);
}

fn help(meant: &str, is_single: bool) -> String {
    if is_single {
        format!("write `{meant}`; `odgen fix` does")
    } else {
        format!("write `{meant}`, and have one section of this name only")
    }
}
