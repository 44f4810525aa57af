//! A client SDO channel that exists asks and hears one node, the one that its sub-index 3 names.

use crate::check::findings::Findings;
use crate::check::pdo::parameters::{NOT_VALID, Parameter};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::Index;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0829",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an SDO client between two servers",
    explanation: "The client sends its requests to one node and waits for the answers of another, or sub-index 3 names \
        a third. Requests on 600h + node-ID are for the first SDO channel of that node, which answers on 580h + the \
        same node-ID: a client that waits elsewhere gets no answer and ends with a timeout. Write both identifiers, \
        and sub-index 3, for the same node.",
    clause: Some("CiA 301, objects 1280h to 12FFh, table 34 (pre-defined connection set)"),
    example: Some(Example::new(
        "objects:\n  0x1280:\n    name: SDO client parameter\n    record:\n      1: {name: request, type: unsigned32, access: rw, default: 0x80000000}\n      2: {name: answer, type: unsigned32, access: rw, default: 0x80000000}\n      3: {name: server, type: unsigned8, access: rw, default: 1}\n# --set 1280.1=0x606\n# --set 1280.2=0x587\n# --set 1280.3=6",
        "objects:\n  0x1280:\n    name: SDO client parameter\n    record:\n      1: {name: request, type: unsigned32, access: rw, default: 0x80000000}\n      2: {name: answer, type: unsigned32, access: rw, default: 0x80000000}\n      3: {name: server, type: unsigned8, access: rw, default: 1}\n# --set 1280.1=0x606\n# --set 1280.2=0x586\n# --set 1280.3=6",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (index, _) in subject.device.objects.range(Index(0x1280)..Index(0x1300)) {
        let channel = [1, 2, 3].map(|sub| subject.parameter(index.0, sub));
        let [Some(request), Some(answer), server] = &channel else { continue };
        let Some(problem) = subject.nodes().find_map(|node| problem(request, answer, server.as_ref(), node))
        else {
            continue;
        };
        // A setting of one of them is reported there.
        let all = [Some(answer), Some(request), server.as_ref()];
        let blamed = all.into_iter().flatten().find(|parameter| parameter.entry.is_set()).unwrap_or(answer);
        let help = "write both identifiers and sub-index 3 for the same node";
        findings.push(
            Diagnostic::new(CODE, blamed.place, format!("{index}: {problem}")).about(*index).help(help),
        );
    }
}

/// What is wrong with a channel on a node; identifiers that are not those of a first SDO channel name no server.
fn problem(
    request: &Parameter<'_>,
    answer: &Parameter<'_>,
    server: Option<&Parameter<'_>>,
    node: u8,
) -> Option<String> {
    let identifier = |parameter: &Parameter<'_>| {
        let raw = parameter.value.integer_for(node)?;
        // That 0 is not an identifier is said by itself.
        (raw & NOT_VALID == 0 && raw != 0).then_some(raw)
    };
    let server_of = |id: i128, base: i128| (base + 1..=base + 127).contains(&id).then_some(id - base);
    let (request, answer) = (identifier(request)?, identifier(answer)?);
    let (asked, heard) = (server_of(request, 0x600), server_of(answer, 0x580));
    let named = server.and_then(|server| server.value.integer_for(node)).filter(|named| *named <= 127);
    match (asked, heard, named) {
        (Some(asked), Some(heard), _) if asked != heard => {
            Some(format!("requests go to node {asked}, answers come from node {heard}"))
        }
        (Some(asked), _, Some(named)) if asked != named => {
            Some(format!("requests go to node {asked}, sub-index 3 names node {named}"))
        }
        (_, Some(heard), Some(named)) if heard != named => {
            Some(format!("answers come from node {heard}, sub-index 3 names node {named}"))
        }
        (_, _, Some(0)) => Some("the channel exists, but sub-index 3 names no node".to_owned()),
        _ => None,
    }
}
