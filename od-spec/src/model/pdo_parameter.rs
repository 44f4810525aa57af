//! What the parameter objects of a PDO hold, and what it is called where nothing else is stated.

use std::collections::BTreeMap;

use super::{Access, DataType, Direction, Index, Object, Storage, SubIndex};

/// An entry of the communication parameters of a PDO (CiA 301, object 22h).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CommunicationParameter {
    /// Highest sub-index.
    Count,
    /// COB-ID.
    CobId,
    /// Transmission type.
    Transmission,
    /// Inhibit time.
    InhibitTime,
    /// Without a meaning; devices that follow old versions of CiA 301 have it.
    Reserved,
    /// Event timer.
    EventTimer,
    /// SYNC start value.
    SyncStart,
}

impl CommunicationParameter {
    /// All, by sub-index.
    pub const ALL: [Self; 7] = [
        Self::Count,
        Self::CobId,
        Self::Transmission,
        Self::InhibitTime,
        Self::Reserved,
        Self::EventTimer,
        Self::SyncStart,
    ];

    /// Sub-index.
    pub const fn sub(self) -> u8 {
        match self {
            Self::Count => 0,
            Self::CobId => 1,
            Self::Transmission => 2,
            Self::InhibitTime => 3,
            Self::Reserved => 4,
            Self::EventTimer => 5,
            Self::SyncStart => 6,
        }
    }

    /// The key of a specification that is about it.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Count => "sub0",
            Self::CobId => "cob-id",
            Self::Transmission => "transmission",
            Self::InhibitTime => "inhibit-time",
            Self::Reserved => "reserved",
            Self::EventTimer => "event-timer",
            Self::SyncStart => "sync-start",
        }
    }

    /// Data type.
    pub const fn data_type(self) -> DataType {
        match self {
            Self::CobId => DataType::Unsigned32,
            Self::InhibitTime | Self::EventTimer => DataType::Unsigned16,
            Self::Count | Self::Transmission | Self::Reserved | Self::SyncStart => DataType::Unsigned8,
        }
    }

    /// Access where the specification says nothing.
    pub const fn usual_access(self) -> Access {
        match self {
            Self::Count | Self::Reserved => Access::Ro,
            Self::CobId | Self::Transmission | Self::InhibitTime | Self::EventTimer | Self::SyncStart => {
                Access::Rw
            }
        }
    }

    /// Name where the specification gives none.
    pub const fn usual_name(self, direction: Direction) -> &'static str {
        match (self, direction) {
            (Self::Count, _) => "highest sub-index supported",
            (Self::CobId, Direction::Receive) => "COB-ID used by RPDO",
            (Self::CobId, Direction::Transmit) => "COB-ID used by TPDO",
            (Self::Transmission, _) => "transmission type",
            (Self::InhibitTime, _) => "inhibit time",
            (Self::Reserved, _) => "reserved",
            (Self::EventTimer, _) => "event timer",
            (Self::SyncStart, _) => "SYNC start value",
        }
    }
}

/// What keeps the parameters of PDOs that can be written, where the specification says nothing: a device that stores communication
/// parameters (1010h.2), or all of them (1010h.1), stores these.
pub fn usual_pdo_storage(objects: &BTreeMap<Index, Object>) -> Storage {
    let stores = |store: &Object| [1, 2].into_iter().any(|sub| store.entry(SubIndex(sub)).is_some());
    match objects.get(&Index(0x1010)) {
        Some(store) if stores(store) => Storage::Communication,
        Some(_) | None => Storage::No,
    }
}

/// Patterns of the names that the parameter objects of PDOs have where the specification gives none.
pub mod usual {
    use super::Direction;

    /// The communication parameter object.
    pub const fn communication(direction: Direction) -> &'static str {
        match direction {
            Direction::Receive => "RPDO {pdo} communication parameter",
            Direction::Transmit => "TPDO {pdo} communication parameter",
        }
    }

    /// The mapping parameter object.
    pub const fn mapping(direction: Direction) -> &'static str {
        match direction {
            Direction::Receive => "RPDO {pdo} mapping parameter",
            Direction::Transmit => "TPDO {pdo} mapping parameter",
        }
    }

    /// Sub-index 0 of the mapping parameter object.
    pub const MAPPED: &str = "number of mapped entries";

    /// An entry of the mapping parameter object.
    pub const ENTRY: &str = "mapped entry {n}";
}
