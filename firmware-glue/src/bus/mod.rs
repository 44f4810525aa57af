//! What every service takes and gives: CAN frames, node-IDs and the time.

pub mod clock;
#[cfg(feature = "embedded-can")]
mod driver;
pub mod frame;
pub(crate) mod node_id;
