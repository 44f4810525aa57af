//! A REAL holds the number that is written.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity, shorten};
use crate::model::{DataType, Fact, Value};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0830",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a number with more digits than its type keeps",
    explanation: "A REAL32 keeps about seven decimal digits, a REAL64 fifteen. It holds the nearest value that it can represent, and a tool that reads the value back gets another one than the \
        file shows: as REAL32, 16777217 becomes 16777216. A number is as written if it is what the type keeps, rounded to as many digits as are written, or the shortest text that reads back as the \
        same value: 0.1 is right for both. Write what the type keeps; instead of `real32`, you may take `real64`.",
    clause: Some("CiA 301, data types REAL32 and REAL64"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: gain, type: real32, access: rw, default: 0.123456789, eds: {default: withheld}}",
        "objects:\n  0x2000: {name: gain, type: real32, access: rw, default: 0.12345679, eds: {default: withheld}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let values = subject.device.entries().flat_map(|(id, _, entry)| {
        let limits = &entry.real_limits;
        let default = entry.default.as_ref().and_then(Value::real);
        let of_fact = [
            (Fact::Default, default),
            (Fact::LowLimit, limits.low.as_ref()),
            (Fact::HighLimit, limits.high.as_ref()),
        ];
        of_fact.into_iter().filter_map(move |(fact, real)| Some((id, entry, fact, real?)))
    });
    for (id, entry, fact, real) in values {
        let Some(written) = real.departing() else { continue };
        let kept = kept(real.number(), entry.data_type);
        let message =
            format!("{id} ({}): of {}, a {} keeps {kept}", entry.name, shorten(written), entry.data_type);
        let write = format!("write {kept}");
        let or_wider = if entry.data_type == DataType::Real32 { ", or take `real64`" } else { "" };
        let help =
            subject.help(Help { specification: &format!("{write}{or_wider}"), eds: &write, setting: &write });
        findings.push(subject.finding(CODE, id, entry, fact, message).help(help));
    }
}

/// The number that a type keeps, with a decimal point or an exponent.
#[expect(clippy::cast_possible_truncation, reason = "the value that survives is shown")]
fn kept(number: f64, data_type: DataType) -> String {
    if data_type == DataType::Real32 { format!("{:?}", number as f32) } else { format!("{number:?}") }
}
