//! A device has what its device type promises: the objects of every drive, the types of the profiles that it unites.

use super::findings::Findings;
use super::rule::{Check, Needs, Rule};
use super::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::Index;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0817",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a device type without its objects",
    explanation: "The low word of 1000h names a device profile, and masters that know the profile use its objects without looking: for 402, a drive, controlword, statusword, \
        mode of operation and its display (6040h, 6041h, 6060h, 6061h). A high word of FFFFh says that several profiles are united, each of which tells its own type in 67FFh, \
        6FFFh and so on. Some of these objects are missing. Add them, or correct `device-type:`.",
    clause: Some("CiA 301, object 1000h; CiA 402, objects that every drive has"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer]}",
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6502: {from: cia402, default: 0}",
    )),
};

/// Number of the profile for drives.
const DRIVES: i128 = 402;
/// Controlword, statusword, mode of operation and its display; error code and supported modes are optional in version 2.
const OF_EVERY_DRIVE: [u16; 4] = [0x6040, 0x6041, 0x6060, 0x6061];
/// The type of the first of several profiles; the others follow each 800h.
const FIRST_TYPE: u16 = 0x67FF;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    let Some(parameter) = subject.parameter(0x1000, 0) else { return };
    let device_type = parameter.raw();
    let is_united = device_type >> 16 == 0xFFFF;
    let lacks = |index: &Index| !device.objects.contains_key(index);
    let missing: Vec<String> = match device_type & 0xFFFF {
        _ if is_united => {
            let types: Vec<Index> = (0..8).map(|axis| Index(FIRST_TYPE + axis * 0x800)).collect();
            let first = types.first().filter(|_| types.iter().all(lacks));
            first.map(ToString::to_string).into_iter().collect()
        }
        DRIVES => {
            OF_EVERY_DRIVE.map(Index).iter().filter(|index| lacks(index)).map(ToString::to_string).collect()
        }
        _ => Vec::new(),
    };
    if missing.is_empty() {
        return;
    }
    let what = if is_united { "several profiles".to_owned() } else { format!("profile {DRIVES}") };
    let message =
        format!("the device type of `{}` names {what}, but there is no {}", device.key, missing.join(", "));
    findings.push(Diagnostic::new(CODE, parameter.place, message).help(if is_united {
        "add the types of the profiles, or correct `device-type:`"
    } else {
        "add the feature `drive` of `cia402`, or correct `device-type:`"
    }));
}
