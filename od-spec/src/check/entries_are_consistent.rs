//! Every entry holds together once everything about it is known: type, limits, default, access, mapping and what the
//! EDS shows. Most of it is checked where it is written; this rule also sees what was derived.

use super::own_place;
use crate::diag::{Code, Diagnostic, Diagnostics, codes};
use crate::model::{
    Access, DataType, Dictionary, Direction, Entry, EntryId, Index, Object, Origin, SubIndex, Value,
    format_value,
};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    for (id, object, entry) in device.entries() {
        let problem = value(entry).or_else(|| eds_access(entry)).or_else(|| count(id, object, entry));
        if let Some((code, message, help)) = problem {
            let place = own_place(device, entry.span);
            diagnostics.push(Diagnostic::new(code, place, format!("{id}: {message}")).help(help));
        }
    }
}

type Problem = (&'static Code, String, &'static str);

/// The default is a value of the type, and inside the limits for every node.
fn value(entry: &Entry) -> Option<Problem> {
    let default = entry.default.as_ref()?;
    let is_text = matches!(entry.data_type, DataType::VisibleString | DataType::UnicodeString);
    let fits_type = match default {
        Value::Integer(_) | Value::NodeId(_) => entry.data_type.range().is_some(),
        Value::Real(_) => matches!(entry.data_type, DataType::Real32 | DataType::Real64),
        Value::Text(_) => is_text,
        Value::Bytes(_) => entry.data_type == DataType::OctetString,
    };
    let shown = format_value(entry, default);
    if !fits_type {
        return Some((
            codes::VALUE_DOES_NOT_FIT,
            format!("the default `{shown}` is no value of type {}", entry.data_type),
            "correct the type; the default follows from the device",
        ));
    }
    let (low, high) = entry.data_type.range()?;
    let nodes = if matches!(default, Value::NodeId(_)) { 1..=127 } else { 1..=1 };
    for raw in nodes.filter_map(|node| default.integer_for(node)) {
        if !(low..=high).contains(&raw) {
            return Some((
                codes::VALUE_DOES_NOT_FIT,
                format!("the default {raw} does not fit {}", entry.data_type),
                "correct the type; the default follows from the device or from another entry",
            ));
        }
        if !entry.allows(raw) {
            return Some((
                codes::DEFAULT_OUTSIDE_LIMITS,
                format!("the default {shown} is outside the limits"),
                "correct the limits; the default follows from the device or from another entry",
            ));
        }
    }
    None
}

/// The EDS promises no access that the device refuses, and none that contradicts the mapping.
fn eds_access(entry: &Entry) -> Option<Problem> {
    let (own, shown) = (entry.access, entry.eds.access);
    if (shown.is_writable() && !own.is_writable()) || (shown.is_readable() && !own.is_readable()) {
        return Some((
            codes::MAPPING_AGAINST_ACCESS,
            format!("the EDS would show `{}`, the entry is `{}`", shown.word(), own.word()),
            "an EDS may show less access than the device gives, not more",
        ));
    }
    let contradicts = |direction, fine: bool| entry.pdo.allows(direction) && !fine;
    let receive = matches!(shown, Access::Wo | Access::Rw | Access::Rww);
    let transmit = matches!(shown, Access::Const | Access::Ro | Access::Rw | Access::Rwr);
    for (direction, fine) in [(Direction::Receive, receive), (Direction::Transmit, transmit)] {
        if contradicts(direction, fine) {
            return Some((
                codes::MAPPING_AGAINST_ACCESS,
                format!("mappable into a {}, but the EDS shows `{}`", direction.pdo(), shown.word()),
                "remove `pdo:`, or let the EDS show the access; a locked entry is `ro` in the EDS",
            ));
        }
    }
    None
}

/// Sub-index 0 tells the highest sub-index, where its value is fixed.
fn count(id: EntryId, object: &Object, entry: &Entry) -> Option<Problem> {
    if !object.is_structured() || id.sub != SubIndex(0) || object.origin == Origin::Pdo {
        return None;
    }
    if !entry.access.is_readable() || entry.data_type != DataType::Unsigned8 {
        return Some((
            codes::MAPPING_AGAINST_ACCESS,
            "sub-index 0 is not a readable UNSIGNED8".to_owned(),
            "correct `sub0:`; CiA 301 fixes its type, and every client reads it",
        ));
    }
    let highest = object.entries.last().map(|last| i128::from(last.sub.0))?;
    let shown = entry.default.as_ref().and_then(Value::integer);
    // A writable count, such as that of 1003h, is no constant.
    let fixed = !entry.access.is_writable() && id.index != Index(0x1003);
    (fixed && shown != Some(highest)).then(|| {
        (
            codes::COUNT_MISMATCH,
            format!("sub-index 0 is {}, the highest sub-index {highest}", shown.unwrap_or_default()),
            "remove `default:` from `sub0:`; the value follows from the entries",
        )
    })
}
