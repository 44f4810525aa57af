//! Parameters that outlive a power failure: 1010h and 1011h (CiA 301 9.6.3) over any flash of the crate `embedded-storage`.
//!
//! The flash has two slots, each with a record of everything that is stored. A record is written as a whole, and counts once
//! its checksum follows it; first into the slot that does not count, then, as a copy, into the other. So
//!
//! - whenever power fails, the next start finds the values of before or those of after, of all groups together;
//! - a bit that flips, or a whole slot that is lost, costs nothing, as the other slot has the same;
//! - values that are not as they were written are never taken: where both slots are lost, the factory's values remain.
//!
//! "Restore defaults" writes a record without the group, and so takes effect when the values are loaded the next time, after a reset, as
//! CiA 301 says. Values of another layout (of a firmware with other entries) are not taken, either, nor those of another node-ID where they follow it, nor
//! single ones that their entries cannot have any more.
//!
//! ```
//! use embedded_storage::nor_flash::NorFlash;
//! use firmware_glue::storage::{ALL, BadArea, Command, Loaded, ParameterStore};
//! use firmware_glue::{AbortCode, Application, Dictionary, NodeId};
//!
//! struct Drive<F> {
//!     store: ParameterStore<F, 64>,
//! }
//!
//! impl<F: NorFlash> Drive<F> {
//!     /// Two slots of 2 KiB, 48 KiB after the beginning of the flash.
//!     fn new(flash: F) -> Result<Self, BadArea> {
//!         Ok(Self { store: ParameterStore::new(flash, 0xC000, 2048)? })
//!     }
//!
//!     /// At power-on, and at "reset node"; at "reset communication", the communication parameters alone.
//!     fn restart<'t, D: Dictionary<'t>>(&mut self, od: &mut D, node: NodeId) -> Loaded {
//!         self.store.load(od, node, &ALL)
//!     }
//! }
//!
//! impl<'t, D: Dictionary<'t>, F: NorFlash> Application<D> for Drive<F> {
//!     fn command(&mut self, od: &mut D, command: Command) -> Result<(), AbortCode> {
//!         self.store.command(od, command).map(drop).map_err(AbortCode::from)
//!     }
//! }
//! ```

mod crc;
mod error;
mod groups;
mod loaded;
mod record;
#[cfg(test)]
mod tests;

use embedded_storage::nor_flash::NorFlash;

pub use error::{BadArea, StoreError};
pub use loaded::{Copies, Loaded, Outcome};

use crate::access::command::Command;
use crate::access::dictionary::Dictionary;
use crate::bus::node_id::NodeId;
use crate::storage::flash::groups::{PerGroup, STORED};
use crate::storage::flash::record::{EMPTY_RECORD, Part, Reader, SECTION, Section, Slot, Unreadable, Writer};
use crate::table::{Region, Storage};

/// Parameters in two slots of a flash, read and written `CHUNK` bytes at a time: a multiple of the sizes that the flash reads and writes.
#[derive(Debug)]
pub struct ParameterStore<F, const CHUNK: usize> {
    flash: F,
    slots: [Slot; 2],
    /// The node that the values of a group in the dictionary are for.
    nodes: PerGroup<Option<NodeId>>,
}

/// The newest record.
#[derive(Debug, Clone, Copy)]
struct Newest {
    slot: Slot,
    number: u32,
    copies: Copies,
}

