//! EDS and DCF texts (CiA 306).
//!
//! A [`Document`] is what a writer fills and what a reader gives: it knows sections, keys, comments and line breaks, and
//! nothing of devices, objects or types. It stands with the other front ends and not with the model, so that a text can be
//! read, mended, compared and written back before anybody has understood it.

pub(crate) mod check;
pub(crate) mod codes;
mod document;
mod encoding;
pub(crate) mod example;
mod findings;
mod fix;
pub(crate) mod names;
pub(crate) mod number;
mod scan;
pub(crate) mod view;

pub use document::{Document, Line, LineEnd, LineKind, Section, SectionRef};
pub use encoding::{Encoding, decode, encode};
pub use findings::findings;
pub use fix::{Change, Fixed, fix};

#[cfg(test)]
mod examples;
