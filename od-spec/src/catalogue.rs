//! Every code that there is.

use crate::check::RULES;
use crate::diag::{Code, codes, readers};
use crate::{eds, plant};

/// All codes, ascending: those of reading and looking up, and those of the rules over texts and over the model.
pub fn all_codes() -> Vec<&'static Code> {
    let mut list: Vec<&Code> = codes::ALL.to_vec();
    list.extend(RULES.iter().map(|rule| rule.code));
    list.extend(plant::rules::codes());
    list.extend(eds::codes::ALL);
    list.extend(readers::codes::ALL);
    list.extend(eds::check::RULES.iter().map(|rule| rule.code));
    list.sort();
    // One code may be said by several rules.
    list.dedup();
    list
}

/// The code with this id, in any case.
pub fn code(id: &str) -> Option<&'static Code> {
    all_codes().into_iter().find(|code| code.id.eq_ignore_ascii_case(id))
}
