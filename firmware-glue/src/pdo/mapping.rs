//! The mapping of a PDO, resolved: where its values lie, so that a frame needs no search.
//!
//! The mapping parameters in the dictionary stay the only description. Whoever changes them, a client, a store or the firmware, tells
//! nobody: they are compared with those that were resolved whenever the mapping is used, a word each.

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::dictionary::{Dictionary, put_free, write_row};
use crate::pdo::{Frame, PdoError, Received, Refused, get_bits, put_bits};
use crate::table::mapping::{FRAME_BITS, Mapped, width};
use crate::table::stored::{at_row, value_of};
use crate::table::{Found, Pdo, Place, Row, Table};
use crate::value::image;

/// Entries that are resolved at the same time: as many as a frame has bytes. Of a PDO with more, of single bits, they take turns.
const KEPT: u8 = 8;

/// A mapping as it was when it was used last.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mapping {
    source: Source,
    /// Mapped entries; 0 if none are resolved.
    count: u8,
    /// Bits up to the end of the entries that are resolved.
    bits: u32,
    /// Bytes of a frame.
    length: u8,
    parameters: [u32; KEPT as usize],
    fields: [Field; KEPT as usize],
}

/// Where the mapping parameters lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Source {
    /// Each somewhere else, or too many: they are resolved for every frame.
    Apart,
    /// In flash: they do not change.
    Constants,
    /// In the image, one after the other from a place on.
    Image(u32),
}

/// A mapped entry.
#[derive(Debug, Clone, Copy)]
struct Field {
    row: Row,
    /// Its offset in the image: low half and the rest.
    place: u16,
    page: u8,
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
    /// Whole bytes in the image that take every value.
    Free,
}

impl Mapping {
    /// Nothing is resolved yet.
    pub(crate) const NEW: Self = Self {
        source: Source::Apart,
        count: 0,
        bits: 0,
        length: 0,
        parameters: [0; KEPT as usize],
        fields: [Field::dummy(0, 0); KEPT as usize],
    };

    /// The data of a TPDO.
    pub(crate) fn pack<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        pdo: &Pdo<'_>,
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Frame, PdoError> {
        let table = dictionary.table();
        let count = self.update(dictionary, pdo)?;
        let mut bytes = [0; 8];
        let mut at = 0;
        loop {
            for field in self.fields.iter().take((count - at).into()) {
                let holder = if field.kind == Kind::Other { table.holder(field.row) } else { field.row };
                if let Some(entry) = dictionary.entry(holder) {
                    application.refresh(dictionary, entry);
                }
                match field.kind {
                    Kind::Dummy => return Err(PdoError::NotMapped),
                    Kind::Checked | Kind::Free => field.get(dictionary.image(), &mut bytes),
                    Kind::Other => field.get_other(dictionary, &mut bytes)?,
                }
            }
            at += KEPT;
            if at >= count {
                return Ok(Frame { bytes, length: self.length });
            }
            self.window(dictionary, pdo, at, count)?;
        }
    }

    /// Takes the data of an RPDO.
    pub(crate) fn unpack<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        pdo: &Pdo<'_>,
        data: &[u8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Received<D::Entry>, PdoError> {
        let count = self.update(dictionary, pdo)?;
        let length = usize::from(self.length);
        if data.len() < length {
            return Err(PdoError::TooShort);
        }
        let mut received = Received { too_long: data.len() > length, refused: None };
        let mut at = 0;
        loop {
            for field in self.fields.iter().take((count - at).into()) {
                if let Err(code) = field.put(data, dictionary, application)
                    && let (None, Some(entry)) = (received.refused, dictionary.entry(field.row))
                {
                    received.refused = Some(Refused { entry, code });
                }
            }
            at += KEPT;
            if at >= count {
                return Ok(received);
            }
            self.window(dictionary, pdo, at, count)?;
        }
    }

    /// Bytes that the data of an RPDO has to have.
    pub(crate) fn length<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        pdo: &Pdo<'_>,
    ) -> Result<u8, PdoError> {
        self.update(dictionary, pdo)?;
        Ok(self.length)
    }

