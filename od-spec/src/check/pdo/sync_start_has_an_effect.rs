//! A SYNC start value belongs to a TPDO that counts SYNC messages, and the counter reaches it.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{Parameter, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Direction, Index, Pdo};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0836",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a SYNC start value without effect",
    explanation: "The SYNC start value (sub-index 6) sets with which value of the SYNC counter a TPDO begins to count. It needs a transmission type that waits for SYNC, and a \
        device that knows the counter: 1019h, which says how far the counter runs. Otherwise the PDO begins with any SYNC; and a counter that never gets as far as the \
        start value leaves it silent for ever. An RPDO has no start. Write 0, or describe the counter.",
    clause: Some("CiA 301, objects 1019h and 1800h (SYNC start value)"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync consumer]}\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 1, sync-start: 1, map: [level]}}}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync counter]}\nobjects:\n  0x1019: {from: cia301, default: 2}\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 1, sync-start: 1, map: [level]}}}",
    )),
};

/// Synchronous counter overflow value.
const COUNTER: u16 = 0x1019;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in &subject.device.pdos {
        // What no counter reaches is said by itself.
        let start = subject.communication(pdo, 6).filter(|start| matches!(start.raw(), 1..=240));
        if let Some(finding) = start.and_then(|start| finding(subject, pdo, &start)) {
            findings.push(finding);
        }
    }
}

fn finding(subject: &Subject<'_>, pdo: &Pdo, start: &Parameter<'_>) -> Option<Diagnostic> {
    let (id, title, raw) = (start.id, title(pdo), start.raw());
    let blame = |place: Span, message: String, help: Help<'_>| {
        let diagnostic = Diagnostic::new(CODE, place, message).help(subject.help(help));
        if place == start.place { diagnostic } else { diagnostic.with(start.place, "the start value") }
    };
    if pdo.direction == Direction::Receive {
        let message = format!("{id}: {title} has a SYNC start value, which only a TPDO has");
        return Some(blame(
            start.place,
            message,
            Help { specification: "remove `sync-start:`", eds: "write 0", setting: "write 0" },
        ));
    }
    let event_driven = |transmission: &Parameter<'_>| matches!(transmission.raw(), 253..=255);
    if let Some(transmission) = subject.communication(pdo, 2).filter(event_driven) {
        let message =
            format!("{id}: {title} has a SYNC start value, but transmission type {}", transmission.raw());
        let place = if transmission.entry.is_set() && !start.entry.is_set() {
            transmission.place
        } else {
            start.place
        };
        return Some(blame(
            place,
            message,
            Help {
                specification: "remove `sync-start:`, or let `transmission:` be 1 to 240",
                eds: "write 0, or a transmission type from 1 to 240",
                setting: "write 0, or a transmission type from 1 to 240",
            },
        ));
    }
    let Some(counter) = subject.parameter(COUNTER, 0) else {
        let is_there = subject.device.objects.contains_key(&Index(COUNTER));
        let message = format!(
            "{id}: {title} begins with SYNC {raw}, but `{}` knows no SYNC counter ({})",
            subject.device.key,
            Index(COUNTER)
        );
        return (!is_there).then(|| {
            blame(
                start.place,
                message,
                Help {
                    specification: "add the feature `sync counter` of `cia301`, or remove `sync-start:`",
                    eds: "add 1019h, the synchronous counter overflow value, or write 0",
                    setting: "write 0; the device counts no SYNC messages",
                },
            )
        });
    };
    let last = counter.raw();
    if last >= raw {
        return None;
    }
    let place = if counter.entry.is_set() && !start.entry.is_set() { counter.place } else { start.place };
    let how =
        if last == 0 { "SYNC has no counter".to_owned() } else { format!("the counter runs to {last}") };
    let message = format!("{id}: {title} begins with SYNC {raw}, but {how} ({})", counter.id);
    Some(blame(
        place,
        message,
        Help {
            specification: "give 1019h a default that is as large, or write a smaller `sync-start:`",
            eds: "give 1019h a value that is as large, or write a smaller start value",
            setting: "set 1019h to a value that is as large, or write a smaller start value",
        },
    ))
}
