//! Values against type, limits, enum and each other at start.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    value_in_enum,
    value_fits_type,
    value_within_limits,
    limits_in_order,
    constants_have_values,
    real_defaults,
    reserved_bits_are_zero,
    integers_have_common_widths,
    real_values_are_kept,
    start_values_are_allowed,
    special_values_mean_one_thing,
    units_measure_quantities,
    symbols_keep_their_meaning,
    quantities_are_possible,
}
