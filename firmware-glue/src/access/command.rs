//! What a client stores and restores by 1010h and 1011h (CiA 301 9.6.3).

use crate::abort::AbortCode;
use crate::table::Storage;
use crate::table::entry::EntryId;

/// The groups that a client stores: those of sub-index 1.
pub const ALL: [Storage; 3] = [Storage::Communication, Storage::Application, Storage::Manufacturer];

/// What a client commands by a signature in 1010h or 1011h.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Command {
    /// Store the values of now (1010h), by sub-index.
    Save(u8),
    /// The factory's values, from the next reset on (1011h), by sub-index.
    Restore(u8),
}

impl Command {
    /// The command of an entry, if it is one.
    #[must_use]
    pub const fn of(entry: EntryId) -> Option<Self> {
        match (entry.index, entry.sub) {
            (0x1010, sub @ 1..=127) => Some(Self::Save(sub)),
            (0x1011, sub @ 1..=127) => Some(Self::Restore(sub)),
            _ => None,
        }
    }

    /// The command that a client gives by a value of an entry: its signature, and nothing else.
    pub(crate) fn given(entry: EntryId, value: u32) -> Result<Self, AbortCode> {
        Self::of(entry).filter(|command| value == command.signature()).ok_or(AbortCode::NOT_STORED)
    }

    const fn signature(self) -> u32 {
        match self {
            Self::Save(_) => u32::from_le_bytes(*b"save"),
            Self::Restore(_) => u32::from_le_bytes(*b"load"),
        }
    }

    /// The groups that it is about (CiA 301 9.6.3, 1010h): sub-index 1 all, 2 communication, 3 application, others the manufacturer's.
    #[must_use]
    pub const fn groups(self) -> &'static [Storage] {
        let (Self::Save(sub) | Self::Restore(sub)) = self;
        match sub {
            1 => &ALL,
            2 => &[Storage::Communication],
            3 => &[Storage::Application],
            4..=127 => &[Storage::Manufacturer],
            _ => &[],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::access::dictionary::Dictionary;
    use crate::access::test_table::{dictionary, value};

    #[test]
    fn a_command_is_given_by_its_signature_alone() {
        let given =
            |index, sub, value: &[u8; 4]| Command::given(EntryId { index, sub }, u32::from_le_bytes(*value));
        assert_eq!(given(0x1010, 1, b"save"), Ok(Command::Save(1)));
        assert_eq!(given(0x1011, 2, b"load"), Ok(Command::Restore(2)));
        for (index, sub, value) in
            [(0x1010, 1, b"load"), (0x1011, 1, b"save"), (0x1010, 1, b"evas"), (0x1010, 128, b"save")]
        {
            assert_eq!(given(index, sub, value), Err(AbortCode::NOT_STORED));
        }
    }

    /// A client whose command succeeds relies on the memory.
    #[test]
    fn an_application_without_a_store_refuses_to_store() {
        let values =
            [value(0x1010, 0, 1, 1), value(0x1010, 1, 4, 0), value(0x1011, 0, 1, 1), value(0x1011, 1, 4, 0)];
        let mut od = dictionary(&values);
        assert_eq!(od.write(0x1010, 1, b"save", &mut ()), Err(AbortCode::NOT_STORED));
        assert_eq!(od.write(0x1011, 1, b"load", &mut ()), Err(AbortCode::NOT_STORED));
    }

    #[test]
    fn commands_are_those_of_1010h_and_1011h() {
        let of = |index, sub| Command::of(EntryId { index, sub });
        assert_eq!((of(0x1010, 1), of(0x1011, 127)), (Some(Command::Save(1)), Some(Command::Restore(127))));
        assert_eq!((of(0x1010, 0), of(0x1011, 128), of(0x1012, 1)), (None, None, None));
        assert_eq!(Command::Save(1).groups(), ALL);
        assert_eq!(Command::Save(2).groups(), [Storage::Communication]);
        assert_eq!(Command::Restore(3).groups(), [Storage::Application]);
        assert_eq!(Command::Restore(4).groups(), [Storage::Manufacturer]);
    }
}
