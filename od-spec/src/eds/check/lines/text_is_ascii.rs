//! The text is ASCII.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::ascii::transliterate;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::line::{Line, LineKind};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS101",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "characters outside ASCII",
    explanation: "An EDS is ASCII text. Other characters are stored in different ways by different editors, and nothing in the \
        file says which: lely's tools and python-canopen refuse a file that is not UTF-8, others show wrong characters. \
        Write `ae` for `ä`, `deg` for `°`. The values of objects are left to you, as they are what the device has.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds(
        "[Comments]\nLines=1\nLine1=Up to 40 °C",
        "[Comments]\nLines=1\nLine1=Up to 40 degC",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for line in view.document.lines().iter().filter(|line| !line.text().is_ascii()) {
        // A mark in front of the text is another rule's.
        let foreign = |(_, c): &(usize, char)| !c.is_ascii() && *c != '\u{FEFF}';
        let Some((at, c)) = line.text().char_indices().find(foreign) else { continue };
        let place = edits::place(view, line).part(at, at + c.len_utf8());
        found.add(place, transliterated(view, line), || {
            let text = shorten(&c.to_string());
            Diagnostic::new(
                CODE,
                place,
                format!("`{text}` is not ASCII, the file is {}", view.facts.encoding),
            )
            .help("write it in ASCII; `odgen fix` transliterates names and texts")
        });
    }
    found.finish("lines", diagnostics);
}

/// The changes that make a name, text or comment ASCII; none for the values of objects and for what has no transcription.
fn transliterated(view: &View<'_>, line: &Line<'_>) -> Vec<Edit> {
    let text = line.text();
    let start = match (line.kind(), line.value_part()) {
        (LineKind::Comment, _) => 0,
        (LineKind::KeyValue, Some(value)) if !is_value(line.key().unwrap_or_default()) => {
            value.start as usize
        }
        _ => return Vec::new(),
    };
    let place = edits::place(view, line);
    let mut edits = Vec::new();
    for (at, c) in text.char_indices().filter(|(at, c)| *at >= start && !c.is_ascii()) {
        let ascii = transliterate(c.encode_utf8(&mut [0; 4]));
        if ascii.contains('?') {
            return Vec::new();
        }
        edits.push(Edit { span: place.part(at, at + c.len_utf8()), text: ascii });
    }
    edits
}

/// Whether a key holds what the device has, byte by byte.
fn is_value(key: &str) -> bool {
    ["DefaultValue", "ParameterValue", "LowLimit", "HighLimit"]
        .iter()
        .any(|name| name.eq_ignore_ascii_case(key))
}
