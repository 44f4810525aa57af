//! What is printed of the language itself: the reference of its keys, the JSON Schema of its files, and what its messages mean.
//!
//! All of it follows from the tables of `od-spec`: keys, rules and codes.

mod explain;
mod json_schema;
mod language;
mod messages;
mod page;

pub use explain::{explained, explanation};
pub use json_schema::{json_schema, parameter_schema, plant_schema, plant_schema_of};
pub use language::{language_pages, reference};
pub use messages::message_pages;
pub use page::Page;

/// The README's examples compile and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
