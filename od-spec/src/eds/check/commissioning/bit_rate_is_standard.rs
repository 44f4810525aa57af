//! The bit rate is one of CiA 301, in kbit/s.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Severity, shorten};
use crate::eds::coded;
use crate::eds::names::Topic;
use crate::eds::number::{help, lenient_integer};
use crate::eds::view::View;
use crate::model::BIT_RATES;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS705",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a bit rate that CiA 301 does not have",
    explanation: "`Baudrate` is the bit rate in kbit/s, one of 10, 20, 50, 125, 250, 500, 800 and 1000. Readers do not \
        understand `500000` or `500K`; 500 is meant, and taken.",
    clause: Some("CiA 306 5.3"),
    example: Some(Example::dcf(
        "[DeviceComissioning]\nNodeID=1\nBaudrate=125000",
        "[DeviceComissioning]\nNodeID=1\nBaudrate=125",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(value) = view.section(Topic::Commissioning).and_then(|part| part.value("Baudrate")) else {
        return;
    };
    let rate = lenient_integer(value.value);
    if BIT_RATES.into_iter().any(|standard| rate == Some(i128::from(standard))) {
        return;
    }
    let message = format!("found `{}`, expected a bit rate in kbit/s", shorten(value.value));
    let diagnostic = Diagnostic::new(CODE, value.span, message);
    diagnostics.push(match coded::bit_rate(value.value) {
        Some(standard) => {
            let mut diagnostic = diagnostic.help(format!("write `Baudrate={standard}`; `odgen fix` does"));
            diagnostic.edits.push(Edit { span: value.span, text: standard.to_string() });
            diagnostic
        }
        None => diagnostic.help(help(value.value, "write 10, 20, 50, 125, 250, 500, 800 or 1000")),
    });
}
