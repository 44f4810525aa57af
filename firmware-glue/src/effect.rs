//! What a write does.

/// What becomes of a value that passed every check of the dictionary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Effect {
    /// The entry takes it.
    Store,
    /// It is a command for the application, such as the signature of 1010h; nothing is stored.
    Command,
}
