//! The checksum of stored records.

/// CRC-32 as Ethernet has it (polynomial 04C1_1DB7h, reflected): it finds every error of up to three bits in records of up to
/// 11 kB, and every burst of up to 32.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Crc(u32);

impl Crc {
    pub(super) const fn new() -> Self {
        Self(u32::MAX)
    }

    /// With another byte.
    pub(super) const fn with(self, byte: u8) -> Self {
        // Four bits at a time: 64 bytes of flash for a table are enough.
        const TABLE: [u32; 16] = table();
        let mut rest = self.0 ^ byte as u32;
        rest = rest >> 4 ^ TABLE[(rest & 0xF) as usize];
        rest = rest >> 4 ^ TABLE[(rest & 0xF) as usize];
        Self(rest)
    }

    pub(super) const fn value(self) -> u32 {
        !self.0
    }
}

const fn table() -> [u32; 16] {
    let mut table = [0; 16];
    let (mut at, mut number) = (0, 0u32);
    while at < table.len() {
        let (mut rest, mut bit) = (number, 0);
        while bit < 4 {
            rest = if rest & 1 == 1 { rest >> 1 ^ 0xEDB8_8320 } else { rest >> 1 };
            bit += 1;
        }
        table[at] = rest;
        at += 1;
        number += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::Crc;

    #[test]
    fn it_is_the_crc_of_ethernet() {
        let crc = |bytes: &[u8]| bytes.iter().fold(Crc::new(), |crc, byte| crc.with(*byte)).value();
        assert_eq!(crc(b"123456789"), 0xCBF4_3926, "the check value of CRC-32/ISO-HDLC");
        assert_eq!(crc(b""), 0);
    }
}
