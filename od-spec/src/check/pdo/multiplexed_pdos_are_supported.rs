//! A multiplexed PDO belongs to a device that says it has such, is event-driven, and only one names its source.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{Parameter, SOURCE_ADDRESS, is_multiplexed, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Direction, Pdo};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0511",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a multiplexed PDO that cannot be",
    explanation: "254 and 255 as the number of mapped entries make a PDO multiplexed: each message names the entry that it carries. The device does not say that it supports this \
        (`group-messaging:`), the transmission type is not event-driven (254 or 255), or two TPDOs name their source (254), of which a device has one. A device \
        refuses such a number with abort code 0604 0042h. Map entries instead, or correct what the message names.",
    clause: Some("CiA 301, 11.4 (multiplexed PDOs); CiA 306, 4.5 (GroupMessaging)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}}}\n# --set 1A00.0=254",
        "devices:\n  io: {name: Example, bit-rates: [125], group-messaging: yes, features: [heartbeat producer]}\nobjects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}}}\n# --set 1A00.0=254",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let mut scanned: Option<&Pdo> = None;
    for pdo in &subject.device.pdos {
        let Some(count) = subject.mapping_count(pdo).filter(|count| is_multiplexed(count.raw())) else {
            continue;
        };
        let event_driven = |parameter: &Parameter<'_>| matches!(parameter.raw(), 254 | 255);
        let transmission = subject.communication(pdo, 2).filter(|parameter| !event_driven(parameter));
        let first = if pdo.direction == Direction::Transmit && count.raw() == SOURCE_ADDRESS {
            scanned.replace(pdo)
        } else {
            None
        };
        let (id, this) = (count.id, title(pdo));
        let problem = if !subject.device.info.group_messaging {
            format!("{id}: {this} is multiplexed, but `{}` has no multiplexed PDOs", subject.device.key)
        } else if let Some(transmission) = transmission {
            format!("{id}: {this} is multiplexed, but has transmission type {}", transmission.raw())
        } else if let Some(first) = first {
            format!("{id}: {this} names the source of each value, as {} does", title(first))
        } else {
            continue;
        };
        findings.push(Diagnostic::new(CODE, count.place, problem).help(subject.help(Help {
            specification: "map entries instead; a multiplexed PDO needs `group-messaging: yes` and transmission type 254 or 255, and only one TPDO may have 254 entries",
            eds: "map entries instead; a multiplexed PDO needs `GroupMessaging=1` and transmission type 254 or 255, and only one TPDO may have 254 entries",
            setting: "map entries instead; a multiplexed PDO needs a device that has such PDOs and transmission type 254 or 255, and only one TPDO may have 254 entries",
        })));
    }
}
