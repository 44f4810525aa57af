//! The mapping of a PDO, resolved: where its values lie, so that a frame needs no search.
//!
//! The mapping parameters in the dictionary stay the only description. A client, a store or the firmware changes them without a report
//! to the engine, so they are compared with those that were resolved whenever the mapping is used.

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::communication::cob_id::NOT_VALID;
use crate::access::dictionary::{Dictionary, put_free, value, write_row};
use crate::pdo::{Frame, PdoError, Received, Refused, get_bits, put_bits};
use crate::table::mapping::{FRAME_BITS, Mapped, width};
use crate::table::stored::at_row;
use crate::table::{NONE, Pdo, Place, Row};
use crate::value::image::{get, get_u8, get_u32};
use crate::value::number::unsigned;

/// Entries that are resolved at the same time: as many as a frame has bytes. Of a PDO with more, of single bits, they take turns.
const KEPT: u8 = 8;

/// A mapping as it was when it was used last.
#[derive(Debug, Clone)]
pub(crate) struct Mapping {
    /// Mapped entries; 0 if none are resolved.
    count: u8,
    /// Bits up to the end of the entries that are resolved.
    bits: u8,
    /// Bytes of a frame.
    length: u8,
    packing: Packing,
    watched: Option<Watched>,
    cob_id: u32,
    /// The mapping parameters, as they are in the image.
    parameters: [[u8; 4]; KEPT as usize],
    fields: [Field; KEPT as usize],
    /// Where each byte of a frame is in the image.
    places: [u16; KEPT as usize],
}

/// Where the parameters lie that led to the fields: in the image, or [`NONE`] of one in flash, which does not change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Watched {
    cob_id: u16,
    number: u16,
    /// The mapping parameters, one after the other.
    parameters: u16,
}

/// How a TPDO is packed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Packing {
    /// Value by value.
    Values,
    /// Byte by byte: all values are whole bytes of the image.
    Bytes,
    /// Two bytes at a time.
    Words,
}

/// A mapped entry.
#[derive(Debug, Clone)]
struct Field {
    row: Row,
    /// Its place in the image, of the kinds that have one.
    place: u16,
    kind: Kind,
    /// Its first bit in the frame.
    first: u8,
    bits: u8,
}

/// How a mapped entry is read and written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A placeholder.
    Dummy,
    /// A view of another entry, a constant, or not of whole bytes.
    Other,
    /// Whole bytes in the image, which are checked when they are written.
    Checked,
    /// One, two or four bytes in the image that take every value.
    Byte,
    Word,
    Long,
}

impl Mapping {
    /// Nothing is resolved yet.
    pub(crate) const NEW: Self = Self {
        count: 0,
        bits: 0,
        length: 0,
        packing: Packing::Values,
        watched: None,
        cob_id: 0,
        parameters: [[0; 4]; KEPT as usize],
        fields: [Field::NONE; KEPT as usize],
        places: [0; KEPT as usize],
    };

    /// The data of a TPDO.
    #[inline]
    pub(crate) fn pack<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        pdo: &Pdo<'_>,
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Frame, PdoError> {
        self.update(dictionary, pdo)?;
        let mut bytes = [0; 8];
        if self.packing == Packing::Values {
            self.pack_values(pdo, dictionary, application, &mut bytes)?;
        } else {
            for field in first(&self.fields, self.count) {
                if let Some(entry) = dictionary.entry(field.row) {
                    application.refresh(dictionary, entry);
                }
            }
            let (image, places) = (dictionary.image(), first(&self.places, self.length));
            if self.packing == Packing::Words {
                let words = bytes.as_chunks_mut::<2>().0.iter_mut().zip(places.as_chunks::<2>().0);
                words.for_each(|(word, [place, _])| *word = get(image, usize::from(*place)));
            } else {
                let bytes = bytes.iter_mut().zip(places);
                bytes.for_each(|(byte, place)| *byte = get_u8(image, usize::from(*place)));
            }
        }
        Ok(Frame { bytes, length: self.length })
    }

