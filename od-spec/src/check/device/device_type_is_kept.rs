//! A device has what its device type promises: the objects of every drive, the types of the profiles that it unites.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
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
/// How far the objects of two axes are apart.
const AXIS: u16 = 0x800;
/// How many profiles a device can unite.
const AXES: u16 = 8;

/// Whether a device type says that several profiles are united.
const fn is_united(device_type: i128) -> bool {
    device_type >> 16 == 0xFFFF
}

/// The first index of each axis that is a drive.
pub(in crate::check) fn axes_of_drives(subject: &Subject<'_>) -> Vec<Index> {
    let Some(device_type) = subject.parameter(0x1000, 0).map(|parameter| parameter.raw()) else {
        return Vec::new();
    };
    let is_drive = |device_type: i128| device_type & 0xFFFF == DRIVES;
    let is_axis = |axis: &u16| {
        if is_united(device_type) {
            let of_axis = subject.parameter(FIRST_TYPE + axis * AXIS, 0);
            of_axis.is_some_and(|parameter| is_drive(parameter.raw()))
        } else {
            *axis == 0 && is_drive(device_type)
        }
    };
    (0..AXES).filter(is_axis).map(|axis| Index(0x6000 + axis * AXIS)).collect()
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    let Some(parameter) = subject.parameter(0x1000, 0) else { return };
    let lacks = |index: &Index| !device.objects.contains_key(index);
    let mut types = (0..AXES).map(|axis| Index(FIRST_TYPE + axis * AXIS));
    let lacks_types = is_united(parameter.raw()) && types.all(|index| lacks(&index));
    let missing: Vec<String> = if lacks_types {
        vec![Index(FIRST_TYPE).to_string()]
    } else {
        let of_axis = |first: Index| OF_EVERY_DRIVE.map(|index| Index(index - 0x6000 + first.0));
        let demanded = axes_of_drives(subject).into_iter().flat_map(of_axis);
        demanded.filter(lacks).map(|index| index.to_string()).collect()
    };
    if missing.is_empty() {
        return;
    }
    let (what, help) = if lacks_types {
        ("several profiles".to_owned(), "add the types of the profiles, or correct the device type")
    } else {
        let help = subject.help(Help {
            specification: "add the feature `drive` of `cia402`, or correct the device type",
            eds: "add these objects, or correct the device type",
            setting: "the device has to have these objects, or another device type",
        });
        (format!("profile {DRIVES}"), help)
    };
    let message =
        format!("the device type of `{}` names {what}, but there is no {}", device.key, missing.join(", "));
    findings.push(Diagnostic::new(CODE, parameter.place, message).help(help));
}
