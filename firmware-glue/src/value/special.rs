//! Values of which some raw numbers mean something else, such as a broken wire.

use core::fmt;

/// A value `V`, or one of the special values `S` that are possible in addition to it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Special<V, S> {
    /// An ordinary value.
    Value(V),
    /// A special value.
    Special(S),
}

impl<V, S> Special<V, S> {
    /// The ordinary value; `None` for a special one.
    pub fn value(self) -> Option<V> {
        match self {
            Self::Value(value) => Some(value),
            Self::Special(_) => None,
        }
    }

    /// The special value; `None` for an ordinary one.
    pub fn special(self) -> Option<S> {
        match self {
            Self::Value(_) => None,
            Self::Special(special) => Some(special),
        }
    }
}

/// The value with its unit, or what it means.
impl<V: fmt::Display, S: fmt::Display> fmt::Display for Special<V, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(value) => value.fmt(f),
            Self::Special(special) => special.fmt(f),
        }
    }
}

impl<V: fmt::Debug, S: fmt::Debug> fmt::Debug for Special<V, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(value) => value.fmt(f),
            Self::Special(special) => special.fmt(f),
        }
    }
}