    #[inline(never)]
    fn pack_values<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        pdo: &Pdo<'_>,
        dictionary: &mut D,
        application: &mut A,
        bytes: &mut [u8; 8],
    ) -> Result<(), PdoError> {
        let (table, mut at) = (dictionary.table(), 0);
        loop {
            for field in first(&self.fields, self.count - at) {
                if field.kind == Kind::Dummy {
                    return Err(PdoError::NotMapped);
                }
                if let Some(entry) = dictionary.entry(table.holder(field.row)) {
                    application.refresh(dictionary, entry);
                }
                let value = value(dictionary, table.found(field.row)).map_err(PdoError::NoValue)?;
                let number = unsigned(&value);
                put_bits(bytes, field.first.into(), field.bits.into(), number);
            }
            if !self.next(&mut at, dictionary, pdo)? {
                return Ok(());
            }
        }
    }

    /// Takes the data of an RPDO.
    #[inline]
    pub(crate) fn unpack<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        pdo: &Pdo<'_>,
        data: &[u8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Received<D::Entry>, PdoError> {
        self.update(dictionary, pdo)?;
        let length = usize::from(self.length);
        if data.len() < length {
            return Err(PdoError::TooShort);
        }
        let mut received = Received { too_long: data.len() > length, refused: None };
        let (frame, mut at) = (whole(data), 0);
        loop {
            for field in first(&self.fields, self.count - at) {
                let outcome = match field.kind {
                    Kind::Word => field.put_bytes::<2, D, A>(&frame, dictionary, application),
                    Kind::Long => field.put_bytes::<4, D, A>(&frame, dictionary, application),
                    Kind::Byte => field.put_bytes::<1, D, A>(&frame, dictionary, application),
                    Kind::Dummy | Kind::Checked | Kind::Other => {
                        field.put_other(&frame, dictionary, application)
                    }
                };
                if let Err(code) = outcome
                    && let (None, Some(entry)) = (received.refused, dictionary.entry(field.row))
                {
                    received.refused = Some(Refused { entry, code });
                }
            }
            if !self.next(&mut at, dictionary, pdo)? {
                return Ok(received);
            }
        }
    }

    /// Bytes that the data of an RPDO has to have.
    pub(crate) fn length<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        pdo: &Pdo<'_>,
    ) -> Result<u8, PdoError> {
        self.renew(dictionary, pdo)?;
        Ok(self.length)
    }

    /// Whether the PDO carries an entry or a view of it.
    pub(crate) fn carries<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, pdo: &Pdo<'_>, row: Row) -> bool {
        let (table, mut at) = (dictionary.table(), 0);
        let mut goes_on = self.renew(dictionary, pdo).is_ok();
        while goes_on {
            let mut fields = first(&self.fields, self.count - at).iter();
            if fields.any(|field| field.kind != Kind::Dummy && table.holder(field.row) == row) {
                return true;
            }
            goes_on = self.next(&mut at, dictionary, pdo) == Ok(true);
        }
        false
    }

    /// Resolves the entries after those from a position on, if there are more.
    #[inline]
    fn next<'t, D: Dictionary<'t>>(
        &mut self,
        at: &mut u8,
        dictionary: &D,
        pdo: &Pdo<'_>,
    ) -> Result<bool, PdoError> {
        *at += KEPT;
        if *at >= self.count {
            return Ok(false);
        }
        self.window(dictionary, pdo, *at, self.count).map(|()| true)
    }

    /// Resolves the mapping of now, unless it is.
    #[inline]
    fn update<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, pdo: &Pdo<'_>) -> Result<(), PdoError> {
        if self.is_current(dictionary.image()) { Ok(()) } else { self.resolve(dictionary, pdo) }
    }

    /// [`update`](Self::update) where it need not be fast: one function for all that call it.
    #[inline(never)]
    fn renew<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, pdo: &Pdo<'_>) -> Result<(), PdoError> {
        self.update(dictionary, pdo)
    }

    /// Whether the parameters are those that were resolved.
    #[inline]
    fn is_current(&self, image: &[u8]) -> bool {
        let Some(Watched { cob_id, number, parameters }) = self.watched else { return false };
        if cob_id != NONE && get_u32(image, cob_id.into()) != self.cob_id {
            return false;
        }
        if number != NONE && get_u8(image, number.into()) != self.count {
            return false;
        }
        // One at a time: for a few, a call of `memcmp` takes longer.
        parameters_at(image, parameters)
            .iter()
            .zip(first(&self.parameters, self.count))
            .all(|(now, kept)| now == kept)
    }

    #[cold]
    #[inline(never)]
    fn resolve<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, pdo: &Pdo<'_>) -> Result<(), PdoError> {
        self.watched = None;
        let cob_id = row_number(dictionary, pdo.cob_id).ok_or(PdoError::NoPdo)?;
        if cob_id & NOT_VALID != 0 {
            return Err(PdoError::NotValid);
        }
        let count = row_number(dictionary, pdo.mapping).and_then(|count| u8::try_from(count).ok());
        let Some(count @ 1..=64) = count else { return Err(PdoError::NotMapped) };
        self.packing = if count > KEPT { Packing::Values } else { Packing::Words };
        for first in (0..count).step_by(KEPT.into()) {
            self.window(dictionary, pdo, first, count)?;
        }
        (self.count, self.cob_id, self.length) = (count, cob_id, self.bits.div_ceil(8));
        if count > KEPT {
            return self.window(dictionary, pdo, 0, count);
        }
        self.watched = watched(dictionary, pdo, count);
        let parameters = self.watched.map_or(NONE, |watched| watched.parameters);
        let parameters = parameters_at(dictionary.image(), parameters).iter();
        self.parameters.iter_mut().zip(parameters).for_each(|(kept, now)| *kept = *now);
        Ok(())
    }

    /// Resolves some entries; those before them were resolved last.
    #[inline(never)]
    fn window<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        pdo: &Pdo<'_>,
        first: u8,
        count: u8,
    ) -> Result<(), PdoError> {
        if first == 0 {
            self.bits = 0;
        }
        for (at, field) in (first..count).zip(&mut self.fields) {
            let row = pdo.mapping.saturating_add(1 + Row::from(at));
            let mapped = Mapped::of(row_number(dictionary, row).ok_or(PdoError::NotMapped)?);
            *field = Field::of(dictionary, mapped, self.bits).ok_or(PdoError::NotMapped)?;
            let size = field.bits / 8;
            self.packing = match field.kind {
                Kind::Dummy | Kind::Other => Packing::Values,
                Kind::Checked | Kind::Byte | Kind::Word | Kind::Long if !size.is_multiple_of(2) => {
                    self.packing.min(Packing::Bytes)
                }
                Kind::Checked | Kind::Byte | Kind::Word | Kind::Long => self.packing,
            };
            let places = self.places.iter_mut().skip((field.first / 8).into()).take(size.into());
            places.zip(field.place..).for_each(|(byte, place)| *byte = place);
            let next = u32::from(self.bits) + mapped.bits;
            if next > FRAME_BITS {
                return Err(PdoError::NotMapped);
            }
            self.bits = u8::try_from(next).unwrap_or(u8::MAX);
        }
        Ok(())
    }
}

