//! Drives (CiA 402).

pub(in crate::check) mod modes;

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    drive_modes_have_their_objects,
    drive_modes_are_listed,
    drive_values_mean_something,
    drives_start_at_rest,
}
