//! What standards say of an entry, for a device that says nothing of itself.

use std::collections::BTreeMap;

use od_bus::client::{Found, Holds};
use od_spec::model::{
    Access, CommunicationParameter, DataType, Direction, Entry, EntryId, Index, Object, ObjectKind,
    PdoMapping, Role, SubIndex, usual_pdo_names,
};
use od_spec::{Library, library};

/// What is known of an entry.
pub(super) struct KnownEntry {
    pub(super) name: String,
    pub(super) data_type: DataType,
    pub(super) access: Access,
    pub(super) mapping: PdoMapping,
    /// `ObjFlags` of an EDS.
    pub(super) flags: u32,
}

/// What is known of an object.
pub(super) struct KnownObject {
    pub(super) name: String,
    pub(super) kind: ObjectKind,
}

/// The standards that apply to a device.
pub(super) struct Known(Vec<Library>);

/// 1200h, whose parameters every SDO server has.
const FIRST_SERVER: Index = Index(0x1200);
/// The last server.
const LAST_SERVER: u16 = 0x127F;

impl Known {
    /// Those of a device with this device type: its low half names a profile.
    pub(super) fn of(device_type: u32) -> Self {
        let profile = match device_type & 0xFFFF {
            401 => Some("cia401"),
            402 => Some("cia402"),
            _ => None,
        };
        Self(["cia301", "cia302"].into_iter().chain(profile).filter_map(library).collect())
    }

    /// What they say of an object.
    pub(super) fn object(&self, index: Index) -> Option<KnownObject> {
        if let Some(pdo) = pdo(index) {
            let pattern = if pdo.is_mapping {
                usual_pdo_names::mapping(pdo.direction)
            } else {
                usual_pdo_names::communication(pdo.direction)
            };
            let name = pattern.replace("{pdo}", &pdo.number.to_string());
            return Some(KnownObject { name, kind: ObjectKind::Record });
        }
        if let Some(number) = further_server(index) {
            return Some(KnownObject {
                name: format!("SDO server parameter {number}"),
                kind: ObjectKind::Record,
            });
        }
        self.of_library(index).map(|(object, _)| KnownObject { name: object.name.clone(), kind: object.kind })
    }

    /// What they say of an entry.
    pub(super) fn entry(&self, id: EntryId) -> Option<KnownEntry> {
        if let Some(pdo) = pdo(id.index) {
            return pdo.entry(id.sub);
        }
        let index = further_server(id.index).map_or(id.index, |_| FIRST_SERVER);
        let (object, further) = self.of_library(index)?;
        let entry = object.entry(id.sub).or_else(|| further.iter().find(|entry| entry.sub == id.sub))?;
        let name = if object.is_structured() { entry.name.clone() } else { object.name.clone() };
        let access = entry.access.joined(entry.pdo);
        Some(KnownEntry {
            name,
            data_type: entry.data_type,
            access,
            mapping: entry.pdo,
            flags: entry.eds.flags(),
        })
    }

    fn of_library(&self, index: Index) -> Option<(&Object, &[Entry])> {
        let of = |library: &'_ Library| library.objects.contains_key(&index);
        let object = self.0.iter().find(|library| of(library))?.objects.get(&index)?;
        Some((&object.object, &object.further))
    }
}

/// The number of an SDO server that is not the first.
fn further_server(index: Index) -> Option<u16> {
    (FIRST_SERVER.0 + 1..=LAST_SERVER).contains(&index.0).then(|| index.0 - FIRST_SERVER.0 + 1)
}

/// A parameter object of a PDO.
struct PdoObject {
    direction: Direction,
    number: u16,
    is_mapping: bool,
}

/// The PDO that an object is a parameter of.
fn pdo(index: Index) -> Option<PdoObject> {
    if !Role::of(index).is_pdo_parameter() {
        return None;
    }
    let direction = if index.0 < 0x1800 { Direction::Receive } else { Direction::Transmit };
    let from_first = index.0 - direction.first_communication_index();
    Some(PdoObject { direction, number: from_first % 0x200 + 1, is_mapping: from_first >= 0x200 })
}

