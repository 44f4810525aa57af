//! The SDO server of the PMC, with segments and blocks: frames come from outside, and what it answers leaves it.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use firmware_glue::clock::Instant;
use firmware_glue::frame::{CanId, Frame};
use firmware_glue::sdo::{Channel, SdoServer};
use od_generated::pmc::Pmc;
use panic_halt as _;

#[entry]
fn main() -> ! {
    // `entry` hands them out as `&'static mut`.
    static mut DICTIONARY: Pmc = Pmc::new(1);
    static mut SERVER: SdoServer<[u8; Pmc::LARGEST_VALUE]> =
        SdoServer::new(Channel { request: CanId::MAX, answer: CanId::MAX }, [0; Pmc::LARGEST_VALUE]);
    let frame = Frame::full(CanId::MAX, [0; 8]);
    loop {
        black_box(SERVER.handle(black_box(&frame), DICTIONARY, &mut (), black_box(Instant::ZERO)));
        black_box(SERVER.poll(DICTIONARY, &mut (), black_box(Instant::ZERO)));
    }
}
