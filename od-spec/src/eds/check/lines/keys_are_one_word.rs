//! Keys are one word of letters, digits and underscores.

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::view::Entry;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS113",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a key of other characters",
    explanation: "A key consists of letters and digits; the standard itself uses `_` as well. `Supported Objects` with a blank is \
        no key for anybody: editors of CANopen and PLC tools refuse files with it or find no objects.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nScale-Factor=10",
        "; scale factor: 10\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (topic, part) in view.topics() {
        let keys = keys::of(topic);
        for entry in part.entries().filter(|entry| !is_word(entry.key.value)) {
            let joined: String = entry.key.value.split_whitespace().collect();
            let meant = keys.as_ref().and_then(|keys| keys.spelling(&joined));
            let edit = meant.clone().map(|text| Edit { span: entry.key.span, text });
            found.add(entry.key.span, edit, || message(&entry, meant.as_deref()));
        }
    }
    found.finish("keys", diagnostics);
}

fn message(entry: &Entry<'_>, meant: Option<&str>) -> Diagnostic {
    let found = format!("`{}` is not one word of letters and digits", shorten(entry.key.value));
    let diagnostic = Diagnostic::new(CODE, entry.key.span, found);
    match meant {
        Some(meant) => diagnostic.help(format!("write `{meant}`; `odgen fix` does")),
        None => diagnostic.help("write it as one word; if it is meant as a comment, put `;` in front"),
    }
}

/// Whether a text is a key as the standard has them.
pub(super) fn is_word(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}
