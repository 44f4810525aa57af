//! SDO: access to the dictionary of a node over the bus (CiA 301 7.2.4).
//!
//! Nothing here sends, waits or knows a clock: frames go in, frames come out, and the time is given.
//!
//! - [`SdoServer`] serves any dictionary: expedited and segmented transfers, and with the feature
//!   `sdo-block` blocks with checksums.
//! - [`SdoClient`] reads and writes the dictionary of another node the same ways.
//! - [`codec`] has the frames.

#[cfg(feature = "sdo-block")]
mod block;
mod channel;
mod client;
pub mod codec;
#[cfg(feature = "sdo-block")]
mod crc;
mod piece;
mod server;

use crate::bus::clock::Duration;
pub use channel::Channel;
pub use client::{Failure, Filled, SdoClient, SdoRead, SdoWrite, Sink, Source, Step, Way};
pub use server::SdoServer;

/// Time without a frame of the other side, after which a transfer ends with
/// [`AbortCode::TIMEOUT`](crate::AbortCode::TIMEOUT), unless something else is asked for: a second.
pub const DEFAULT_TIMEOUT: Duration = Duration::from_millis(1000);

/// Segments of a block, unless something else is asked for: the most that there can be.
#[cfg(feature = "sdo-block")]
pub const DEFAULT_BLOCK_SIZE: u8 = 127;
