//! An error code is of a class of CiA 301.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{ErrorCode, System};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::System(check) };

const CODE: &Code = &Code {
    id: "OD0876",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an error code of no class",
    explanation: "The upper byte of an error code is its class, by which a master treats codes that it does not know: \
        current (2xxxh), voltage (3xxxh), temperature (4xxxh), hardware (5xxxh), software (6xxxh), modules (7xxxh), \
        monitoring (8xxxh), external (9xxxh), others (10xxh, F0xxh, FFxxh). 00xxh means that there is no error, so a \
        master takes such a code as the end of an error; 01xxh to 0Fxxh and Axxxh to Exxxh are not classes. Take a \
        code of the class of the error; those of the maker's own are FFxxh.",
    clause: Some("CiA 301, table 21 (emergency error codes)"),
    example: Some(Example::new(
        "errors:\n  0xA123: {name: pump blocked}",
        "errors:\n  0xFF23: {name: pump blocked}",
    )),
};

fn check(system: &System, findings: &mut Findings) {
    let mut said: Option<Span> = None;
    for error in &system.errors {
        let problem = match error.code >> 8 {
            0 if error.code != ErrorCode::NONE => "means that there is no error (class 00xxh)",
            0x01..=0x0F | 0xA0..=0xEF => "is of no class",
            _ => continue,
        };
        // A run of codes has one place.
        if said == Some(error.span) {
            continue;
        }
        said = Some(error.span);
        let message = format!("error code {:04X}h {problem}", error.code);
        findings.push(
            Diagnostic::new(CODE, error.span, message)
                .help("take a code of the class of the error; those of the maker's own are FFxxh"),
        );
    }
}
