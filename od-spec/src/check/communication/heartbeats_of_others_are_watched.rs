//! An entry of 1016h that has a time names a node, and that is another one.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::Fact;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0828",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a heartbeat that no node sends",
    explanation: "An entry of 1016h with a time but without a node-ID watches no node, and an entry that names the \
        node itself waits for a message that a device never receives from itself. The author of the time believes that \
        a node is watched. Write the node-ID of the other node into bits 23 to 16, or the time 0.",
    clause: Some("CiA 301, object 1016h"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, heartbeat consumer]}\nobjects:\n  0x1016: {from: cia301, array: {count: 1, elements: {1: {default: 1000}}}}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, heartbeat consumer]}\nobjects:\n  0x1016: {from: cia301, array: {count: 1, elements: {1: {default: 0x007F_03E8}}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values().filter(|(id, ..)| id.index.0 == 0x1016 && id.sub.0 > 0) {
        let problem = |node: u8| {
            let raw = value.integer_for(node)?;
            let (watched, time) = (raw >> 16, raw & 0xFFFF);
            if time == 0 {
                None
            } else if watched == 0 {
                Some(format!("{time} ms without a node-ID watch no node"))
            } else if subject.node.is_some() && watched == i128::from(node) {
                // A type may become any node; a user who makes it the watched one sets it to another value.
                Some(format!("node {node} would watch itself"))
            } else {
                None
            }
        };
        if let Some(problem) = subject.nodes_of(value).find_map(problem) {
            let message = format!("{id} ({}): {problem}", entry.name);
            let help = "write the node-ID of another node in bits 23..16, or the time 0";
            findings.push(subject.finding(CODE, id, entry, Fact::Default, message).help(help));
        }
    }
}
