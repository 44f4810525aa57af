//! Sections of objects and sub-indices.

pub(super) mod flags_are_defined;
pub(super) mod flags_are_needed;
pub(super) mod links_have_an_object;
pub(super) mod mapping_has_a_direction;
pub(super) mod single_values_have_no_sub_indices;
pub(super) mod structured_objects_have_no_value;
pub(super) mod sub_indices_are_counted;
pub(super) mod sub_indices_are_counted_in_one_way;
pub(super) mod sub_number_agrees;
