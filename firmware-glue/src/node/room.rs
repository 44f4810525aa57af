//! What a node has too little room for.

use core::fmt;

use crate::pdo::engine::TooManyPdos;

/// A dictionary has more of something than a node has room for: nothing of it is left out in silence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum NoRoom {
    /// TPDOs or RPDOs.
    Pdos(TooManyPdos),
    /// Nodes that it can watch: the highest sub-index of 1016h.
    Watched(usize),
}

impl fmt::Display for NoRoom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pdos(pdos) => pdos.fmt(f),
            Self::Watched(nodes) => write!(f, "too little room for {nodes} watched nodes"),
        }
    }
}

impl core::error::Error for NoRoom {}
