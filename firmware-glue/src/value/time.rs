//! Dates and times as they travel.

/// A TIME_OF_DAY or TIME_DIFFERENCE (CiA 301 9.1.6.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Time {
    /// Days; of a TIME_OF_DAY, since 1984-01-01.
    pub days: u16,
    /// Milliseconds of the day; of a TIME_OF_DAY, since midnight. 28 bits travel.
    pub milliseconds: u32,
}

impl Time {
    /// The time in 6 bytes.
    pub const fn from_bytes(bytes: [u8; 6]) -> Self {
        let [m0, m1, m2, m3, d0, d1] = bytes;
        Self {
            days: u16::from_le_bytes([d0, d1]),
            milliseconds: u32::from_le_bytes([m0, m1, m2, m3]) & 0x0FFF_FFFF,
        }
    }

    /// 6 bytes, as they travel.
    pub const fn to_bytes(self) -> [u8; 6] {
        let [m0, m1, m2, m3] = (self.milliseconds & 0x0FFF_FFFF).to_le_bytes();
        let [d0, d1] = self.days.to_le_bytes();
        [m0, m1, m2, m3, d0, d1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_28_bits_of_milliseconds() {
        let time = Time { days: 0x1234, milliseconds: 86_399_999 };
        assert_eq!(Time::from_bytes(time.to_bytes()), time);
        assert_eq!(Time { days: 0, milliseconds: u32::MAX }.to_bytes(), [0xFF, 0xFF, 0xFF, 0x0F, 0, 0]);
    }
}
