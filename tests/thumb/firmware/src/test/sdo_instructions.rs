//! How many instructions the SDO server takes for a request, by SysTick: with `-icount shift=0`, QEMU's clock goes by instructions.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use firmware_glue::Dictionary;
use firmware_glue::clock::Instant;
use firmware_glue::frame::{CanId, Frame};
use firmware_glue::sdo::{Channel, SdoServer};
use od_generated::pmc::Pmc;
use panic_semihosting as _;

#[path = "../shared/instructions.rs"]
mod instructions;

use instructions::{count, timer};

/// A read may not take as many: fewer than the best stack that was measured (149, of a server that refuses).
const READ: u32 = 150;
/// Neither may what has more to do.
const REFUSED: u32 = 230;
const WRITE: u32 = 200;

type Server = SdoServer<[u8; Pmc::LARGEST_VALUE]>;

/// What a firmware does with a frame: a function of its own, so that what is called from here is not woven into the loop.
#[inline(never)]
fn turn(server: &mut Server, frame: &Frame, dictionary: &mut Pmc) -> Option<Frame> {
    server.handle(frame, dictionary, &mut (), Instant::ZERO)
}

#[entry]
fn main() -> ! {
    static mut DICTIONARY: Pmc = Pmc::new(1);
    let mut timer = timer();
    let mut server: Server =
        SdoServer::new(Channel { request: CanId::MAX, answer: CanId::MAX }, [0; Pmc::LARGEST_VALUE]);
    // The loop alone: a frame goes in and nothing is done with it.
    let nothing = Frame::full(CanId::MAX, [0; 8]);
    let empty = count(&mut timer, || {
        black_box(black_box(&nothing));
    });
    let own = count(&mut timer, || {
        let (index, sub) = black_box((0x1000, 0));
        black_box(DICTIONARY.upload(index, sub, &mut ()).map_or(0, |value| value.len()));
    });
    hprintln!("{} instructions: the dictionary alone, for 1000h", own - empty);
    let requests = [
        ("reads 1000h, 4 bytes", [0x40, 0x00, 0x10, 0, 0, 0, 0, 0], 0x43, READ),
        ("reads 6041h, 2 bytes", [0x40, 0x41, 0x60, 0, 0, 0, 0, 0], 0x4B, READ),
        ("reads 1018h.1, 4 bytes", [0x40, 0x18, 0x10, 1, 0, 0, 0, 0], 0x43, READ),
        ("reads 1018h.0, a constant", [0x40, 0x18, 0x10, 0, 0, 0, 0, 0], 0x4F, READ),
        ("reads 5FFFh, which is not there", [0x40, 0xFF, 0x5F, 0, 0, 0, 0, 0], 0x80, REFUSED),
        ("writes 6040h, 2 bytes", [0x2B, 0x40, 0x60, 0, 6, 0, 0, 0], 0x60, WRITE),
    ];
    let mut within = true;
    for (what, bytes, expected, most) in requests {
        let frame = Frame::full(CanId::MAX, bytes);
        let mut answer = None;
        let taken = count(&mut timer, || answer = turn(&mut server, black_box(&frame), DICTIONARY));
        let command = answer.and_then(|answer| answer.bytes()?.first().copied());
        hprintln!("{} instructions: {}", taken - empty, what);
        within &= taken - empty < most && taken > empty && command == Some(expected);
    }
    debug::exit(if within { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
    unreachable!("QEMU ends at the line before")
}
