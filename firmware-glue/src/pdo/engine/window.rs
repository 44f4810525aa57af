//! The synchronous window (CiA 301 9.6.3, 1007h): how long after a SYNC its PDOs may come.

use crate::access::dictionary::Dictionary;
use crate::access::parameters::Parameters;
use crate::bus::clock::{Duration, Instant};

/// A point in time, and where it lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment {
    pub now: Instant,
    pub window: Window,
}

/// Whether synchronous PDOs may be sent and taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Window {
    Open,
    /// Too late: they wait for the next SYNC.
    Closed,
}

impl Moment {
    /// A moment after a SYNC; before the first one, and without a length, every moment is in time.
    pub(super) fn after<'t, D: Dictionary<'t>>(
        synced: Option<Instant>,
        dictionary: &D,
        now: Instant,
    ) -> Self {
        let length = Parameters::of(dictionary).number(0x1007, 0).unwrap_or_default();
        let length = Duration::from_micros(length.into());
        let window = match synced {
            Some(synced) if !length.is_zero() && now > synced + length => Window::Closed,
            Some(_) | None => Window::Open,
        };
        Self { now, window }
    }
}
