//! What a firmware costs that does nothing: vector table, start-up code, an empty loop.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use panic_halt as _;

#[entry]
fn main() -> ! {
    loop {
        black_box(0_u32);
    }
}
