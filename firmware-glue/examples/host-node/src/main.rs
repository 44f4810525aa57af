//! A CANopen node on the host: the lamp of `lamp.od.yaml`, on a bus that any SLCAN client reaches by TCP.
//!
//! `cargo run` starts it. In another terminal, `odgen node read lamp.od.yaml brightness --node 5` reads an entry,
//! and `odgen node write lamp.od.yaml brightness=40 --node 5` writes one. An argument replaces the address.

mod slcan;

/// The dictionary that build.rs generated.
#[allow(missing_docs, unreachable_pub, dead_code, clippy::all, clippy::pedantic)]
mod lamp {
    include!(concat!(env!("OUT_DIR"), "/lamp.rs"));
}

use std::io::{self, Write as _};
use std::net::TcpListener;
use std::time::Duration;

use firmware_glue::clock::Instant;
use firmware_glue::lss::LssHandler;
use firmware_glue::node::{NodeHandler, Room, UpTo};
use firmware_glue::pdo::engine::PdoHandler;
use firmware_glue::{Application, Dictionary as _, Node, NodeId};

use lamp::{Entry, Lamp};
use slcan::Slcan;

const NODE_ID: u8 = 5;
/// The longest wait for a frame.
const LONGEST_WAIT: Duration = Duration::from_millis(100);

/// What the device does. Every hook has a default, so only those that this device uses are here.
struct Bulb;

impl Application<Lamp> for Bulb {
    /// A client wrote an entry. The dictionary has checked type, access and limits already.
    fn changed(&mut self, lamp: &mut Lamp, entry: Entry) {
        if entry == Entry::Brightness {
            print(&format!("brightness {} %", lamp.brightness().0));
        }
    }
}

impl PdoHandler<Lamp> for Bulb {}
impl LssHandler for Bulb {}
impl NodeHandler<Lamp> for Bulb {}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let address = std::env::args().nth(1).unwrap_or_else(|| "127.0.0.1:3333".to_owned());
    let listener = TcpListener::bind(address)?;
    print(&format!("node {NODE_ID} at tcp:{}", listener.local_addr()?));

    let mut lamp = Lamp::new(NODE_ID);
    let room = Room {
        tpdos: UpTo::<4>,
        rpdos: UpTo::<4>,
        errors: UpTo::<8>,
        watched: UpTo::<0>,
        sdo_buffer: [0; Lamp::LARGEST_VALUE],
    };
    let mut node = Node::new(lamp.table(), NodeId::new(NODE_ID), room)?;
    let mut bulb = Bulb;
    let start = std::time::Instant::now();
    let now = || Instant::from_micros(u64::try_from(start.elapsed().as_micros()).unwrap_or(u64::MAX));

    // One client at a time; the node keeps its state between them.
    for client in listener.incoming() {
        // A connection that breaks ends its client, and not the node.
        let Ok(mut bus) = client.and_then(|client| Slcan::new(client, LONGEST_WAIT)) else { continue };
        let mut step = || -> io::Result<()> {
            while let Some(frame) = node.poll(&mut lamp, &mut bulb, now()) {
                bus.send(&frame)?;
            }
            if let Some(frame) = bus.receive()?
                && let Some(answer) = node.handle(&frame, &mut lamp, &mut bulb, now())
            {
                bus.send(&answer)?;
            }
            Ok(())
        };
        while step().is_ok() {}
    }
    Ok(())
}

/// Prints a line at once, also into a pipe.
fn print(line: &str) {
    let mut out = io::stdout();
    let _ = writeln!(out, "{line}").and_then(|()| out.flush());
}
