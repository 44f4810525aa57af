//! Inhibit time and event timer are those of a PDO that is sent on an event, and the timer is not the shorter one.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::title;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Direction, Pdo};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0824",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a time that the PDO does not keep",
    explanation: "Inhibit time (sub-index 3) and event timer (sub-index 5) decide when a TPDO is sent on an event, \
        that is, only with the transmission types 254 and 255: a TPDO that waits for SYNC or a remote frame uses \
        neither. An RPDO has no inhibit time; its event timer watches for messages that fail to come. An event timer \
        that is shorter than the inhibit time runs out while the PDO must not be sent. The time has no effect \
        there. Write 0, or the transmission type or time that was meant.",
    clause: Some("CiA 301, objects 1400h and 1800h (inhibit time, event-timer)"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync consumer]}\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 1, event-timer: 100, map: [level]}}}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync consumer]}\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 255, event-timer: 100, map: [level]}}}",
    )),
};

/// A time of a PDO.
struct Time {
    sub: u8,
    name: &'static str,
}

const INHIBIT_TIME: Time = Time { sub: 3, name: "an inhibit time" };
const EVENT_TIMER: Time = Time { sub: 5, name: "an event timer" };

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in &subject.device.pdos {
        let times: &[Time] = match pdo.direction {
            Direction::Receive => &[INHIBIT_TIME],
            Direction::Transmit => &[INHIBIT_TIME, EVENT_TIMER],
        };
        let unused = times.iter().filter_map(|time| unused(subject, pdo, time));
        for finding in unused.chain(outrun(subject, pdo)) {
            findings.push_each(finding);
        }
    }
}

fn unused(subject: &Subject<'_>, pdo: &Pdo, time: &Time) -> Option<Diagnostic> {
    let parameter = subject.communication(pdo, time.sub).filter(|parameter| parameter.raw() != 0)?;
    let (id, title, name) = (parameter.id, title(pdo), time.name);
    if pdo.direction == Direction::Receive {
        let message = format!("{id}: {title} has {name}, which only a TPDO keeps");
        return Some(parameter.finding(CODE, message).help("write 0"));
    }
    // What is reserved is said by itself.
    let transmission =
        subject.communication(pdo, 2).filter(|one| matches!(one.raw(), 0..=240 | 252 | 253))?;
    let kind = if transmission.raw() <= 240 { "on SYNC" } else { "on remote frames" };
    let message =
        format!("{id}: {title} has {name}, but is sent {kind} (transmission type {})", transmission.raw());
    // What was set is blamed before what the device has.
    let blamed =
        if transmission.entry.is_set() && !parameter.entry.is_set() { &transmission } else { &parameter };
    let finding = blamed.finding(CODE, message).help(subject.help(Help {
        specification: "leave the time out, or let `transmission:` be 254 or 255",
        eds: "write 0, or the transmission type 254 or 255",
        setting: "write 0, or the transmission type 254 or 255",
    }));
    Some(if blamed.id == parameter.id { finding } else { finding.with(parameter.place, name) })
}

/// An event timer that the inhibit time outlasts. The timer counts ms, the inhibit time 100 µs.
fn outrun(subject: &Subject<'_>, pdo: &Pdo) -> Option<Diagnostic> {
    let is_event_driven = subject.communication(pdo, 2).is_some_and(|one| matches!(one.raw(), 254 | 255));
    if pdo.direction == Direction::Receive || !is_event_driven {
        return None;
    }
    let timer = subject.communication(pdo, EVENT_TIMER.sub).filter(|timer| timer.raw() != 0)?;
    let inhibit = subject.communication(pdo, INHIBIT_TIME.sub)?;
    if timer.raw() * 10 >= inhibit.raw() {
        return None;
    }
    // What was set is blamed before what the device has.
    let (blamed, other) =
        if inhibit.entry.is_set() && !timer.entry.is_set() { (&inhibit, &timer) } else { (&timer, &inhibit) };
    let message = format!(
        "{}: the event timer of {} is {} ms, the inhibit time {}.{} ms",
        blamed.id,
        title(pdo),
        timer.raw(),
        inhibit.raw() / 10,
        inhibit.raw() % 10
    );
    let diagnostic = blamed.finding(CODE, message);
    let diagnostic = if other.place == blamed.place {
        diagnostic
    } else {
        diagnostic
            .with(other.place, if other.id == timer.id { "the event timer" } else { "the inhibit time" })
    };
    Some(diagnostic.help(
        "make the event timer at least as long as the inhibit time; it counts ms, the inhibit time 100 µs",
    ))
}
