//! Shows that a firmware starts, that initialised data is in place, and that its output and verdict arrive.
#![no_std]
#![no_main]

use core::hint::black_box;
use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use panic_semihosting as _;

static INITIALISED: AtomicU32 = AtomicU32::new(0x1234_5678);

#[entry]
fn main() -> ! {
    let value = black_box(&INITIALISED).load(Ordering::Relaxed);
    assert_eq!(value, 0x1234_5678, "the start-up code copies .data");
    hprintln!("hello from thumbv7em");
    debug::exit(debug::EXIT_SUCCESS);
    unreachable!("QEMU ends at the line before")
}
