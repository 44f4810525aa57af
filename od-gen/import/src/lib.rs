//! From files and models back to texts that a person edits: an EDS, DCF or XDD as a specification, a node's values as a
//! parameter file.

mod import;
pub mod parameters;
pub mod yaml;

pub use import::{Imported, import};