/// The first items of a list, at most all.
#[inline]
fn first<T>(list: &[T], count: u8) -> &[T] {
    list.get(..usize::from(count)).unwrap_or(list)
}

/// The mapping parameters from a place in the image on, and what follows them; none at [`NONE`].
#[inline]
fn parameters_at(image: &[u8], place: u16) -> &[[u8; 4]] {
    image.get(usize::from(place)..).unwrap_or_default().as_chunks().0
}

/// Data with zeros after them.
#[inline]
fn whole(data: &[u8]) -> [u8; 8] {
    match data.first_chunk() {
        Some(bytes) => *bytes,
        None => unsigned(data).to_le_bytes(),
    }
}

/// The number in a row.
#[inline(never)]
fn row_number<'t, D: Dictionary<'t>>(dictionary: &D, row: Row) -> Option<u32> {
    let table = dictionary.table();
    at_row(table, dictionary.image(), table.found(row))
}

/// Where the parameters lie; `None` if some may change and are not where they can be watched.
fn watched<'t, D: Dictionary<'t>>(dictionary: &D, pdo: &Pdo<'_>, count: u8) -> Option<Watched> {
    let table = dictionary.table();
    let place = |row: Row, size: u16| {
        let found = table.found(row);
        match found.shared.place {
            Place::Constant => Some(NONE),
            Place::Image if found.shared.size == size => found.near(),
            Place::Image | Place::Alias | Place::Application => None,
        }
    };
    let parameter = |at: u16| place(pdo.mapping.saturating_add(1 + at), 4);
    let first = parameter(0)?;
    for at in 0..u16::from(count) {
        let expected = if first == NONE { NONE } else { first + 4 * at };
        if parameter(at)? != expected {
            return None;
        }
    }
    Some(Watched { cob_id: place(pdo.cob_id, 4)?, number: place(pdo.mapping, 1)?, parameters: first })
}

