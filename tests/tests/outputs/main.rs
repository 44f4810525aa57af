//! All outputs together: they are current, say the same, and no text in them commands.

mod generated;
mod hostile;
mod renamed;
mod wording;
