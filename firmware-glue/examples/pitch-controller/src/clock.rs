//! The time: milliseconds since power-on, counted by the interrupt of SysTick.

use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;
use firmware_glue::clock::Instant;

/// Ticks of the core's clock in a millisecond: 25 MHz.
const TICKS: u32 = 25_000;

/// Milliseconds; begins anew after 49 days.
static MILLIS: AtomicU32 = AtomicU32::new(0);

/// A clock that never begins anew, as long as it is asked every 49 days.
#[derive(Debug)]
pub struct Clock {
    seen: u32,
    millis: u64,
}

impl Clock {
    /// Starts the clock.
    pub fn start(mut timer: SYST) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(TICKS.saturating_sub(1));
        timer.clear_current();
        timer.enable_interrupt();
        timer.enable_counter();
        Self { seen: 0, millis: 0 }
    }

    /// The time now.
    pub fn now(&mut self) -> Instant {
        let counted = MILLIS.load(Ordering::Relaxed);
        self.millis = self.millis.saturating_add(counted.wrapping_sub(self.seen).into());
        self.seen = counted;
        Instant::from_millis(self.millis)
    }
}

#[exception]
fn SysTick() {
    // No other code writes it, so that no count is lost between the two accesses.
    MILLIS.store(MILLIS.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
}
