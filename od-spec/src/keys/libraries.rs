//! What libraries offer.

use super::shape::{CHANNELS_OF_ELEMENT, INDICES, Key, Keys, NameOf, Shape};
use super::table::keys;

keys! {
    /// A feature of a library.
    FEATURE = "a feature" {
        "about": Shape::Words, "what the device can do with it";
        "implied": Shape::YesNo, "every device has it; no unless given";
        "objects" required: INDICES, "objects it brings", "[0x1003]";
        "needs": Shape::List(&Shape::NameOf(NameOf::Feature)), "features it cannot be without", "[emergency]";
        "channels": Shape::Integer(1, CHANNELS_OF_ELEMENT), "channels in each element of its arrays; a device says how many it has: `digital inputs 8-bit: 20`", "8";
        "channels-of": Shape::NameOf(NameOf::Feature), "feature that has as many channels, which this one needs; `channels` unless given is that of the other", "digital inputs 8-bit";
    }
}

keys! {
    /// `axes:`.
    AXES = "axes" {
        "first" required: Shape::Index, "first index of axis 1", "0x6000";
        "last" required: Shape::Index, "last index of axis 1; axis 2 begins behind it", "0x67FF";
        "count" required: Shape::Integer(2, 16), "number of axes";
    }
}
