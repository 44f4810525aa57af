//! Numbers about file, device and node are decimal or hexadecimal, and nothing else.

use super::super::rule::FormatRule;
use super::information_is_numbers::NUMBERS;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Severity, shorten};
use crate::eds::names::Topic;
use crate::eds::number::{Deviation, Number, integer};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS207",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a number about the device in another notation",
    explanation: "Numbers are decimal or, with `0x`, hexadecimal. A leading zero makes a decimal number an octal one: \
        `010` is 8 for those who follow the standard, 10 for some, and python-canopen stops at `001`. Signs, points, \
        quotation marks and suffixes such as `UL` are not part of a number.",
    clause: Some("CiA 306 4.3"),
    example: Some(Example::eds(
        "[DeviceInfo]\nVendorNumber=010\n; ...",
        "[DeviceInfo]\nVendorNumber=8\n; ...",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    const MORE: [(Topic, &str); 4] = [
        (Topic::FileInfo, "FileVersion"),
        (Topic::FileInfo, "FileRevision"),
        (Topic::Commissioning, "NodeID"),
        (Topic::Commissioning, "Baudrate"),
    ];
    for (topic, key) in NUMBERS.into_iter().map(|(topic, key, _)| (topic, key)).chain(MORE) {
        let Some(value) = view.section(topic).and_then(|part| part.value(key)) else { continue };
        let Some(number) = integer(value.value) else { continue };
        // A version such as `1.0` is another rule's.
        let is_version = topic == Topic::FileInfo && number.deviations.contains(&Deviation::Fraction);
        let Some(deviation) = number.deviations.first().filter(|_| !is_version) else { continue };
        let text = shorten(value.value);
        let message = match deviation {
            Deviation::Octal => format!("`{key}` is `{text}`, which is octal: {}", number.value),
            Deviation::NegativeHex
            | Deviation::PlusSign
            | Deviation::Suffix(_)
            | Deviation::Fraction
            | Deviation::Word
            | Deviation::Remark(_)
            | Deviation::Quoted => format!("`{key}` is `{text}`, expected {} and nothing else", number.value),
        };
        let mut diagnostic = Diagnostic::new(CODE, value.span, message);
        diagnostic.edits.extend(plain(&number).map(|text| Edit { span: value.span, text }));
        let help = if diagnostic.edits.is_empty() {
            "write the number without the zero if it is meant as decimal"
        } else {
            "write the number alone; `odgen fix` does"
        };
        diagnostics.push(diagnostic.help(help));
    }
}

/// The number alone, unless it is doubtful which is meant: most people who write a zero in front mean a decimal number.
fn plain(number: &Number) -> Option<String> {
    let is_doubtful = number.deviations.contains(&Deviation::Octal) && number.value > 7;
    (!is_doubtful).then(|| number.value.to_string())
}
