//! Archives in which nothing is compressed (ZIP), the same on every machine and at every time.
//!
//! Files are a megabyte or ten, and lie beside others of hundreds: a library that compresses would be larger than what it saves.

/// The first day that the format knows.
const FIRST_DAY: u16 = 0x21;
/// The oldest version of the format, in which files are stored as they are.
const VERSION: u16 = 10;

/// An archive that is being written.
#[derive(Debug, Default)]
pub(crate) struct Archive {
    bytes: Vec<u8>,
    directory: Vec<u8>,
    count: u16,
}

impl Archive {
    /// Adds a file; nothing, if the format has no numbers that are large enough. Names are ASCII.
    pub(crate) fn add(&mut self, name: &str, contents: &[u8]) -> Option<()> {
        let start = u32::try_from(self.bytes.len()).ok()?;
        let size = u32::try_from(contents.len()).ok()?;
        let mut facts = Vec::new();
        // Version, flags, method, time.
        for number in [VERSION, 0, 0, 0, FIRST_DAY] {
            facts.extend(number.to_le_bytes());
        }
        for number in [checksum(contents), size, size] {
            facts.extend(number.to_le_bytes());
        }
        // Length of the name, and of what may follow it.
        facts.extend(u16::try_from(name.len()).ok()?.to_le_bytes());
        facts.extend([0; 2]);
        self.bytes.extend(b"PK\x03\x04");
        self.bytes.extend(&facts);
        self.bytes.extend(name.as_bytes());
        self.bytes.extend(contents);
        self.directory.extend(b"PK\x01\x02");
        self.directory.extend(VERSION.to_le_bytes());
        self.directory.extend(&facts);
        // No remark, the first volume, no attributes.
        self.directory.extend([0; 10]);
        self.directory.extend(start.to_le_bytes());
        self.directory.extend(name.as_bytes());
        self.count = self.count.checked_add(1)?;
        Some(())
    }

    /// The whole archive; nothing, if the format has no numbers that are large enough.
    pub(crate) fn finish(mut self) -> Option<Vec<u8>> {
        let start = u32::try_from(self.bytes.len()).ok()?;
        let size = u32::try_from(self.directory.len()).ok()?;
        self.bytes.append(&mut self.directory);
        self.bytes.extend(b"PK\x05\x06");
        self.bytes.extend([0; 4]);
        self.bytes.extend(self.count.to_le_bytes());
        self.bytes.extend(self.count.to_le_bytes());
        self.bytes.extend(size.to_le_bytes());
        self.bytes.extend(start.to_le_bytes());
        self.bytes.extend([0; 2]);
        Some(self.bytes)
    }
}

/// CRC-32 as ZIP has it: the polynomial 04C11DB7h, bits turned round.
fn checksum(bytes: &[u8]) -> u32 {
    const POLYNOMIAL: u32 = 0xEDB8_8320;
    const TABLE: [u32; 256] = {
        let mut table = [0; 256];
        let mut at = 0;
        let mut number: u32 = 0;
        while at < table.len() {
            let mut rest = number;
            let mut bit = 0;
            while bit < 8 {
                rest = if rest & 1 == 1 { (rest >> 1) ^ POLYNOMIAL } else { rest >> 1 };
                bit += 1;
            }
            table[at] = rest;
            at += 1;
            number += 1;
        }
        table
    };
    let step = |sum: u32, byte: &u8| {
        let [low, ..] = sum.to_le_bytes();
        (sum >> 8) ^ TABLE[usize::from(low ^ byte)]
    };
    !bytes.iter().fold(u32::MAX, step)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value that everybody publishes for these nine digits.
    #[test]
    fn the_checksum_is_the_one_of_the_format() {
        assert_eq!(checksum(b"123456789"), 0xCBF4_3926);
        assert_eq!(checksum(b""), 0);
    }
}
