// Counts instructions by SysTick: with `-icount shift=0`, QEMU's clock goes by instructions.

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

/// Nanoseconds, and so instructions, in a tick of the board's 25 MHz.
const PER_TICK: u32 = 40;
const TIMES: u32 = 1000;

/// The timer, running.
pub(crate) fn timer() -> SYST {
    let mut timer = cortex_m::Peripherals::take().expect("the first time").SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(0x00FF_FFFF);
    timer.clear_current();
    timer.enable_counter();
    timer
}

/// Instructions of one of many calls, with those of the loop.
pub(crate) fn count(timer: &mut SYST, mut call: impl FnMut()) -> u32 {
    timer.clear_current();
    let before = SYST::get_current();
    for _ in 0..TIMES {
        call();
    }
    let ticks = before.wrapping_sub(SYST::get_current()) & 0x00FF_FFFF;
    ticks * PER_TICK / TIMES
}
