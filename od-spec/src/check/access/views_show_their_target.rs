//! A view can show what its target has.

use crate::check::findings::Findings;
use crate::check::possible::{Run, fits, hull};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Alias, BitUsage, Entry, Fact, Outside, Ratio, TypeKind, Value, convert};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0881",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a view that cannot show its target",
    explanation: "An alias shows another entry in a narrower type or another unit. This one shows none of the values that its target can have, not the default, or one number for all of \
        them; or it cuts a bit field, and a value that does not fit becomes the largest number, in which all bits are set. The view then reads as another value, and a \
        write through it cannot reach what the target takes. Give the alias a wider type or another unit; for the lower bits of a bit field, `outside: wrap`.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: speed, type: unsigned16, access: rw, default: 1000, min: 500}\n  0x2001: {name: short speed, alias: speed, type: unsigned8}",
        "objects:\n  0x2000: {name: speed, type: unsigned32, access: rw, default: 1000, min: 500}\n  0x2001: {name: short speed, alias: speed, type: unsigned16}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for view in subject.device.views() {
        let Some(target) = subject.device.entry(view.alias.target) else { continue };
        let (problem, help) = match cut(view.entry, view.alias, target) {
            Some(bit) => (
                format!("shows all bits set while bit {bit} of {} is", view.alias.target),
                "write `outside: wrap`, which leaves the upper bits out, or give the alias a wider type",
            ),
            None => match problem(view.entry, view.alias, target) {
                Some(problem) => (problem, "give the alias a wider type or another unit"),
                None => continue,
            },
        };
        let message = format!("{} ({}) {problem}", view.id, view.entry.name);
        findings.push(subject.finding(CODE, view.id, view.entry, Fact::Alias, message).help(help));
    }
}

fn problem(view: &Entry, alias: &Alias, target: &Entry) -> Option<String> {
    let of = alias.target;
    let (low, high) = hull(target)?;
    let (exact_low, exact_high) = ends(alias.factor, (low, high))?;
    let (least, most) = hull(view)?;
    if exact_high.compare(Ratio::whole(least))?.is_lt() || exact_low.compare(Ratio::whole(most))?.is_gt() {
        return Some(format!("shows none of the values of {of}"));
    }
    let shown = |raw| convert(raw, alias.factor, alias.rounding, Outside::Abort, view.data_type);
    // The author of `outside:` has seen that the view is narrow.
    if let Some(default) = target.default.as_ref().and_then(Value::integer)
        && alias.outside == Outside::Saturate
        && fits(default, target.data_type)
        && shown(default).is_none()
    {
        return Some(format!("cannot show the default of {of}"));
    }
    let is_one = low != high && shown(low).is_some() && shown(low) == shown(high);
    is_one.then(|| format!("shows one number for all values of {of}"))
}

/// The first bit that means something and does not fit into a view that then shows the largest number.
fn cut(view: &Entry, alias: &Alias, target: &Entry) -> Option<u8> {
    let Some(TypeKind::Bits(fields)) = target.named_type.as_ref().map(|named| &named.kind) else {
        return None;
    };
    if alias.outside != Outside::Saturate || alias.factor != Ratio::ONE || !view.access.is_readable() {
        return None;
    }
    let width = view.data_type.bits()?;
    let used = fields.iter().filter(|field| field.usage == BitUsage::Used);
    used.filter(|field| u16::from(field.last) >= width)
        .map(|field| field.first.max(u8::try_from(width).unwrap_or(u8::MAX)))
        .min()
}

/// The ends of a run of values in the steps of a view.
fn ends(factor: Ratio, (low, high): Run) -> Option<(Ratio, Ratio)> {
    let (one, other) = (Ratio::whole(low).checked_mul(factor)?, Ratio::whole(high).checked_mul(factor)?);
    Some(if one.compare(other)?.is_le() { (one, other) } else { (other, one) })
}
