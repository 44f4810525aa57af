//! What the device keeps over a power cycle.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    constants_are_not_stored,
    stored_entries_can_be_stored,
    areas_are_stored_apart,
}
