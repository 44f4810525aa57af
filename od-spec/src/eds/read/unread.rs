//! Keys of the standard that the dictionary has no place for.

use crate::diag::{Diagnostics, Repeated};
use crate::eds::codes;
use crate::eds::number::lenient_integer;
use crate::eds::view::{Part, View};

use super::without_place;

/// The keys. `ParamRefd` of an entry is said where its value is read.
const UNREAD: [&str; 9] = [
    "SRDOMapping",
    "InvertedSRAD",
    "CANopenSafetySupported",
    "NG_Slave",
    "NG_Master",
    "NrOfNG_MonitoredNodes",
    "NodeRefd",
    "NetRefd",
    "CANopenManager",
];

/// Tells of each that says something, once for all its places.
pub(super) fn tell(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = UNREAD.map(|key| (key, Repeated::new()));
    for entry in view.parts().flat_map(Part::entries) {
        let says_nothing = entry.value.value.is_empty() || lenient_integer(entry.value.value) == Some(0);
        let is_key = |(key, _): &&mut (&str, Repeated)| entry.key.value.eq_ignore_ascii_case(key);
        if says_nothing {
            continue;
        }
        if let Some((key, places)) = found.iter_mut().find(is_key) {
            let message = || format!("`{key}` is left out of what is made from this file");
            places.add(entry.key.span, [], || without_place(codes::UNREAD, entry.key.span, message()));
        }
    }
    for (_, places) in found {
        places.finish("places", diagnostics);
    }
}
