//! Values leave reserved bits at 0.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::standard_objects::from_library::is_from_library;
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{BitUsage, Entry, EntryId, Fact, TypeKind};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0810",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a value sets reserved bits",
    explanation: "Reserved bits are written as 0: a later device may give them a meaning, and would then do something unexpected. Correct the value, \
        or say what the bits mean.",
    clause: None,
    example: Some(Example::new(
        "types:\n  flags: {base: unsigned8, bits: {0: on}, rest: reserved}\nobjects:\n  0x2000: {name: flags, type: flags, access: rw, default: 3}",
        "types:\n  flags: {base: unsigned8, bits: {0: on}, rest: reserved}\nobjects:\n  0x2000: {name: flags, type: flags, access: rw, default: 1}",
    )),
};

/// The entry that says what the bits mean: for one of CiA 301 that is written in full and does not say it, that of the standard.
fn meant<'a>(subject: &Subject<'a>, id: EntryId, entry: &'a Entry) -> &'a Entry {
    let says_it = entry.named_type.is_some() || !entry.special.is_empty();
    if says_it || subject.device.objects.get(&id.index).is_none_or(is_from_library) {
        return entry;
    }
    let standard = subject.standard.entry(id.index, id.sub);
    standard.filter(|standard| standard.data_type == entry.data_type).unwrap_or(entry)
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values() {
        let defined = meant(subject, id, entry);
        let Some(TypeKind::Bits(fields)) = defined.named_type.as_ref().map(|named| &named.kind) else {
            continue;
        };
        let set = |node: u8| {
            let raw = value.integer_for(node)?;
            let is_special = defined.special.iter().any(|one| one.value == raw);
            let set = |bit: &u8| raw.checked_shr(u32::from(*bit)).unwrap_or(0) & 1 == 1;
            let mut reserved = fields.iter().filter(|field| field.usage == BitUsage::Reserved && !is_special);
            Some((node, reserved.find_map(|field| (field.first..=field.last).find(set))?))
        };
        if let Some((node, bit)) = subject.nodes_of(value).find_map(set) {
            let what = if entry.is_set() { "value" } else { "default" };
            let on_node = subject.on_node(value, node);
            let message = format!("the {what} of {id} sets bit {bit}{on_node}, which is reserved");
            findings.push(subject.finding(CODE, id, entry, Fact::Default, message).help(subject.help(
                Help {
                    specification: "correct the default, or say what the bit means",
                    eds: "correct the default; the bit has no meaning",
                    setting: "correct the value; the bit has no meaning",
                },
            )));
        }
    }
}
