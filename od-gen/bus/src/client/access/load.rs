//! Data that take long to write, such as a program.

use std::ops::ControlFlow;
use std::time::Duration;

use firmware_glue::AbortCode;
use firmware_glue::sdo::{Source, Way};
use od_spec::model::EntryId;

use super::{AccessError, Client, micros};
use crate::client::Bus;

/// Bytes, with a function that gets the number of those that have gone out, and may end the transfer.
struct Watched<'a, F> {
    data: &'a [u8],
    progress: F,
}

impl<F: FnMut(usize) -> ControlFlow<()>> Source for Watched<'_, F> {
    fn size(&self) -> Option<u32> {
        self.data.size()
    }

    fn copy(&mut self, offset: u32, buffer: &mut [u8]) -> Result<usize, AbortCode> {
        let count = self.data.copy(offset, buffer)?;
        let sent = usize::try_from(offset).unwrap_or(usize::MAX).saturating_add(count);
        if (self.progress)(sent).is_break() { Err(AbortCode::GENERAL) } else { Ok(count) }
    }
}

impl<B: Bus> Client<B> {
    /// Writes an entry of a node in blocks, or in segments where the node refuses blocks, once. After each piece, `progress`
    /// gets the number of bytes that have gone out; it can end the transfer. A node may need `patience` between two of its answers.
    ///
    /// # Errors
    /// [`AccessError`], as of [`write`](Self::write); [`AbortCode::GENERAL`] as a wrong answer where `progress` ended it.
    pub fn load(
        &mut self,
        node: u8,
        id: EntryId,
        data: &[u8],
        patience: Duration,
        progress: impl FnMut(usize) -> ControlFlow<()>,
    ) -> Result<(), AccessError> {
        let mut client = self.sdo(node)?;
        (client.way, client.timeout) = (Way::Blocks, micros(patience));
        self.give(client, id, Watched { data, progress })
    }
}
