//! What an object's section is about, as far as rules over the text need it.

use crate::eds::coded;
use crate::eds::number::lenient_integer;
use crate::eds::view::{ObjectPart, Part};

/// Which keys belong to an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// VAR, DOMAIN or DEFTYPE: one value.
    Single,
    /// ARRAY, RECORD or DEFSTRUCT with sub-indices of their own.
    Structured,
    /// The same with elements that are only counted.
    Compact,
}

/// The form of an object; `None` where its type cannot be read, or where it is one value that has sub-indices: what that is
/// meant to be is for the reader to say.
pub(super) fn form(object: &ObjectPart<'_>) -> Option<Form> {
    let part = object.object.as_ref()?;
    let is_compact = || number(part, "CompactSubObj").is_some_and(|number| number != 0);
    match part.value("ObjectType").map_or(Some(7), |value| coded::object_code(value.value))? {
        2 | 5 | 7 if object.subs.is_empty() => Some(Form::Single),
        6 | 8 | 9 if is_compact() => Some(Form::Compact),
        6 | 8 | 9 => Some(Form::Structured),
        _ => None,
    }
}

/// The number of sub-indices that have a section; FFh does not count.
pub(super) fn described(object: &ObjectPart<'_>) -> i128 {
    object.subs.keys().filter(|sub| **sub < 0xFF).map(|_| 1).sum()
}

/// The number that a key says; `None` where it says none.
pub(super) fn number(part: &Part<'_>, key: &str) -> Option<i128> {
    lenient_integer(part.value(key)?.value)
}
