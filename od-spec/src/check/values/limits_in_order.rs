//! The low limit of an entry is not above the high one.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Fact, Value};
use crate::wording::format_value;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0407",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "limits in the wrong order",
    explanation: "The low limit is above the high limit, so that no value would be allowed. Probably the two were swapped. Correct one of them.",
    clause: Some("CiA 306, 4.6.3.2 (LowLimit, HighLimit)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: brightness, type: unsigned8, access: rw, min: 100, max: 0}",
        "objects:\n  0x2000: {name: brightness, type: unsigned8, access: rw, min: 0, max: 100}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, _, entry) in subject.device.entries() {
        // What follows from the target of a view is reported there.
        if entry.alias.is_some()
            && entry.facts.get(Fact::LowLimit).is_none()
            && entry.facts.get(Fact::HighLimit).is_none()
        {
            continue;
        }
        let are_swapped = entry.low.zip(entry.high).is_some_and(|(low, high)| low > high)
            || entry.real_limits.are_swapped(entry.data_type);
        let (Some(low), Some(high)) = entry.limits() else { continue };
        if !are_swapped {
            continue;
        }
        let show = |limit: Value| format_value(entry, &limit);
        let message = format!(
            "{id} ({}): the low limit {} is above the high limit {}",
            entry.name,
            show(low),
            show(high)
        );
        findings.push(
            subject
                .finding(CODE, id, entry, Fact::LowLimit, message)
                .label("low limit")
                .with(subject.place(entry, Fact::HighLimit), "high limit")
                .help("swap or correct the two"),
        );
    }
}
