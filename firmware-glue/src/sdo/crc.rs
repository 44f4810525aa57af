//! The checksum of a block transfer.

/// CRC of 16 bits, polynomial x^16 + x^12 + x^5 + 1, most significant bit first, from 0 on (CiA 301 7.2.4.3.16).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Crc(u16);

impl Crc {
    /// Takes more bytes in. Without a table: 512 bytes of flash are worth more than the time between two frames.
    pub(crate) fn update(&mut self, bytes: &[u8]) {
        for byte in bytes {
            let mut crc = self.0 ^ u16::from(*byte) << 8;
            for _ in 0..8 {
                crc = if crc & 0x8000 == 0 { crc << 1 } else { crc << 1 ^ 0x1021 };
            }
            self.0 = crc;
        }
    }

    /// The checksum of all bytes so far.
    pub(crate) const fn value(self) -> u16 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::Crc;

    #[test]
    fn the_check_value_of_the_polynomial() {
        let mut crc = Crc::default();
        crc.update(b"1234");
        crc.update(b"56789");
        assert_eq!(crc.value(), 0x31C3);
    }
}
