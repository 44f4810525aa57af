//! Who may read and write what: access, locks, commands, aliases.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    locks_guard_writing,
    commands_are_flagged,
    values_can_be_read_back,
    views_show_values,
    views_show_their_target,
}
