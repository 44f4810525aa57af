//! Streams of bytes to a CAN adapter.

use std::fmt;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::Duration;

/// A stream of bytes to and from an adapter.
pub trait Port: Read + Write + fmt::Debug {
    /// Makes it ready: a write does not wait for ever, and nothing waits to be sent with what comes later.
    ///
    /// # Errors
    /// The system does not do that.
    fn prepare(&mut self, patience: Duration) -> io::Result<()>;

    /// From now on a read waits so long at most; afterwards it fails as timed out.
    ///
    /// # Errors
    /// The system does not do that.
    fn wait_at_most(&mut self, time: Duration) -> io::Result<()>;

    /// Nothing more is written, and all that was arrives.
    ///
    /// # Errors
    /// The stream is broken.
    fn finish(&mut self) -> io::Result<()>;

    /// Whether what is there answers commands.
    fn manner(&self) -> Manner;
}

/// What the adapter at the end of a stream does with commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Manner {
    /// It answers each: a device that does not is not an adapter.
    Answers,
    /// It may carry them out in silence, as the firmware of some serial adapters does.
    MayBeSilent,
}

impl Port for TcpStream {
    fn prepare(&mut self, patience: Duration) -> io::Result<()> {
        self.set_nodelay(true)?;
        self.set_write_timeout(Some(patience))
    }

    fn wait_at_most(&mut self, time: Duration) -> io::Result<()> {
        self.set_read_timeout(Some(time))
    }

    fn finish(&mut self) -> io::Result<()> {
        self.shutdown(Shutdown::Write)
    }

    fn manner(&self) -> Manner {
        Manner::Answers
    }
}

impl<P: Port + ?Sized> Port for Box<P> {
    fn prepare(&mut self, patience: Duration) -> io::Result<()> {
        (**self).prepare(patience)
    }

    fn wait_at_most(&mut self, time: Duration) -> io::Result<()> {
        (**self).wait_at_most(time)
    }

    fn finish(&mut self) -> io::Result<()> {
        (**self).finish()
    }

    fn manner(&self) -> Manner {
        (**self).manner()
    }
}