impl<F: NorFlash, const CHUNK: usize> ParameterStore<F, CHUNK> {
    /// A store in two slots of a size, from an offset in the flash on.
    ///
    /// # Errors
    /// [`BadArea`].
    pub fn new(flash: F, start: u32, slot_size: u32) -> Result<Self, BadArea> {
        let size_of = |bytes: usize| u32::try_from(bytes).ok().filter(|bytes| *bytes > 0);
        let erase = size_of(F::ERASE_SIZE).ok_or(BadArea::EraseSize)?;
        if slot_size == 0 || !start.is_multiple_of(erase) || !slot_size.is_multiple_of(erase) {
            return Err(BadArea::EraseSize);
        }
        let chunk = size_of(CHUNK).ok_or(BadArea::ChunkSize)?;
        let fits = CHUNK.is_multiple_of(F::WRITE_SIZE.max(1)) && CHUNK.is_multiple_of(F::READ_SIZE.max(1));
        if !fits || !slot_size.is_multiple_of(chunk) {
            return Err(BadArea::ChunkSize);
        }
        let middle = start.checked_add(slot_size).ok_or(BadArea::Capacity)?;
        let end = middle.checked_add(slot_size).ok_or(BadArea::Capacity)?;
        if usize::try_from(end).map_or(true, |end| end > flash.capacity()) {
            return Err(BadArea::Capacity);
        }
        let slots = [Slot { start, end: middle }, Slot { start: middle, end }];
        Ok(Self { flash, slots, nodes: PerGroup::all(None) })
    }

    /// The flash.
    pub fn into_inner(self) -> F {
        self.flash
    }

