//! What running text names: tables, figures and sections of a manual by number, objects by index.

mod indices;
mod mentions;

pub use indices::{Written, indices};
pub use mentions::{Mention, Numbered, mentions};
