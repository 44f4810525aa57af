//! Error codes and what a device does about them.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    error_codes_have_a_class,
    reactions_can_happen,
}
