//! EDS and DCF texts (CiA 306), apart from what they mean.
//!
//! A [`Document`] is what a writer fills and what a reader gives: it knows sections, keys, comments and line breaks, and
//! nothing of devices, objects or types. It stands with the other front ends and not with the model, so that a text can be
//! read, mended, compared and written back before anybody has understood it.

mod document;

pub use document::{Document, Header, Item, KeyValue, Line, LineEnd, Section, Trivia};
