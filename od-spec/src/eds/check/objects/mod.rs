//! Sections of objects and sub-indices.

use super::rule::FormatRule;
use crate::rules::rules;

rules! { FormatRule:
    structured_objects_have_no_value,
    single_values_have_no_sub_indices,
    sub_indices_are_counted_in_one_way,
    sub_indices_are_counted,
    sub_number_agrees,
    flags_are_defined,
    flags_are_needed,
    links_have_an_object,
    mapping_has_a_direction,
}
