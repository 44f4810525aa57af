//! A special value is not an ordinary value as well.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity, shorten};
use crate::model::{BitField, BitUsage, Entry, Fact, SpecialValue, SystemSource, TypeKind};
use crate::wording::allowed;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0875",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a special value that is an ordinary one, too",
    explanation: "A special value means something other than a number: that there is none, or that another is meant. \
        One between `min` and `max`, one that the enum lists, or one that is a usual combination of bits has two \
        meanings, and a reader cannot know which. Take a value outside the limits, or narrow them. The value 0 and the \
        limits themselves are not checked: 0 is often `off`, and the last value of a range often something else.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: rw, min: 0, max: 100, special: {50: automatic}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: rw, min: 0, max: 100, special: {255: automatic}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // Only a specification has special values.
    if subject.system.source != SystemSource::Specification {
        return;
    }
    for (id, _, entry) in subject.device.entries().filter(|(.., entry)| by_maker(entry)) {
        let found = entry.special.iter().find_map(|special| Some((special, other_meaning(entry, special)?)));
        let Some((special, other)) = found else { continue };
        let message =
            format!("{id} ({}): {} is `{}` and {other}", entry.name, special.value, shorten(&special.name));
        findings.push(
            subject
                .finding(CODE, id, entry, Fact::Special, message)
                .help("take a value that the entry does not have otherwise"),
        );
    }
}

/// Whether the maker has special values; what a standard calls so is meant so.
fn by_maker(entry: &Entry) -> bool {
    !entry.special.is_empty() && !entry.is_only_standard(Fact::Special)
}

/// What a special value means, apart from what it is special for.
fn other_meaning(entry: &Entry, special: &SpecialValue) -> Option<String> {
    match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => {
            values.of(special.value).map(|value| format!("`{}`", shorten(&value.name)))
        }
        Some(TypeKind::Bits(fields)) => (special.value != 0
            && fields.iter().all(|field| may_have(field, special.value)))
        .then(|| "a combination of its bits".to_owned()),
        None => {
            let (low, high) = (entry.low?, entry.high?);
            (special.value != 0 && low < special.value && special.value < high)
                .then(|| format!("a value from {}", allowed(entry)))
        }
    }
}

/// Whether bits may be as in a value.
fn may_have(field: &BitField, value: i128) -> bool {
    let bits = value >> field.first & ((1 << (field.last - field.first + 1)) - 1);
    match field.usage {
        BitUsage::Reserved | BitUsage::Unused => bits == 0,
        BitUsage::Used => field.values.is_empty() || field.values.iter().any(|value| value.value == bits),
    }
}
