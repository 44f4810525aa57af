//! Objects of CiA 301: which a device has, and whether they are as the standard has them.

pub(in crate::check) mod from_library;

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    standard_objects_keep_their_type,
    standard_objects_are_complete,
    objects_need_each_other,
    mandatory_objects_exist,
    standard_access_is_kept,
}
