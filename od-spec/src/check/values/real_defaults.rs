//! Tools disagree about how a REAL value is written in an EDS.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Fact, Value};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0807",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a default or limit of a REAL type",
    explanation: "Tools read `DefaultValue`, `LowLimit` and `HighLimit` of REAL32 and REAL64 differently: some as \
        decimal text, some as the bit pattern of IEEE 754, and some only as integers. They are written as decimal \
        text. Withhold the default from the EDS, or scale the value to an integer; if the tools in use are known to \
        read decimal text, allow this with `allow:`.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: gain, type: real32, access: rw, default: 0.5}",
        "objects:\n  0x2000: {name: gain, type: real32, access: rw, default: 0.5, eds: {default: withheld}}",
    )),
};

const OF_LIMITS: Help<'_> = Help {
    specification: "scale the value to an integer, or say with `allow:` why this is right",
    eds: "leave them out, or scale the value to an integer",
    setting: "the device has to scale the value to an integer",
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, _, entry) in subject.device.entries() {
        let limits = &entry.real_limits;
        // What is set was wished for, in this notation.
        let has_default =
            matches!(entry.default, Some(Value::Real(_))) && entry.eds.default && !entry.is_set();
        let leave_out =
            format!("leave {} out, or scale the value to an integer", subject.format.key(Key::Default));
        let (what, fact, help) = match (has_default, &limits.low, &limits.high) {
            (true, None, None) => (
                "default",
                Fact::Default,
                Help {
                    specification: "withhold it from the EDS with `eds: {default: withheld}`, or scale the value to an integer",
                    eds: &leave_out,
                    setting: "the device has to scale the value to an integer",
                },
            ),
            (true, _, _) => ("default and the limits", Fact::Default, OF_LIMITS),
            (false, Some(_), _) => ("limits", Fact::LowLimit, OF_LIMITS),
            (false, None, Some(_)) => ("limits", Fact::HighLimit, OF_LIMITS),
            (false, None, None) => continue,
        };
        let message = format!("PLC tools may misread the {what} of {id}");
        findings.push(subject.finding(CODE, id, entry, fact, message).help(subject.help(help)));
    }
}
