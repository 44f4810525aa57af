//! Error codes.

use super::shape::{DEVICES, Key, Keys, NameOf, PHRASES, Shape};
use super::table::keys;
use crate::model::ErrorKind;

macro_rules! error_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "name" inherited: Shape::Text => name: Option<Name>, "name; `{n}` counts through a range from 1", "\"Voltage at battery block {n} too low\"";
            "from": Shape::NameOf(NameOf::Library) => from: Option<Name>, "library that defines the code; the other keys override its facts", "cia402";
            "devices": DEVICES => devices: Option<Vec<Name>>, "devices that report it; all unless given";
            "priority": Shape::Text => priority: Option<Name>, "priority, as the manual classifies it";
            "reaction": Shape::Words => reaction: Words, "what the device does";
            "option-code": Shape::Entry => option_code: Option<Name>, "entry whose value chooses the reaction", "0x605E";
            "treated-by": DEVICES => treated_by: Option<Vec<Name>>, "devices for which `priority`, `reaction` and `option-code` apply; all that report it unless given";
            "register": Shape::OneOrMore(&Shape::Choice(ErrorKind::WORDS)) => register: Vec<Spanned<ErrorKind>>, "kinds of error that it sets in 1001h, in addition to `generic`, which every error sets; that of its class unless given", "[current, temperature]";
            "reset": Shape::Words => reset: Words, "what resets it; that of the device's `any-error` unless given", "switch the device off and on";
            "about": Shape::Words => about: Words, "more about it";
            "gap": Shape::Words => gap: Words, "what the printed manual leaves open about it";
            "search": PHRASES => search: Option<Spanned<Phrases>>, "words and phrases by which readers look for it, by language, where its name and texts have others", "{en: DC link too high}";
        } }
    };
}
pub(crate) use error_keys;

error_keys! { keys
    /// An error code.
    ERROR = "an error code"
}

macro_rules! any_error_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "shown": Shape::Words => shown: Words, "what shows that there is an error", "bit 3 of 6041h";
            "reaction": Shape::Words => reaction: Words, "what the device does at any error";
            "reset": Shape::Words => reset: Words, "what resets an error, except 0x0000 and those with a `reset` of their own", "bit 7 of 6040h from 0 to 1";
        } }
    };
}
pub(crate) use any_error_keys;

any_error_keys! { keys
    /// `any-error:` of a device.
    ANY_ERROR = "an error rule"
}
