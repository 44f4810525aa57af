//! What a configuration sets can be written one after the other.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Course, EntryId, Outcome, Stuck};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Settings(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0838",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "values that no order of writes brings into the device",
    explanation: "Constraints and write conditions hold for the values as a whole, but not on the way to them: \
        whichever is written first, the device refuses it with abort code 0604 0043h or 0800 0022h, because the others \
        still have their old values. A PLC writes one value after the other. Set an entry to an intermediate value \
        first, and the others in a second configuration; or choose values that the device can pass through.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: left share, type: unsigned8, access: rw, default: 50}\n  0x2001: {name: right share, type: unsigned8, access: rw, default: 50}\nconstraints:\n  shares make a whole: {require: \"0x2000 + 0x2001 == 100\"}\n# --set 2000=40\n# --set 2001=60",
        "objects:\n  0x2000: {name: left share, type: unsigned8, access: rw, default: 50}\n  0x2001: {name: right share, type: unsigned8, access: rw, default: 50}\nconstraints:\n  shares make no more than a whole: {require: \"0x2000 + 0x2001 <= 100\"}\n# --set 2000=40\n# --set 2001=60",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let (Some(before), Some(node)) = (subject.system.device(&subject.device.key), subject.node) else {
        return;
    };
    let set = subject.set_entries().filter_map(|(id, entry, _)| Some((id, entry.default.as_ref()?)));
    let Err(Stuck { left, .. }) = Course::new(subject.system, before, node).order(set) else { return };
    // What the device accepts only in another state is said by itself.
    let is_writable = |id: EntryId| {
        let condition = subject.device.entry(id).and_then(|entry| entry.writable_when.as_ref());
        condition.is_none_or(|condition| !matches!(condition.evaluate(subject), Outcome::Fails { .. }))
    };
    let is_stuck = |id: &EntryId| {
        let alias = subject.device.entry(*id).and_then(|entry| entry.alias.as_ref());
        is_writable(*id) && alias.is_none_or(|alias| is_writable(alias.target))
    };
    let mut places = subject.set_entries().filter(|(id, ..)| left.contains(id) && is_stuck(id));
    let Some((id, entry, place)) = places.next() else { return };
    let message =
        format!("{id} ({}) cannot be written before the others are, nor they before it", entry.name);
    let diagnostic = Diagnostic::new(CODE, place, message)
        .help("set values that the device can pass through one by one, or use a second configuration");
    findings
        .push(places.fold(diagnostic, |diagnostic, (id, _, place)| diagnostic.with(place, id.to_string())));
}
