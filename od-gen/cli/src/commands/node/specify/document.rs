//! What a node answered as an EDS.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use od_bus::client::{Found, Holds};
use od_import::yaml::Place;
use od_spec::ascii::is_printable;
use od_spec::eds::{Document, Section};
use od_spec::model::{
    Access, BIT_RATES, DataType, Direction, EntryId, Family, Index, ObjectKind, PdoMapping, Role, SubIndex,
};

use super::known::{Known, Mapped, mapped, number};

/// An EDS of a node, with remarks that have no place in it.
pub(super) struct Described {
    pub(super) document: Document<'static>,
    pub(super) comments: BTreeMap<Place, Vec<String>>,
}

/// What a node answered.
pub(super) struct Findings<'a> {
    pub(super) node: u8,
    /// In kbit/s, where the user says it.
    pub(super) bit_rate: Option<u16>,
    /// Entries in order.
    found: BTreeMap<EntryId, &'a Holds>,
    known: Known,
    mapped: BTreeMap<EntryId, Mapped>,
}

/// Longer values that are not text are blocks.
const LONGEST_OCTETS: usize = 255;

/// 1028h, in which 0 is the identifier of no emergency message.
const EMERGENCY_CONSUMER: Index = Index(0x1028);
const DEVICE_TYPE: EntryId = id(0x1000, 0);
const NAME: EntryId = id(0x1008, 0);
const VENDOR: EntryId = id(0x1018, 1);
const PRODUCT: EntryId = id(0x1018, 2);
const REVISION: EntryId = id(0x1018, 3);
const SERIAL_NUMBER: EntryId = id(0x1018, 4);

const fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

impl<'a> Findings<'a> {
    pub(super) fn new(node: u8, bit_rate: Option<u16>, found: &'a [Found]) -> Self {
        let mapped = mapped(found);
        let found: BTreeMap<EntryId, &Holds> = found.iter().map(|one| (one.id, &one.holds)).collect();
        let device_type = found.get(&DEVICE_TYPE).and_then(|holds| number(holds));
        Self { node, bit_rate, found, known: Known::of(device_type.unwrap_or(0)), mapped }
    }

    fn number(&self, id: EntryId) -> Option<u32> {
        number(self.found.get(&id)?)
    }

    /// The EDS, under the name of a file.
    pub(super) fn described(&self, file: &str) -> Described {
        let mut document = Document::default();
        let mut comments = BTreeMap::new();
        let mut section = Section::new("FileInfo");
        section.push("FileName", file);
        for (key, value) in [("FileVersion", "1"), ("FileRevision", "0"), ("EDSVersion", "4.0")] {
            section.push(key, value);
        }
        document.push(section);
        document.push(self.device_info());
        document.push(self.dummies());
        let indices: BTreeSet<Index> = self.found.keys().map(|id| id.index).collect();
        for (list, is_in) in LISTS {
            let mut section = Section::new(list);
            let objects: Vec<Index> = indices.iter().copied().filter(|index| is_in(*index)).collect();
            section.push("SupportedObjects", &objects.len().to_string());
            for (number, index) in (1..).zip(&objects) {
                section.push(&number.to_string(), &format!("0x{:04X}", index.0));
            }
            document.push(section);
            for index in objects {
                self.object(index, &mut document, &mut comments);
            }
        }
        Described { document, comments }
    }

    fn device_info(&self) -> Section {
        let mut section = Section::new("DeviceInfo");
        let number = |id| format!("0x{:08X}", self.number(id).unwrap_or(0));
        let name = self.found.get(&NAME).and_then(|holds| text(holds)).unwrap_or_default();
        section.push("VendorName", "");
        section.push("VendorNumber", &number(VENDOR));
        let unnamed = format!("Node {}", self.node);
        section.push("ProductName", if name.trim().is_empty() { &unnamed } else { name.trim() });
        section.push("ProductNumber", &number(PRODUCT));
        section.push("RevisionNumber", &number(REVISION));
        section.push("OrderCode", "");
        let flag = |is_set| if is_set { "1" } else { "0" };
        for rate in BIT_RATES {
            section.push(&format!("BaudRate_{rate}"), flag(self.bit_rate == Some(rate)));
        }
        section.push("SimpleBootUpMaster", "0");
        section.push("SimpleBootUpSlave", "1");
        let granularity = if self.mapped.values().all(|mapped| mapped.bits % 8 == 0) { "8" } else { "1" };
        section.push("Granularity", granularity);
        section.push("DynamicChannelsSupported", "0");
        section.push("GroupMessaging", "0");
        for (key, direction) in [("NrOfRXPDO", Direction::Receive), ("NrOfTXPDO", Direction::Transmit)] {
            let first = direction.first_communication_index();
            let pdos = first..=first + 0x1FF;
            let indices: BTreeSet<Index> = self.found.keys().map(|id| id.index).collect();
            let count = indices.iter().filter(|index| pdos.contains(&index.0)).count();
            section.push(key, &count.to_string());
        }
        section.push("LSS_Supported", "0");
        section
    }

