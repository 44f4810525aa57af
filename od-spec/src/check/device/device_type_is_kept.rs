//! A device has what its device type promises: the objects of every drive, the types of the profiles that it unites.

use std::collections::{BTreeMap, BTreeSet};

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::Index;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0817",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a device type without its objects",
    explanation: "The low word of 1000h names a device profile, and masters that know the profile use its objects without looking: for 402, a drive, controlword, statusword, \
        mode of operation and its display (6040h, 6041h, 6060h, 6061h; of a second axis 6840h and so on). A high word of FFFFh says that several profiles are united, each of which has its own type in 67FFh, \
        6FFFh and so on. Some of these objects are missing. Add them, or correct `device-type:`.",
    clause: Some("CiA 301, object 1000h; CiA 402, objects that every drive has"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer]}",
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6502: {from: cia402, default: 0x0001_0000}",
    )),
};

/// Number of the profile for I/O modules.
pub(in crate::check) const IO_MODULES: i128 = 401;
/// Number of the profile for drives.
pub(in crate::check) const DRIVES: i128 = 402;
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

/// The profiles that the device type names, by the first index of each; 0 for none.
pub(in crate::check) fn profiles(subject: &Subject<'_>) -> BTreeMap<Index, i128> {
    let number = |index: u16| subject.parameter(index, 0).map(|parameter| parameter.raw());
    let Some(device_type) = number(0x1000) else { return BTreeMap::new() };
    if !is_united(device_type) {
        return BTreeMap::from([(Index(0x6000), device_type & 0xFFFF)]);
    }
    let of_axis = |axis: u16| Some((Index(0x6000 + axis * AXIS), number(FIRST_TYPE + axis * AXIS)? & 0xFFFF));
    (0..AXES).filter_map(of_axis).collect()
}

/// The first index of each axis that is of a profile.
pub(in crate::check) fn axes(subject: &Subject<'_>, profile: i128) -> Vec<Index> {
    profiles(subject).into_iter().filter(|(_, number)| *number == profile).map(|(first, _)| first).collect()
}

/// The first index of each axis that is a drive, also where the device type names the first one alone: CiA 402 puts the objects
/// of the next axis 800h after.
fn axes_with_objects(subject: &Subject<'_>) -> BTreeSet<Index> {
    let drives = axes(subject, DRIVES);
    let further = (1..AXES).map(|axis| Index(0x6000 + axis * AXIS)).filter(|first| {
        let has = |index: &u16| subject.device.objects.contains_key(&Index(index - 0x6000 + first.0));
        drives.first() == Some(&Index(0x6000)) && OF_EVERY_DRIVE.iter().any(has)
    });
    drives.iter().copied().chain(further).collect()
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
        let demanded = axes_with_objects(subject).into_iter().flat_map(of_axis);
        demanded.filter(lacks).map(|index| index.to_string()).collect()
    };
    if missing.is_empty() {
        return;
    }
    let (what, help) = if lacks_types {
        (
            "several profiles".to_owned(),
            "add the types of the profiles, or correct the device type".to_owned(),
        )
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
    findings.push(parameter.finding(CODE, message).help(help));
}
