//! What generated CANopen object dictionaries call at run time.
//!
//! A generated dictionary is a byte image with typed accessors, and a constant table in flash that says what every byte is
//! ([`Table`]). This crate does the rest, for every dictionary with the same code: lookup, reading, checked writing with the
//! abort codes of CiA 301 ([`Dictionary`]), the application's hooks ([`Application`]), aliases ([`View`]), PDO mapping
//! ([`pdo`]), parameter storage, conditions between entries ([`Constrained`]), physical units ([`Quantity`]).
//!
//! An SDO server needs five functions: [`Dictionary::upload`] and [`Dictionary::write`] for values,
//! [`Dictionary::upload_domain`] and [`Dictionary::download_domain`] for DOMAINs, and [`Dictionary::info`] to
//! distinguish them. A PDO handler needs [`pdo::pack`] and [`pdo::unpack`]. A firmware with a stack of its own needs
//! nothing else.
//!
//! The services of a node are types of their own ([`sdo`], [`pdo::engine`], [`nmt`], [`sync`], [`emcy`], [`lss`]), and [`Node`] joins
//! them: frames go in, frames come out, and the time is passed in. A firmware links what it calls.
//!
//! `no_std`, no allocation, no `unsafe`; no function panics on any input, except `Shared::with` called from inside itself.
//! There is no hidden state: a dictionary is a plain value, and a program can have several.
//!
//! # Layers
//!
//! Each folder uses only those before it: `abort`, `bus` (frames, node-IDs, time) and `value` (data types and what they hold),
//! `table` (what entries are, and where their values lie), `access` (dictionary, checks, application), one for each service,
//! `node`, which joins the services.
//!
//! # Features
//!
//! - `defmt`: `defmt::Format` for codes, events, states, frames and values, also in generated code; not for tables and for the services themselves
//! - `critical-section`: `Shared`, a dictionary inside short critical sections
//! - `embedded-can`: `Frame::of_driver` and `Frame::for_driver`, for the frames of CAN drivers
//! - `sdo-block`: block transfers of the SDO server and client
//! - `storage`: `storage::ParameterStore`, parameters in flash that survive a power failure at any byte

#![no_std]
#![warn(clippy::missing_errors_doc)]

mod abort;
mod access;
mod bus;
pub mod emcy;
#[doc(hidden)]
pub mod generated_for_layout_1;
pub mod lss;
pub mod nmt;
pub mod node;
pub mod pdo;
pub mod sdo;
pub mod state_machine;
pub mod storage;
pub mod sync;
pub mod table;
mod value;

pub use abort::AbortCode;
pub use access::application::{Application, Entries};
pub use access::constraint::{Consistent, Constrained, Constraint};
pub use access::dictionary::{Dictionary, OtherLayout};
#[cfg(feature = "critical-section")]
pub use access::shared::Shared;
pub use access::table_dictionary::{TableDictionary, WrongSize};
pub use bus::node_id::NodeId;
pub use bus::{clock, frame};
#[cfg(feature = "defmt")]
pub use defmt;
pub use emcy::error_register;
pub use node::Node;
pub use state_machine::StateMachine;
pub use table::entry::{EntryId, Info};
pub use table::view::{Outside, Rounding, View};
pub use table::{Fault, Storage, Table, TableError};
pub use value::Value;
pub use value::data_type::DataType;
pub use value::image::OutOfRange;
pub use value::named::{BitField, Enumeration, UnknownValue};
pub use value::quantity::Quantity;
pub use value::special::Special;
pub use value::text::{NoFit, Utf16};
pub use value::time::Time;
pub use value::{image, named, quantity, text};

/// What the README shows compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
