//! What libraries offer.

use super::shape::{CHANNELS_OF_ELEMENT, INDICES, Key, Keys, NameOf, Shape};
use super::table::keys;

keys! {
    /// A feature of a library.
    FEATURE = "a feature" {
        "about": Shape::Words, "what a device can do with it";
        "implied": Shape::YesNo, "whether every device has it; no unless given";
        "objects" required: INDICES, "objects that it adds", "[0x1003]";
        "needs": Shape::List(&Shape::NameOf(NameOf::Feature)), "features that it requires", "[emergency]";
        "channels": Shape::Integer(1, CHANNELS_OF_ELEMENT), "channels in each element of its arrays; a device states how many it has: `digital inputs 8-bit: 20`", "8";
        "channels-of": Shape::NameOf(NameOf::Feature), "feature that has as many channels, which this one requires; it also gives `channels` unless given", "digital inputs 8-bit";
    }
}

keys! {
    /// `axes:`.
    AXES = "axes" {
        "first" required: Shape::Index, "first index of axis 1", "0x6000";
        "last" required: Shape::Index, "last index of axis 1; axis 2 begins after it", "0x67FF";
        "count" required: Shape::Integer(2, 16), "number of axes";
    }
}