    /// The placeholders that mappings hold.
    fn dummies(&self) -> Section {
        let mut section = Section::new("DummyUsage");
        for data_type in DataType::ALL.into_iter().filter(|data_type| data_type.is_dummy()) {
            let is_used = self.mapped.contains_key(&id(data_type.code(), 0));
            section.push(&format!("Dummy{:04X}", data_type.code()), if is_used { "1" } else { "0" });
        }
        section
    }

    fn object(&self, index: Index, document: &mut Document<'_>, comments: &mut BTreeMap<Place, Vec<String>>) {
        let mut remark = |place, remark: Option<String>| {
            if let Some(remark) = remark {
                comments.entry(place).or_default().push(remark);
            }
        };
        let known = self.known.object(index);
        let name = known.as_ref().map_or_else(|| format!("Object {index}"), |known| known.name.clone());
        let entries: Vec<(EntryId, &Holds)> = self
            .found
            .range(id(index.0, 0)..=id(index.0, u8::MAX))
            .map(|(id, holds)| (*id, *holds))
            .collect();
        let section_name = format!("{:04X}", index.0);
        let structure = known
            .map(|known| known.kind)
            .filter(|kind| matches!(kind, ObjectKind::Array | ObjectKind::Record));
        if let ([(id, holds)], None) = (entries.as_slice(), structure)
            && id.sub == SubIndex(0)
        {
            let line = self.line(*id, holds);
            remark(Place::Object(index), line.remark.clone());
            document.push(line.section(&section_name, &name));
            return;
        }
        let mut lines: Vec<(EntryId, Line)> =
            entries.iter().map(|(id, holds)| (*id, self.line(*id, holds))).collect();
        let highest = entries.last().map_or(0, |(id, _)| id.sub.0);
        if lines.first().is_none_or(|(id, _)| id.sub != SubIndex(0)) {
            let said = "sub-index 0 does not answer; the highest one that does is taken for it".to_owned();
            remark(Place::Object(index), Some(said));
            lines.insert(0, (id(index.0, 0), Line::count(highest)));
        }
        let mut section = Section::new(&section_name);
        section.push("SubNumber", &lines.len().to_string());
        section.push("ParameterName", &name);
        let otherwise = if are_alike(&lines) { ObjectKind::Array } else { ObjectKind::Record };
        let kind = structure.unwrap_or(otherwise);
        section.push("ObjectType", &format!("0x{:X}", kind.code()));
        document.push(section);
        for (id, line) in lines {
            remark(Place::Entry(id), line.remark.clone());
            let name = self.name(id);
            document.push(line.section(&format!("{section_name}sub{:X}", id.sub.0), &name));
        }
    }

    /// The name of an entry of an object with several.
    fn name(&self, id: EntryId) -> String {
        match self.known.entry(id) {
            Some(known) => known.name,
            None if id.sub == SubIndex(0) => "Highest sub-index supported".to_owned(),
            None => format!("Entry {}", id.sub.0),
        }
    }

    /// What an EDS says of an entry.
    fn line(&self, id: EntryId, holds: &Holds) -> Line {
        let known = self.known.entry(id);
        let mapped = self.mapped.get(&id).copied();
        let known_type = known.as_ref().map(|known| known.data_type);
        let data_type = data_type(holds, known_type, mapped);
        let mapping = mapped.map_or(PdoMapping::None, |mapped| mapped.mapping);
        let known_mapping = known.as_ref().map_or(PdoMapping::None, |known| known.mapping);
        let access = match (holds, known.as_ref().map(|known| known.access), mapping) {
            (Holds::WriteOnly, _, _) => Access::Wo,
            // What takes values from RPDOs can be written.
            (_, None | Some(Access::Ro | Access::Const | Access::Wo), PdoMapping::Receive) => Access::Rww,
            (
                _,
                None | Some(Access::Ro | Access::Const | Access::Wo | Access::Rww | Access::Rwr),
                PdoMapping::Both,
            ) => Access::Rw,
            (_, Some(Access::Rwr), PdoMapping::Receive) | (_, Some(Access::Rww), PdoMapping::Transmit) => {
                Access::Rw
            }
            (_, None | Some(Access::Wo), _) => Access::Ro,
            (_, Some(access), _) => access,
        };
        let default = if self.is_of_type(id, access, mapping) {
            self.default(id, data_type.unwrap_or(DataType::Domain), holds)
        } else {
            None
        };
        let access = if access == Access::Const && default.is_none() { Access::Ro } else { access };
        Line {
            data_type: data_type.unwrap_or(DataType::Domain),
            access,
            is_mappable: mapping != PdoMapping::None || known_mapping != PdoMapping::None,
            flags: known.as_ref().map_or(0, |known| known.flags),
            default,
            remark: remark(holds, data_type),
        }
    }

