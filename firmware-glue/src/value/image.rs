//! Numbers in a byte image, least significant byte first.
//!
//! Generated accessors pass constant offsets, which the generator has checked; the compiler turns each call into one load
//! or store. An offset outside the image reads zeros and writes nothing: nothing here panics.

#![expect(
    clippy::inline_always,
    reason = "only where it is inlined, the constant offset makes the bounds check vanish"
)]

use crate::value::number::{signed, unsigned};
use crate::value::time::Time;

/// The `N` bytes at an offset.
#[inline(always)]
pub fn get<const N: usize>(image: &[u8], at: usize) -> [u8; N] {
    match image.get(at..).and_then(<[u8]>::first_chunk::<N>) {
        Some(bytes) => *bytes,
        None => [0; N],
    }
}

/// Puts `N` bytes at an offset.
#[inline(always)]
pub fn put<const N: usize>(image: &mut [u8], at: usize, bytes: [u8; N]) {
    if let Some(place) = image.get_mut(at..).and_then(<[u8]>::first_chunk_mut::<N>) {
        *place = bytes;
    }
}

macro_rules! numbers {
    ($($get:ident $put:ident $type:ident,)+) => {
        $(
            #[doc = concat!("The `", stringify!($type), "` at an offset.")]
            #[inline(always)]
            pub fn $get(image: &[u8], at: usize) -> $type {
                $type::from_le_bytes(get(image, at))
            }

            #[doc = concat!("Puts an `", stringify!($type), "` at an offset.")]
            #[inline(always)]
            pub fn $put(image: &mut [u8], at: usize, value: $type) {
                put(image, at, value.to_le_bytes());
            }
        )+
    };
}

numbers! {
    get_i8 put_i8 i8,
    get_i16 put_i16 i16,
    get_i32 put_i32 i32,
    get_i64 put_i64 i64,
    get_u8 put_u8 u8,
    get_u16 put_u16 u16,
    get_u32 put_u32 u32,
    get_u64 put_u64 u64,
    get_f32 put_f32 f32,
    get_f64 put_f64 f64,
}

/// The `bool` at an offset: whether the byte is not 0.
#[inline(always)]
pub fn get_bool(image: &[u8], at: usize) -> bool {
    get_u8(image, at) != 0
}

/// Puts a `bool` at an offset.
#[inline(always)]
pub fn put_bool(image: &mut [u8], at: usize, value: bool) {
    put_u8(image, at, value.into());
}

/// The [`Time`] at an offset.
#[inline(always)]
pub fn get_time(image: &[u8], at: usize) -> Time {
    Time::from_bytes(get(image, at))
}

/// Puts a [`Time`] at an offset.
#[inline(always)]
pub fn put_time(image: &mut [u8], at: usize, value: Time) {
    put(image, at, value.to_bytes());
}

/// An unsigned number of `N` bytes, up to 8.
#[inline(always)]
pub fn get_unsigned<const N: usize>(image: &[u8], at: usize) -> u64 {
    unsigned(&get::<N>(image, at))
}

/// A signed number of `N` bytes, up to 8.
#[inline(always)]
pub fn get_signed<const N: usize>(image: &[u8], at: usize) -> i64 {
    signed(&get::<N>(image, at))
}

/// Offset of an element: sub-indices 1 to `highest`, the first at `start`, each of `size` bytes.
#[inline]
pub const fn element(sub: u8, highest: usize, start: usize, size: usize) -> Option<usize> {
    let sub = sub as usize;
    if sub >= 1 && sub <= highest { Some(start + (sub - 1) * size) } else { None }
}

/// Offset of a value in the object with a number: `first` to `last`, the value of the first object at `start`, those of the
/// others `step` bytes after each other.
#[inline]
pub const fn numbered(number: u16, first: u16, last: u16, start: usize, step: usize) -> Option<usize> {
    if number >= first && number <= last { Some(start + (number - first) as usize * step) } else { None }
}

/// A number that the generator knows to fit; 0 should it not.
#[inline(always)]
pub fn narrow<T: TryFrom<i64> + Default>(number: i64) -> T {
    T::try_from(number).unwrap_or_default()
}

