//! How a dictionary names its entries.

use core::fmt::Debug;

/// Something whose entries have names: a dictionary, as its application sees it.
pub trait Entries: Sized {
    /// Every entry, by name; an enumeration in generated code.
    type Entry: Copy + Eq + Debug + 'static;
}
