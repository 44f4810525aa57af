//! How a record lies in flash, byte by byte.
//!
//! A record begins a slot and is: four bytes that name the format, its number, sections, an end, the checksum of all before; numbers
//! are little-endian. A section is a storage group (1 byte), the node-ID if its values follow it, else 0 (1 byte), two zeros, the layout number and the number of
//! bytes of its values, and these. The checksum is written last, so that a record that was not finished is not valid.

use embedded_storage::nor_flash::NorFlash;

use crate::bus::node_id::NodeId;
use crate::storage::flash::crc::Crc;
use crate::storage::flash::error::StoreError;
use crate::storage::flash::groups::STORED;
use crate::table::Storage;

/// The format; another one is another four bytes.
pub(super) const FORMAT: [u8; 4] = *b"ODr1";

/// Bytes of a record without sections: format, number, end, checksum.
pub(super) const EMPTY_RECORD: usize = 16;

/// Bytes of a section without values.
pub(super) const SECTION: usize = 12;

/// What ends the sections.
const END: u8 = 0;

/// The head of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Section {
    pub storage: Storage,
    /// Whose values they are, if they are of no use to another node.
    pub node: Option<NodeId>,
    pub layout: u32,
    pub length: u32,
}

/// What comes next in a record.
pub(super) enum Part {
    Section(Section),
    End,
}

/// A part of the flash for one record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Slot {
    pub start: u32,
    pub end: u32,
}

/// Why reading a record ended early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unreadable {
    /// The flash does not give the bytes; after a power failure, some report this of what was being written.
    Flash,
    /// They are no record.
    NoRecord,
}

/// Reads the bytes of a slot one after the other, and their checksum.
#[derive(Debug)]
pub(super) struct Reader<const CHUNK: usize> {
    slot: Slot,
    /// Where the next chunk begins.
    next: u32,
    chunk: [u8; CHUNK],
    /// Bytes of the chunk that were given.
    given: usize,
    crc: Crc,
}

impl<const CHUNK: usize> Reader<CHUNK> {
    /// A reader of a slot.
    pub(super) const fn new(slot: Slot) -> Self {
        Self { slot, next: slot.start, chunk: [0; CHUNK], given: CHUNK, crc: Crc::new() }
    }

    /// Begins the record; its number.
    pub(super) fn open<F: NorFlash>(&mut self, flash: &mut F) -> Result<u32, Unreadable> {
        if self.number(flash)? != u32::from_le_bytes(FORMAT) {
            return Err(Unreadable::NoRecord);
        }
        self.number(flash)
    }

    /// The next byte.
    #[inline(never)]
    pub(super) fn byte<F: NorFlash>(&mut self, flash: &mut F) -> Result<u8, Unreadable> {
        if self.given >= CHUNK {
            let after = u32::try_from(CHUNK).ok().and_then(|size| self.next.checked_add(size));
            let after = after.filter(|after| *after <= self.slot.end).ok_or(Unreadable::NoRecord)?;
            flash.read(self.next, &mut self.chunk).map_err(|_| Unreadable::Flash)?;
            self.next = after;
            self.given = 0;
        }
        let byte = self.chunk.get(self.given).copied().ok_or(Unreadable::NoRecord)?;
        self.given += 1;
        self.crc = self.crc.with(byte);
        Ok(byte)
    }

    /// The next four bytes.
    fn number<F: NorFlash>(&mut self, flash: &mut F) -> Result<u32, Unreadable> {
        let mut bytes = [0; 4];
        for byte in &mut bytes {
            *byte = self.byte(flash)?;
        }
        Ok(u32::from_le_bytes(bytes))
    }

    /// The head of the next section, or the end. Values have to be read, or skipped, before the next.
    pub(super) fn part<F: NorFlash>(&mut self, flash: &mut F) -> Result<Part, Unreadable> {
        let [group, node, zeros @ ..] = self.number(flash)?.to_le_bytes();
        if zeros != [0; 2] {
            return Err(Unreadable::NoRecord);
        }
        let node = match (node, NodeId::new(node)) {
            (0, _) => None,
            (_, Some(node)) => Some(node),
            (_, None) => return Err(Unreadable::NoRecord),
        };
        if group == END {
            return if node.is_none() { Ok(Part::End) } else { Err(Unreadable::NoRecord) };
        }
        let storage =
            STORED.into_iter().find(|storage| code(*storage) == group).ok_or(Unreadable::NoRecord)?;
        let layout = self.number(flash)?;
        let length = self.number(flash)?;
        Ok(Part::Section(Section { storage, node, layout, length }))
    }

