//! What state machines do: where their states lead, what their commands cause, and what their entries can hold.

mod paths;
mod words;

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    states_are_entered_and_left,
    commands_have_one_effect,
    automatic_transitions_come_to_rest,
    machine_entries_do_their_part,
    patterns_can_occur,
}
