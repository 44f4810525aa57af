//! Objects of CiA 301 as a device has them: taken from the library, or written in full.

use crate::check::help::Help;
use crate::check::subject::Subject;
use crate::model::{Fact, Object};

/// The name of the library of CiA 301.
pub(in crate::check) const CIA301: &str = "cia301";
/// The name of the library of CiA 302.
pub(crate) const CIA302: &str = "cia302";
/// The name of the library of CiA 401.
pub(crate) const CIA401: &str = "cia401";
/// The name of the library of CiA 402.
pub(crate) const CIA402: &str = "cia402";

/// Whether a device takes an object from the library of CiA 301. What it says otherwise then is noted as a departure (OD0811): the maker
/// has seen the standard and decided, where the standard leaves a choice.
pub(in crate::check) fn is_from_library(object: &Object) -> bool {
    object.profile.as_deref() == Some(CIA301)
}

/// Whether a device says something of its own about facts of an object that a standard describes: it does not take the object from the
/// library of the standard, or takes it and says otherwise.
pub(in crate::check) fn says_itself(object: &Object, library: &str, facts: &[Fact]) -> bool {
    let departs = || object.departures.iter().any(|departure| facts.contains(&departure.fact));
    object.profile.as_deref() != Some(library) || departs()
}

/// What to do about an object that is not as CiA 301 has it: the library has most of them.
pub(in crate::check) fn help(subject: &Subject<'_>, object: &Object) -> String {
    if is_from_library(object) {
        return "leave out what differs from the library; masters know the object as CiA 301 describes it"
            .to_owned();
    }
    let index = object.index;
    let from_library =
        format!("correct it, or take the object from the library: `0x{:04X}: {{from: cia301}}`", index.0);
    let as_described = "correct it; masters know the object as CiA 301 describes it";
    let specification = if (subject.standard.is_in_library)(index) { &from_library } else { as_described };
    subject.help(Help { specification, eds: as_described, setting: as_described })
}