impl PdoObject {
    fn entry(&self, sub: SubIndex) -> Option<KnownEntry> {
        let (name, data_type, access) = if self.is_mapping {
            match sub.0 {
                0 => (usual_pdo_names::MAPPED.to_owned(), DataType::Unsigned8, Access::Rw),
                n => {
                    (usual_pdo_names::ENTRY.replace("{n}", &n.to_string()), DataType::Unsigned32, Access::Rw)
                }
            }
        } else {
            let parameter = CommunicationParameter::ALL.into_iter().find(|one| one.sub() == sub.0)?;
            let name = parameter.usual_name(self.direction).to_owned();
            (name, parameter.data_type(), parameter.usual_access())
        };
        Some(KnownEntry { name, data_type, access, mapping: PdoMapping::None, flags: 0 })
    }
}

/// An entry's place in the PDOs of a device.
#[derive(Clone, Copy)]
pub(super) struct Mapped {
    pub(super) mapping: PdoMapping,
    pub(super) bits: u8,
}

/// A number of four bytes.
pub(super) fn number(holds: &Holds) -> Option<u32> {
    let Holds::Bytes(bytes) = holds else { return None };
    bytes.as_slice().try_into().map(u32::from_le_bytes).ok()
}

/// What the PDOs of a device carry, by what its mapping objects hold.
pub(super) fn mapped(found: &[Found]) -> BTreeMap<EntryId, Mapped> {
    let numbers = found.iter().filter_map(|one| Some((one.id, number(&one.holds)?)));
    all_mapped(numbers)
}

fn all_mapped(values: impl Iterator<Item = (EntryId, u32)>) -> BTreeMap<EntryId, Mapped> {
    let mut all: BTreeMap<EntryId, Mapped> = BTreeMap::new();
    for (id, value) in values.filter(|(_, value)| *value != 0) {
        let Some(PdoObject { direction, is_mapping: true, .. }) = pdo(id.index) else { continue };
        let [bits, sub, low, high] = value.to_le_bytes();
        let index = Index(u16::from_le_bytes([low, high]));
        let mapping = match direction {
            Direction::Receive => PdoMapping::Receive,
            Direction::Transmit => PdoMapping::Transmit,
        };
        let target = EntryId { index, sub: SubIndex(sub) };
        let before = all.get(&target).map_or(mapping, |mapped| mapped.mapping);
        let mapping = if before == mapping { mapping } else { PdoMapping::Both };
        all.insert(target, Mapped { mapping, bits });
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_of_pdos_have_the_names_of_their_pdo() {
        let known = Known::of(402);
        let name = |index| known.object(Index(index)).unwrap().name;
        assert_eq!(name(0x1400), "RPDO 1 communication parameter");
        assert_eq!(name(0x1603), "RPDO 4 mapping parameter");
        assert_eq!(name(0x19FF), "TPDO 512 communication parameter");
        assert_eq!(name(0x1A01), "TPDO 2 mapping parameter");
        assert_eq!(name(0x1201), "SDO server parameter 2");
        let entry = |index, sub| known.entry(EntryId { index: Index(index), sub: SubIndex(sub) });
        assert_eq!(entry(0x1800, 5).unwrap().data_type, DataType::Unsigned16);
        assert_eq!(entry(0x1800, 9).map(|entry| entry.name), None);
        assert_eq!(entry(0x6041, 0).unwrap().data_type, DataType::Unsigned16);
        assert!(Known::of(0).object(Index(0x6041)).is_none());
    }

    #[test]
    fn an_entry_in_pdos_of_both_directions_is_reported_as_that() {
        let id = |index, sub| EntryId { index: Index(index), sub: SubIndex(sub) };
        let values =
            [(id(0x1600, 1), 0x2000_0110), (id(0x1A00, 1), 0x2000_0110), (id(0x1A00, 2), 0x2001_0008)];
        let all = all_mapped(values.into_iter().chain([(id(0x1A00, 3), 0), (id(0x1800, 1), 0x185)]));
        let reported: Vec<_> = all.iter().map(|(id, one)| (id.index.0, one.mapping, one.bits)).collect();
        assert_eq!(reported, [(0x2000, PdoMapping::Both, 16), (0x2001, PdoMapping::Transmit, 8)]);
    }
}
