//! Serial numbers are those of one machine, and of one device.

use std::collections::BTreeMap;

use super::{Check, Rule};
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::plant::Plant;
use crate::source::Span;

pub(super) const RULE: Rule = Rule { codes: &[CODE], check: Check::Plant(check) };

const CODE: &Code = &Code {
    id: "OD0742",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a serial number that is used twice",
    explanation: "Two machines, or two devices of one kind, have the same serial number. One of the two numbers is \
        wrong, or a run states it for every machine in it; by LSS, both devices would answer at once. Correct one of \
        the two, and state serial numbers for single machines.",
    clause: Some("CiA 305 (LSS address)"),
    example: Some(Example::plant(
        "sites:\n  Hall: {type: P1, machines: {1: {serial: \"26-1\"}, 2: {serial: \"26-1\"}}}",
        "sites:\n  Hall: {type: P1, machines: {1: {serial: \"26-1\"}, 2: {serial: \"26-2\"}}}",
    )),
};

fn check(plant: &Plant, diagnostics: &mut Diagnostics) {
    let mut machines: BTreeMap<&str, (Span, String)> = BTreeMap::new();
    for machine in &plant.machines {
        let Some(serial) = &machine.serial else { continue };
        let name = format!("machine {} {}", plant.site_of(machine), machine.name);
        look(&mut machines, serial.value.trim(), serial.span, name, diagnostics);
    }
    let mut devices: BTreeMap<(usize, &str, u32), (Span, String)> = BTreeMap::new();
    for node in &plant.nodes {
        let (Some(serial), Some(device)) = (node.serial, plant.devices.get(node.device)) else { continue };
        // The devices of one kind are numbered by their maker.
        let key = (device.file, device.dictionary.key.as_str(), serial.value);
        let name = plant.name_of(node);
        let shown = serial.value.to_string();
        match devices.get(&key) {
            Some((span, other)) => twice(&shown, serial.span, &name, *span, other, diagnostics),
            None => {
                devices.insert(key, (serial.span, name));
            }
        }
    }
}

fn look<'a>(
    known: &mut BTreeMap<&'a str, (Span, String)>,
    serial: &'a str,
    span: Span,
    name: String,
    diagnostics: &mut Diagnostics,
) {
    match known.get(serial) {
        Some((first, other)) => twice(serial, span, &name, *first, other, diagnostics),
        None => {
            known.insert(serial, (span, name));
        }
    }
}

fn twice(serial: &str, span: Span, name: &str, first: Span, other: &str, diagnostics: &mut Diagnostics) {
    // A number that a run says is one mistake.
    if !diagnostics.is_new(CODE, span) {
        return;
    }
    let message = format!("the serial number `{serial}` is that of {other} and of {name}");
    let diagnostic = Diagnostic::new(CODE, span, message)
        .help("correct one of the two; state serial numbers for single machines");
    diagnostics.push(if first == span { diagnostic } else { diagnostic.with(first, "first here") });
}
