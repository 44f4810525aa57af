//! Storage groups: what the stack stores and restores in one piece is one variable.

use od_spec::model::{Dictionary, Index, Storage, SubIndex};

/// Values that lie in one variable, because one command stores them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Group(pub Storage);

impl Group {
    /// All, in the order of the files.
    pub(super) const ALL: [Self; 5] = [
        Self(Storage::Communication),
        Self(Storage::Application),
        Self(Storage::Manufacturer),
        Self(Storage::Remanent),
        Self(Storage::No),
    ];

    /// `PERSIST_COMM`, of the variable `OD_PERSIST_COMM`.
    pub(super) const fn name(self) -> &'static str {
        match self.0 {
            Storage::Communication => "PERSIST_COMM",
            Storage::Application => "PERSIST_APP",
            Storage::Manufacturer => "PERSIST_MANUF",
            Storage::Remanent => "PERSIST_AUTO",
            Storage::No => "RAM",
        }
    }

    /// How the stack has to store it; `None` for what is lost at power-off.
    pub(super) fn storage(self, device: &Dictionary) -> Option<GroupStorage> {
        let has = |index: u16, sub: u8| {
            device.objects.get(&Index(index)).is_some_and(|object| object.entry(SubIndex(sub)).is_some())
        };
        let by_command = |sub: u8| {
            // The stack takes sub-index 1 for all groups.
            let on = |index: u16, flag: u8| if has(index, sub) || has(index, 1) { flag } else { 0 };
            GroupStorage { sub, attributes: on(0x1010, COMMAND) | on(0x1011, RESTORE) }
        };
        match self.0 {
            Storage::Communication => Some(by_command(2)),
            Storage::Application => Some(by_command(3)),
            Storage::Manufacturer => Some(by_command(4)),
            // The stack wants a number here, which no command is about.
            Storage::Remanent => Some(GroupStorage { sub: 127, attributes: AUTOMATIC }),
            Storage::No => None,
        }
    }
}

/// Stored by a command, 1010h.
pub(super) const COMMAND: u8 = 1;
/// Stored by the device itself.
pub(super) const AUTOMATIC: u8 = 2;
/// Restored by a command, 1011h.
pub(super) const RESTORE: u8 = 4;

/// What an entry of the stack's list of storage says about a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct GroupStorage {
    /// The sub-index of 1010h and 1011h.
    pub sub: u8,
    /// [`COMMAND`], [`AUTOMATIC`] and [`RESTORE`], as the stack adds them up.
    pub attributes: u8,
}