    /// Puts groups to the values that hold after a reset: the stored ones, else the factory's for the node-ID. At power-on and
    /// "reset node" that is [`ALL`](crate::storage::ALL), at "reset communication" [`Storage::Communication`]. Values that follow another node-ID than this one are not taken;
    /// a group without such values is the same for every node-ID.
    pub fn load<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &mut D,
        node: NodeId,
        groups: &[Storage],
    ) -> Loaded {
        for storage in groups {
            self.nodes.set(*storage, Some(node));
        }
        // The newest first; what turns out not to be intact after all leaves the other one.
        let mut lost = None;
        while let Some(newest) = self.newest(lost) {
            reset(dictionary, node, groups);
            let mut loaded = Loaded::new(newest.copies);
            if self.load_record(newest.slot, dictionary, node, groups, &mut loaded).is_ok() {
                correct(dictionary, node, &mut loaded);
                return loaded;
            }
            if lost.replace(newest.slot).is_some() {
                break;
            }
        }
        reset(dictionary, node, groups);
        Loaded::new(Copies::None)
    }

    fn load_record<'t, D: Dictionary<'t>>(
        &mut self,
        slot: Slot,
        dictionary: &mut D,
        node: NodeId,
        groups: &[Storage],
        loaded: &mut Loaded,
    ) -> Result<(), Unreadable> {
        let mut reader = Reader::<CHUNK>::new(slot);
        reader.open(&mut self.flash)?;
        let table = dictionary.table();
        while let Part::Section(section) = reader.part(&mut self.flash)? {
            let Section { storage, length, .. } = section;
            if !groups.contains(&storage) {
                reader.skip(&mut self.flash, length)?;
                continue;
            }
            let follows = dictionary.follows_node_id(storage).then_some(node);
            let region = table.region(storage).filter(|region| is_of(section, region));
            let place = region.and_then(|region| dictionary.image_mut().get_mut(region.range()));
            let outcome = match (place, section.node, follows) {
                (Some(place), saved, now) if saved == now => {
                    for byte in place {
                        *byte = reader.byte(&mut self.flash)?;
                    }
                    Outcome::Restored
                }
                (Some(_), Some(_), Some(_)) => Outcome::OtherNode,
                // Also where a firmware added the node-ID to values, or did not, and this one does otherwise.
                (Some(_), Some(_), None) | (Some(_), None, _) | (None, _, _) => Outcome::OtherLayout,
            };
            if outcome != Outcome::Restored {
                reader.skip(&mut self.flash, length)?;
            }
            loaded.set(storage, outcome);
        }
        reader.is_intact(&mut self.flash)
    }

    /// Carries out a command of a client.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn command<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        command: Command,
    ) -> Result<Copies, StoreError<F::Error>> {
        match command {
            Command::Save(_) => self.save(dictionary, command.groups()),
            Command::Restore(_) => self.forget(dictionary, command.groups()),
        }
    }

    /// Stores the values of now of some groups; those of others stay as they are stored, also for another node-ID. A group that follows the node-ID
    /// belongs to the node that it was [loaded](Self::load) for last.
    ///
    /// # Errors
    /// [`StoreError`]. [`Copies::One`] if it is stored, but the second copy failed.
    pub fn save<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        groups: &[Storage],
    ) -> Result<Copies, StoreError<F::Error>> {
        self.write(dictionary, groups, groups)
    }

    /// Forgets the stored values of some groups: the next [`load`](Self::load) gives the factory's.
    ///
    /// # Errors
    /// As [`save`](Self::save).
    pub fn forget<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        groups: &[Storage],
    ) -> Result<Copies, StoreError<F::Error>> {
        self.write(dictionary, groups, &[])
    }

    /// Makes a second copy where there is one only, as after a power failure or when bits have flipped.
    ///
    /// # Errors
    /// [`StoreError`]; the one copy is kept.
    pub fn repair(&mut self) -> Result<Copies, StoreError<F::Error>> {
        match self.newest(None) {
            Some(newest) if newest.copies == Copies::One => {
                self.copy(newest.slot, self.other(newest.slot), newest.number)?;
                Ok(Copies::Both)
            }
            Some(newest) => Ok(newest.copies),
            None => Ok(Copies::None),
        }
    }

    /// Writes a record: what is stored, without the groups `but`, and the present values of the groups `with`.
    fn write<'t, D: Dictionary<'t>>(
        &mut self,
        dictionary: &D,
        but: &[Storage],
        with: &[Storage],
    ) -> Result<Copies, StoreError<F::Error>> {
        let [first, _] = self.slots;
        if largest(dictionary) > usize::try_from(first.end - first.start).unwrap_or(0) {
            return Err(StoreError::TooLarge);
        }
        for storage in with {
            self.node_of(dictionary, *storage)?;
        }
        let newest = self.newest(None);
        let slot = newest.map_or(first, |newest| self.other(newest.slot));
        let number = newest.map_or(0, |newest| newest.number.wrapping_add(1));
        let mut writer = Writer::<CHUNK>::new(slot);
        writer.begin(&mut self.flash, number)?;
        if let Some(newest) = newest {
            let table = dictionary.table();
            self.keep(&mut writer, newest.slot, |section| {
                let region = table.region(section.storage);
                !but.contains(&section.storage) && region.is_some_and(|region| is_of(section, region))
            })?;
        }
        for storage in STORED.into_iter().filter(|storage| with.contains(storage)) {
            if let Some(region) = dictionary.table().region(storage) {
                let section = section_of(region, self.node_of(dictionary, storage)?);
                writer.section(&mut self.flash, section)?;
                writer.bytes(&mut self.flash, dictionary.stored(storage))?;
            }
        }
        writer.finish(&mut self.flash)?;
        self.verify(slot)?;
        // From here on, the new values are stored.
        match self.copy(slot, self.other(slot), number) {
            Ok(()) => Ok(Copies::Both),
            Err(_) => Ok(Copies::One),
        }
    }

    /// Copies the sections of an intact record that are to be kept.
    fn keep(
        &mut self,
        writer: &mut Writer<CHUNK>,
        from: Slot,
        is_kept: impl Fn(Section) -> bool,
    ) -> Result<(), StoreError<F::Error>> {
        let mut reader = Reader::<CHUNK>::new(from);
        reader.open(&mut self.flash).map_err(not_verified)?;
        while let Part::Section(section) = reader.part(&mut self.flash).map_err(not_verified)? {
            let is_kept = is_kept(section);
            if is_kept {
                writer.section(&mut self.flash, section)?;
            }
            for _ in 0..section.length {
                let byte = reader.byte(&mut self.flash).map_err(not_verified)?;
                if is_kept {
                    writer.bytes(&mut self.flash, &[byte])?;
                }
            }
        }
        // What was copied is what was stored: else the new record is never finished.
        reader.is_intact(&mut self.flash).map_err(not_verified)
    }

    /// Copies an intact record.
    fn copy(&mut self, from: Slot, to: Slot, number: u32) -> Result<(), StoreError<F::Error>> {
        let mut writer = Writer::<CHUNK>::new(to);
        writer.begin(&mut self.flash, number)?;
        self.keep(&mut writer, from, |_| true)?;
        writer.finish(&mut self.flash)?;
        self.verify(to)
    }

    fn verify(&mut self, slot: Slot) -> Result<(), StoreError<F::Error>> {
        self.check(slot).map(drop).map_err(not_verified)
    }

    /// The number of a record, if it is intact.
    fn check(&mut self, slot: Slot) -> Result<u32, Unreadable> {
        let mut reader = Reader::<CHUNK>::new(slot);
        let number = reader.open(&mut self.flash)?;
        while let Part::Section(section) = reader.part(&mut self.flash)? {
            reader.skip(&mut self.flash, section.length)?;
        }
        reader.is_intact(&mut self.flash)?;
        Ok(number)
    }

    /// The newest intact record, except in a slot.
    fn newest(&mut self, but: Option<Slot>) -> Option<Newest> {
        let [first, second] = self.slots;
        let mut number = |slot| if but == Some(slot) { None } else { self.check(slot).ok() };
        let one = |slot, number| Newest { slot, number, copies: Copies::One };
        match (number(first), number(second)) {
            (Some(number), Some(other)) if number == other => {
                Some(Newest { copies: Copies::Both, ..one(first, number) })
            }
            // Numbers count on beyond their end.
            (Some(number), Some(other)) if number.wrapping_sub(other) > u32::MAX / 2 => {
                Some(one(second, other))
            }
            (Some(number), _) => Some(one(first, number)),
            (None, Some(other)) => Some(one(second, other)),
            (None, None) => None,
        }
    }

    /// Whose the values of a group are, if they follow the node-ID.
    fn node_of<'t, D: Dictionary<'t>>(
        &self,
        dictionary: &D,
        storage: Storage,
    ) -> Result<Option<NodeId>, StoreError<F::Error>> {
        if !dictionary.follows_node_id(storage) {
            return Ok(None);
        }
        self.nodes.of(storage).flatten().map(Some).ok_or(StoreError::NotLoaded)
    }

    fn other(&self, slot: Slot) -> Slot {
        let [first, second] = self.slots;
        if slot == first { second } else { first }
    }
}

