//! The entries of a machine can have the values that its states and commands need.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity, shorten};
use crate::model::{BitField, BitPattern, BitUsage, Entry, EntryId, StateMachine, System, TypeKind};
use crate::source::Span;
use crate::wording::allowed;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::System(check) };

const CODE: &Code = &Code {
    id: "OD0874",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a pattern that its entry cannot have",
    explanation: "A state is seen where the status entry has the bits of its pattern, and a command is given by writing those of its own. A pattern that needs a 1 in a bit that the type of the entry calls reserved \
        or unused, or that no value within the limits or of the enum has, never occurs: the state is never seen, the command is refused. So is a code under `send:` that the entry does not take. \
        Correct the pattern, the limits or the type.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw, max: 3}\n  0x2001: {name: status, type: unsigned8, access: ro}\nstate-machines:\n  motor:\n    status: status\n    command: command\n    states: {stopped: {pattern: xxxx xxx0}, running: {pattern: xxxx xxx1}}\n    transitions:\n      0: {from: start, to: stopped, event: power-on}\n      1: {from: stopped, to: running, event: command run}\n      2: {from: running, to: stopped, event: an end switch}\n    commands: {run: {pattern: xxxx x1xx, transitions: [1]}}",
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw, max: 7}\n  0x2001: {name: status, type: unsigned8, access: ro}\nstate-machines:\n  motor:\n    status: status\n    command: command\n    states: {stopped: {pattern: xxxx xxx0}, running: {pattern: xxxx xxx1}}\n    transitions:\n      0: {from: start, to: stopped, event: power-on}\n      1: {from: stopped, to: running, event: command run}\n      2: {from: running, to: stopped, event: an end switch}\n    commands: {run: {pattern: xxxx x1xx, transitions: [1]}}",
    )),
};

fn check(system: &System, findings: &mut Findings) {
    for machine in system.machines.values() {
        for device in system.devices.iter().filter(|device| machine.devices.includes(&device.key)) {
            if let Some(entry) = device.entry(machine.status) {
                let of_status = Needed { machine, id: machine.status, entry };
                for state in &machine.states {
                    let what = format!("state `{}`", shorten(&state.name));
                    if let Some(finding) = of_status.pattern(&what, &state.pattern, state.span) {
                        findings.push(finding);
                    }
                }
            }
            let Some(entry) = device.entry(machine.command) else { continue };
            let of_command = Needed { machine, id: machine.command, entry };
            for command in &machine.commands {
                let what = format!("command `{}`", shorten(&command.name));
                let send = command.send.and_then(|send| of_command.value(&what, send.into(), command.span));
                let found = of_command.pattern(&what, &command.pattern, command.span).or(send);
                if let Some(finding) = found {
                    findings.push(finding);
                }
            }
        }
    }
}

/// What a machine needs of an entry.
struct Needed<'a> {
    machine: &'a StateMachine,
    id: EntryId,
    entry: &'a Entry,
}

impl Needed<'_> {
    fn finding(&self, span: Span, message: String, help: &str) -> Diagnostic {
        Diagnostic::new(CODE, self.machine.place(span), message).help(help)
    }

    /// What keeps the entry from having a pattern.
    fn pattern(&self, what: &str, pattern: &BitPattern, span: Span) -> Option<Diagnostic> {
        let (_, ones) = pattern.mask_and_value();
        if let Some(finding) = self.idle_bit(what, ones, span) {
            return Some(finding);
        }
        if some_value(self.entry, pattern).is_some() {
            return None;
        }
        let message = format!("{what} needs a value that {} does not have: {ones:02X}h", self.id);
        Some(
            self.finding(span, message, "correct the pattern, or the limits or values of the entry")
                .note(self.allowed()),
        )
    }

    /// What keeps it from having a value.
    fn value(&self, what: &str, raw: u64, span: Span) -> Option<Diagnostic> {
        if let Some(finding) = self.idle_bit(what, raw, span) {
            return Some(finding);
        }
        if is_allowed(self.entry, signed(self.entry, raw)?) {
            return None;
        }
        let message = format!("{what} sends {raw:02X}h, which {} does not take", self.id);
        Some(
            self.finding(span, message, "correct `send:`, or the limits or values of the entry")
                .note(self.allowed()),
        )
    }

    /// A bit that has to be 1 and means nothing.
    fn idle_bit(&self, what: &str, ones: u64, span: Span) -> Option<Diagnostic> {
        let field = fields(self.entry).iter().find(|field| {
            field.usage != BitUsage::Used && (field.first..=field.last).any(|bit| ones >> bit & 1 == 1)
        })?;
        let bit = (field.first..=field.last).find(|bit| ones >> bit & 1 == 1)?;
        let usage = match field.usage {
            BitUsage::Reserved => "reserved",
            BitUsage::Used | BitUsage::Unused => "unused",
        };
        let message = format!("{what} needs bit {bit} of {}, which is {usage}", self.id);
        Some(self.finding(
            span,
            message,
            "correct the pattern, or give the bit a name in the type of the entry",
        ))
    }

    /// What the entry can have.
    fn allowed(&self) -> String {
        match self.entry.named_type.as_ref().map(|named| &named.kind) {
            Some(TypeKind::Enum(_)) => format!("{} has the values of an enum", self.id),
            Some(TypeKind::Bits(_)) | None => format!("{} takes {}", self.id, allowed(self.entry)),
        }
    }
}

fn fields(entry: &Entry) -> &[BitField] {
    match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Bits(fields)) => fields,
        Some(TypeKind::Enum(_)) | None => &[],
    }
}

/// Bits of an entry as the number that they are there.
fn signed(entry: &Entry, raw: u64) -> Option<i128> {
    let (_, high) = entry.data_type.range()?;
    let (raw, bits) = (i128::from(raw), entry.data_type.bits()?);
    Some(if raw > high { raw - (1 << bits) } else { raw })
}

fn is_allowed(entry: &Entry, value: i128) -> bool {
    let is_listed = match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => {
            values.of(value).is_some() || entry.special.iter().any(|special| special.value == value)
        }
        Some(TypeKind::Bits(_)) | None => true,
    };
    is_listed && entry.allows(value)
}

/// A value of an entry that has the bits of a pattern.
pub(super) fn some_value(entry: &Entry, pattern: &BitPattern) -> Option<u64> {
    let (low, high) = entry.data_type.range()?;
    let bits = entry.data_type.bits()?;
    let raw = |value: i128| u64::try_from(value & ((1 << bits) - 1)).ok();
    let (mask, needed) = pattern.mask_and_value();
    let has_bits = |value: &i128| raw(*value).is_some_and(|raw| raw & mask == needed);
    let listed: Vec<i128> = match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => values.iter().map(|value| value.value).collect(),
        Some(TypeKind::Bits(_)) | None => Vec::new(),
    };
    let special = entry.special.iter().map(|special| special.value);
    let mut named = listed.iter().copied().chain(special);
    if let Some(value) = named.find(|value| has_bits(value) && entry.allows(*value)) {
        return raw(value);
    }
    if !listed.is_empty() {
        return None;
    }
    let (low, high) = (low.max(entry.low.unwrap_or(low)), high.min(entry.high.unwrap_or(high)));
    // The numbers from 0 on, and those below, whose bits follow after.
    let runs = [(low.max(0), high), (low, high.min(-1))];
    runs.into_iter().filter(|(first, last)| first <= last).find_map(|(first, last)| {
        pattern.smallest_from(raw(first)?).filter(|found| raw(last).is_some_and(|last| *found <= last))
    })
}
