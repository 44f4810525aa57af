//! What a device sends by its timers fits on the bus at one of its bit rates.

use crate::check::findings::Findings;
use crate::check::pdo::parameters::title;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Direction, Pdo};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0878",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "more messages than the bus carries",
    explanation: "The event timers of the TPDOs, the SYNC period and the heartbeat time determine how often the device sends at least. A frame with n bytes of data takes 47 + 8n bits, stuffing not counted; here \
        the sum is more than the fastest bit rate of the device carries, so that messages come late or never, and those of other nodes with a higher identifier do not come at all. \
        Write longer times, map less, or add a bit rate.",
    clause: Some("CiA 301, objects 1006h, 1017h and 1800h"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [10], features: [heartbeat producer]}\nobjects:\n  0x2000: {name: level, type: unsigned32, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {event-timer: 2, map: [level]}}}",
        "devices:\n  io: {name: Example, bit-rates: [10], features: [heartbeat producer]}\nobjects:\n  0x2000: {name: level, type: unsigned32, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {event-timer: 200, map: [level]}}}",
    )),
};

/// What a device sends again and again.
struct Message {
    name: String,
    place: Span,
    /// How many bits in 1000 seconds.
    load: i128,
}

impl Message {
    /// A message of some bytes that is sent once in a period of microseconds.
    fn every(period: i128, bytes: u32, name: String, place: Span) -> Option<Self> {
        let load = i128::from(47 + 8 * bytes) * 1_000_000_000 / Some(period).filter(|period| *period > 0)?;
        Some(Self { name, place, load })
    }
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let Some(fastest) = subject.device.info.bit_rates.iter().max().copied() else { return };
    let transmitted = subject.device.pdos_of(Direction::Transmit).filter(|pdo| pdo.valid);
    let heartbeat = subject
        .parameter(0x1017, 0)
        .and_then(|time| Message::every(time.raw() * 1000, 1, "the heartbeat".to_owned(), time.place));
    let messages: Vec<Message> =
        transmitted.filter_map(|pdo| of_pdo(subject, pdo)).chain(heartbeat).collect();
    let (sum, capacity) =
        (messages.iter().map(|one| one.load).sum::<i128>(), i128::from(fastest) * 1_000_000);
    if sum <= capacity {
        return;
    }
    let Some(most) = messages.iter().max_by_key(|one| one.load) else { return };
    let percent = |load: i128| (load * 100 + capacity / 2) / capacity;
    let message = format!(
        "`{}` sends {} % of what a bus carries at {fastest} kbit/s",
        subject.device.key,
        percent(sum)
    );
    findings.push(
        Diagnostic::new(CODE, most.place, message)
            .note(format!("{} alone takes {} %", most.name, percent(most.load)))
            .help("write longer times, or map less; the bit rate is the fastest of the device"),
    );
}

/// How often a PDO is sent at least: by its event timer, or by the SYNC whose period the device has.
fn of_pdo(subject: &Subject<'_>, pdo: &Pdo) -> Option<Message> {
    let (bytes, name) = (pdo.bits().div_ceil(8).min(8), title(pdo));
    match pdo.transmission? {
        every @ 1..=240 => {
            let period = subject.parameter(0x1006, 0)?;
            Message::every(
                period.raw() * i128::from(every),
                bytes,
                name,
                subject.communication(pdo, 2)?.place,
            )
        }
        254 | 255 => {
            let timer = subject.communication(pdo, 5)?;
            Message::every(timer.raw() * 1000, bytes, name, timer.place)
        }
        _ => None,
    }
}
