//! The device type of an I/O module states which kinds of channels it has.

use crate::check::device::device_type_is_kept::IO_MODULES;
use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::Index;
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0844",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a device type with other channels than the device",
    explanation: "For an I/O module (profile 401), bits 16 to 19 of 1000h show whether it has digital inputs, digital \
        outputs, analogue inputs and analogue outputs. Masters use them to choose what they read and write. Here they \
        differ from the objects with the values: 6000h, 6020h, 6100h or 6120h; 6200h, 6220h, 6300h or 6320h; 6400h to \
        6404h; 6410h to 6414h. Correct `device-type:`, or the objects.",
    clause: Some("CiA 401, object 1000h"),
    example: Some(Example::new(
        "uses: [cia301, cia401]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x0002_0191, features: [heartbeat producer, digital inputs 8-bit: 8]}\npdos: {io: {transmit: {1: {map: [0x6000.1]}}}}",
        "uses: [cia301, cia401]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x0001_0191, features: [heartbeat producer, digital inputs 8-bit: 8]}\npdos: {io: {transmit: {1: {map: [0x6000.1]}}}}",
    )),
};

/// Kinds of channels, from bit 16 on, and the objects that hold their values.
pub(in crate::check) const KINDS: [(&str, &[u16]); 4] = [
    ("digital inputs", &[0x6000, 0x6020, 0x6100, 0x6120]),
    ("digital outputs", &[0x6200, 0x6220, 0x6300, 0x6320]),
    ("analogue inputs", &[0x6400, 0x6401, 0x6402, 0x6403, 0x6404]),
    ("analogue outputs", &[0x6410, 0x6411, 0x6412, 0x6413, 0x6414]),
];
/// The bit of the first kind.
const FIRST_BIT: u32 = 16;
/// The high word of a device that unites several profiles.
const UNITED: i128 = 0xFFFF;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let Some(parameter) = subject.parameter(0x1000, 0) else { return };
    let device_type = parameter.raw();
    if device_type & 0xFFFF != IO_MODULES || device_type >> 16 == UNITED {
        return;
    }
    let mut expected = device_type;
    let mut differences = Vec::new();
    for ((kind, objects), bit) in KINDS.iter().zip(FIRST_BIT..) {
        let is_told = device_type >> bit & 1 == 1;
        let mut objects = objects.iter().copied().map(Index);
        // Whether a bus coupler has them depends on its modules.
        if objects.clone().any(|index| subject.device.is_of_modules(index)) {
            continue;
        }
        let first = objects.find(|index| subject.device.objects.contains_key(index));
        match first {
            Some(index) if !is_told => differences.push(format!("no {kind}, and there is {index}")),
            None if is_told => differences.push(format!("{kind}, and there are none")),
            Some(_) | None => continue,
        }
        expected ^= 1 << bit;
    }
    if differences.is_empty() {
        return;
    }
    let message = format!("the device type of `{}` shows {}", subject.device.key, differences.join("; "));
    let (high, low) = (expected >> 16, expected & 0xFFFF);
    let specification = format!("write `device-type: 0x{high:04X}_{low:04X}`, or correct the objects");
    let value = subject.format.set(Key::Default, &format!("0x{expected:08X}"));
    let eds = format!("write {value} at 1000h, or correct the objects");
    let help = subject.help(Help {
        specification: &specification,
        eds: &eds,
        setting: "the device has to have these objects, or another device type",
    });
    findings.push(parameter.finding(CODE, message).help(help));
}
