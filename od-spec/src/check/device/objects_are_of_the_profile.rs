//! Objects of a device profile belong to a device whose type names the profile.

use std::collections::BTreeMap;

use crate::check::device::device_type_is_kept::{DRIVES, IO_MODULES, profiles};
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::standard_objects::from_library::{CIA401, CIA402};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Index, Object, Role, SystemSource};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0885",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "objects of a profile that the device type does not name",
    explanation: "6000h to 9FFFh mean what a device profile says, and the low word of 1000h says which one: 401 for I/O modules, 402 for drives, 0 for none. The device has objects of a profile \
        that its type does not name, so that masters do not treat it as what it is; or objects of its own in this area, although it names no profile. A frequent cause is a number written \
        as hexadecimal: 402 is 192h. Correct `device-type:`, or move objects of the maker's own to 2000h to 5FFFh.",
    clause: Some("CiA 301, table 1 and object 1000h"),
    example: Some(Example::new(
        "uses: [cia301, cia401]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x0001_0401, features: [heartbeat producer, digital inputs 8-bit: 8]}\npdos: {io: {transmit: {1: {map: [0x6000.1]}}}}",
        "uses: [cia301, cia401]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x0001_0191, features: [heartbeat producer, digital inputs 8-bit: 8]}\npdos: {io: {transmit: {1: {map: [0x6000.1]}}}}",
    )),
};

/// The libraries of device profiles, their numbers, and the objects that make a device one of the profile; others are taken from there by many.
const LIBRARIES: [(&str, i128, &[u16]); 2] = [
    (
        CIA401,
        IO_MODULES,
        &[
            0x6000, 0x6100, 0x6120, 0x6200, 0x6300, 0x6320, 0x6400, 0x6401, 0x6402, 0x6403, 0x6410, 0x6411,
            0x6412, 0x6413,
        ],
    ),
    (CIA402, DRIVES, &[0x6040, 0x6041]),
];

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // Which objects are of a profile, an EDS does not say.
    if subject.system.source != SystemSource::Specification {
        return;
    }
    let Some(parameter) = subject.parameter(0x1000, 0) else { return };
    let named: BTreeMap<Index, i128> = profiles(subject);
    let objects = || subject.device.objects.values().filter(|object| object.role() == Role::DeviceProfile);
    for (library, number, makes) in LIBRARIES {
        let is_of =
            |object: &&Object| object.profile.as_deref() == Some(library) && makes.contains(&object.index.0);
        let Some(object) = objects().find(is_of).filter(|_| !named.values().any(|one| *one == number)) else {
            continue;
        };
        let message = format!(
            "{} is of profile {number}, the device type of `{}` names {}",
            object.index,
            subject.device.key,
            names(&named)
        );
        let help = format!("write {number} (0x{number:04X}) into the low word of `device-type:`");
        findings.push(parameter.finding(CODE, message).help(help));
    }
    let names_none = !named.is_empty() && named.values().all(|one| *one == 0);
    let is_own = |object: &&Object| object.profile.is_none();
    if let Some(object) = objects().find(is_own).filter(|_| names_none) {
        let message = format!("{} is in the area of device profiles, of which none is named", object.index);
        let more = objects().filter(is_own).count() - 1;
        let finding: Diagnostic = subject
            .object_finding(CODE, object, message)
            .help("name the profile in `device-type:`, or move the object to 2000h to 5FFFh");
        findings.push(match more {
            0 => finding,
            1 => finding.note("so does 1 more object"),
            _ => finding.note(format!("so do {more} more objects")),
        });
    }
}

/// `no profile`, `profile 401`.
fn names(named: &BTreeMap<Index, i128>) -> String {
    let numbers: Vec<String> =
        named.values().filter(|number| **number != 0).map(|number| format!("profile {number}")).collect();
    if numbers.is_empty() { "none".to_owned() } else { numbers.join(", ") }
}
