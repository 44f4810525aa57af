//! Names of sections have no prefix, no spaces and no leading zeros.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::document::SectionRef;
use crate::eds::names::{Topic, canonical};
use crate::eds::view::{View, name_place};
use crate::source::Span;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS121",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a section name in another notation",
    explanation: "The name of an object's section is its index in hexadecimal, without `0x`, without spaces and with as few digits \
        as the number has: `[1018]`, `[1018sub1]`. Readers that compare letters find no object in `[0x1018]`, and no \
        sub-index in `[1018sub01]`.",
    clause: Some("CiA 306 4.6.3.2"),
    example: Some(Example::eds(
        "[0x2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (topic, part) in view.topics().filter(|(topic, _)| *topic != Topic::Commissioning) {
        let Some(meant) = canonical(topic) else { continue };
        for section in &part.sections {
            let name = section.name();
            if meant.eq_ignore_ascii_case(name) && !has_blanks(section.header().text()) {
                continue;
            }
            let place = inside(view, section);
            // In one spelling two sections would be there that every reader takes for one.
            let is_single = part.sections.len() == 1;
            let edit = is_single.then(|| Edit { span: place, text: meant.clone() });
            found.add(place, edit, || {
                Diagnostic::new(
                    CODE,
                    place,
                    format!(
                        "`{}` is written `{meant}` in the standard",
                        shorten(name_between_brackets(section.header().text()))
                    ),
                )
                .help(help(&meant, is_single))
            });
        }
    }
    found.finish("sections", diagnostics);
}

fn name_between_brackets(line: &str) -> &str {
    let inside = line.split_once('[').map_or(line, |(_, rest)| rest);
    inside.split_once(']').map_or(inside, |(name, _)| name)
}

fn has_blanks(line: &str) -> bool {
    let name = name_between_brackets(line);
    line.contains(']') && name.trim() != name
}

/// What is between the brackets.
fn inside(view: &View<'_>, section: &SectionRef<'_, '_>) -> Span {
    let text = section.header().text();
    match (text.find('['), text.find(']')) {
        (Some(open), Some(close)) => edits::place(view, section.header()).part(open + 1, close),
        _ => name_place(section.header(), view.file),
    }
}

fn help(meant: &str, is_single: bool) -> String {
    if is_single {
        format!("write `{meant}`; `odgen fix` does")
    } else {
        format!("write `{meant}`, and have one section of this name only")
    }
}
