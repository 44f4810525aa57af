//! How much a file may describe. A few lines can describe millions of entries: a run of indices, of arrays, on many
//! devices. What no device has is refused before it is made.

/// Devices of a file. A network has 127 nodes; a file may describe a family of products.
pub(crate) const DEVICES: usize = 1_000;
/// Entries of a device. The largest devices have some thousands.
pub(crate) const ENTRIES_OF_DEVICE: usize = 100_000;
/// Entries of all devices of a file.
pub(crate) const ENTRIES_OF_FILE: usize = 200_000;
/// Tables that the places of all errata of a file name: each may name all of them.
pub(crate) const TABLES_OF_ERRATA: usize = 20_000;
/// States of a state machine. Transitions have the numbers 0 to 255, so that more could not be reached one by one.
pub(crate) const STATES: usize = 256;
/// Steps of a sequence of events. A picture of more would be too wide to be read.
pub(crate) const TIMING_STEPS: usize = 64;
/// Signals of a sequence of events.
pub(crate) const TIMING_SIGNALS: usize = 32;
/// Switches with a hysteresis in one picture: each is compared with the others.
pub(crate) const SWITCHES: usize = 32;
/// Blocks of a diagram: a picture of more would not be read.
pub(crate) const BLOCKS: usize = 48;
/// Arrows of a diagram: each is drawn around the others.
pub(crate) const ARROWS: usize = 96;
/// Marks of an axis.
pub(crate) const MARKS: usize = 16;
/// Spans of an axis.
pub(crate) const SPANS: usize = 32;
/// Nodes of a plant. The largest have some thousands.
pub(crate) const NODES_OF_PLANT: usize = 100_000;
/// Bytes that are written once and count many times: the texts of a run, of the elements of an array, of an object that
/// several devices have. It is the size of the largest file.
pub(crate) const REPEATED_TEXT: usize = 64 << 20;

/// What is left of the limits of a file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Room {
    entries: usize,
    text: usize,
}

/// A limit that was reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Full {
    /// There are too many entries.
    Entries,
    /// There is too much text.
    Text,
}

impl Full {
    /// What there is too much of, as part of a message.
    pub(crate) fn words(self, entries: usize) -> String {
        match self {
            Self::Entries => format!("more than {entries} entries"),
            Self::Text => format!("more than {} MiB of repeated text", REPEATED_TEXT >> 20),
        }
    }
}

impl Room {
    /// Nothing is described yet; there may be this many entries.
    pub(crate) const fn new(entries: usize) -> Self {
        Self { entries, text: REPEATED_TEXT }
    }

    /// Takes the room of entries, and of text that is repeated for them. What does not fit takes none.
    pub(crate) const fn take(&mut self, entries: usize, text: usize) -> Result<(), Full> {
        let (Some(entries), Some(text)) = (self.entries.checked_sub(entries), self.text.checked_sub(text))
        else {
            return Err(if entries > self.entries { Full::Entries } else { Full::Text });
        };
        *self = Self { entries, text };
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_takes_no_room() {
        let mut room = Room::new(3);
        assert_eq!(room.take(4, 0), Err(Full::Entries));
        assert_eq!(room.take(1, REPEATED_TEXT + 1), Err(Full::Text));
        assert_eq!(room.take(3, REPEATED_TEXT), Ok(()));
        assert_eq!(room.take(0, 0), Ok(()));
        assert_eq!(room.take(1, 0), Err(Full::Entries));
    }
}
