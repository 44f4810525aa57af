//! What 1010h.2 and 1010h.3 store is of their areas.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Fact, Role, Storage};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0884",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "stored by the command of another area",
    explanation: "1010h.2 stores the communication profile (1000h to 1FFFh), and 1010h.3 the device profile (6000h to 9FFFh), each with what the maker adds from 2000h to 5FFFh. Storing \
        one of the two leaves this entry out, and 1011h resets it with the other. Correct `stored:`.",
    clause: Some("CiA 301, objects 1010h and 1011h"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, store parameters]}\nobjects:\n  0x1017: {from: cia301, stored: application}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, store parameters]}\nobjects:\n  0x1017: {from: cia301, stored: communication}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, object, entry) in subject.device.entries() {
        let in_profile = object.role() == Role::DeviceProfile;
        let (command, area) = match entry.stored {
            Storage::Application if id.index.is_communication_profile() => {
                (3, "of the communication profile")
            }
            Storage::Communication if in_profile => (2, "of the device profile"),
            _ => continue,
        };
        let message = format!("{id} ({}) is {area}, which 1010h.{command} does not store", entry.name);
        findings.push(subject.finding(CODE, id, entry, Fact::Storage, message).help(subject.help(Help {
            specification: "correct `stored:`",
            eds: "correct the comment that names what stores it",
            setting: "nothing that is set changes what stores the entry",
        })));
    }
}
