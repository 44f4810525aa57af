//! Granularity 0 means "no mapping can be changed", and nothing else does; placeholders are not shorter than the
//! granularity.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{DataType, Fact, Index, Pdo};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0509",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "granularity against mapping",
    explanation: "A granularity of 0 means that no mapping can be changed; any other value that at least one can. The PDOs say the opposite, or a \
        placeholder of the device is shorter than its granularity: a tool would refuse to change a mapping that can be changed, or try where it cannot. \
        Correct `granularity:` or `dummies:` of the device, or `mapping:` of the PDOs.",
    clause: Some("CiA 306, 4.5 ([DeviceInfo], Granularity)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {mapping: fixed, map: [level]}}}",
        "devices:\n  io: {name: Example, bit-rates: [125], granularity: 0, features: [heartbeat producer]}\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {mapping: fixed, map: [level]}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    mapping(subject, findings);
    placeholders(subject, findings);
}

/// Granularity 0 and fixed mappings go together.
fn mapping(subject: &Subject<'_>, findings: &mut Findings) {
    let (device, keys) = (subject.device, subject.format);
    // A PDO without a mapping parameter is said by itself.
    let has_mapping = |pdo: &&Pdo| device.objects.contains_key(&Index(pdo.mapping_index()));
    let Some(first) = device.pdos.iter().find(has_mapping) else { return };
    let variable = device.pdos.iter().find(|pdo| pdo.variable_mapping);
    let (pdo, problem) = match (device.info.granularity, variable) {
        (0, Some(pdo)) => (pdo, "granularity is 0, but this mapping can be changed"),
        (1.., None) => (first, "granularity is not 0, but no mapping can be changed"),
        (0, None) | (1.., Some(_)) => return,
    };
    let diagnostic = Diagnostic::new(CODE, pdo.span, format!("`{}`: {problem}", device.key))
        .about(Index(pdo.mapping_index()))
        .help(subject.help(Help {
            specification: "correct the device's `granularity:`, or `mapping:` of the PDOs",
            eds: &format!(
                "correct {}, or {} of the mapping parameters",
                keys.key(Key::Granularity),
                keys.key(Key::Access)
            ),
            setting: "the granularity and the mappings of the device have to be corrected",
        }));
    findings.push(match device.facts.get(Fact::Granularity) {
        Some(granularity) => diagnostic.with(granularity.span, "the granularity"),
        None => diagnostic,
    });
}

/// A placeholder fills at least one step of the granularity.
fn placeholders(subject: &Subject<'_>, findings: &mut Findings) {
    let (device, granularity) = (subject.device, subject.device.info.granularity);
    let is_short =
        |placeholder: &&DataType| placeholder.bits().is_some_and(|bits| bits < u16::from(granularity));
    if let Some(short) = device.info.dummies.iter().find(is_short) {
        let message =
            format!("`{}` takes {short} placeholders, but its granularity is {granularity}", device.key);
        findings.push_each(Diagnostic::new(CODE, device.place(Fact::Granularity), message).help(
            subject.help(Help {
                specification: "take the type out of `dummies:`, or lower the device's `granularity:`",
                eds: &format!(
                    "write `Dummy{:04X}=0`, or lower {}",
                    short.code(),
                    subject.format.key(Key::Granularity)
                ),
                setting: "the granularity and the placeholders of the device have to be corrected",
            }),
        ));
    }
}
