//! Storage groups: what the stack stores and restores in one piece is one variable.

use od_spec::model::{Author, Dictionary, Entry, EntryId, Fact, Index, Object, Storage, SubIndex};
use od_spec::order::Arrange as _;

/// Values that lie in one variable, because one command stores them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Group<'a> {
    /// `PERSIST_COMM`, of the variable `OD_PERSIST_COMM`.
    pub name: &'a str,
    /// What stores it.
    pub storage: Storage,
}

impl<'a> Group<'a> {
    /// What can store a group, in the order of the files.
    const ORDER: [Storage; 5] =
        [Storage::Communication, Storage::Application, Storage::Manufacturer, Storage::Remanent, Storage::No];

    /// The group of an entry of an object: the one that the file names, or else that of what stores the entry. CANopenEditor
    /// has no place in a group for what has no default.
    pub(super) fn of(object: &'a Object, entry: &Entry, storage: Storage) -> Self {
        let has_length = entry.facts.is_said_by(Fact::Capacity, Author::Maker);
        let named = object.editor.as_ref().and_then(|notes| notes.storage_group.as_deref());
        let named = named.filter(|_| entry.default.is_some() || has_length);
        match named {
            Some(name) => Self { name, storage: Storage::of_group(name) },
            None => Self { name: Self::usual(storage), storage },
        }
    }

    /// Each group once, in the order of the files.
    pub(super) fn in_order(groups: impl Iterator<Item = Self>) -> Vec<Self> {
        let mut groups: Vec<Self> = groups.collect();
        groups.arrange_by_key(|group| (Self::ORDER.iter().position(|one| *one == group.storage), group.name));
        groups.dedup();
        groups
    }

    /// Whether it is called as it is where the file does not name it.
    pub(super) fn is_usual(self) -> bool {
        self.name == Self::usual(self.storage)
    }

    /// The name of a group that the file does not name.
    const fn usual(storage: Storage) -> &'static str {
        match storage {
            Storage::Communication => "PERSIST_COMM",
            Storage::Application => "PERSIST_APP",
            Storage::Manufacturer => "PERSIST_MANUF",
            Storage::Remanent => "PERSIST_AUTO",
            Storage::No => "RAM",
        }
    }

    /// How the stack has to store it; `None` for what is lost at power-off.
    pub(super) fn stored(self, device: &Dictionary) -> Option<GroupStorage> {
        let has = |index: u16, sub: u8| {
            device.objects.get(&Index(index)).is_some_and(|object| object.entry(SubIndex(sub)).is_some())
        };
        let by_command = |sub: u8| {
            // The stack takes sub-index 1 for all groups.
            let on = |index: u16, flag: u8| if has(index, sub) || has(index, 1) { flag } else { 0 };
            GroupStorage { sub, attributes: on(0x1010, COMMAND) | on(0x1011, RESTORE) }
        };
        match self.storage {
            Storage::Communication => Some(by_command(2)),
            Storage::Application => Some(by_command(3)),
            Storage::Manufacturer => Some(by_command(4)),
            // The stack wants a number here, which no command is about.
            Storage::Remanent => Some(GroupStorage { sub: 127, attributes: AUTOMATIC }),
            Storage::No => None,
        }
    }
}

/// Whether a command of 1010h or 1011h, by its sub-index, is about groups of a device; `None` for what is no command.
pub(super) fn has_groups(device: &Dictionary, groups: &[Group<'_>], command: EntryId) -> Option<bool> {
    let flag = match command.index.0 {
        0x1010 => COMMAND,
        0x1011 => RESTORE,
        _ => return None,
    };
    let sub = command.sub.0;
    let stored = || groups.iter().filter_map(|group| group.stored(device));
    // The stack takes sub-index 1 for all groups.
    let is_about = |group: GroupStorage| group.attributes & flag != 0 && (sub == 1 || group.sub == sub);
    (sub > 0).then(|| stored().any(is_about))
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
