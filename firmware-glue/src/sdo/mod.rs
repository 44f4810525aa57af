//! SDO: access to the dictionary of a node over the bus (CiA 301 7.2.4).
//!
//! Nothing here sends, waits or knows a clock: frames go in, frames come out, and the time is told. A time is a count of
//! microseconds in a `u32` that may begin anywhere and wraps around (after 71 minutes); only differences count.
//!
//! - [`SdoServer`] (feature `sdo-server`) serves any dictionary: expedited and segmented transfers, and with the feature
//!   `sdo-block` blocks with checksums.
//! - [`codec`] has the frames.

mod channel;
pub mod codec;

#[cfg(feature = "sdo-block")]
mod block;
#[cfg(feature = "sdo-block")]
mod crc;
#[cfg(feature = "sdo-server")]
mod download;
#[cfg(feature = "sdo-server")]
mod server;
#[cfg(feature = "sdo-server")]
mod upload;

pub use channel::Channel;
#[cfg(feature = "sdo-server")]
pub use server::SdoServer;

/// Microseconds without a frame of the other side, after which a transfer ends with
/// [`AbortCode::TIMEOUT`](crate::AbortCode::TIMEOUT), unless something else is asked for: a second.
pub const DEFAULT_TIMEOUT: u32 = 1_000_000;

/// Segments of a block, unless something else is asked for: the most that there can be.
#[cfg(feature = "sdo-block")]
pub const DEFAULT_BLOCK_SIZE: u8 = 127;
