//! Exit codes.

/// The input is without errors, and what was to be written is.
pub(crate) const SUCCESS: u8 = 0;
/// Errors in the input, or output that could not be written.
pub(crate) const ERRORS: u8 = 1;
/// The command line cannot be understood.
pub(crate) const USAGE: u8 = 2;
/// `odgen diff --exit-code` found what it looked for, or `odgen node compare` a difference.
pub(crate) const DIFFERS: u8 = 3;
/// The user interrupted the command before all was done.
pub(crate) const INTERRUPTED: u8 = 130;