    /// Whether the PDO carries an entry or a view of it.
    pub(crate) fn carries<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, pdo: &Pdo<'_>, row: Row) -> bool {
        let Ok(count) = self.update(dictionary, pdo) else { return false };
        let mut at = 0;
        loop {
            let mut fields = self.fields.iter().take((count - at).into());
            if fields.any(|field| field.kind != Kind::Dummy && dictionary.table().holder(field.row) == row) {
                return true;
            }
            at += KEPT;
            if at >= count || self.window(dictionary, pdo, at, count).is_err() {
                return false;
            }
        }
    }

    /// Resolves the mapping of now, unless it is; the number of mapped entries.
    #[inline]
    fn update<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, pdo: &Pdo<'_>) -> Result<u8, PdoError> {
        let (table, image) = (dictionary.table(), dictionary.image());
        let count = at_row(table, image, table.found(pdo.mapping)).unwrap_or_default();
        if u32::from(self.count) == count && self.is_current(image) {
            return Ok(self.count);
        }
        self.resolve(dictionary, pdo, count)
    }

    /// Whether the parameters are those that were resolved.
    #[inline]
    fn is_current(&self, image: &[u8]) -> bool {
        match self.source {
            Source::Constants => true,
            Source::Image(at) => {
                let now = usize::try_from(at).ok().and_then(|at| image.get(at..)).unwrap_or_default();
                let kept = self.parameters.iter().take(self.count.into());
                // Word by word: for a few, a call of `memcmp` takes longer.
                now.len() >= 4 * usize::from(self.count)
                    && now
                        .as_chunks::<4>()
                        .0
                        .iter()
                        .zip(kept)
                        .all(|(now, kept)| u32::from_le_bytes(*now) == *kept)
            }
            Source::Apart => false,
        }
    }

    #[cold]
    #[inline(never)]
    fn resolve<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        pdo: &Pdo<'_>,
        count: u32,
    ) -> Result<u8, PdoError> {
        self.count = 0;
        let Ok(count @ 1..=64) = u8::try_from(count) else { return Err(PdoError::NotMapped) };
        for first in (0..count).step_by(KEPT.into()) {
            self.window(dictionary, pdo, first, count)?;
        }
        self.length = u8::try_from(self.bits.div_ceil(8)).unwrap_or(8);
        if count > KEPT {
            self.window(dictionary, pdo, 0, count)?;
            self.source = Source::Apart;
        } else {
            self.source = source(dictionary.table(), pdo.mapping.saturating_add(1), count);
        }
        self.count = count;
        Ok(count)
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
        let (table, image) = (dictionary.table(), dictionary.image());
        if first == 0 {
            self.bits = 0;
        }
        for (at, (kept, field)) in (first..count).zip(self.parameters.iter_mut().zip(&mut self.fields)) {
            let row = pdo.mapping.saturating_add(1 + Row::from(at));
            let parameter = at_row(table, image, table.found(row)).ok_or(PdoError::NotMapped)?;
            let mapped = Mapped::of(parameter);
            (*kept, *field) = (parameter, Field::of(table, mapped, self.bits).ok_or(PdoError::NotMapped)?);
            self.bits += mapped.bits;
            if self.bits > FRAME_BITS {
                return Err(PdoError::NotMapped);
            }
        }
        Ok(())
    }
}

/// Where so many mapping parameters lie, the first of which is in a row.
fn source(table: &Table<'_>, first: Row, count: u8) -> Source {
    let rows = (first..).take(count.into());
    let mut places = rows.map(|row| table.found(row)).zip(0..);
    let start = table.found(first).offset();
    if places.clone().all(|(found, _)| found.shared.place == Place::Constant) {
        Source::Constants
    } else if places.all(|(found, at): (Found<'_>, usize)| {
        found.shared.place == Place::Image && found.shared.size == 4 && found.offset() == start + 4 * at
    }) {
        u32::try_from(start).map_or(Source::Apart, Source::Image)
    } else {
        Source::Apart
    }
}

