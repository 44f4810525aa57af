//! Object dictionaries as tables, and back.
//!
//! Data flows one way: file → cells with their places ([`Notation`]) → title rows → facts, each with its cell → a
//! specification with a line for each fact, which the compiler of the language reads → the model → the specification
//! that is given, by the writer that EDS files have, too. So values, units and rules are those of the language; what the compiler
//! refuses, and what was not understood before, is left out, with a comment that names the cell.

mod asked;
mod columns;
mod draft;
mod export;
mod facts;
mod import;
mod read;
mod settle;
mod sheet;
mod spelling;
mod understand;

pub use columns::{Assigned, assigned};
pub use export::{Exported, as_held, csv, xlsx};
pub use import::{Imported, import};
pub use read::Notation;
