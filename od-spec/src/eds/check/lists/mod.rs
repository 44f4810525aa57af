//! Lists of objects, and other numbered lists.

pub(super) mod counts_agree;
pub(super) mod data_types_are_not_listed;
pub(super) mod entries_are_indices;
pub(super) mod listed_objects_are_described;
pub(super) mod lists_are_numbered;
pub(super) mod lists_ascend;
pub(super) mod lists_exist;
pub(super) mod mandatory_objects_are_those_of_the_standard;
pub(super) mod objects_are_in_their_list;
pub(super) mod objects_are_listed;
pub(super) mod objects_are_listed_once;
