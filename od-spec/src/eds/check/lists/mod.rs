//! Lists of objects, and other numbered lists.

use super::rule::FormatRule;
use crate::rules::rules;

rules! { FormatRule:
    lists_exist,
    counts_agree,
    lists_are_numbered,
    entries_are_indices,
    objects_are_listed_once,
    listed_objects_are_described,
    objects_are_listed,
    objects_are_in_their_list,
    mandatory_objects_are_those_of_the_standard,
    data_types_are_not_listed,
    lists_ascend,
}