/// Where a value lies that has the node-ID added to it after a factory reset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NodeIdPlace {
    /// Offset in the image.
    pub offset: u32,
    /// Bytes.
    pub size: u8,
}

/// A factory image with the node-ID added at its places.
pub const fn with_node_id<const N: usize>(
    mut image: [u8; N],
    places: &[NodeIdPlace],
    node_id: u8,
) -> [u8; N] {
    let mut at = 0;
    while at < places.len() {
        let place = places[at];
        add(&mut image, place.offset as usize, place.size as usize, node_id);
        at += 1;
    }
    image
}

/// Adds to a number in the image, from its lowest byte on.
pub(crate) const fn add(image: &mut [u8], offset: usize, size: usize, node_id: u8) {
    let (mut at, mut carry) = (offset, node_id);
    while at < offset + size && at < image.len() {
        let (sum, over) = image[at].overflowing_add(carry);
        image[at] = sum;
        carry = over as u8;
        at += 1;
    }
}

/// A value outside the range of a type whose width Rust does not have, such as INTEGER24.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OutOfRange;

/// Puts an unsigned number of `N` bytes, up to 8.
///
/// # Errors
/// [`OutOfRange`] for one that has more; nothing changes then.
#[inline(always)]
pub fn put_unsigned<const N: usize>(image: &mut [u8], at: usize, value: u64) -> Result<(), OutOfRange> {
    let bytes = value.to_le_bytes();
    let (low, high) = bytes.split_first_chunk::<N>().ok_or(OutOfRange)?;
    if high.iter().any(|byte| *byte != 0) {
        return Err(OutOfRange);
    }
    put(image, at, *low);
    Ok(())
}

/// Puts a signed number of `N` bytes, up to 8.
///
/// # Errors
/// [`OutOfRange`] for one that has more; nothing changes then.
#[inline(always)]
pub fn put_signed<const N: usize>(image: &mut [u8], at: usize, value: i64) -> Result<(), OutOfRange> {
    let bytes = value.to_le_bytes();
    let (low, _) = bytes.split_first_chunk::<N>().ok_or(OutOfRange)?;
    if signed(low) != value {
        return Err(OutOfRange);
    }
    put(image, at, *low);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_node_id_carries_over_within_its_value_only() {
        let places = [NodeIdPlace { offset: 0, size: 2 }, NodeIdPlace { offset: 2, size: 1 }];
        assert_eq!(with_node_id([0xFF, 0x00, 0xFE, 0x55], &places, 5), [0x04, 0x01, 0x03, 0x55]);
        assert_eq!(with_node_id([0, 0], &[NodeIdPlace { offset: 1, size: 4 }], 5), [0, 5]);
    }

    #[test]
    fn outside_the_image_nothing_happens() {
        let mut image = [1, 2, 3];
        assert_eq!(get::<2>(&image, 1), [2, 3]);
        assert_eq!(get::<2>(&image, 2), [0, 0]);
        assert_eq!(get::<2>(&image, usize::MAX), [0, 0]);
        put(&mut image, 2, [9, 9]);
        assert_eq!(image, [1, 2, 3]);
    }

    #[test]
    fn odd_widths_refuse_what_does_not_fit() {
        let mut image = [0; 4];
        for value in [-0x80_0000, -1, 0, 0x7F_FFFF] {
            assert_eq!(put_signed::<3>(&mut image, 1, value), Ok(()));
            assert_eq!(get_signed::<3>(&image, 1), value);
        }
        assert_eq!(put_signed::<3>(&mut image, 1, 0x80_0000), Err(OutOfRange));
        assert_eq!(put_signed::<3>(&mut image, 1, -0x80_0001), Err(OutOfRange));
        assert_eq!(put_unsigned::<3>(&mut image, 1, 0xFF_FFFF), Ok(()));
        assert_eq!(get_unsigned::<3>(&image, 1), 0xFF_FFFF);
        assert_eq!(put_unsigned::<3>(&mut image, 1, 0x100_0000), Err(OutOfRange));
        assert_eq!(image[0], 0);
    }
}
