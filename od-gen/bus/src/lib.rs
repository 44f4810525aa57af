//! Nodes on a bus: dictionaries that are served without being compiled, a client for the nodes of others, and the frames of a
//! bus in words.

pub mod client;
pub mod monitor;
pub mod program;
mod restarts;
pub mod runtime;
pub mod slcan;
#[cfg(target_os = "linux")]
pub mod socketcan;
pub mod trace;
