//! What a file says about itself and the device: `[FileInfo]`, `[DeviceInfo]`, `[DummyUsage]`.

pub(super) mod a_bit_rate_is_supported;
pub(super) mod dates_and_times_are_such;
pub(super) mod dates_are_in_order;
pub(super) mod device_is_identified;
pub(super) mod device_says_what_it_can;
pub(super) mod dummies_are_allowed_or_not;
pub(super) mod dummies_are_static_types;
pub(super) mod dynamic_channels_agree;
pub(super) mod dynamic_objects_are_not_described;
pub(super) mod every_dummy_is_mentioned;
pub(super) mod file_has_its_name;
pub(super) mod file_is_described;
pub(super) mod format_version_is_current;
pub(super) mod implied_pdos_are_whole;
pub(super) mod information_exists;
pub(super) mod information_is_numbers;
pub(super) mod numbers_are_plain;
pub(super) mod pdo_counts_agree;
pub(super) mod sections_are_complete;
pub(super) mod versions_are_numbers;
