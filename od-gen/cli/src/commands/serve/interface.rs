//! A CAN interface of Linux, to which the virtual nodes belong.

use std::io;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::time::Duration;

use firmware_glue::frame::Frame;
use od_bus::socketcan::Interface;

use super::event::Event;

/// So many frames wait for a bus that does not take them; the others are lost, as they are with a real controller.
const WAITING: usize = 1024;
const NAP: Duration = Duration::from_secs(1);

/// Where the frames of the nodes go.
pub(super) struct Outlet {
    frames: SyncSender<Frame>,
}

impl Outlet {
    /// Joins the bus: two threads, one for each direction.
    pub(super) fn open(name: &str, events: &SyncSender<Event>) -> io::Result<Self> {
        let interface = Interface::open(name)?;
        let (reading, hears) = (interface.clone(), events.clone());
        std::thread::spawn(move || {
            loop {
                let event = match reading.next(NAP) {
                    Ok(Some(what)) => Event::Seen(what),
                    Ok(None) => continue,
                    Err(error) => {
                        let _ = hears.send(Event::Broken(error));
                        return;
                    }
                };
                if hears.send(event).is_err() {
                    return;
                }
            }
        });
        let (frames, from) = sync_channel::<Frame>(WAITING);
        let events = events.clone();
        std::thread::spawn(move || {
            for frame in from {
                if let Err(error) = interface.put(&frame)
                    && events.send(Event::NotSent(error)).is_err()
                {
                    return;
                }
            }
        });
        Ok(Self { frames })
    }

    /// Sends a frame of a node.
    pub(super) fn put(&self, frame: &Frame) {
        match self.frames.try_send(*frame) {
            Ok(()) | Err(TrySendError::Full(_) | TrySendError::Disconnected(_)) => {}
        }
    }
}