    /// Whether the value of an entry is that of all such devices, as far as is known: not of this one, not of this moment, and no command.
    fn is_of_type(&self, id: EntryId, access: Access, mapping: PdoMapping) -> bool {
        let is_of_this_one = id == SERIAL_NUMBER || matches!(id.index.0, 0x1001..=0x1003 | 0x1013);
        let is_command = match Role::of(id.index) {
            Role::StoreParameters | Role::RestoreDefaults => id.sub != SubIndex(0),
            _ => matches!(id.index.0, 0x1F50..=0x1F5F) && id.sub != SubIndex(0),
        };
        // What a profile says can only be read is measured.
        let is_measured = Role::of(id.index) == Role::DeviceProfile
            && access == Access::Ro
            && id.sub == SubIndex(0)
            && self.known.object(id.index).is_some_and(|object| object.kind == ObjectKind::Var);
        !is_of_this_one && !is_command && !is_measured && mapping == PdoMapping::None
    }

    fn default(&self, id: EntryId, data_type: DataType, holds: &Holds) -> Option<String> {
        let Holds::Bytes(bytes) = holds else { return None };
        match data_type.family() {
            Family::Boolean | Family::Signed | Family::Unsigned => {
                let mut all = [0; 8];
                all.get_mut(..bytes.len())?.copy_from_slice(bytes);
                let raw = u64::from_le_bytes(all);
                if data_type.is_signed() {
                    let above = 64 - 8 * u32::try_from(bytes.len()).ok()?;
                    return Some(((raw << above).cast_signed() >> above).to_string());
                }
                if id.index == EMERGENCY_CONSUMER && raw == 0 {
                    return None;
                }
                Some(self.formula(id, raw).unwrap_or_else(|| match Role::of(id.index) {
                    Role::PdoMapping | Role::PdoCommunication if bytes.len() == 4 => format!("0x{raw:08X}"),
                    _ => raw.to_string(),
                }))
            }
            Family::Real => {
                let real = match bytes.as_slice() {
                    &[a, b, c, d] => f64::from(f32::from_le_bytes([a, b, c, d])),
                    eight => f64::from_le_bytes(eight.try_into().ok()?),
                };
                real.is_finite().then(|| format!("{real:?}"))
            }
            Family::VisibleString => text(holds).filter(|text| text.trim() == text && !text.is_empty()),
            Family::OctetString => Some(hexadecimal(bytes)).filter(|text| !text.is_empty()),
            Family::UnicodeString | Family::Time | Family::Domain => None,
        }
    }

    /// A COB-ID of the predefined connection set, which follows the node-ID (CiA 301 v4.02, 9.3.5.3).
    fn formula(&self, id: EntryId, raw: u64) -> Option<String> {
        let base = |cob_id: u64| cob_id & 0x780;
        let is_predefined = match (Role::of(id.index), id.index.0, id.sub.0) {
            (Role::PdoCommunication, _, 1) => (0x180..=0x500).contains(&base(raw)),
            (Role::SdoServer, _, 1) => base(raw) == 0x600,
            (Role::SdoServer, _, 2) => base(raw) == 0x580,
            (_, 0x1014, 0) => base(raw) == 0x80,
            _ => false,
        };
        // Bits 11 to 28 belong to identifiers with 29 bits.
        let is_own = raw & 0x1FFF_F800 == 0 && raw & 0x7F == u64::from(self.node);
        (is_predefined && is_own).then(|| format!("$NODEID+0x{:X}", raw - u64::from(self.node)))
    }
}

/// Which objects a list of an EDS has.
type IsIn = fn(Index) -> bool;

