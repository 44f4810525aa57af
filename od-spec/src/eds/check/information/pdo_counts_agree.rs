//! The device says how many PDOs it has.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;
use crate::model::Index;
use std::ops::RangeInclusive;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS214",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a number of PDOs that differs from what is described",
    explanation: "`NrOfRXPDO` and `NrOfTXPDO` are the number of all PDOs that the device can receive and transmit. Without \
        `CompactPDO` every one of them is described, by an object of 1400h to 15FFh or 1800h to 19FFh. PLC tools offer \
        as many as the key says, and lely's tools make up those that are counted and not described.",
    clause: Some("CiA 306 4.5"),
    example: Some(Example::eds("[DeviceInfo]\nNrOfTXPDO=3\n; ...", "[DeviceInfo]\nNrOfTXPDO=0\n; ...")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::DeviceInfo) else { return };
    let number = |key: &str| part.value(key).map_or(Some(0), |value| lenient_integer(value.value));
    let Some(compact) = number("CompactPDO") else { return };
    for (key, what, objects) in
        [("NrOfRXPDO", "receive", 0x1400..=0x15FF), ("NrOfTXPDO", "transmit", 0x1800..=0x19FF)]
    {
        let described = count(view, objects);
        let Some(declared) = number(key) else { continue };
        if declared == described || (compact != 0 && declared > described) {
            continue;
        }
        let place = part.key(key).map_or(part.place(), |entry| entry.value.span);
        let message =
            format!("`{key}` is {declared}, but the number of {what} PDOs that are described is {described}");
        let mut diagnostic = Diagnostic::new(CODE, place, message);
        // What is described is there; whether the others are, only the maker knows.
        if declared > described {
            diagnostics
                .push(diagnostic.help("describe the others, or write the number of PDOs that are described"));
            continue;
        }
        diagnostic.edits.extend(edits::set(view, part, key, &described.to_string()));
        diagnostics.push(diagnostic.help(format!("write `{key}={described}`; `odgen fix` does")));
    }
}

/// The communication parameters that are described.
fn count(view: &View<'_>, objects: RangeInclusive<u16>) -> i128 {
    let indices = Index(*objects.start())..=Index(*objects.end());
    i128::try_from(view.objects.range(indices).filter(|(_, object)| object.object.is_some()).count())
        .unwrap_or_default()
}
