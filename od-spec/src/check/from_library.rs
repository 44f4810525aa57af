//! Objects of CiA 301 as a device has them: taken from the library, or written in full.

use crate::model::Object;
use crate::standard;

/// Whether a device takes an object from the library of CiA 301. What it says otherwise then is noted as a departure (OD0811): the maker
/// has seen the standard and decided.
pub(super) fn is_from_library(object: &Object) -> bool {
    object.profile.as_deref() == Some(standard::CIA301)
}

/// What to do about an object that is not as CiA 301 has it: the library has most of them.
pub(super) fn help(object: &Object) -> String {
    let index = object.index;
    if standard::is_in_library(index) {
        format!("correct it, or take the object from the library: `0x{:04X}: {{from: cia301}}`", index.0)
    } else {
        "correct it; masters know the object as CiA 301 describes it".to_owned()
    }
}
