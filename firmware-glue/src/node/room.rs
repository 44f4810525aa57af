//! How much a node has room for, and what a dictionary has too much of.

use core::fmt;

use crate::pdo::engine::TooManyPdos;

/// How much a [`Node`](crate::Node) has room for. The compiler takes the type of the node from it.
#[derive(Debug, Clone, Copy)]
pub struct Room<B, const T: usize, const R: usize, const ERRORS: usize, const WATCHED: usize> {
    /// The TPDOs of the dictionary.
    pub tpdos: UpTo<T>,
    /// The RPDOs of the dictionary.
    pub rpdos: UpTo<R>,
    /// The errors that can be present at the same time. Up to five of them are the node's own.
    pub errors: UpTo<ERRORS>,
    /// The nodes whose heartbeat it monitors: the highest sub-index of 1016h.
    pub watched: UpTo<WATCHED>,
    /// The buffer of the SDO server. It has `LARGEST_VALUE` bytes, a constant of every generated dictionary.
    pub sdo_buffer: B,
}

/// A number of items that is known at compile time: `UpTo::<4>`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UpTo<const N: usize>;

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
