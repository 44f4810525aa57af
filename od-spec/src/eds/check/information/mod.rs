//! What a file says about itself and the device: `[FileInfo]`, `[DeviceInfo]`, `[DummyUsage]`.

use super::rule::FormatRule;
use crate::rules::rules;

rules! { FormatRule:
    information_exists,
    sections_are_complete,
    file_is_described,
    device_is_identified,
    device_says_what_it_can,
    information_is_numbers,
    numbers_are_plain,
    versions_are_numbers,
    format_version_is_current,
    dates_and_times_are_such,
    dates_are_in_order,
    file_has_its_name,
    a_bit_rate_is_supported,
    pdo_counts_agree,
    implied_pdos_are_whole,
    dynamic_channels_agree,
    dummies_are_allowed_or_not,
    every_dummy_is_mentioned,
    dummies_are_static_types,
    dynamic_objects_are_not_described,
}
