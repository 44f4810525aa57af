//! What is stored has a command that stores it: 1010h.2, .3 or .4.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::check::subject::entry_id;
use crate::diag::{Code, Example, Severity};
use crate::model::{Fact, Storage};
use crate::wording::{Notation, Wording};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0809",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "stored, but nothing stores",
    explanation: "An entry is saved by a \"store parameters\" command that the device does not have: 1010h lacks the sub-index of its group (2 communication, \
        3 application, 4 manufacturer). Its value would be lost after the next power-off. Add the feature `store parameters`, or \
        correct `stored:`. The parameters of PDOs of which nothing is said are stored where the device can do that, and do not count.",
    clause: Some("CiA 301, object 1010h"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: gain, type: unsigned8, access: rw, stored: application}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, store parameters]}\nobjects:\n  0x2000: {name: gain, type: unsigned8, access: rw, stored: application}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let (device, wording) = (subject.device, Wording::english(Notation::Diagnostic));
    for (group, sub) in [(Storage::Communication, 2), (Storage::Application, 3), (Storage::Manufacturer, 4)] {
        let command = entry_id(0x1010, sub);
        if device.entry(command).is_some() {
            continue;
        }
        let stored = |entry: &crate::model::Entry| entry.stored == group;
        // What is not stated about a parameter of a PDO follows from the commands that there are.
        let mut entries = device.entries().filter(|(_, object, entry)| {
            !object.role().is_pdo_parameter() || entry.facts.get(Fact::Storage).is_some()
        });
        if let Some((id, _, entry)) = entries.find(|(.., entry)| stored(entry)) {
            let message =
                format!("{id} is {}, but `{}` has no {command}", wording.storage(group), device.key);
            findings.push(subject.finding(CODE, id, entry, Fact::Storage, message).help(subject.help(
                Help {
                    specification: "add the feature `store parameters` of `cia301`, or correct `stored:`",
                    eds: &format!("add {command}, or correct the comment that the entry is stored"),
                    setting: "the device has to have what stores it",
                },
            )));
        }
    }
}
