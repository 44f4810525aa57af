//! CAN interfaces of Linux (SocketCAN): frames to and from the kernel.

use std::io;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ::socketcan::{
    CanDataFrame, CanFrame as Kernel, CanRemoteFrame, CanSocket, EmbeddedFrame as _, Frame as _, Socket as _,
    SocketOptions as _, StandardId,
};
use firmware_glue::frame::{CanId, Frame};

use crate::client::{Bus, BusError};
use crate::slcan::CanFrame;
use crate::trace::What;

/// A frame waits so long for room in the queue of the interface.
const PATIENCE: Duration = Duration::from_secs(1);
/// The system's number for a queue without room.
const NO_ROOM: i32 = 105;

/// A CAN interface. Its clones are the same one.
#[derive(Debug, Clone)]
pub struct Interface {
    socket: Arc<CanSocket>,
    start: Instant,
}

impl Interface {
    /// Opens an interface, such as `can0`. It has its bit rate from the system, and has to be up.
    ///
    /// # Errors
    /// There is no such interface.
    pub fn open(name: &str) -> io::Result<Self> {
        let socket = CanSocket::open(name)?;
        socket.set_write_timeout(PATIENCE)?;
        // Errors on the bus are reported, too, and not only frames.
        socket.set_error_filter_accept_all()?;
        Ok(Self { socket: Arc::new(socket), start: Instant::now() })
    }

    /// The next thing that is on the bus and is not from here; `None` when there is nothing for so long.
    ///
    /// # Errors
    /// The interface is down or gone.
    pub fn next(&self, within: Duration) -> io::Result<Option<What>> {
        match self.socket.read_frame_timeout(within) {
            Ok(frame) => Ok(Some(of_kernel(&frame))),
            Err(error) => match error.kind() {
                io::ErrorKind::TimedOut | io::ErrorKind::WouldBlock | io::ErrorKind::Interrupted => Ok(None),
                _ => Err(error),
            },
        }
    }

    /// Sends a frame.
    ///
    /// # Errors
    /// The interface is down or gone, or its queue has no room for a second: no node on the bus acknowledges.
    pub fn put(&self, frame: &Frame) -> io::Result<()> {
        let Some(frame) = to_kernel(frame) else { return Ok(()) };
        let until = Instant::now() + PATIENCE;
        loop {
            match self.socket.write_frame(&frame) {
                Err(error) if error.raw_os_error() == Some(NO_ROOM) && Instant::now() < until => {
                    std::thread::sleep(Duration::from_millis(1));
                }
                done => return done,
            }
        }
    }
}

impl Bus for Interface {
    fn send(&mut self, frame: &Frame) -> Result<(), BusError> {
        self.put(frame).map_err(BusError::Connection)
    }

    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        let until = Instant::now() + within;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            match self.next(left).map_err(BusError::Connection)? {
                Some(What::Frame(CanFrame::Standard(frame))) => return Ok(Some(frame)),
                Some(What::Frame(CanFrame::Extended { .. }) | What::Fd(_) | What::Error) => {}
                None if Instant::now() >= until => return Ok(None),
                None => {}
            }
        }
    }

    fn now(&self) -> u64 {
        u64::try_from(self.start.elapsed().as_micros()).unwrap_or(u64::MAX)
    }
}

/// A frame as the kernel has it; every frame of CANopen is one.
fn to_kernel(frame: &Frame) -> Option<Kernel> {
    let id = StandardId::new(frame.id().get())?;
    match frame.bytes() {
        Some(bytes) => CanDataFrame::new(id, bytes).map(Kernel::Data),
        None => CanRemoteFrame::new_remote(id, frame.length().into()).map(Kernel::Remote),
    }
}

/// What the kernel reports.
fn of_kernel(frame: &Kernel) -> What {
    let standard = |made: fn(CanId, &Kernel) -> Option<Frame>| {
        let id = u16::try_from(frame.raw_id()).ok().and_then(CanId::new).filter(|_| !frame.is_extended())?;
        made(id, frame).map(CanFrame::Standard)
    };
    let length = u8::try_from(frame.dlc()).unwrap_or(u8::MAX);
    let extended = || CanFrame::Extended { id: frame.raw_id(), length };
    match frame {
        Kernel::Error(_) => What::Error,
        Kernel::Data(_) => {
            What::Frame(standard(|id, frame| Frame::data(id, frame.data())).unwrap_or_else(extended))
        }
        Kernel::Remote(_) => {
            let remote = |id, frame: &Kernel| Frame::remote(id, u8::try_from(frame.dlc()).ok()?);
            What::Frame(standard(remote).unwrap_or_else(extended))
        }
    }
}

#[cfg(test)]
mod tests {
    use ::socketcan::{CanErrorFrame, ExtendedId};

    use super::*;

    fn id(id: u16) -> CanId {
        CanId::new(id).unwrap()
    }

    #[test]
    fn frames_of_canopen_go_to_the_kernel_and_back() {
        let frames = [
            Frame::data(id(0), &[1, 5]).unwrap(),
            Frame::data(id(0x080), &[]).unwrap(),
            Frame::data(id(0x7FF), &[1, 2, 3, 4, 5, 6, 7, 8]).unwrap(),
            Frame::remote(id(0x705), 1).unwrap(),
            Frame::remote(id(0x185), 8).unwrap(),
        ];
        for frame in frames {
            let kernel = to_kernel(&frame).unwrap();
            assert_eq!(kernel.raw_id(), u32::from(frame.id().get()));
            assert_eq!(kernel.is_remote_frame(), frame.bytes().is_none());
            assert_eq!(kernel.dlc(), usize::from(frame.length()));
            assert_eq!(of_kernel(&kernel), What::Frame(CanFrame::Standard(frame)));
        }
    }

    #[test]
    fn other_frames_are_reported_as_what_they_are() {
        let wide = ExtendedId::new(0x12345).unwrap();
        let data = CanDataFrame::new(wide, &[1, 2]).map(Kernel::Data).unwrap();
        assert_eq!(of_kernel(&data), What::Frame(CanFrame::Extended { id: 0x12345, length: 2 }));
        // A small number does not make it one of 11 bits.
        let small = CanRemoteFrame::new_remote(ExtendedId::new(5).unwrap(), 3).map(Kernel::Remote).unwrap();
        assert_eq!(of_kernel(&small), What::Frame(CanFrame::Extended { id: 5, length: 3 }));
        let error = CanErrorFrame::new_error(0x40, &[0; 8]).map(Kernel::Error).unwrap();
        assert_eq!(of_kernel(&error), What::Error);
    }

    #[test]
    fn an_interface_that_is_not_there_is_an_error() {
        assert!(Interface::open("no-such-bus").is_err());
    }
}
