//! Bit rates, and how files write them.

/// The bit rates of CiA 301, in kbit/s.
pub(super) const BIT_RATES: [u16; 8] = [10, 20, 50, 125, 250, 500, 800, 1000];

/// The bit rate, in kbit/s, of a number in bit/s: it is far above every number in kbit/s.
pub(super) fn of_bits_per_second(number: i128) -> Option<u16> {
    BIT_RATES.into_iter().find(|rate| number == i128::from(*rate) * 1000)
}
