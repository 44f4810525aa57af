//! A device whose PDOs wait for SYNC knows SYNC, and one that produces it knows how often.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::title;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::{Subject, entry_id};
use crate::diag::{Code, Example, Severity};
use crate::model::Index;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0814",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "SYNC without its objects",
    explanation: "A PDO has a synchronous transmission type (0 to 240, or 252), but the device has no 1005h, and no master can set which message is SYNC; or the \
        device produces SYNC (bit 30 of 1005h), but has no 1006h for the period. Add the feature `sync consumer` or `sync producer`, or make the PDO \
        event-driven.",
    clause: Some("CiA 301, objects 1005h and 1006h"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 1, map: [level]}}}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync consumer]}\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 1, map: [level]}}}",
    )),
};

const SYNC: u16 = 0x1005;
const PERIOD: u16 = 0x1006;
/// Bit of 1005h: the device produces SYNC.
const PRODUCER: i128 = 1 << 30;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    let has = |index| device.objects.contains_key(&Index(index));
    let transmission = |pdo| Some((pdo, subject.communication(pdo, 2)?));
    let is_synchronous = |raw: i128| matches!(raw, 0..=240 | 252);
    let mut synchronous =
        device.pdos.iter().filter_map(transmission).filter(|(_, parameter)| is_synchronous(parameter.raw()));
    if let Some((pdo, parameter)) = synchronous.next().filter(|_| !has(SYNC)) {
        let message = format!("{} waits for SYNC, but `{}` has no {}", title(pdo), device.key, Index(SYNC));
        findings.push(parameter.finding(CODE, message).help(subject.help(Help {
            specification: "add the feature `sync consumer` of `cia301`, or write another transmission type",
            eds: "add 1005h, the COB-ID of SYNC, or write another transmission type",
            setting: "write another transmission type; no master can set which message is SYNC",
        })));
    }
    let Some(sync) = subject.parameter(SYNC, 0).filter(|sync| sync.raw() & PRODUCER != 0) else { return };
    if !has(PERIOD) {
        let message =
            format!("{} of `{}` produces SYNC, but there is no {}", sync.id, device.key, entry_id(PERIOD, 0));
        findings.push(sync.finding(CODE, message).help(subject.help(Help {
            specification: "add the feature `sync producer` of `cia301`, or clear bit 30 of 1005h",
            eds: "add 1006h, the communication cycle period, or clear bit 30 of 1005h",
            setting: "clear bit 30 of 1005h",
        })));
    }
}
