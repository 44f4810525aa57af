//! Where a PLC may create network variables, the device has no objects.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0896",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an object among network variables",
    explanation: "Tools of PLCs create network variables at the indices of the dynamic channels; until then there is nothing, and an EDS describes no object there. A tool would take the index \
        of this object for a variable of its own. Give the object another index, or the channels other ones.",
    clause: Some("CiA 306, 4.6.3.4.3 (objects that are created dynamically)"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer], dynamic-channels: {0xA080..0xA0BF: {type: unsigned8, access: ro, offset: 0}}}\nobjects:\n  0xA080: {name: level, type: unsigned8, access: ro}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer], dynamic-channels: {0xA080..0xA0BF: {type: unsigned8, access: ro, offset: 0}}}\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for channel in &subject.device.info.dynamic_channels {
        for (index, object) in subject.device.objects.range(channel.first..=channel.last) {
            let message = format!(
                "{index} ({}) lies where PLCs create variables, {} to {}",
                object.name, channel.first, channel.last
            );
            findings.push(
                subject
                    .object_finding(CODE, object, message)
                    .help("give the object another index, or the channels"),
            );
        }
    }
}
