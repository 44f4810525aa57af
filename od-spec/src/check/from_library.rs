//! Objects of CiA 301 as a device has them: taken from the library, or written in full.

use super::help::Help;
use super::subject::Subject;
use crate::model::Object;

/// The name of the library.
const CIA301: &str = "cia301";

/// Whether a device takes an object from the library of CiA 301. What it says otherwise then is noted as a departure (OD0811): the maker
/// has seen the standard and decided.
pub(super) fn is_from_library(object: &Object) -> bool {
    object.profile.as_deref() == Some(CIA301)
}

/// What to do about an object that is not as CiA 301 has it: the library has most of them.
pub(super) fn help(subject: &Subject<'_>, object: &Object) -> String {
    let index = object.index;
    let from_library =
        format!("correct it, or take the object from the library: `0x{:04X}: {{from: cia301}}`", index.0);
    let as_described = "correct it; masters know the object as CiA 301 describes it";
    let specification = if (subject.standard.is_in_library)(index) { &from_library } else { as_described };
    subject.help(Help { specification, eds: as_described, setting: as_described }).to_owned()
}
