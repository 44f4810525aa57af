//! The lower end of a range that a profile keeps in two entries lies below the upper one.

use crate::check::device::device_type_is_kept::{DRIVES, IO_MODULES, axes};
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{EntryId, Index, Object, SubIndex};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0891",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a range whose lower end lies above its upper end",
    explanation: "Two entries are the ends of a range: sub-index 1 and 2 of 607Bh, 607Dh, 6046h, 6047h and 6056h to 6059h (with 3 and 4 of 6047h, 6057h and 6059h) in a drive, 6425h and 6424h in \
        an I/O module. With the lower end above the upper one, nothing lies between them: the drive does not move, and the input sends nothing or always. Swap the two.",
    clause: Some("CiA 402, objects 6046h, 607Bh and 607Dh; CiA 401, objects 6424h and 6425h"),
    example: Some(Example::new(
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x607D: {from: cia402, array: {pdo: none, elements: {1: {default: 1000}, 2: {default: -1000}}}}",
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x607D: {from: cia402, array: {pdo: none, elements: {1: {default: -1000}, 2: {default: 1000}}}}",
    )),
};

/// Objects of a drive whose sub-indices 1 and 2 are the ends of a range.
const PAIRS: [u16; 8] = [0x6046, 0x6047, 0x6056, 0x6057, 0x6058, 0x6059, 0x607B, 0x607D];
/// Those whose sub-indices 3 and 4 are so, too.
const SECOND_PAIRS: [u16; 3] = [0x6047, 0x6057, 0x6059];
/// Upper limits of the analogue inputs, and the lower ones.
const UPPER: u16 = 0x6424;
const LOWER: u16 = 0x6425;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let mut ends: Vec<(EntryId, EntryId)> = Vec::new();
    for first in axes(subject, DRIVES) {
        let mut pair = |index: u16, low: u8| {
            let index = Index(index - 0x6000 + first.0);
            ends.push((EntryId { index, sub: SubIndex(low) }, EntryId { index, sub: SubIndex(low + 1) }));
        };
        for index in PAIRS {
            pair(index, 1);
        }
        for index in SECOND_PAIRS {
            pair(index, 3);
        }
    }
    for first in axes(subject, IO_MODULES) {
        let at = |index: u16| Index(index - 0x6000 + first.0);
        let inputs = subject.device.objects.get(&at(LOWER)).into_iter().flat_map(Object::counted);
        ends.extend(inputs.map(|entry| {
            (EntryId { index: at(LOWER), sub: entry.sub }, EntryId { index: at(UPPER), sub: entry.sub })
        }));
    }
    for (low, high) in ends {
        let parameter = |id: EntryId| subject.parameter(id.index.0, id.sub.0);
        let (Some(low), Some(high)) = (parameter(low), parameter(high)) else { continue };
        if low.raw() <= high.raw() {
            continue;
        }
        let message = format!("{} is {}, the upper end {} is {}", low.id, low.raw(), high.id, high.raw());
        let (blamed, other) =
            if high.entry.is_set() && !low.entry.is_set() { (&high, &low) } else { (&low, &high) };
        let finding = blamed.finding(CODE, message);
        let finding = if other.place == blamed.place {
            finding
        } else {
            finding.with(other.place, other.id.to_string())
        };
        findings.push(finding.help("swap or correct the two"));
    }
}
