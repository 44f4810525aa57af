//! `odgen reference`: the reference of the language.

use crate::report::print;

pub(crate) fn run() -> u8 {
    print(&od_reference::reference())
}
