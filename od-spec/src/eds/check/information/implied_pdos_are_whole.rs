//! PDOs that are not described have an identifier and a transmission type.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS215",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "PDOs without identifier or transmission type",
    explanation: "`CompactPDO` says, with a bit for each, which sub-indices the communication parameters have that the \
        file does not describe. Sub-indices 1 and 2, bits 0 and 1, are mandatory, and there are six: the value is \
        `0x3` to `0x3F`. It makes no sense where no PDO is left to imply.",
    clause: Some("CiA 306 4.6.3.4.1"),
    example: Some(Example::eds(
        "[DeviceInfo]\nNrOfTXPDO=1\nCompactPDO=0x2\n; ...",
        "[DeviceInfo]\nNrOfTXPDO=1\nCompactPDO=0x3\n; ...",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::DeviceInfo) else { return };
    let number = |key: &str| part.value(key).and_then(|value| lenient_integer(value.value)).unwrap_or(0);
    let Some(value) = part.value("CompactPDO") else { return };
    let mask = number("CompactPDO");
    let message = match mask {
        0 => return,
        _ if number("NrOfRXPDO") == 0 && number("NrOfTXPDO") == 0 => {
            "`CompactPDO` implies PDOs, but the device has none".to_owned()
        }
        _ if mask & 0x3 != 0x3 => format!("`CompactPDO` is {mask:#X}, without sub-index 1 or 2"),
        _ if mask > 0x3F => {
            format!("`CompactPDO` is {mask:#X}, with more than the six sub-indices there are")
        }
        _ => return,
    };
    diagnostics.push(
        Diagnostic::new(CODE, value.span, message)
            .help("set the bits of the sub-indices that the PDOs have: `0x3`"),
    );
}
