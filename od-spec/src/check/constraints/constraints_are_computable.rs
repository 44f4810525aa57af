//! The conditions between entries can be worked out with the values of a device.

use crate::check::constraints::constraints_hold::views;
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::shorten;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::Incomputable;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0843",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a constraint that cannot be worked out",
    explanation: "The values at hand make a condition of the specification one that has no answer: it divides by 0, or its numbers are too large for fractions \
        of 128 bits. It cannot be decided whether the device keeps it, so it guards nothing. Give the divisor another default, leave the division out \
        (`a / b < 3` is `a < 3 * b` where `b` is positive), or say with `when:` in which case the condition counts.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: distance, type: unsigned8, access: rw, default: 50}\n  0x2001: {name: time, type: unsigned8, access: rw, default: 0}\nconstraints:\n  speed: {require: \"0x2000 / 0x2001 < 100\"}",
        "objects:\n  0x2000: {name: distance, type: unsigned8, access: rw, default: 50}\n  0x2001: {name: time, type: unsigned8, access: rw, default: 0}\nconstraints:\n  speed: {require: \"0x2000 / 0x2001 < 100\", when: \"0x2001 != 0\"}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for constraint in subject.system.constraints_about(&subject.device.key) {
        for view in views(subject, constraint) {
            let Some(incomputable) = view.incomputable(constraint) else { continue };
            let reason = match incomputable {
                Incomputable::DivisorIsZero(divisor) => format!("`{}` is 0", shorten(&divisor.to_string())),
                Incomputable::TooLarge(term) => format!("`{}` is too large", shorten(&term.to_string())),
            };
            let name = shorten(&constraint.name);
            let message = format!("`{name}` cannot be worked out with the values of `{}`", view.from);
            findings.push(Diagnostic::new(CODE, constraint.span, message).label(reason).help(
                "give the entry another default, or say with `when:` in which case the condition counts",
            ));
            break;
        }
    }
}
