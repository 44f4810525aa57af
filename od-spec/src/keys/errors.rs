//! Error codes.

use super::shape::{Key, Keys, NAMES, Shape};
use super::table::keys;

macro_rules! error_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "name": Shape::Text => name: Option<Name>, "name; `{n}` counts through a range from 1; needed without `from`", "\"Voltage at battery block {n} too low\"";
            "from": Shape::Text => from: Option<Name>, "library that defines the code; the other keys go before it", "cia402";
            "devices": NAMES => devices: Option<Vec<Name>>, "devices that report it; all unless given";
            "priority": Shape::Text => priority: Option<Name>, "priority, as the manual classes it";
            "reaction": Shape::Words => reaction: Words, "what the device does";
            "option-code": Shape::Entry => option_code: Option<Name>, "entry whose value chooses the reaction", "0x605E";
            "about": Shape::Words => about: Words, "more about it";
        } }
    };
}
pub(crate) use error_keys;

error_keys! { keys
    /// An error code.
    ERROR = "an error code"
}
