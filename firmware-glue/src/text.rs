//! Strings and times.

use core::fmt;

use crate::dictionary::store_string;
use crate::table::DataType;
use crate::value::{prefix, trimmed};

/// A text longer than the capacity of its entry, or with characters that a VISIBLE_STRING does not have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NoFit;

/// A UNICODE_STRING: units of 16 bits, least significant byte first.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Utf16<'a>(pub &'a [u8]);

impl<'a> Utf16<'a> {
    /// The characters; what is none is shown as U+FFFD.
    pub fn chars(self) -> impl Iterator<Item = char> + 'a {
        let units = self.0.chunks_exact(2).map(|unit| match *unit {
            [low, high] => u16::from_le_bytes([low, high]),
            _ => 0,
        });
        char::decode_utf16(units).map(|character| character.unwrap_or(char::REPLACEMENT_CHARACTER))
    }
}

impl fmt::Display for Utf16<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.chars().try_for_each(|character| fmt::Write::write_char(f, character))
    }
}

impl fmt::Debug for Utf16<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\"{self}\"")
    }
}

/// The VISIBLE_STRING at a place.
#[doc(hidden)]
pub fn visible(image: &[u8], at: usize, capacity: usize) -> &str {
    core::str::from_utf8(string(image, DataType::VisibleString, at, capacity)).unwrap_or_default()
}

/// Puts a VISIBLE_STRING.
#[doc(hidden)]
pub fn put_visible(image: &mut [u8], at: usize, capacity: usize, text: &str) -> Result<(), NoFit> {
    if !text.bytes().all(|byte| (0x20..=0x7E).contains(&byte)) {
        return Err(NoFit);
    }
    put_string(image, DataType::VisibleString, at, capacity, text.as_bytes())
}

/// The OCTET_STRING at a place.
#[doc(hidden)]
pub fn octets(image: &[u8], at: usize, capacity: usize) -> &[u8] {
    string(image, DataType::OctetString, at, capacity)
}

/// Puts an OCTET_STRING.
#[doc(hidden)]
pub fn put_octets(image: &mut [u8], at: usize, capacity: usize, bytes: &[u8]) -> Result<(), NoFit> {
    put_string(image, DataType::OctetString, at, capacity, bytes)
}

/// The UNICODE_STRING at a place.
#[doc(hidden)]
pub fn unicode(image: &[u8], at: usize, capacity: usize) -> Utf16<'_> {
    Utf16(string(image, DataType::UnicodeString, at, capacity))
}

/// Puts a UNICODE_STRING; on an error, the old one may be gone in part.
#[doc(hidden)]
pub fn put_unicode(image: &mut [u8], at: usize, capacity: usize, text: &str) -> Result<(), NoFit> {
    // A zero would end the text.
    if text.contains('\0') || text.encode_utf16().count() * 2 > capacity {
        return Err(NoFit);
    }
    let place = image.get_mut(at..at + capacity).ok_or(NoFit)?;
    let mut units = text.encode_utf16();
    for pair in place.chunks_mut(2) {
        let unit = units.next().unwrap_or_default().to_le_bytes();
        pair.iter_mut().zip(unit).for_each(|(byte, new)| *byte = new);
    }
    Ok(())
}

fn string(image: &[u8], data_type: DataType, at: usize, capacity: usize) -> &[u8] {
    trimmed(data_type, image.get(at..at + capacity + prefix(data_type)).unwrap_or_default())
}

fn put_string(
    image: &mut [u8],
    data_type: DataType,
    at: usize,
    capacity: usize,
    bytes: &[u8],
) -> Result<(), NoFit> {
    let place = image.get_mut(at..at + capacity + prefix(data_type)).filter(|_| bytes.len() <= capacity);
    store_string(place.ok_or(NoFit)?, data_type, bytes);
    Ok(())
}

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
    fn strings_are_padded_and_never_cut() {
        let mut image = [0xAA; 8];
        assert_eq!(put_visible(&mut image, 1, 6, "abc"), Ok(()));
        assert_eq!(visible(&image, 1, 6), "abc");
        assert_eq!(put_visible(&mut image, 1, 6, "abcdef"), Ok(()));
        assert_eq!(visible(&image, 1, 6), "abcdef");
        assert_eq!(put_visible(&mut image, 1, 6, "abcdefg"), Err(NoFit));
        assert_eq!(put_visible(&mut image, 1, 6, "ä"), Err(NoFit));
        assert_eq!(put_visible(&mut image, 4, 6, "a"), Err(NoFit));
        assert_eq!(image, *b"\xAAabcdef\xAA");
    }

    #[test]
    fn octets_keep_zeros_and_their_length() {
        let mut image = [0xAA; 8];
        assert_eq!(put_octets(&mut image, 1, 4, &[1, 0, 2, 0]), Ok(()));
        assert_eq!(octets(&image, 1, 4), [1, 0, 2, 0]);
        assert_eq!(put_octets(&mut image, 1, 4, &[7]), Ok(()));
        assert_eq!(image, [0xAA, 1, 0, 7, 0, 0, 0, 0xAA]);
        assert_eq!(octets(&image, 1, 4), [7]);
        assert_eq!(put_octets(&mut image, 1, 4, &[0; 5]), Err(NoFit));
    }

    #[test]
    fn unicode_counts_units() {
        let mut image = [0; 6];
        assert_eq!(put_unicode(&mut image, 0, 6, "aä"), Ok(()));
        assert!(unicode(&image, 0, 6).chars().eq("aä".chars()));
        assert_eq!(put_unicode(&mut image, 0, 6, "𝄞𝄞"), Err(NoFit));
        assert!(unicode(&image, 0, 6).chars().eq("aä".chars()));
    }

    #[test]
    fn times_have_28_bits_of_milliseconds() {
        let time = Time { days: 0x1234, milliseconds: 86_399_999 };
        assert_eq!(Time::from_bytes(time.to_bytes()), time);
        assert_eq!(Time { days: 0, milliseconds: u32::MAX }.to_bytes(), [0xFF, 0xFF, 0xFF, 0x0F, 0, 0]);
    }
}
