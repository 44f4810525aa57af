//! Limits of work for templates: one that never ends, or prints without end, ends with a message.

use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Bytes of all pages of a set. The pages of a device with 100,000 entries have a fifth of it.
pub(super) const OUTPUT: usize = 512 << 20;

/// Steps that a page may take that shows, or lists, so many entries. The shipped templates take less than a thousand for an entry.
pub(super) const fn steps(entries: usize) -> u64 {
    10_000_000 + 5_000 * entries as u64
}

/// What is left of the bytes that the pages of a set may have.
#[derive(Debug)]
pub(super) struct Room(AtomicUsize);

impl Room {
    pub(super) const fn new(bytes: usize) -> Self {
        Self(AtomicUsize::new(bytes))
    }

    /// A page, empty yet.
    pub(super) const fn output(&self) -> Output<'_> {
        Output { room: self, bytes: Vec::new() }
    }
}

/// A page while it is printed.
#[derive(Debug)]
pub(super) struct Output<'a> {
    room: &'a Room,
    bytes: Vec<u8>,
}

impl Output<'_> {
    pub(super) fn into_text(self) -> String {
        // Templates print whole texts, so that nothing is replaced.
        String::from_utf8(self.bytes)
            .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned())
    }
}

impl io::Write for Output<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let take = |room: usize| room.checked_sub(bytes.len());
        match self.room.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take) {
            Ok(_) => {
                self.bytes.extend_from_slice(bytes);
                Ok(bytes.len())
            }
            Err(_) => {
                let message = format!("the pages have more than {} MiB", OUTPUT >> 20);
                Err(io::Error::new(io::ErrorKind::FileTooLarge, message))
            }
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use super::*;

    #[test]
    fn pages_share_their_room() {
        let room = Room::new(3);
        let (mut one, mut other) = (room.output(), room.output());
        one.write_all("é".as_bytes()).unwrap();
        assert!(other.write_all(b"ab").is_err());
        other.write_all(b"a").unwrap();
        assert_eq!((one.into_text(), other.into_text()), ("é".to_owned(), "a".to_owned()));
    }
}
