//! Errors of a device: the error register (1001h) and emergencies.

pub mod error_register;
mod producer;

pub use error_register::{DeviceError, ErrorRegister};
pub use producer::{Emergency, EmergencyProducer, Raised, heard};
