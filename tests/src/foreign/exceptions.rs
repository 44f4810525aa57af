//! Differences that are as they should be, each with its reason.

use od_import::yaml::{Place, Repair};
use od_spec::ascii::transliterate;
use od_spec::model::{DataType, Dictionary, EntryId, Fact, Index, Object, SubIndex, Value};

use super::{Checked, Difference, Stated, Step};

/// The longest text that an EDS of ours has in a line of `[FileInfo]` and `[DeviceInfo]`.
const LONGEST_TEXT: usize = 243;
/// Why what a device fills in can differ.
const OTHER_THAN_FILLED_IN: &str =
    "an identity, device type or name of another type than the device fills in";
/// The longest default.
const LONGEST_DEFAULT: usize = 242;

/// Takes away what is as it should be after an import that says what it has changed, and reports the rest.
pub(super) fn except(repairs: &[Repair], before: &Dictionary, found: Vec<Difference>, checked: &mut Checked) {
    for difference in found {
        let Some(reason) = imported(&difference, before, repairs) else {
            checked.problem(Step::Import, reported(&difference, repairs));
            continue;
        };
        match checked.excepted.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, count)) => *count += 1,
            None => checked.excepted.push((reason, 1)),
        }
    }
}

/// The difference, with why the import says that it has changed the place.
fn reported(difference: &Difference, repairs: &[Repair]) -> String {
    let because = repairs.iter().find(|repair| is_about(repair, difference.place));
    match because {
        Some(repair) => format!("{difference}; the import says: {}", repair.comment()),
        None => difference.to_string(),
    }
}

fn is_about(repair: &Repair, place: Option<EntryId>) -> bool {
    match &repair.place {
        Place::Object(index) => place == Some(EntryId { index: *index, sub: SubIndex(0) }),
        Place::Entry(entry) => place == Some(*entry),
        Place::Device => place.is_none(),
    }
}

/// Why an import has another fact than its original.
fn imported(difference: &Difference, before: &Dictionary, repairs: &[Repair]) -> Option<&'static str> {
    let renamed = |repair: &Repair| repair.fact == Some(Fact::Name) && is_about(repair, difference.place);
    let Some(id) = difference.place else {
        let device_type = before.objects.get(&Index(0x1000)).and_then(|object| object.entry(SubIndex(0)));
        if difference.fact == Stated::Device("device type")
            && device_type.is_some_and(|entry| entry.data_type != DataType::Unsigned32)
        {
            return Some(OTHER_THAN_FILLED_IN);
        }
        let text = match difference.fact {
            Stated::Device("description") => &before.file.description,
            Stated::Device("created by") => &before.file.created_by,
            Stated::Device("modified by") => &before.file.modified_by,
            Stated::Device("product name") => &before.info.product_name,
            Stated::Device("order code") => &before.info.order_code,
            _ => return None,
        };
        return (transliterate(text).len() > LONGEST_TEXT).then_some("a text that is too long for a line");
    };
    let entry = before.entry(id)?;
    let is_counted = before.objects.get(&id.index).is_some_and(Object::is_structured);
    if is_filled_in(id) && entry.data_type != filled_in_type(id) {
        return Some(OTHER_THAN_FILLED_IN);
    }
    match difference.fact {
        Stated::Name => repairs.iter().any(renamed).then_some("a name that an EDS cannot hold"),
        Stated::Type | Stated::Default | Stated::LowLimit | Stated::HighLimit
            if is_counted && id.sub.0 == 0 && entry.data_type != DataType::Unsigned8 =>
        {
            Some("a sub-index 0 of another type than UNSIGNED8, which no specification can have")
        }
        Stated::Default | Stated::Mapping if entry.data_type == DataType::Domain => {
            Some("a DOMAIN, of which an EDS of ours shows neither a value nor a mapping")
        }
        Stated::Default => match &entry.default {
            Some(Value::Text(text)) if !fits(text) => Some("a text that no line of an EDS can hold"),
            Some(
                Value::Text(_) | Value::Integer(_) | Value::NodeId(_) | Value::Real(_) | Value::Bytes(_),
            )
            | None => None,
        },
        Stated::Existence
        | Stated::Kind
        | Stated::Access
        | Stated::Mapping
        | Stated::Type
        | Stated::LowLimit
        | Stated::HighLimit
        | Stated::Flags
        | Stated::Links
        | Stated::Device(_) => None,
    }
}

/// Whether a specification takes the value of an entry from what it says about the device.
const fn is_filled_in(id: EntryId) -> bool {
    matches!((id.index.0, id.sub.0), (0x1000 | 0x1008, 0) | (0x1018, 1..=3))
}

/// The type that such a value has.
const fn filled_in_type(id: EntryId) -> DataType {
    if id.index.0 == 0x1008 { DataType::VisibleString } else { DataType::Unsigned32 }
}

/// Whether a default is plain ASCII that fits into its line.
fn fits(text: &str) -> bool {
    text.len() <= LONGEST_DEFAULT && text.bytes().all(|byte| matches!(byte, b' '..=b'~'))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::foreign::differences;
    use crate::foreign::tests::device;

    /// What is reported about two files, as far as it is not an exception.
    fn reported(repairs: &[Repair], before: &str, after: &str) -> Vec<String> {
        let (before, after) = (device(before), device(after));
        let mut checked = Checked::default();
        except(repairs, &before, differences(&before, &after), &mut checked);
        checked.problems.into_iter().map(|problem| problem.what).collect()
    }

    #[test]
    fn only_what_a_line_cannot_hold_may_be_lost() {
        let text = |value: &str| {
            format!("[2000]\nParameterName=a\nObjectType=7\nDataType=9\nAccessType=ro\n{value}PDOMapping=0\n")
        };
        let none = text("");
        let lost = |value: &str| reported(&[], &text(&format!("DefaultValue={value}\n")), &none);
        assert_eq!(lost("plain").len(), 1);
        assert_eq!(lost("ω"), [""; 0]);
        assert_eq!(lost(&"x".repeat(LONGEST_DEFAULT)).len(), 1);
        assert_eq!(lost(&"x".repeat(LONGEST_DEFAULT + 1)), [""; 0]);
    }
}