/// A record that was intact a moment ago.
fn not_verified<E>(_: Unreadable) -> StoreError<E> {
    StoreError::NotVerified
}

fn reset<'t, D: Dictionary<'t>>(dictionary: &mut D, node: NodeId, groups: &[Storage]) {
    for storage in groups {
        dictionary.reset_stored(*storage, node.get());
    }
}

/// Corrects what entries cannot have of what was restored.
fn correct<'t, D: Dictionary<'t>>(dictionary: &mut D, node: NodeId, loaded: &mut Loaded) {
    for storage in STORED {
        if loaded.outcome(storage) == Outcome::Restored
            && let Some(entry) = dictionary.correct_stored(storage, node.get())
        {
            loaded.set(storage, Outcome::RestoredBut(dictionary.info(entry).id()));
        }
    }
}

/// The section of a region.
fn section_of(region: &Region, node: Option<NodeId>) -> Section {
    Section {
        storage: region.storage,
        node,
        layout: region.layout,
        length: region.end.saturating_sub(region.start),
    }
}

/// Whether the values of a section are those of a region, of whichever node.
fn is_of(section: Section, region: &Region) -> bool {
    section == section_of(region, section.node)
}

/// Bytes of a record with all groups of a dictionary.
fn largest<'t, D: Dictionary<'t>>(dictionary: &D) -> usize {
    dictionary
        .table()
        .parts()
        .regions
        .iter()
        .fold(EMPTY_RECORD, |sum, region| sum + SECTION + region.range().len())
}
