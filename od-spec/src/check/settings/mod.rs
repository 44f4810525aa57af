//! What is set for one node.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    set_entries_are_writable,
    locked_entries_are_not_set,
    commands_are_not_downloaded,
    write_conditions_are_met,
    settings_have_an_order,
}
