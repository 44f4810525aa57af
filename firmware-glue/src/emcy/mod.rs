//! Errors of a device: the error register (1001h) and, with the feature `node`, emergencies.

pub mod error_register;
#[cfg(feature = "node")]
mod producer;

pub use error_register::{DeviceError, ErrorRegister};
#[cfg(feature = "node")]
pub use producer::{Emergency, EmergencyProducer, Raised, heard};
