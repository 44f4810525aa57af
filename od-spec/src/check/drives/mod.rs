//! Drives (CiA 402).

pub(in crate::check) mod modes;

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    drive_objects_keep_their_type,
    drive_modes_have_their_objects,
    drive_modes_are_listed,
}
