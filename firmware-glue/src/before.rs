//! What a write replaces.

/// What a value replaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Before {
    /// The one of now: a client writes it, and some values change only while a message does not exist.
    Present,
    /// None: it comes from a memory.
    Nothing,
}
