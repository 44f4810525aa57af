//! Nothing is commanded through a view.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Entry, EntryId, Fact};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0420",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an alias of a command",
    explanation: "A view shows a value in another type, and turns what is written to it into that of its target: a number that the target cannot have becomes the nearest. Of a command there is \
        no nearest; another number is another command, and what is read is not a number that was written. The target is 1010h or 1011h, or carries `flags: [no-write]`. Remove the alias, or make \
        it `access: ro`.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: reset, type: unsigned32, access: rw, eds: {flags: [no-write]}}\n  0x2001: {name: short reset, alias: reset, type: unsigned16}",
        "objects:\n  0x2000: {name: reset, type: unsigned32, access: rw, eds: {flags: [no-write]}}\n  0x2001: {name: short reset, alias: reset, type: unsigned16, access: ro}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, _, view) in subject.device.entries().filter(|(.., entry)| entry.access.is_writable()) {
        let Some(alias) = &view.alias else { continue };
        let is_command = |target: &Entry| {
            let is_signature = matches!((alias.target.index.0, alias.target.sub.0), (0x1010 | 0x1011, 1..));
            // A lock has the same flag.
            is_signature || target.eds.no_write && !target.locked
        };
        if subject.device.entry(alias.target).is_some_and(is_command) {
            findings.push(finding(subject, id, view, alias.target));
        }
    }
}

fn finding(subject: &Subject<'_>, id: EntryId, view: &Entry, target: EntryId) -> Diagnostic {
    let message = format!("{id} ({}) writes {target}, which is a command", view.name);
    subject
        .finding(CODE, id, view, Fact::Alias, message)
        .help("write to the command itself, and remove the alias or make it `access: ro`")
}
