//! Modules of a modular device.

pub(super) mod connected_modules_are_supported;
pub(super) mod extensions_can_be_counted;
pub(super) mod modules_are_described;
pub(super) mod modules_bring_something;
pub(super) mod objects_of_modules_are_one_thing;
pub(super) mod shared_objects_agree;
