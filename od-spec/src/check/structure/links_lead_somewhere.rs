//! Links lead from an object to others that the device has.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Fact, Index};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0323",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "a link that leads nowhere else",
    explanation: "The links of an object name others that belong together with it, such as the limits of a value. A \
        link to an object that the device does not have leads nowhere: a reader who follows it finds nothing. One to \
        the object itself says nothing; another index was meant. Correct the index, or remove the link. Indices below \
        1000h are those of data types, which are not objects of a device here; links to them are not checked.",
    clause: Some("CiA 306 4.6.4"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, links: [0x2001]}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, links: [0x2001]}\n  0x2001: {name: limit, type: unsigned8, access: rw}",
    )),
};

/// The area of the data types.
const fn is_data_type(index: Index) -> bool {
    matches!(index.0, 1..=0x0FFF)
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    let who = match subject.system.devices.as_slice() {
        [_] => "the device".to_owned(),
        _ => format!("`{}`", device.key),
    };
    for object in device.objects.values() {
        let is_lost = |index: Index| !device.objects.contains_key(&index) && !is_data_type(index);
        for link in &object.links {
            let problem = if link.value == object.index {
                format!("{} is linked to itself", object.index)
            } else if is_lost(link.value) {
                format!("{} is linked to {}, which {who} does not have", object.index, link.value)
            } else {
                continue;
            };
            // A library knows objects that a device may leave out.
            let place = if link.span.file.is_one_with(device.span.file) {
                link.span
            } else {
                subject.object_place(object)
            };
            findings.push(Diagnostic::new(CODE, place, problem).about((object.index, Fact::Links)).help(
                subject.help(Help {
                    specification: "correct the index, or remove it from `links:`",
                    eds: "correct the index, or remove it from the list and count one less",
                    setting: "correct the index, or remove the link",
                }),
            ));
        }
    }
}