impl Field {
    /// The field of a mapping parameter; `None` if it maps what is not there.
    fn of(table: &Table<'_>, mapped: Mapped, first: u32) -> Option<Self> {
        let (first, bits) = (u8::try_from(first).ok()?, u8::try_from(mapped.bits).ok()?);
        if mapped.is_dummy() {
            return Some(Self::dummy(first, bits));
        }
        let found = table.search(mapped.index, mapped.sub).ok()?;
        let is_whole = width(found.shared) == mapped.bits && (first | bits).is_multiple_of(8);
        let kind = if !is_whole || found.shared.place != Place::Image || found.shared.data_type.is_string() {
            Kind::Other
        } else if table.is_free(found) {
            Kind::Free
        } else {
            Kind::Checked
        };
        let (place, page) = found.place();
        Some(Self { row: found.row, place, page, kind, first, bits })
    }

    const fn dummy(first: u8, bits: u8) -> Self {
        Self { row: 0, place: 0, page: 0, kind: Kind::Dummy, first, bits }
    }

    fn offset(&self) -> usize {
        usize::from(self.page) << 16 | usize::from(self.place)
    }

    /// Puts the value into a frame.
    #[inline]
    fn get(&self, image: &[u8], frame: &mut [u8; 8]) {
        let (from, to) = (self.offset(), usize::from(self.first / 8));
        match self.bits {
            32 => image::put(frame, to, image::get::<4>(image, from)),
            16 => image::put(frame, to, image::get::<2>(image, from)),
            8 => image::put(frame, to, image::get::<1>(image, from)),
            bits => {
                let value = image.get(from..).unwrap_or_default().iter().take((bits / 8).into());
                frame.iter_mut().skip(to).zip(value).for_each(|(byte, value)| *byte = *value);
            }
        }
    }

    /// Puts a value into a frame that does not lie in the image as whole bytes.
    #[inline(never)]
    fn get_other<'t, D: Dictionary<'t>>(&self, dictionary: &D, frame: &mut [u8; 8]) -> Result<(), PdoError> {
        let table = dictionary.table();
        let value = value_of(table, dictionary.image(), table.found(self.row)).map_err(PdoError::NoValue)?;
        put_bits(frame, self.first.into(), self.bits.into(), crate::value::number::unsigned(&value));
        Ok(())
    }

    /// Writes the value from a frame, with every check.
    #[inline]
    fn put<'t, D: Dictionary<'t>, A: Application<D>>(
        &self,
        frame: &[u8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<(), AbortCode> {
        match self.kind {
            Kind::Dummy => Ok(()),
            Kind::Free => {
                let (from, size) = (usize::from(self.first / 8), usize::from(self.bits / 8));
                let value = frame.get(from..from + size).ok_or(AbortCode::INTERNAL)?;
                put_free(dictionary, self.row, self.offset(), value, application)
            }
            Kind::Checked | Kind::Other => self.put_other(frame, dictionary, application),
        }
    }

    #[inline(never)]
    fn put_other<'t, D: Dictionary<'t>, A: Application<D>>(
        &self,
        frame: &[u8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<(), AbortCode> {
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

            // Nobody says that a parameter has changed.
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
    fn values_that_are_not_whole_bytes_move_those_behind_them() {
        let mut device = device(&[0x2000_0004, 0x2001_0010], Storage::No);
        assert_eq!(*pdo::pack(&mut device, 1, &mut ()).expect("a mapping"), [0x21, 0x32, 0x03]);
        pdo::unpack(&mut device, 1, &[0xF5, 0xCD, 0x0A], &mut ()).expect("a mapping");
        assert_eq!((read(&device, 0x2000), read(&device, 0x2001)), ([5].to_vec(), [0xDF, 0xAC].to_vec()));
    }
}
