//! A NOR flash that is a piece of RAM: it outlives a reset of the node, but not the end of the emulator. On a board, the driver of the
//! controller's flash takes its place; `ParameterStore` needs nothing but these traits.

use core::ops::Range;

use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash};

/// Bytes of a sector.
const SECTOR: usize = 1024;
/// What an erased byte reads.
const ERASED: u8 = 0xFF;

/// Bytes of one of the two copies of the parameters.
pub const SLOT: u32 = 1024;
/// Bytes of the flash: both copies.
pub const SIZE: usize = 2 * SECTOR;

/// As a flash: writing only takes bits from 1 to 0, erasing brings whole sectors back to 1.
#[derive(Debug)]
pub struct RamFlash<'m>(&'m mut [u8; SIZE]);

impl<'m> RamFlash<'m> {
    /// A flash that is erased, as in a new device.
    pub fn new(memory: &'m mut [u8; SIZE]) -> Self {
        memory.fill(ERASED);
        Self(memory)
    }

    fn range(&mut self, from: u32, length: usize) -> Result<&mut [u8], NorFlashErrorKind> {
        let from = usize::try_from(from).map_err(|_| NorFlashErrorKind::OutOfBounds)?;
        let end = from.checked_add(length).ok_or(NorFlashErrorKind::OutOfBounds)?;
        self.0.get_mut(Range { start: from, end }).ok_or(NorFlashErrorKind::OutOfBounds)
    }
}

impl ErrorType for RamFlash<'_> {
    type Error = NorFlashErrorKind;
}

impl ReadNorFlash for RamFlash<'_> {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Self::Error> {
        let stored = self.range(offset, bytes.len())?;
        bytes.iter_mut().zip(stored).for_each(|(byte, stored)| *byte = *stored);
        Ok(())
    }

    fn capacity(&self) -> usize {
        SIZE
    }
}

impl NorFlash for RamFlash<'_> {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = SECTOR;

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Self::Error> {
        if !offset.is_multiple_of(4) || !bytes.len().is_multiple_of(Self::WRITE_SIZE) {
            return Err(NorFlashErrorKind::NotAligned);
        }
        let stored = self.range(offset, bytes.len())?;
        stored.iter_mut().zip(bytes).for_each(|(stored, byte)| *stored &= byte);
        Ok(())
    }

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Self::Error> {
        let length = usize::try_from(to.saturating_sub(from)).map_err(|_| NorFlashErrorKind::OutOfBounds)?;
        if !from.is_multiple_of(SLOT) || !length.is_multiple_of(SECTOR) {
            return Err(NorFlashErrorKind::NotAligned);
        }
        self.range(from, length)?.fill(ERASED);
        Ok(())
    }
}
