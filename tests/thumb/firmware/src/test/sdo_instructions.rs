//! How many instructions the SDO server takes for a request, by SysTick: with `-icount shift=0`, QEMU's clock goes by instructions.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use firmware_glue::Dictionary;
use firmware_glue::frame::{CanId, Frame};
use firmware_glue::sdo::{Channel, SdoServer};
use od_generated::pmc::Pmc;
use panic_semihosting as _;

/// Nanoseconds, and so instructions, in a tick of the board's 25 MHz.
const PER_TICK: u32 = 40;
const TIMES: u32 = 1000;
/// No request may take more.
const MOST: u32 = 330;

/// Instructions of one of many calls, with those of the loop.
fn count(timer: &mut SYST, mut call: impl FnMut()) -> u32 {
    timer.clear_current();
    let before = SYST::get_current();
    for _ in 0..TIMES {
        call();
    }
    let ticks = before.wrapping_sub(SYST::get_current()) & 0x00FF_FFFF;
    ticks * PER_TICK / TIMES
}

#[entry]
fn main() -> ! {
    static mut DICTIONARY: Pmc = Pmc::new(1);
    let mut timer = cortex_m::Peripherals::take().expect("the first time").SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(0x00FF_FFFF);
    timer.clear_current();
    timer.enable_counter();
    let mut server =
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
        ("reads 1000h, 4 bytes", [0x40, 0x00, 0x10, 0, 0, 0, 0, 0], 0x43),
        ("reads 6041h, 2 bytes", [0x40, 0x41, 0x60, 0, 0, 0, 0, 0], 0x4B),
        ("reads 1018h.1, 4 bytes", [0x40, 0x18, 0x10, 1, 0, 0, 0, 0], 0x43),
        ("reads 5FFFh, which is not there", [0x40, 0xFF, 0x5F, 0, 0, 0, 0, 0], 0x80),
        ("writes 6040h, 2 bytes", [0x2B, 0x40, 0x60, 0, 6, 0, 0, 0], 0x60),
    ];
    let mut within = true;
    for (what, bytes, expected) in requests {
        let frame = Frame::full(CanId::MAX, bytes);
        let mut command = None;
        let taken = count(&mut timer, || {
            let answer = black_box(server.handle(black_box(&frame), DICTIONARY, &mut (), 0));
            command = answer.and_then(|answer| answer.bytes()?.first().copied());
        });
        hprintln!("{} instructions: {}", taken - empty, what);
        within &= taken - empty < MOST && taken > empty && command == Some(expected);
    }
    debug::exit(if within { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
    unreachable!("QEMU ends at the line before")
}
