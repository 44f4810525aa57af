//! The modes that 6060h takes and 6502h lists are the same, and bits have meanings in modes that there are.

use std::collections::BTreeSet;

use crate::check::drives::modes::{Axis, MODES, axes};
use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity, nearest, shorten};
use crate::model::{Author, EntryId, Fact, SubIndex, SystemSource, TypeKind};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0840",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a mode of operation that is not listed, or listed alone",
    explanation: "A master reads 6502h before it writes a mode into 6060h. Here 6060h or 6061h has a mode that 6502h \
        does not list, or 6060h has an enum of the device's own without a mode that is listed. The master leaves out a \
        mode that the drive has, or asks for one that it refuses. Under `modes:` of a bit, a name that is almost that \
        of a mode is not a mode. Correct 6502h, the value, the enum, or the name. Modes of the maker's own, below 0, \
        have no bit.",
    clause: Some("CiA 402, objects 6060h, 6061h and 6502h"),
    example: Some(Example::new(
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6060: {from: cia402, default: 6}\n  0x6502: {from: cia402, default: 0x0001_0000}",
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6060: {from: cia402, default: 0}\n  0x6502: {from: cia402, default: 0x0001_0000}",
    )),
};

const MODE: u16 = 0x6060;
const DISPLAY: u16 = 0x6061;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for axis in axes(subject) {
        for index in [MODE, DISPLAY] {
            value(subject, &axis, index, findings);
        }
        values(subject, &axis, findings);
    }
    names(subject, findings);
}

/// The modes in which bits have a meaning of their own: those of 6060h and 6061h, or else of CiA 402.
fn names(subject: &Subject<'_>, findings: &mut Findings) {
    let is_mode = |index: u16| {
        matches!(index.checked_sub(0x6000), Some(0..0x4000))
            && matches!(0x6000 + (index - 0x6000) % 0x800, MODE | DISPLAY)
    };
    let mut known: BTreeSet<&str> = MODES.iter().map(|mode| mode.name).collect();
    for (.., entry) in subject.device.entries().filter(|(id, ..)| is_mode(id.index.0)) {
        if let Some(TypeKind::Enum(values)) = entry.named_type.as_ref().map(|named| &named.kind) {
            known.extend(values.iter().map(|value| value.name.as_str()));
        }
    }
    let by_maker = subject.system.types.values().filter(|named| named.stated.author == Author::Maker);
    let fields = by_maker.flat_map(|named| match &named.kind {
        TypeKind::Bits(fields) => fields.as_slice(),
        TypeKind::Enum(_) => &[],
    });
    for meaning in fields.flat_map(|field| &field.modes) {
        if known.iter().any(|name| name.eq_ignore_ascii_case(&meaning.mode)) {
            continue;
        }
        // Modes of the maker's own may have any name.
        if let Some(meant) = nearest(&meaning.mode, known.iter().copied()) {
            let message = format!("there is no mode of operation `{}`", shorten(&meaning.mode));
            findings.push(Diagnostic::new(CODE, meaning.mode.span, message).did_you_mean(meant));
        }
    }
}

/// The value that the drive starts with, or that is set.
fn value(subject: &Subject<'_>, axis: &Axis<'_>, index: u16, findings: &mut Findings) {
    let Some(parameter) = subject.parameter(axis.index(index).0, 0) else { return };
    let raw = parameter.raw();
    if axis.lists(raw) {
        return;
    }
    let listing = axis.supported.id;
    let message = format!(
        "{} ({}) is {}, which {listing} does not list",
        parameter.id,
        parameter.entry.name,
        named(raw)
    );
    let help = format!("write a mode that {listing} lists, or 0 for none; or add the bit to {listing}");
    let set = format!("write a mode that {listing} lists, or 0 for none");
    let help = subject.help(Help { specification: &help, eds: &help, setting: &set });
    findings.push(parameter.finding(CODE, message).help(help));
}

/// The values that the device's own enum has.
fn values(subject: &Subject<'_>, axis: &Axis<'_>, findings: &mut Findings) {
    let id = EntryId { index: axis.index(MODE), sub: SubIndex(0) };
    let Some(entry) = subject.device.entry(id) else { return };
    // The library's enum has all modes that there are, and an EDS has no enum of its own.
    if subject.system.source != SystemSource::Specification {
        return;
    }
    let own = entry.named_type.as_ref().filter(|named| named.stated.author != Author::Library);
    let Some(TypeKind::Enum(values)) = own.map(|named| &named.kind) else { return };
    let takes = |raw: i128| values.of(raw).is_some_and(|value| value.supported);
    let listing = axis.supported.id;
    let unlisted = values.iter().filter(|value| value.supported && !axis.lists(value.value));
    let more = unlisted.map(|value| format!("{}, which {listing} does not list", named(value.value)));
    let lacking = MODES.iter().filter(|mode| axis.has(mode) && !takes(mode.value));
    let less = lacking.map(|mode| format!("no {}, which {listing} lists", named(mode.value)));
    let problems: Vec<String> = more.chain(less).collect();
    if problems.is_empty() {
        return;
    }
    let message = format!("the enum of {id} ({}) has {}", entry.name, problems.join("; "));
    findings.push(subject.finding(CODE, id, entry, Fact::Type, message).help(format!(
        "correct the values of the enum (`supported: no` where the drive lacks one), or {listing}"
    )));
}

/// `6 (homing mode)`.
fn named(raw: i128) -> String {
    match MODES.iter().find(|mode| mode.value == raw) {
        Some(mode) => format!("{raw} ({})", mode.name),
        None => raw.to_string(),
    }
}