impl Field {
    const NONE: Self = Self { row: 0, place: 0, kind: Kind::Dummy, first: 0, bits: 0 };

    /// The field of a mapping parameter; `None` if it maps what is not there.
    fn of<'t, D: Dictionary<'t>>(dictionary: &D, mapped: Mapped, first: u8) -> Option<Self> {
        let bits = u8::try_from(mapped.bits).ok()?;
        if mapped.is_dummy() {
            return Some(Self { first, bits, ..Self::NONE });
        }
        let table = dictionary.table();
        let found = table.search(mapped.index, mapped.sub).ok()?;
        let is_whole = width(found.shared) == mapped.bits && (first | bits).is_multiple_of(8);
        let is_number = found.shared.place == Place::Image && !found.shared.data_type.is_string();
        let (kind, place) = match found.near() {
            Some(place) if is_whole && is_number => match bits {
                8 if table.is_free(found) => (Kind::Byte, place),
                16 if table.is_free(found) => (Kind::Word, place),
                32 if table.is_free(found) => (Kind::Long, place),
                _ => (Kind::Checked, place),
            },
            Some(_) | None => (Kind::Other, 0),
        };
        Some(Self { row: found.row, place, kind, first, bits })
    }

    /// Writes a value from a frame, which the entry takes whatever it is.
    #[inline]
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "the frame stays where it is")]
    fn put_bytes<'t, const N: usize, D: Dictionary<'t>, A: Application<D>>(
        &self,
        frame: &[u8; 8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<(), AbortCode> {
        let value = get::<N>(frame, usize::from(self.first / 8));
        put_free(dictionary, self.row, self.place.into(), value, application)
    }

    /// Writes the value from a frame, with every check.
    #[inline(never)]
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "as above")]
    fn put_other<'t, D: Dictionary<'t>, A: Application<D>>(
        &self,
        frame: &[u8; 8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<(), AbortCode> {
        if self.kind == Kind::Dummy {
            return Ok(());
        }
        let found = dictionary.table().found(self.row);
        let number = get_bits(frame, self.first.into(), self.bits.into()).to_le_bytes();
        let value = number.get(..usize::from(found.shared.size).min(8)).unwrap_or(&number);
        write_row(dictionary, found, value, application).map(drop)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;
    use crate::access::parameters::set;
    use crate::access::test_table::{TestDictionary, dictionary, stored, value};
    use crate::pdo::{self, Rpdo, Tpdo};
    use crate::table::Storage;

    /// RPDO 1 and TPDO 1 with as many mapping parameters, and entries from 2000h on: bytes, words and a double word with a largest value.
    fn device(parameters: &[u32], storage: Storage) -> TestDictionary {
        let mut values = Vec::new();
        for index in [0x1400, 0x1600, 0x1800, 0x1A00_u16] {
            if index & 0x200 == 0 {
                values.extend([value(index, 0, 1, 1), value(index, 1, 4, 0x181)]);
                continue;
            }
            values.push(value(index, 0, 1, u32::try_from(parameters.len()).expect("few")));
            for (sub, parameter) in (1..).zip(parameters) {
                // Every second one may be in another group.
                let storage = if sub % 2 == 0 { storage } else { Storage::No };
                values.push(stored(index, sub, 4, *parameter, storage));
            }
        }
        values.extend([
            value(0x2000, 0, 1, 0x11),
            value(0x2001, 0, 2, 0x3322),
            value(0x2002, 0, 4, 0x7766_5544),
        ]);
        dictionary(&values)
    }

    const NUMBERS: [u32; 3] = [0x2000_0008, 0x2001_0010, 0x2002_0020];

    fn read(device: &TestDictionary, index: u16) -> Vec<u8> {
        device.read(index, 0).expect("it is there").to_vec()
    }

    #[test]
    fn a_mapping_that_is_kept_does_what_the_parameters_say_now() {
        for storage in [Storage::No, Storage::Application] {
            let mut device = device(&NUMBERS, storage);
            let mut tpdo = Tpdo::new(device.table(), 1).expect("TPDO 1");
            let mut rpdo = Rpdo::new(device.table(), 1).expect("RPDO 1");
            let packed = tpdo.pack(&mut device, &mut ()).expect("a mapping");
            assert_eq!(*packed, [0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77]);
            assert_eq!(rpdo.unpack(&mut device, &[1; 6], &mut ()), Err(PdoError::TooShort));
            assert_eq!(rpdo.unpack(&mut device, &[1; 7], &mut ()).map(|received| received.refused), Ok(None));
            assert_eq!((read(&device, 0x2000), read(&device, 0x2001)), ([1].to_vec(), [1, 1].to_vec()));

            // Nothing reports that a parameter has changed.
            for index in [0x1600, 0x1A00] {
                set(&mut device, index, 2, 0x2000_0008);
                set(&mut device, index, 0, 2);
            }
            assert_eq!(*tpdo.pack(&mut device, &mut ()).expect("a mapping"), [1, 1]);
            assert!(rpdo.unpack(&mut device, &[8, 9, 10], &mut ()).expect("a mapping").too_long);
            assert_eq!(read(&device, 0x2000), [9], "the last one counts");

            for (parameter, error) in [(0x2009_0008, PdoError::NotMapped), (0x2002_0040, PdoError::NotMapped)]
            {
                set(&mut device, 0x1600, 2, parameter);
                assert_eq!(rpdo.unpack(&mut device, &[1; 8], &mut ()), Err(error));
                assert_eq!(read(&device, 0x2000), [9], "nothing was stored");
            }
            set(&mut device, 0x1A00, 0, 0);
            assert_eq!(tpdo.pack(&mut device, &mut ()), Err(PdoError::NotMapped));
            set(&mut device, 0x1800, 1, 0x8000_0181);
            assert_eq!(tpdo.pack(&mut device, &mut ()), Err(PdoError::NotValid));
        }
    }

    /// The parameter may be the last value of all.
    #[test]
    fn a_parameter_at_the_end_of_the_image_is_compared() {
        let mut device = dictionary(&[
            value(0x1100, 0, 1, 0x11),
            value(0x1101, 0, 1, 0x22),
            value(0x1400, 0, 1, 1),
            value(0x1400, 1, 4, 0x205),
            value(0x1600, 0, 1, 1),
            value(0x1600, 1, 4, 0x1100_0008),
        ]);
        let mut rpdo = Rpdo::new(device.table(), 1).expect("RPDO 1");
        rpdo.unpack(&mut device, &[7], &mut ()).expect("a mapping");
        set(&mut device, 0x1600, 1, 0x1101_0008);
        rpdo.unpack(&mut device, &[8], &mut ()).expect("a mapping");
        assert_eq!((read(&device, 0x1100), read(&device, 0x1101)), ([7].to_vec(), [8].to_vec()));
    }

    #[test]
    fn single_bits_are_up_to_64_entries() {
        // The lowest bit of each, 19 times.
        let parameters: Vec<u32> = (0..19).map(|at| [0x2000_0001, 0x2001_0001][at % 2]).collect();
        let mut device = device(&parameters, Storage::No);
        for _ in 0..2 {
            assert_eq!(*pdo::pack(&mut device, 1, &mut ()).expect("a mapping"), [0x55, 0x55, 0x05]);
        }
        let received = pdo::unpack(&mut device, 1, &[0xAA, 0xAA, 0x02], &mut ()).expect("a mapping");
        assert_eq!((received.too_long, received.refused), (false, None));
        assert_eq!((read(&device, 0x2000), read(&device, 0x2001)), ([0].to_vec(), [1, 0].to_vec()));
        // Of more entries, the last is not there: the others keep their values.
        set(&mut device, 0x1600, 19, 0x2009_0001);
        assert_eq!(pdo::unpack(&mut device, 1, &[0xFF; 3], &mut ()), Err(PdoError::NotMapped));
        assert_eq!(read(&device, 0x2000), [0]);
    }

    #[test]
    fn values_that_are_not_whole_bytes_move_those_after_them() {
        let mut device = device(&[0x2000_0004, 0x2001_0010], Storage::No);
        assert_eq!(*pdo::pack(&mut device, 1, &mut ()).expect("a mapping"), [0x21, 0x32, 0x03]);
        pdo::unpack(&mut device, 1, &[0xF5, 0xCD, 0x0A], &mut ()).expect("a mapping");
        assert_eq!((read(&device, 0x2000), read(&device, 0x2001)), ([5].to_vec(), [0xDF, 0xAC].to_vec()));
    }
}
