//! Strings in the image: up to their capacity, padded with zeros.

use core::fmt;

use crate::value::data_type::StringType;

/// A text longer than the capacity of its entry, or with characters that a VISIBLE_STRING does not have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NoFit;

/// A UNICODE_STRING: units of 16 bits, least significant byte first.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Utf16<'a>(pub &'a [u8]);

impl<'a> Utf16<'a> {
    /// The characters; anything else is shown as U+FFFD.
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
    core::str::from_utf8(string(image, StringType::Visible, at, capacity)).unwrap_or_default()
}

/// Puts a VISIBLE_STRING.
#[doc(hidden)]
pub fn put_visible(image: &mut [u8], at: usize, capacity: usize, text: &str) -> Result<(), NoFit> {
    if !text.bytes().all(|byte| (0x20..=0x7E).contains(&byte)) {
        return Err(NoFit);
    }
    put_string(image, StringType::Visible, at, capacity, text.as_bytes())
}

/// The OCTET_STRING at a place.
#[doc(hidden)]
pub fn octets(image: &[u8], at: usize, capacity: usize) -> &[u8] {
    string(image, StringType::Octet, at, capacity)
}

/// Puts an OCTET_STRING.
#[doc(hidden)]
pub fn put_octets(image: &mut [u8], at: usize, capacity: usize, bytes: &[u8]) -> Result<(), NoFit> {
    put_string(image, StringType::Octet, at, capacity, bytes)
}

/// The UNICODE_STRING at a place.
#[doc(hidden)]
pub fn unicode(image: &[u8], at: usize, capacity: usize) -> Utf16<'_> {
    Utf16(string(image, StringType::Unicode, at, capacity))
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

fn string(image: &[u8], string_type: StringType, at: usize, capacity: usize) -> &[u8] {
    trimmed(string_type, image.get(at..at + capacity + prefix(string_type)).unwrap_or_default())
}

fn put_string(
    image: &mut [u8],
    string_type: StringType,
    at: usize,
    capacity: usize,
    bytes: &[u8],
) -> Result<(), NoFit> {
    let place = image.get_mut(at..at + capacity + prefix(string_type)).filter(|_| bytes.len() <= capacity);
    store_string(place.ok_or(NoFit)?, string_type, bytes);
    Ok(())
}

/// Puts a string that fits into its place, padded with zeros.
#[inline(never)]
pub(crate) fn store_string(place: &mut [u8], string_type: StringType, data: &[u8]) {
    let length = u16::try_from(data.len()).unwrap_or_default().to_le_bytes();
    let (head, rest) = place.split_at_mut(prefix(string_type).min(place.len()));
    head.iter_mut().zip(length).for_each(|(byte, new)| *byte = new);
    let (text, padding) = rest.split_at_mut(data.len().min(rest.len()));
    text.iter_mut().zip(data).for_each(|(byte, new)| *byte = *new);
    padding.fill(0);
}

/// A string without what pads it: up to the first 0 byte, or the first 0 unit of 16 bits.
#[inline]
pub(crate) fn trimmed(string_type: StringType, bytes: &[u8]) -> &[u8] {
    let length = match string_type {
        StringType::Visible => bytes.iter().position(|byte| *byte == 0),
        StringType::Unicode => bytes.chunks(2).position(|unit| unit == [0, 0]).map(|units| units * 2),
        StringType::Octet => return counted(bytes),
    };
    bytes.get(..length.unwrap_or(bytes.len())).unwrap_or(bytes)
}

/// An OCTET_STRING in the image: its length in two bytes, then its bytes.
fn counted(bytes: &[u8]) -> &[u8] {
    let Some((length, rest)) = bytes.split_first_chunk::<2>() else { return &[] };
    rest.get(..usize::from(u16::from_le_bytes(*length))).unwrap_or(rest)
}

/// Bytes in the image that a string has in addition to its capacity.
pub(crate) const fn prefix(string_type: StringType) -> usize {
    match string_type {
        StringType::Octet => 2,
        StringType::Visible | StringType::Unicode => 0,
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
}
