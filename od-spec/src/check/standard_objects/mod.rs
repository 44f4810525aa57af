//! Objects of CiA 301: which a device has, and whether they are as the standard has them.

pub(crate) mod from_library;

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    standard_objects_keep_their_type,
    standard_objects_are_complete,
    objects_need_each_other,
    mandatory_objects_exist,
    standard_access_is_kept,
    profile_objects_keep_their_type,
    objects_have_partners,
    arrays_are_as_long,
    functions_can_be_switched_on,
    ranges_are_in_order,
}
