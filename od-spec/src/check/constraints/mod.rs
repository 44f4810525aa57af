//! Constraints between entries.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    constraints_hold,
    constraints_are_computable,
    conditions_are_open,
}
