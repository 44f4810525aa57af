//! Where the data of a client go and come from.

use crate::abort::AbortCode;

/// Takes what a client reads.
///
/// What came before a transfer failed is worth nothing: with blocks, only the end shows whether the checksum is right.
pub trait Sink {
    /// Called before the first piece, with the number of bytes that the server announces, if it does.
    ///
    /// # Errors
    /// The transfer ends, and this code is sent to the server.
    fn begin(&mut self, size: Option<u32>) -> Result<(), AbortCode> {
        let _ = size;
        Ok(())
    }

    /// Takes the next piece; pieces come in order and without gaps.
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    fn put(&mut self, offset: u32, data: &[u8]) -> Result<(), AbortCode>;
}

/// Has what a client writes.
pub trait Source {
    /// The number of bytes, if it is known: it is sent to the server, which checks it.
    fn size(&self) -> Option<u32>;

    /// Copies bytes from an offset on; returns how many, 0 at the end. An offset may come again, when a segment was lost.
    ///
    /// # Errors
    /// The transfer ends, and this code is sent to the server.
    fn copy(&mut self, offset: u32, buffer: &mut [u8]) -> Result<usize, AbortCode>;
}

/// A buffer that is filled with what is read.
#[derive(Debug)]
pub struct Filled<'b> {
    buffer: &'b mut [u8],
    length: usize,
}

impl<'b> Filled<'b> {
    /// An empty one.
    pub fn new(buffer: &'b mut [u8]) -> Self {
        Self { buffer, length: 0 }
    }

    /// What came.
    pub fn bytes(&self) -> &[u8] {
        self.buffer.get(..self.length).unwrap_or_default()
    }
}

impl Sink for Filled<'_> {
    fn begin(&mut self, size: Option<u32>) -> Result<(), AbortCode> {
        self.length = 0;
        let fits = size.is_none_or(|size| usize::try_from(size).is_ok_and(|size| size <= self.buffer.len()));
        if fits { Ok(()) } else { Err(AbortCode::OUT_OF_MEMORY) }
    }

    fn put(&mut self, offset: u32, data: &[u8]) -> Result<(), AbortCode> {
        let from = usize::try_from(offset).map_err(|_| AbortCode::OUT_OF_MEMORY)?;
        let to = from.checked_add(data.len()).ok_or(AbortCode::OUT_OF_MEMORY)?;
        self.buffer.get_mut(from..to).ok_or(AbortCode::OUT_OF_MEMORY)?.copy_from_slice(data);
        self.length = to;
        Ok(())
    }
}

impl<S: Sink + ?Sized> Sink for &mut S {
    fn begin(&mut self, size: Option<u32>) -> Result<(), AbortCode> {
        (**self).begin(size)
    }

    fn put(&mut self, offset: u32, data: &[u8]) -> Result<(), AbortCode> {
        (**self).put(offset, data)
    }
}

impl Source for &[u8] {
    fn size(&self) -> Option<u32> {
        u32::try_from(self.len()).ok()
    }

    fn copy(&mut self, offset: u32, buffer: &mut [u8]) -> Result<usize, AbortCode> {
        let rest = usize::try_from(offset).ok().and_then(|at| self.get(at..)).unwrap_or_default();
        buffer.iter_mut().zip(rest).for_each(|(byte, new)| *byte = *new);
        Ok(rest.len().min(buffer.len()))
    }
}
