//! What happens while nodes are served.

use std::net::TcpStream;

#[cfg(target_os = "linux")]
use od_bus::trace::What;

/// What comes from outside.
pub(super) enum Event {
    /// A client has come.
    Came(TcpStream),
    /// A line of the host with this number; `None` where it was too long for one.
    Line(u64, Option<String>),
    /// The host with this number has gone.
    Gone(u64),
    /// Something on the CAN interface.
    #[cfg(target_os = "linux")]
    Seen(What),
    /// The CAN interface does not send.
    #[cfg(target_os = "linux")]
    NotSent(std::io::Error),
    /// The CAN interface is gone.
    #[cfg(target_os = "linux")]
    Broken(std::io::Error),
    /// A line of a script on standard input.
    Said(String),
    /// A key, while the display is shown.
    Key(ratatui::crossterm::event::KeyEvent),
}

/// Who sent a frame, and does not hear it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sender {
    Node,
    Host(u64),
    #[cfg(target_os = "linux")]
    Interface,
}
