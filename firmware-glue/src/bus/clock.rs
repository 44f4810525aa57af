//! Time as the services of CANopen take it: passed in, in microseconds.
//!
//! No service asks a clock. The firmware reads its timer and passes the [`Instant`]; a test passes whatever it likes.

use core::fmt;
use core::ops::{Add, Sub};

/// A point in time: microseconds since any beginning, such as the start of the firmware. 64 bits do not overflow within
/// 500,000 years, so that no deadline comes around again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Instant(u64);

impl Instant {
    /// The beginning.
    pub const ZERO: Self = Self(0);

    /// The point in time so many microseconds after the beginning.
    pub const fn from_micros(micros: u64) -> Self {
        Self(micros)
    }

    /// The point in time so many milliseconds after the beginning.
    pub const fn from_millis(millis: u64) -> Self {
        Self(millis.saturating_mul(1000))
    }

    /// Microseconds since the beginning.
    pub const fn as_micros(self) -> u64 {
        self.0
    }

    /// Time since another point in time; none if that is later.
    pub const fn since(self, earlier: Self) -> Duration {
        Duration(self.0.saturating_sub(earlier.0))
    }
}

/// A length of time in microseconds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Duration(u64);

impl Duration {
    /// No time.
    pub const ZERO: Self = Self(0);

    /// So many microseconds.
    pub const fn from_micros(micros: u64) -> Self {
        Self(micros)
    }

    /// So many times 100 µs, the unit of inhibit times (CiA 301 9.6.3, 1015h, 1800h).
    pub const fn from_tenth_millis(tenths: u64) -> Self {
        Self(tenths.saturating_mul(100))
    }

    /// So many milliseconds, the unit of heartbeats and event timers (CiA 301 9.6.3, 1016h, 1017h, 1800h).
    pub const fn from_millis(millis: u64) -> Self {
        Self(millis.saturating_mul(1000))
    }

    /// Microseconds.
    pub const fn as_micros(self) -> u64 {
        self.0
    }

    /// Whether it is no time at all, which switches most services off.
    pub const fn is_zero(self) -> bool {
        self.0 == 0
    }

    /// So many times as long.
    pub const fn times(self, factor: u64) -> Self {
        Self(self.0.saturating_mul(factor))
    }
}

impl Add<Duration> for Instant {
    type Output = Self;

    fn add(self, length: Duration) -> Self {
        Self(self.0.saturating_add(length.0))
    }
}

impl Sub for Instant {
    type Output = Duration;

    fn sub(self, earlier: Self) -> Duration {
        self.since(earlier)
    }
}

/// `12.345678 s`.
impl fmt::Display for Instant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Duration(self.0).fmt(f)
    }
}

/// `0.000100 s`.
impl fmt::Display for Duration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{:06} s", self.0 / 1_000_000, self.0 % 1_000_000)
    }
}

/// The earlier of two points in time, of which either may be missing.
#[inline(never)]
pub fn earlier(one: Option<Instant>, other: Option<Instant>) -> Option<Instant> {
    match (one, other) {
        (Some(one), Some(other)) => Some(one.min(other)),
        (one, other) => one.or(other),
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::ToString as _;

    use super::{Duration, Instant, earlier};

    #[test]
    fn time_ends_at_its_limits_and_never_overflows() {
        let last = Instant::from_micros(u64::MAX);
        assert_eq!(last + Duration::from_millis(1), last);
        assert_eq!(Instant::ZERO - last, Duration::ZERO);
        assert_eq!(Duration::from_millis(u64::MAX), Duration::from_micros(u64::MAX));
        assert_eq!(Duration::from_micros(3).times(u64::MAX), Duration::from_micros(u64::MAX));
    }

    #[test]
    fn units_are_those_of_the_objects() {
        assert_eq!(Duration::from_tenth_millis(7), Duration::from_micros(700));
        assert_eq!(Instant::from_millis(2) - Instant::from_micros(500), Duration::from_micros(1500));
        assert_eq!((Instant::from_micros(12_345_678)).to_string(), "12.345678 s");
    }

    #[test]
    fn a_missing_point_in_time_is_no_earlier_one() {
        let (first, second) = (Instant::from_micros(1), Instant::from_micros(2));
        assert_eq!(earlier(Some(second), Some(first)), Some(first));
        assert_eq!(earlier(None, Some(second)), Some(second));
        assert_eq!(earlier(None, None), None);
    }
}
