//! Parameters that outlive a power failure: the commands of a client (1010h, 1011h) and, with the feature `storage`, a store
//! in flash (`ParameterStore`).

#[cfg(feature = "storage")]
mod flash;

pub use crate::access::command::{ALL, Command};
#[cfg(feature = "storage")]
pub use flash::{BadArea, Copies, Loaded, Outcome, ParameterStore, StoreError};
