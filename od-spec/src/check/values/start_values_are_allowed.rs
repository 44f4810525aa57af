//! A device starts with values that its entries can have.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{DataType, Dictionary, Entry, EntryId, Fact, Family, Real, SystemSource, TypeKind, Value};
use crate::wording::allowed;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0837",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a value at start that the entry cannot have",
    explanation: "The entry has no default, so that a generated dictionary starts with 0; but 0 is outside its limits \
        or is not a value of its enum. Until a client writes another one, the device shows what it would refuse, and \
        may act on it. State the value that it starts with as `default:`; if it is not a promise of the maker, `eds: \
        {default: withheld}` keeps it out of the EDS. Of an EDS, `odgen build --rust` says this: without \
        `DefaultValue`, the code starts with 0. A 0 that says \"not yet known\" is a value of its own: `special: {0: \
        not yet known}`.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: gain, type: unsigned8, access: rw, min: 1}",
        "objects:\n  0x2000: {name: gain, type: unsigned8, access: rw, min: 1, default: 1, eds: {default: withheld}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // An EDS without a default says nothing about the start.
    if subject.node.is_some() || subject.system.source != SystemSource::Specification {
        return;
    }
    for (id, entry) in starting_wrong(subject.device) {
        let message = format!("{id} ({}) starts with 0, which is {}", entry.name, problem(entry));
        let diagnostic = subject.finding(CODE, id, entry, limit(entry).fact(), message);
        findings.push(diagnostic.help(if entry.data_type.family() == Family::Real {
            "add `default:`, with `eds: {default: withheld}` if it is not a promise"
        } else {
            "add `default:`, with `eds: {default: withheld}` if it is not a promise; or make 0 a `special` value"
        }));
    }
}

/// What is to be said about code that is made of a device in an EDS: the EDS says nothing about the start, but the code has one.
pub fn start_of_code(device: &Dictionary) -> Option<Diagnostic> {
    /// So many entries are named.
    const NAMED: usize = 5;
    let mut wrong = starting_wrong(device);
    let (id, entry) = wrong.next()?;
    let message = format!("in the code, {id} ({}) starts with 0, which is {}", entry.name, problem(entry));
    let diagnostic = Diagnostic::new(CODE, entry.place(limit(entry).fact()), message)
        .about((id, limit(entry).fact()))
        .help(
            "write `DefaultValue` into the EDS; or let the firmware write these entries before they are read",
        );
    let mut named: Vec<String> = wrong.by_ref().take(NAMED).map(|(id, _)| id.to_string()).collect();
    match wrong.count() {
        0 => {}
        more => named.push(format!("{more} more")),
    }
    Some(if named.is_empty() { diagnostic } else { diagnostic.note(format!("so do {}", named.join(", "))) })
}

/// The entries that show a 0 which they cannot have.
fn starting_wrong(device: &Dictionary) -> impl Iterator<Item = (EntryId, &Entry)> {
    // What cannot be read shows nothing, and a view shows another entry's value.
    let is_shown =
        |entry: &Entry| entry.access.is_readable() && entry.alias.is_none() && entry.default.is_none();
    let wrong = device.entries().filter(move |(.., entry)| is_shown(entry) && !starts_right(entry));
    wrong.map(|(id, _, entry)| (id, entry))
}

/// What is wrong with 0.
fn problem(entry: &Entry) -> String {
    match limit(entry) {
        Limit::Type => "no supported value of its enum".to_owned(),
        Limit::Low | Limit::High => format!("outside {}", allowed(entry)),
    }
}

/// Whether an entry can have the value 0; one that has no numbers starts empty.
fn starts_right(entry: &Entry) -> bool {
    if entry.data_type.family() == Family::Real {
        return entry.real_limits.allow(&Real::from(0.0), entry.data_type);
    }
    let is_number = entry.data_type.is_integer() || entry.data_type == DataType::Boolean;
    !is_number
        || entry.special.iter().any(|special| special.value == 0)
        || (entry.allows(0) && is_listed(entry))
}

/// Whether 0 is among the values that an enum lists, if there is one.
fn is_listed(entry: &Entry) -> bool {
    match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => values.of(0).is_some_and(|listed| listed.supported),
        Some(TypeKind::Bits(_)) | None => true,
    }
}

/// What keeps 0 out.
#[derive(Clone, Copy)]
enum Limit {
    Low,
    High,
    Type,
}

impl Limit {
    const fn fact(self) -> Fact {
        match self {
            Self::Low => Fact::LowLimit,
            Self::High => Fact::HighLimit,
            Self::Type => Fact::Type,
        }
    }
}

fn limit(entry: &Entry) -> Limit {
    let sign = |limit: &Value| match limit {
        Value::Real(real) => i128::from(real.order(entry.data_type)),
        Value::Integer(raw) => *raw,
        Value::NodeId(_) | Value::Text(_) | Value::Bytes(_) => 0,
    };
    let (low, high) = entry.limits();
    if low.is_some_and(|low| sign(&low) > 0) {
        Limit::Low
    } else if high.is_some_and(|high| sign(&high) < 0) {
        Limit::High
    } else {
        Limit::Type
    }
}
