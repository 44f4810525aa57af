//! The run-time part of generated CANopen object dictionaries: `no_std`, no allocation, no `unsafe` code.
//!
//! A generated dictionary is a byte image with typed accessors, and a constant [`Table`] in flash that describes every
//! byte. The crate `od-gen` generates it from a specification, in a build script or with the command `odgen`. This crate
//! does the rest, with the same code for every dictionary.
//!
//! | to | use |
//! |---|---|
//! | run a whole CANopen node | [`Node`] |
//! | read and write entries with the checks and abort codes of CiA 301 | [`Dictionary`] |
//! | react to accesses from the bus | [`Application`] |
//! | run one service without a node | [`sdo`], [`pdo::engine`], [`nmt`], [`sync`], [`emcy`], [`lss`] |
//! | keep parameters in flash | [`storage`] |
//! | run the state machines of a specification | [`StateMachine`] |
//! | add a dictionary to another stack | [`Dictionary::upload`], [`Dictionary::write`], [`pdo::pack`], [`pdo::unpack`] |
//!
//! # A node on a bus in memory
//!
//! Nothing here has a driver or a clock: frames go in, frames come out, and the caller passes the time. The same code
//! therefore runs on a board, in a test and on a host. The folder `examples/host-node` of the repository has a complete
//! program with a generated dictionary, `examples/pitch-controller` a firmware for a Cortex-M4.
//!
//! ```
//! use std::collections::VecDeque;
//!
//! use firmware_glue::clock::Instant;
//! use firmware_glue::frame::Frame;
//! use firmware_glue::node::{Room, UpTo};
//! use firmware_glue::sdo::{Channel, Filled, SdoClient};
//! use firmware_glue::table::{Attributes, Block, Directory, EntryRow, Flags, NONE, Parts, Place};
//! use firmware_glue::{DataType, EntryId, Node, NodeId, Storage, Table, TableDictionary};
//!
//! // 2000h "brightness": UNSIGNED8, rw, default 80. The generator writes such a table from a specification.
//! const BRIGHTNESS: Attributes = Attributes {
//!     data_type: DataType::Unsigned8,
//!     flags: Flags::READ.with(Flags::WRITE),
//!     place: Place::Image,
//!     storage: Storage::No,
//!     page: 0,
//!     size: 1,
//!     limits: NONE,
//!     values: NONE,
//!     condition: NONE,
//! };
//! let (mut blocks, mut seeds, mut order) = ([Block::FREE; 1], [0; 1], [0; 1]);
//! let directory = Directory::arrange(&[0x2000], &mut blocks, &mut seeds, &mut order);
//! let table = Table::checked(Parts {
//!     directory: directory.ok_or("there is a block for each object")?,
//!     objects: &[0, 1],
//!     entries: &[EntryRow { attributes: 0, place: 0 }],
//!     attributes: &[BRIGHTNESS],
//!     factory: &[80],
//!     ..Parts::EMPTY
//! })?;
//! let id = NodeId::new(5).ok_or("a node-ID is 1 to 127")?;
//! let mut lamp = TableDictionary::new(&table, [0; 1], id.get())?;
//!
//! let room =
//!     Room { tpdos: UpTo::<4>, rpdos: UpTo::<4>, errors: UpTo::<8>, watched: UpTo::<0>, sdo_buffer: [0; 8] };
//! let mut node = Node::new(&table, Some(id), room)?;
//! // The application. `()` accepts every value that the dictionary allows.
//! let application = &mut ();
//!
//! // The node starts and sends its boot-up message.
//! let now = Instant::ZERO;
//! let boot_up = node.poll(&mut lamp, application, now).ok_or("it sends a frame")?;
//! assert_eq!((boot_up.id().get(), boot_up.bytes()), (0x705, Some(&[0][..])));
//!
//! // An SDO client reads 2000h. Every frame on the bus reaches both.
//! let (mut buffer, brightness) = ([0; 8], EntryId { index: 0x2000, sub: 0 });
//! let client = SdoClient::new(Channel::predefined(id));
//! let (mut reading, request) = client.start_read(brightness, Filled::new(&mut buffer), now);
//! let mut bus: VecDeque<Frame> = VecDeque::from([request]);
//! while let Some(frame) = bus.pop_front() {
//!     bus.extend(node.handle(&frame, &mut lamp, application, now));
//!     bus.extend(reading.handle(&frame, now).send);
//! }
//! assert_eq!(reading.sink().bytes(), [80]);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # Guarantees
//!
//! No function panics on any input, except `Shared::with` when it is called from inside itself. There is no hidden
//! state: a dictionary is a plain value, and a program can have several. A firmware links only the services that it
//! calls.
//!
//! # Features
//!
//! None is on by default, and generated code needs none.
//!
//! - `defmt`: `defmt::Format` for codes, events, states, frames and values, also in generated code
//! - `critical-section`: `Shared`, a dictionary that interrupts and threads share
//! - `embedded-can`: `Frame::of_driver` and `Frame::for_driver`, for the frames of CAN drivers
//! - `sdo-block`: block transfers of the SDO server and client
//! - `storage`: `storage::ParameterStore`, parameters in flash that survive a power failure at any byte
//!
//! # Layers
//!
//! Each folder of the source uses only those before it: `abort`, `bus` (frames, node-IDs, time) and `value` (data types
//! and values), `table` (what entries are, and where their values are), `access` (dictionary, checks, application), one
//! for each service, `node`, which joins the services.

#![cfg_attr(docsrs, feature(doc_cfg))]
#![no_std]
#![warn(clippy::missing_errors_doc)]

mod abort;
mod access;
mod bus;
pub mod emcy;
#[doc(hidden)]
pub mod generated_for_layout_1;
mod late;
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
pub use late::Late;
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

/// What the README shows compiles, with the features that it needs.
#[cfg(all(doctest, feature = "embedded-can", feature = "storage"))]
#[doc = include_str!("../README.md")]
struct Readme;
