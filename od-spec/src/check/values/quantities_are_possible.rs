//! A temperature lies above absolute zero.

use std::cmp::Ordering;

use crate::check::findings::Findings;
use crate::check::possible::hull;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Fact, Ratio, Unit};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0897",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a temperature below absolute zero",
    explanation: "Every value that the entry can have is below -273.15 °C. The offset of a unit is in its symbol and \
        not in raw steps: -273.2 for a raw value in tenths that counts from there. Correct `offset:` or `scale:`, or \
        the limits.",
    clause: None,
    example: Some(Example::new(
        "units: {decikelvin: {symbol: °C, scale: 1/10, offset: -2732}}\nobjects:\n  0x2000: {name: temperature, type: unsigned8, access: ro, unit: decikelvin}",
        "units: {decikelvin: {symbol: °C, scale: 1/10, offset: -27315/100}}\nobjects:\n  0x2000: {name: temperature, type: unsigned16, access: ro, unit: decikelvin}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, _, entry) in subject.device.entries() {
        let Some(unit) = entry.unit.as_deref().filter(|unit| unit.formula.is_none()) else { continue };
        let Some(zero) = absolute_zero(unit) else { continue };
        let Some((low, high)) = hull(entry) else { continue };
        let is_below =
            |raw: i128| unit.quantity(raw).and_then(|value| value.compare(zero)).is_some_and(Ordering::is_lt);
        if is_below(low) && is_below(high) {
            let message = format!("{id} ({}) is never warmer than {}", entry.name, unit.show(high));
            findings.push(
                subject
                    .finding(CODE, id, entry, Fact::Unit, message)
                    .help("correct the unit: an offset is in its symbol, not in raw steps"),
            );
        }
    }
}

/// Absolute zero in the basic symbol of a temperature.
fn absolute_zero(unit: &Unit) -> Option<Ratio> {
    match unit.base_symbol() {
        "°C" => Ratio::new(-27_315, 100),
        // Differences are in K, too.
        _ => None,
    }
}
