//! Modules of a modular device.

use super::rule::FormatRule;
use crate::rules::rules;

rules! { FormatRule:
    modules_are_described,
    modules_bring_something,
    objects_of_modules_are_one_thing,
    shared_objects_agree,
    extensions_can_be_counted,
    connected_modules_are_supported,
}
