//! 1000h and 1018h say what vendor and device say.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::check::subject::entry_id;
use crate::diag::{Code, Example, Severity};
use crate::model::{Fact, SystemSource, Value};
use crate::wording::Key;
use crate::wording::format_value;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0611",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an identity that disagrees",
    explanation: "1000h and 1018h hold the device type, the vendor number, the product code and the revision, and `[DeviceInfo]` of the EDS says the \
        same numbers from `vendor:` and `devices:`. A PLC compares the two at boot and refuses the device where they differ. Remove the \
        default: it follows from the vendor and the device.",
    clause: Some("CiA 306, 4.5 ([DeviceInfo]); CiA 301, objects 1000h and 1018h"),
    example: Some(Example::new(
        "vendor: {name: Example, number: 0x10}\nobjects:\n  0x1018: {from: cia301, record: {1: {default: 0x11}}}",
        "vendor: {name: Example, number: 0x10}\nobjects:\n  0x1018: {from: cia301}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let (info, keys, vendor) = (&subject.device.info, subject.format, &subject.system.vendor);
    let says = |fact| subject.device.facts.get(fact).is_some();
    // An EDS states the device type in 1000h alone.
    let identity = [
        (entry_id(0x1000, 0), says(Fact::DeviceType), info.device_type, "the device type".to_owned()),
        (entry_id(0x1018, 1), vendor.number_span.is_some(), vendor.number, keys.key(Key::Vendor)),
        (entry_id(0x1018, 2), says(Fact::Product), info.product, keys.key(Key::Product)),
        (
            entry_id(0x1018, 3),
            says(Fact::ProductRevision),
            info.product_revision,
            "`RevisionNumber`".to_owned(),
        ),
    ];
    for (id, is_said, number, key) in identity {
        // What a file does not say disagrees with nothing; that it is missing is said by itself. For a specification, 0 is
        // what its EDS says.
        if !is_said && subject.system.source == SystemSource::Eds {
            continue;
        }
        let Some(entry) = subject.device.entry(id) else { continue };
        let Some(stated) = entry.default.as_ref() else { continue };
        let number = Value::Integer(i128::from(number));
        if *stated != number {
            let (stated, number) = (format_value(entry, stated), format_value(entry, &number));
            findings.push(
                subject
                    .finding(
                        CODE,
                        id,
                        entry,
                        Fact::Default,
                        format!(
                            "{id} ({}) says {stated}, {} {number}",
                            entry.name,
                            said_by(subject.system.source)
                        ),
                    )
                    .help(subject.help(Help {
                        specification: "remove the default; it follows from the vendor and the device",
                        eds: &format!(
                            "correct {key} in `[DeviceInfo]`, or {} of {id}",
                            keys.key(Key::Default)
                        ),
                        setting: "leave the entry out; it states what the device is",
                    })),
            );
        }
    }
}

/// What states the numbers in addition to the objects.
const fn said_by(source: SystemSource) -> &'static str {
    match source {
        SystemSource::Specification => "the device",
        SystemSource::Eds => "`[DeviceInfo]`",
    }
}