    /// Leaves out the values of a section.
    pub(super) fn skip<F: NorFlash>(&mut self, flash: &mut F, length: u32) -> Result<(), Unreadable> {
        (0..length).try_for_each(|_| self.byte(flash).map(drop))
    }

    /// Reads the checksum after the end: whether every byte before it is as it was written.
    pub(super) fn is_intact<F: NorFlash>(&mut self, flash: &mut F) -> Result<(), Unreadable> {
        let expected = self.crc.value();
        let stored = self.number(flash)?;
        if stored == expected { Ok(()) } else { Err(Unreadable::NoRecord) }
    }
}

/// Writes a record into an erased slot.
#[derive(Debug)]
pub(super) struct Writer<const CHUNK: usize> {
    slot: Slot,
    next: u32,
    chunk: [u8; CHUNK],
    filled: usize,
    crc: Crc,
}

impl<const CHUNK: usize> Writer<CHUNK> {
    /// A writer into a slot.
    pub(super) const fn new(slot: Slot) -> Self {
        Self { slot, next: slot.start, chunk: [0xFF; CHUNK], filled: 0, crc: Crc::new() }
    }

    /// Erases the slot and begins a record.
    pub(super) fn begin<F: NorFlash>(
        &mut self,
        flash: &mut F,
        number: u32,
    ) -> Result<(), StoreError<F::Error>> {
        flash.erase(self.slot.start, self.slot.end).map_err(StoreError::Flash)?;
        self.bytes(flash, &FORMAT)?;
        self.bytes(flash, &number.to_le_bytes())
    }

    /// Writes bytes, as soon as they fill a chunk.
    #[inline(never)]
    pub(super) fn bytes<F: NorFlash>(
        &mut self,
        flash: &mut F,
        bytes: &[u8],
    ) -> Result<(), StoreError<F::Error>> {
        for byte in bytes {
            if let Some(place) = self.chunk.get_mut(self.filled) {
                *place = *byte;
                self.filled += 1;
                self.crc = self.crc.with(*byte);
            }
            if self.filled == CHUNK {
                self.flush(flash)?;
            }
        }
        Ok(())
    }

    /// Writes the head of a section.
    pub(super) fn section<F: NorFlash>(
        &mut self,
        flash: &mut F,
        section: Section,
    ) -> Result<(), StoreError<F::Error>> {
        self.bytes(flash, &[code(section.storage), section.node.map_or(0, NodeId::get), 0, 0])?;
        self.bytes(flash, &section.layout.to_le_bytes())?;
        self.bytes(flash, &section.length.to_le_bytes())
    }

    /// Ends the record: now it counts.
    pub(super) fn finish<F: NorFlash>(&mut self, flash: &mut F) -> Result<(), StoreError<F::Error>> {
        self.bytes(flash, &[END, 0, 0, 0])?;
        let checksum = self.crc.value();
        self.bytes(flash, &checksum.to_le_bytes())?;
        if self.filled > 0 { self.flush(flash) } else { Ok(()) }
    }

    fn flush<F: NorFlash>(&mut self, flash: &mut F) -> Result<(), StoreError<F::Error>> {
        let after = u32::try_from(CHUNK).ok().and_then(|size| self.next.checked_add(size));
        let after = after.filter(|after| *after <= self.slot.end).ok_or(StoreError::TooLarge)?;
        flash.write(self.next, &self.chunk).map_err(StoreError::Flash)?;
        self.next = after;
        self.chunk = [0xFF; CHUNK];
        self.filled = 0;
        Ok(())
    }
}

/// How a record names a storage group: not by the order of the enumeration, which may change.
const fn code(storage: Storage) -> u8 {
    match storage {
        Storage::No => END,
        Storage::Communication => 1,
        Storage::Application => 2,
        Storage::Manufacturer => 3,
        Storage::Remanent => 4,
    }
}
