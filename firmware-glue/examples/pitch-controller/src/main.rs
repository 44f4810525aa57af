//! A pitch controller for the Cortex-M4 of the board mps2-an386, as QEMU emulates it: a whole CANopen node with the dictionary of the
//! PMC, and the template of a firmware of your own.
//!
//! `main` wires the parts together, `run` is the whole firmware and knows CAN drivers by `embedded_can` alone. What the device does is in
//! `application`. `slcan` and `uart` are there because the board has no CAN, `flash` because the emulator forgets: on a board, drivers
//! take the place of all three.
#![no_std]
#![no_main]

mod application;
mod clock;
mod flash;
#[cfg(feature = "names")]
mod names;
mod slcan;
mod uart;

/// The dictionary, as build.rs has made it.
#[allow(missing_docs, clippy::all, clippy::pedantic, clippy::restriction, dead_code)]
mod pmc {
    include!(concat!(env!("OUT_DIR"), "/pmc.rs"));
}

use cortex_m_rt::entry;
use embedded_can::nb::Can;
use firmware_glue::frame::Frame;
use firmware_glue::node::{Room, UpTo};
use firmware_glue::{Dictionary, Node, NodeId};
use panic_halt as _;

use application::{Drive, Report, Store};
use clock::Clock;
use flash::RamFlash;
use pmc::{Entry, Pmc};
use slcan::Slcan;
use uart::Uart;

/// A board reads it from its switches.
const NODE_ID: u8 = 5;

#[entry]
fn main() -> ! {
    // `entry` hands it out as `&'static mut`.
    static mut FLASH: [u8; flash::SIZE] = [0; flash::SIZE];

    // It is there once, and the slots fit: a board that finds it otherwise stays silent, and its watchdog ends that.
    if let Some(core) = cortex_m::Peripherals::take()
        && let Ok(store) = Store::new(RamFlash::new(FLASH), 0, flash::SLOT)
    {
        run(Slcan::new(Uart::Frames.open()), Clock::start(core.SYST), Drive::new(store));
    }
    loop {
        cortex_m::asm::wfi();
    }
}

/// The node, with any CAN driver. It comes back only if the dictionary has more PDOs than the node has room for.
fn run<C: Can>(mut can: C, mut clock: Clock, mut drive: Drive<'_>) {
    let mut od = Pmc::new(NODE_ID);
    let room = Room {
        tpdos: UpTo::<4>,
        rpdos: UpTo::<4>,
        errors: UpTo::<16>,
        watched: UpTo::<0>,
        sdo_buffer: [0; Pmc::LARGEST_VALUE],
    };
    let Ok(mut node) = Node::new(od.table(), NodeId::new(NODE_ID), room) else { return };
    // A frame that the driver has not taken yet.
    let mut waiting: Option<Frame> = None;
    let mut shown = (od.statusword(), od.position_actual_value());
    loop {
        let now = clock.now();
        drive.step(&mut od, now);
        match drive.supervise(&mut od, now) {
            Some(Report::Raised(emergency)) => drop(node.raise(&mut od, emergency)),
            Some(Report::Cleared(code)) => drop(node.clear(&mut od, code)),
            None => {}
        }

        // What has changed is an event of the TPDOs that carry it.
        let shows = (od.statusword(), od.position_actual_value());
        if shows.0 != shown.0 {
            node.trigger_entry(&od, Entry::Statusword, now);
        }
        if shows.1 != shown.1 {
            node.trigger_entry(&od, Entry::PositionActualValue, now);
        }
        shown = shows;

        // `&mut Consistent(&mut drive)` in the place of `&mut drive` would refuse what breaks a condition between entries.
        while let Some(frame) = waiting.take().or_else(|| node.poll(&mut od, &mut drive, now)) {
            let Some(message) = frame.for_driver() else { continue };
            match can.transmit(&message) {
                // A driver may give back another frame that has to wait.
                Ok(displaced) => waiting = displaced.and_then(|frame| Frame::of_driver(&frame)),
                Err(nb::Error::WouldBlock) => {
                    waiting = Some(frame);
                    break;
                }
                Err(nb::Error::Other(_)) => node.communication_error(&mut od, &mut drive, now),
            }
        }
        // One answer has to be away before the next request is taken.
        if waiting.is_some() {
            continue;
        }
        match can.receive() {
            Ok(message) => {
                let frame = Frame::of_driver(&message);
                waiting = frame.and_then(|frame| node.handle(&frame, &mut od, &mut drive, now));
            }
            // A frame or the next millisecond ends the wait.
            Err(nb::Error::WouldBlock) => cortex_m::asm::wfi(),
            Err(nb::Error::Other(_)) => node.communication_error(&mut od, &mut drive, now),
        }
    }
}