const LISTS: [(&str, IsIn); 3] = [
    ("MandatoryObjects", is_mandatory),
    ("OptionalObjects", |index| !is_mandatory(index) && Role::of(index) != Role::Manufacturer),
    ("ManufacturerObjects", |index| Role::of(index) == Role::Manufacturer),
];

const fn is_mandatory(index: Index) -> bool {
    matches!(Role::of(index), Role::DeviceType | Role::ErrorRegister | Role::Identity)
}

/// What an EDS says of an entry.
struct Line {
    data_type: DataType,
    access: Access,
    is_mappable: bool,
    flags: u32,
    default: Option<String>,
    remark: Option<String>,
}

impl Line {
    /// Sub-index 0 of an object.
    fn count(highest: u8) -> Self {
        Self {
            data_type: DataType::Unsigned8,
            access: Access::Ro,
            is_mappable: false,
            flags: 0,
            default: Some(highest.to_string()),
            remark: None,
        }
    }

    fn section(&self, section: &str, name: &str) -> Section {
        let mut section = Section::new(section);
        section.push("ParameterName", name);
        let kind = if self.data_type == DataType::Domain { ObjectKind::Domain } else { ObjectKind::Var };
        section.push("ObjectType", &format!("0x{:X}", kind.code()));
        section.push("DataType", &format!("0x{:04X}", self.data_type.code()));
        section.push("AccessType", self.access.word());
        if let Some(default) = &self.default {
            section.push("DefaultValue", default);
        }
        if self.data_type != DataType::Domain {
            section.push("PDOMapping", if self.is_mappable { "1" } else { "0" });
        }
        if self.flags != 0 {
            section.push("ObjFlags", &self.flags.to_string());
        }
        section
    }
}

/// Whether the elements of an object are those of an array.
fn are_alike(lines: &[(EntryId, Line)]) -> bool {
    let elements = lines.get(1..).unwrap_or_default();
    let first = elements.first().map(|(_, line)| (line.data_type, line.access));
    elements.len() > 1
        && elements.iter().enumerate().all(|(at, (id, line))| {
            usize::from(id.sub.0) == at + 1 && Some((line.data_type, line.access)) == first
        })
}

/// `00FF`: bytes as an EDS has them.
pub(super) fn hexadecimal<'b>(bytes: impl IntoIterator<Item = &'b u8>) -> String {
    bytes.into_iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02X}");
        text
    })
}

/// A text, without the zeros after it.
fn text(holds: &Holds) -> Option<String> {
    let Holds::Bytes(bytes) = holds else { return None };
    let text = std::str::from_utf8(bytes).ok()?.trim_end_matches('\0');
    is_printable(text).then(|| text.to_owned())
}

/// The type of an entry: what a standard says where that fits, or else what a PDO carries of it, or how long it is. `None` where
/// nothing states.
fn data_type(holds: &Holds, known: Option<DataType>, mapped: Option<Mapped>) -> Option<DataType> {
    let mapped = mapped.and_then(|mapped| unsigned(mapped.bits));
    let Holds::Bytes(bytes) = holds else { return known.or(mapped) };
    let fits = |data_type: &DataType| {
        data_type.bits().is_none_or(|bits| usize::from(bits.div_ceil(8)) == bytes.len())
    };
    let by_length = || match bytes.len() {
        0 => DataType::VisibleString,
        1 => DataType::Unsigned8,
        2 => DataType::Unsigned16,
        4 => DataType::Unsigned32,
        8 => DataType::Unsigned64,
        _ if text(holds).is_some() => DataType::VisibleString,
        length if length <= LONGEST_OCTETS => DataType::OctetString,
        _ => DataType::Domain,
    };
    Some(known.filter(fits).or_else(|| mapped.filter(fits)).unwrap_or_else(by_length))
}

/// The unsigned type of so many bits.
fn unsigned(bits: u8) -> Option<DataType> {
    let types = DataType::ALL.into_iter();
    let mut types = types.filter(|data_type| data_type.is_unsigned() || *data_type == DataType::Boolean);
    types.find(|data_type| data_type.bits() == Some(bits.into()))
}

/// What the specification is to say where it does not know.
fn remark(holds: &Holds, data_type: Option<DataType>) -> Option<String> {
    let why = match holds {
        Holds::Bytes(_) => return None,
        Holds::WriteOnly => "it can only be written".to_owned(),
        Holds::Unreported(error) => format!("it could not be read ({error})"),
    };
    Some(match data_type {
        Some(_) => why,
        None => format!("type not known, as {why}"),
    })
}
