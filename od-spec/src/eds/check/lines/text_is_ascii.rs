//! The text is ASCII.

use super::super::edits;
use super::super::keys;
use super::super::rule::FormatRule;
use crate::ascii::transliterate;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::line::{Line, LineKind};
use crate::eds::view::View;
use crate::encoding::as_likely;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS101",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "characters outside ASCII",
    explanation: "An EDS is ASCII text. Other characters are stored in different ways by different editors, and \
        nothing in the file says which: lely's tools and python-canopen refuse a file that is not UTF-8, others show \
        wrong characters. Write `ae` for `ä`, `deg` for `°`. The values of objects are left to you, because they are \
        what the device has.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds(
        "[Comments]\nLines=1\nLine1=Up to 40 °C",
        "[Comments]\nLines=1\nLine1=Up to 40 degC",
    )),
};

/// So many characters of a line are changed one by one.
const FEW: usize = 16;

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let lines = || view.document.lines().iter().filter(|line| !line.text().is_ascii());
    let encoding = view.facts.encoding;
    let text: Vec<&str> = lines().map(Line::text).collect();
    let or_another = as_likely(&text.join("\n"), encoding).map(|page| format!(" or, as likely, {page}"));
    let mut found = Repeated::new();
    for line in lines() {
        // A mark in front of the text is another rule's.
        let foreign = |(_, c): &(usize, char)| !c.is_ascii() && *c != '\u{FEFF}';
        let Some((at, c)) = line.text().char_indices().find(foreign) else { continue };
        let place = edits::place(view, line).part(at, at + c.len_utf8());
        found.add(place, transliterated(view, line), || {
            let text = shorten(&c.to_string());
            let or_another = or_another.as_deref().unwrap_or_default();
            let message = format!("`{text}` is not ASCII, the file is {encoding}{or_another}");
            Diagnostic::new(CODE, place, message)
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
        (LineKind::KeyValue, Some(value))
            if !is_value(line.key().unwrap_or_default(), line.value().unwrap_or_default()) =>
        {
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
    if edits.len() <= FEW {
        return edits;
    }
    // Where there are many, each with a column of its own in a long line, single ones are of no interest.
    let (Some(first), Some(last)) = (edits.first(), edits.last()) else { return edits };
    let (from, to) = (first.span.start - place.start, last.span.end - place.start);
    let between = text.get(from as usize..to as usize).unwrap_or_default();
    let ascii = |c: char| match c {
        c if c.is_ascii() => c.to_string(),
        c => transliterate(c.encode_utf8(&mut [0; 4])),
    };
    vec![Edit { span: place.part(from as usize, to as usize), text: between.chars().map(ascii).collect() }]
}

/// Whether a key holds what the device has, byte by byte, or a number or word that another character would change: `000ª` is no
/// number, `000a` is one.
fn is_value(key: &str, value: &str) -> bool {
    let is_index =
        key.bytes().all(|byte| byte.is_ascii_digit()) && value.starts_with(|c: char| c.is_ascii_digit());
    is_index || keys::is_no_text(key)
}

#[cfg(test)]
mod tests {
    use crate::encoding::Encoding;
    use crate::fix;

    #[test]
    fn what_is_no_number_does_not_become_one() {
        let text = "[2000]\nParameterName=10 µm\nDataType=0x000ª\n[OptionalObjects]\n1=0x2000ª\n";
        let fixed = fix("lamp.eds", text.as_bytes()).unwrap();
        let kept = ["ParameterName=10 um", "DataType=0x000ª", "1=0x2000ª"];
        assert!(kept.iter().all(|line| fixed.text().contains(line)), "{}", fixed.text());
    }

    /// A change for each character would have to be reported with its column, for which the whole line is counted.
    #[test]
    fn many_characters_of_a_line_are_one_change() {
        let text = format!("[FileInfo]\nDescription={}\n", "ä\t".repeat(5000));
        let fixed = fix("lamp.eds", text.as_bytes()).unwrap();
        assert_eq!(fixed.encoding, Encoding::Ascii);
        assert!(fixed.text().contains(&format!("Description={}", "ae\t".repeat(5000).trim_end())));
        let changes = fixed.changes.iter().filter(|change| change.code.id == "EDS101").count();
        assert_eq!(changes, 1);
    }
}
