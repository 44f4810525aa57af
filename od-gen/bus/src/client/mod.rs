//! A client of the nodes on a bus: reads and writes their entries by SDO, and commands them by NMT.
//!
//! A [`Bus`] is whatever takes frames and gives them, a clock included; [`SlcanBus`] is one reached through a CAN
//! adapter that is reached by a stream of bytes. [`Client`] does one access after the other, [`involved`] and [`plan`]
//! list what is to be read and written.

mod access;
mod link;
mod port;
mod probe;
mod recognize;
mod restore;
mod scan;
#[cfg(not(target_family = "wasm"))]
mod serial;
#[cfg(test)]
mod tests;

use std::fmt;
use std::time::Duration;

use firmware_glue::frame::Frame;

pub use self::access::{AccessError, Client};
pub use self::link::{OpenError, SlcanBus};
pub use self::port::{Manner, Port};
pub use self::probe::{Found, Holds, Prober};
pub use self::recognize::{Contradiction, Fact, Remark, Revision, introduced, recognize};
pub use self::restore::{involved, judged, kept, plan, value};
pub use self::scan::{Answer, Heard, Identity, scan};
#[cfg(not(target_family = "wasm"))]
pub use self::serial::Serial;
pub use crate::restarts::Restart;

/// Where frames go and come from, and what time it is there.
pub trait Bus {
    /// Sends a frame.
    ///
    /// # Errors
    /// [`BusError`]: it cannot be sent.
    fn send(&mut self, frame: &Frame) -> Result<(), BusError>;

    /// The next frame that others sent; `None` when there is none for so long.
    ///
    /// # Errors
    /// [`BusError`]: no more frames will come.
    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError>;

    /// Microseconds from any beginning.
    fn now(&self) -> u64;
}

impl<B: Bus + ?Sized> Bus for &mut B {
    fn send(&mut self, frame: &Frame) -> Result<(), BusError> {
        (**self).send(frame)
    }

    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        (**self).receive(within)
    }

    fn now(&self) -> u64 {
        (**self).now()
    }
}

impl<B: Bus + ?Sized> Bus for Box<B> {
    fn send(&mut self, frame: &Frame) -> Result<(), BusError> {
        (**self).send(frame)
    }

    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        (**self).receive(within)
    }

    fn now(&self) -> u64 {
        (**self).now()
    }
}

/// Why nothing goes over the bus.
#[derive(Debug)]
#[non_exhaustive]
pub enum BusError {
    /// The connection to the adapter broke.
    Connection(std::io::Error),
    /// The adapter ended the connection.
    Closed,
    /// The adapter refused to send a frame.
    Refused,
}

impl fmt::Display for BusError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Connection(error) => write!(f, "the connection to the adapter broke: {error}"),
            Self::Closed => f.write_str("the adapter ended the connection"),
            Self::Refused => f.write_str("the adapter does not send: it refused a frame"),
        }
    }
}

impl std::error::Error for BusError {}
