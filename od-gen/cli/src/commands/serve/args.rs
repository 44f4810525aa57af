//! Arguments of `odgen serve`.

use std::path::PathBuf;

use clap::Args;

use crate::bus_nodes::NodesArgs;
use crate::messages::Messages;

#[derive(Debug, Args)]
pub(crate) struct ServeArgs {
    #[command(flatten)]
    pub nodes: NodesArgs,

    /// Where hosts find the bus, with the protocol of serial CAN adapters: `tcp:HOST:PORT` is listened to, and port 0 takes a free one; `pty`
    /// makes a serial port without wires and names it, `pty:LINK` with a link to it (Linux)
    #[arg(long, value_name = "PLACE", default_value = "tcp:127.0.0.1:3333")]
    pub slcan: String,

    /// In place of SLCAN: a CAN interface of Linux (SocketCAN), such as `vcan0`
    #[arg(long, value_name = "INTERFACE", conflicts_with = "slcan")]
    pub socketcan: Option<String>,

    /// What happens to the nodes: a file with a command on each line, or `-` to give them by standard input while it serves. `5 fault 0x8611`
    /// and `5 clear 0x8611` raise and clear an error of node 5, `5 set 6064.0=12.34°` sets a value as the device itself does,
    /// `5 ramp 6064.0=0.00°..90.00° in 10` lets it run for ten seconds, `5 triangle …` and `5 sine …` there and back until
    /// `5 stop 6064.0`, `wait 1.5` waits for seconds
    #[arg(long, value_name = "FILE")]
    pub script: Option<PathBuf>,

    /// Refuse values with which a constraint of the specification breaks, as a firmware does that gives its services `Consistent`
    #[arg(long)]
    pub consistent: bool,

    /// Print every frame on the bus in words, on standard error
    #[arg(long, conflicts_with = "watch")]
    pub log: bool,

    /// Show what the nodes have, live in the terminal: states, values in units, bits, errors
    #[arg(long)]
    pub watch: bool,

    #[command(flatten)]
    pub messages: Messages,
}
