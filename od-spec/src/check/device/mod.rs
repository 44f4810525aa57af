//! What the device is: identity, device type, channels.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    identity_agrees,
    device_type_is_kept,
    channels_are_in_the_device_type,
    vendor_has_a_number,
    objects_are_of_the_profile,
    serial_number_is_left_open,
}
