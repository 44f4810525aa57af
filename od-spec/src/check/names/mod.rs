//! Names, texts and definitions.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    names_are_unique,
    names_differ_in_letters,
    names_fit_eds,
    names_keep_their_characters,
    texts_fit_eds,
    definitions_are_used,
}
