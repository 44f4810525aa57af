//! What generated CANopen object dictionaries call at run time.
//!
//! A generated dictionary is a byte image with typed accessors, and a constant table in flash that says what every byte is
//! ([`Table`]). This crate does the rest, for every dictionary with the same code: lookup, reading, checked writing with the
//! abort codes of CiA 301 ([`Dictionary`]), the application's hooks ([`Application`]), aliases ([`View`]), PDO mapping
//! ([`pdo`]), parameter storage, conditions between entries ([`Constrained`]), physical units ([`Quantity`]).
//!
//! An SDO server needs five functions: [`Dictionary::upload`] and [`Dictionary::write`] for values,
//! [`Dictionary::upload_domain`] and [`Dictionary::download_domain`] for DOMAINs, and [`Dictionary::info`] to tell them apart.
//! A PDO handler needs [`pdo::pack`] and [`pdo::unpack`]. All of a node, and each of its services by itself, is here, too, behind
//! features: a firmware that has a stack of its own needs none of it.
//!
//! `no_std`, no allocation, no `unsafe`; no function panics on any input, but for `Shared::with` called from inside itself.
//! There is no hidden state: a dictionary is a plain
//! value, and a program can have several.
//!
//! # Features
//!
//! - `defmt`: `defmt::Format` for codes, events, states, frames and values, also in generated code; not for tables and for the services themselves
//! - `critical-section`: `Shared`, a dictionary behind short critical sections
//! - `embedded-can`: `Frame::of_driver` and `Frame::for_driver`, for the frames of CAN drivers
//! - `sdo-server`, `sdo-client`: the two ends of an SDO channel, in the module `sdo`; with `sdo-block`, also block transfers
//! - `node`: the services of a CANopen node besides SDO (`nmt`, `pdo_engine`, `sync`, `emcy`, `lss`), and all together (`Node`); frames in, frames out,
//!   time passed in
//! - `storage`: `storage`, parameters in flash that survive a power failure at any byte

#![no_std]
#![warn(clippy::missing_errors_doc)]

mod abort;
mod alias;
mod application;
mod before;
mod check;
mod checked;
pub mod clock;
mod cob_id;
mod communication;
mod constraint;
mod corrected;
mod data_type;
mod dictionary;
mod directory;
#[cfg(feature = "embedded-can")]
mod driver;
mod effect;
#[cfg(feature = "node")]
pub mod emcy;
mod entries;
pub mod error_register;
mod fault;
mod flags;
pub mod frame;
#[doc(hidden)]
pub mod generated_for_layout_2;
mod id;
pub mod image;
mod info;
#[cfg(feature = "node")]
pub mod lss;
mod mapping;
pub mod named;
#[cfg(feature = "node")]
pub mod nmt;
#[cfg(feature = "node")]
pub mod node;
mod node_id;
mod number;
pub mod parameter_groups;
#[cfg(feature = "node")]
mod parameters;
pub mod pdo;
#[cfg(feature = "node")]
pub mod pdo_engine;
mod pdo_parameters;
pub mod quantity;
mod rows;
#[cfg(any(feature = "sdo-server", feature = "sdo-client"))]
pub mod sdo;
#[cfg(feature = "critical-section")]
mod shared;
mod special;
mod stand_in;
pub mod state_machine;
#[cfg(feature = "storage")]
pub mod storage;
mod stored;
#[cfg(feature = "node")]
pub mod sync;
pub mod table;
mod table_dictionary;
#[cfg(all(test, feature = "node"))]
mod test_table;
pub mod text;
mod time;
mod value;

pub use abort::AbortCode;
pub use alias::{Outside, Rounding, View};
pub use application::Application;
pub use constraint::{Consistent, Constrained, Constraint, unpack_consistent};
pub use data_type::DataType;
#[cfg(feature = "defmt")]
pub use defmt;
pub use dictionary::{Dictionary, OtherLayout};
pub use entries::Entries;
pub use fault::{Fault, TableError};
pub use id::EntryId;
pub use image::{
    OutOfRange, get_bool, get_f32, get_f64, get_i8, get_i16, get_i32, get_i64, get_time, get_u8, get_u16,
    get_u32, get_u64, narrow, put_bool, put_f32, put_f64, put_i8, put_i16, put_i32, put_i64, put_time,
    put_u8, put_u16, put_u32, put_u64,
};
pub use info::Info;
pub use named::{BitField, Enumeration, UnknownValue};
#[cfg(feature = "node")]
pub use node::Node;
pub use node_id::NodeId;
pub use quantity::Quantity;
#[cfg(feature = "critical-section")]
pub use shared::Shared;
pub use special::Special;
pub use state_machine::StateMachine;
pub use table::{Storage, Table};
pub use table_dictionary::{TableDictionary, WrongSize};
pub use text::{NoFit, Utf16};
pub use time::Time;
pub use value::Value;

/// What the README shows compiles.
#[cfg(all(doctest, feature = "node"))]
#[doc = include_str!("../README.md")]
struct Readme;
