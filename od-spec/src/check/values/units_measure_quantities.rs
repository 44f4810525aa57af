//! What has a unit is a quantity.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Entry, Fact, Family, TypeKind};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0882",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a unit on something that is not a quantity",
    explanation: "A unit says what one step of a number is worth. The values of an enum are names, those of a bit field are bits, and a text, a truth value, a time with its date or a block \
        of bytes has no steps. Masters and documents would show such a value as so many volts. Remove `unit:`, or correct the type. A number that has a few values with a meaning of \
        their own keeps its unit with `special:`.",
    clause: None,
    example: Some(Example::new(
        "units: {volt: {symbol: V}}\ntypes: {mode: {base: unsigned8, values: {0: low, 1: high}}}\nobjects:\n  0x2000: {name: level, type: mode, access: rw, unit: volt, default: 0}",
        "units: {volt: {symbol: V}}\nobjects:\n  0x2000: {name: level, type: unsigned8, access: rw, unit: volt, default: 0}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, _, entry) in subject.device.entries().filter(|(.., entry)| entry.unit.is_some()) {
        let Some(what) = without_quantity(entry) else { continue };
        let message = format!("{id} ({}) has a unit, but is {what}", entry.name);
        findings.push(
            subject
                .finding(CODE, id, entry, Fact::Unit, message)
                .help("remove the unit, or correct the type"),
        );
    }
}

/// What an entry is whose values are not quantities.
fn without_quantity(entry: &Entry) -> Option<&'static str> {
    match (entry.named_type.as_ref().map(|named| &named.kind), entry.data_type.family()) {
        (Some(TypeKind::Enum(_)), _) => Some("an enum"),
        (Some(TypeKind::Bits(_)), _) => Some("a bit field"),
        (None, Family::Signed | Family::Unsigned | Family::Real) => None,
        (None, Family::Boolean) => Some("a truth value"),
        (None, Family::VisibleString | Family::UnicodeString) => Some("a text"),
        (None, Family::OctetString | Family::Domain) => Some("a block of bytes"),
        (None, Family::Time) => Some("a time with its date"),
    }
}
