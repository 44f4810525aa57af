//! Values where they lie: read, put and reset by what the table says about their rows.

use core::ops::Range;

use crate::abort::AbortCode;
use crate::table::{Alias, Attributes, Found, Place, Table};
use crate::value::Value;
use crate::value::image::{self, NodeIdPlace};
use crate::value::number::number;
use crate::value::number::unsigned;
use crate::value::text::{prefix, store_string, trimmed};

/// The value of an entry, whatever its access.
#[inline]
pub(crate) fn value_of<'v>(
    table: &Table<'v>,
    image: &'v [u8],
    found: Found<'v>,
) -> Result<Value<'v>, AbortCode> {
    let shared = found.shared;
    let bytes = match shared.place {
        Place::Image => image,
        Place::Constant => table.parts().constants,
        // Looked up here, where it is known of most tables that there is none: then nothing of it is linked.
        Place::Alias => {
            let alias = table.alias(found.row).ok_or(AbortCode::INTERNAL)?;
            return alias_value(table, image, *alias, shared.size);
        }
        Place::Application => return Err(AbortCode::UNSUPPORTED_ACCESS),
    };
    let at = found.offset();
    if shared.data_type.is_string() && shared.place == Place::Image {
        return string_value(bytes, at, shared);
    }
    let bytes = bytes.get(at..at + usize::from(shared.size)).ok_or(AbortCode::INTERNAL)?;
    Ok(Value::of(bytes))
}

#[inline(never)]
fn string_value<'v>(bytes: &'v [u8], at: usize, shared: &Attributes) -> Result<Value<'v>, AbortCode> {
    let string_type = shared.data_type.string().ok_or(AbortCode::INTERNAL)?;
    let size = usize::from(shared.size) + prefix(string_type);
    let bytes = bytes.get(at..at + size).ok_or(AbortCode::INTERNAL)?;
    Ok(Value::of(trimmed(string_type, bytes)))
}

#[inline(never)]
fn alias_value<'v>(table: &Table<'_>, image: &[u8], alias: Alias, size: u16) -> Result<Value<'v>, AbortCode> {
    let target = table.found(alias.target);
    let number = number(target.shared.data_type, &value_of(table, image, target)?);
    Ok(Value::computed(alias.view.show(number)?, size))
}

/// The present number of an entry, where it exists and has at most 32 bits.
pub(crate) fn current(table: &Table<'_>, image: &[u8], index: u16, sub: u8) -> Option<u32> {
    at_row(table, image, table.search(index, sub).ok()?)
}

/// The present number of an entry, where it has at most 32 bits.
#[expect(clippy::inline_always, reason = "see `pdo`")]
#[inline(always)]
pub(crate) fn at_row(table: &Table<'_>, image: &[u8], found: Found<'_>) -> Option<u32> {
    let bytes = match found.shared.place {
        Place::Image => image,
        Place::Constant => table.parts().constants,
        Place::Alias | Place::Application => return slow_row(table, image, found),
    };
    let bytes = bytes.get(found.offset()..)?;
    match found.shared.size {
        4 => bytes.first_chunk().map(|bytes| u32::from_le_bytes(*bytes)),
        2 => bytes.first_chunk().map(|bytes| u16::from_le_bytes(*bytes).into()),
        1 => bytes.first().copied().map(u32::from),
        _ => slow_row(table, image, found),
    }
}

#[inline(never)]
fn slow_row(table: &Table<'_>, image: &[u8], found: Found<'_>) -> Option<u32> {
    u32::try_from(unsigned(&value_of(table, image, found).ok()?)).ok()
}

/// Puts the value of an entry of the image, which has been checked.
#[inline]
pub(crate) fn put(image: &mut [u8], holder: Found<'_>, data: &[u8]) -> Result<(), AbortCode> {
    let at = holder.offset();
    if let Some(string_type) = holder.shared.data_type.string() {
        let size = usize::from(holder.shared.size) + prefix(string_type);
        let place = image.get_mut(at..at + size).ok_or(AbortCode::INTERNAL)?;
        store_string(place, string_type, data);
        return Ok(());
    }
    let place = image.get_mut(at..at + data.len()).ok_or(AbortCode::INTERNAL)?;
    copy(place, data);
    Ok(())
}

/// Copies bytes of the same number: a call of `memcpy` takes longer than the copy of a small number.
#[inline]
fn copy(place: &mut [u8], data: &[u8]) {
    let done =
        copy_exactly::<4>(place, data) || copy_exactly::<2>(place, data) || copy_exactly::<1>(place, data);
    if !done {
        place.iter_mut().zip(data).for_each(|(byte, new)| *byte = *new);
    }
}

#[inline]
fn copy_exactly<const N: usize>(place: &mut [u8], data: &[u8]) -> bool {
    match (<&mut [u8; N]>::try_from(place), <&[u8; N]>::try_from(data)) {
        (Ok(place), Ok(data)) => {
            *place = *data;
            true
        }
        _ => false,
    }
}

/// Puts the values of a part of the image back to those after a factory reset, for a node-ID.
pub(crate) fn reset(table: &Table<'_>, image: &mut [u8], part: &Range<usize>, node_id: u8) {
    let factory = table.parts().factory;
    let part = part.start..part.end.min(image.len()).min(factory.len());
    if let (Some(now), Some(factory)) = (image.get_mut(part.clone()), factory.get(part.clone())) {
        now.iter_mut().zip(factory).for_each(|(byte, factory)| *byte = *factory);
    }
    for place in table.parts().node_id_places {
        let at = usize::try_from(place.offset).unwrap_or(usize::MAX);
        if part.contains(&at) {
            image::add(image, at, place.size.into(), node_id);
        }
    }
}

/// Whether an entry of the image has the value of a factory reset, for a node-ID; by its bytes.
pub(crate) fn is_reset(table: &Table<'_>, image: &[u8], part: &Range<usize>, node_id: u8) -> bool {
    let (Some(now), Some(factory)) = (image.get(part.clone()), table.parts().factory.get(part.clone()))
    else {
        return false;
    };
    let mut places = table.parts().node_id_places.iter();
    let follows = |place: &&NodeIdPlace| usize::try_from(place.offset) == Ok(part.start);
    let Some(place) = places.find(follows) else { return now == factory };
    // What follows the node-ID is a number.
    let mut number = [0; 8];
    let Some(expected) = number.get_mut(..factory.len()) else { return false };
    expected.iter_mut().zip(factory).for_each(|(byte, factory)| *byte = *factory);
    image::add(expected, 0, place.size.into(), node_id);
    now == expected
}
