//! Where values lie: in the image, in flash, or nowhere.

use std::collections::BTreeMap;

use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{
    Access, DataType, Dictionary, Entry, EntryId, Family, Object, Role, Storage, SubIndex, Value,
};
use od_spec::order::Arrange as _;

/// The image is made for the node 0; a node adds its node-ID when it starts.
const NO_NODE: u8 = 0;

/// Where the value of an entry lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Offset in the image.
    Image(usize),
    /// Offset in the constants.
    Constant(usize),
    /// Nowhere: it is a view of another entry.
    Alias,
    /// With the application.
    Application,
}

/// Where the value of an entry lies, and how large it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Placed {
    /// Where it is.
    pub place: Place,
    /// Bytes; of a string its capacity.
    pub size: usize,
}

/// A part of the image that is stored together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    /// The group.
    pub storage: Storage,
    /// Its first byte.
    pub start: usize,
    /// The byte after its last one.
    pub end: usize,
    /// A checksum of what is stored where, to recognize values of another layout.
    pub layout: u32,
}

/// The values of a dictionary in memory.
#[derive(Debug, Default)]
pub struct Layout {
    /// Place of every entry.
    pub places: BTreeMap<EntryId, Placed>,
    /// The image after a factory reset of node 0.
    pub factory: Vec<u8>,
    /// Alignment of the image.
    pub align: usize,
    /// Values that never change; equal ones lie in one place.
    pub constants: Vec<u8>,
    /// Offset and size of values that have the node-ID added to them.
    pub node_ids: Vec<(usize, usize)>,
    /// Stored parts of the image, by offset.
    pub regions: Vec<Region>,
}

/// The position of a group in the image.
const fn rank(storage: Storage) -> u8 {
    match storage {
        Storage::Communication => 0,
        Storage::Application => 1,
        Storage::Manufacturer => 2,
        Storage::Remanent => 3,
        Storage::No => 4,
    }
}

/// An entry with a value in the image.
struct Variable<'a> {
    id: EntryId,
    entry: &'a Entry,
    size: usize,
}

/// Lays out a dictionary: stored groups first, each in one piece, and in each group the widest values first, so that every
/// value is aligned without gaps. Elements of an array stay together.
pub fn lay_out(device: &Dictionary, diagnostics: &mut Diagnostics) -> Layout {
    let mut layout = Layout { align: 4, ..Layout::default() };
    let mut variables = Vec::new();
    for (id, object, entry) in device.entries() {
        let is_value = entry.alias.is_none() && entry.data_type != DataType::Domain;
        let constant = constant(object, entry).filter(|_| is_value);
        let size = constant.as_ref().map(Vec::len).or_else(|| size(id, entry, diagnostics));
        let Some(size) = size else { continue };
        let place = if entry.alias.is_some() {
            Place::Alias
        } else if entry.data_type == DataType::Domain {
            Place::Application
        } else if let Some(bytes) = constant {
            Place::Constant(layout.constant(&bytes))
        } else {
            variables.push(Variable { id, entry, size });
            continue;
        };
        layout.places.insert(id, Placed { place, size });
    }
    variables.arrange_by_key(|variable| {
        let Variable { id, entry, .. } = variable;
        (rank(entry.stored), std::cmp::Reverse(align(entry.data_type)), *id)
    });
    for group in variables.chunk_by(|one, next| one.entry.stored == next.entry.stored) {
        layout.group(group);
    }
    let end = layout.factory.len().next_multiple_of(layout.align);
    layout.factory.resize(end, 0);
    layout
}

impl Layout {
    fn constant(&mut self, bytes: &[u8]) -> usize {
        let found = self.constants.windows(bytes.len().max(1)).position(|window| window == bytes);
        found.unwrap_or_else(|| {
            self.constants.extend_from_slice(bytes);
            self.constants.len() - bytes.len()
        })
    }

    /// Adds the entries of one storage, the widest first.
    fn group(&mut self, group: &[Variable<'_>]) {
        let Some(first) = group.first() else { return };
        let (storage, widest) = (first.entry.stored, align(first.entry.data_type));
        self.align = self.align.max(widest);
        self.factory.resize(self.factory.len().next_multiple_of(widest), 0);
        let (start, mut hash) = (self.factory.len(), Fnv::new());
        for Variable { id, entry, size } in group {
            let at = self.factory.len();
            let prefix = prefix(entry.data_type);
            let value = factory(*id, entry).and_then(|value| value.bytes_for(entry.data_type, NO_NODE));
            let mut bytes = value.unwrap_or_default();
            if prefix > 0 {
                let length = u16::try_from(bytes.len()).unwrap_or_default();
                bytes.splice(0..0, length.to_le_bytes());
            }
            bytes.resize(size + prefix, 0);
            if matches!(entry.default, Some(Value::NodeId(_))) {
                self.node_ids.push((at, *size));
            }
            for part in [id.index.0.into(), id.sub.0.into(), entry.data_type.code().into(), at - start, *size]
            {
                hash.add(part);
            }
            self.factory.extend(bytes);
            self.places.insert(*id, Placed { place: Place::Image(at), size: *size });
        }
        if storage != Storage::No {
            self.regions.push(Region { storage, start, end: self.factory.len(), layout: hash.0 });
        }
    }
}

/// The COB-ID of a PDO that does not exist.
static NOT_VALID: Value = Value::Integer(1 << 31);

/// No errors.
static NONE_YET: Value = Value::Integer(0);

/// The value after a factory reset, where there is one. A PDO without a stated value of its COB-ID does not exist: 0
/// would be the identifier that stops nodes. 1003h.0 counts the errors that occurred; an EDS that has the size of the
/// list there means none.
pub fn factory(id: EntryId, entry: &Entry) -> Option<&Value> {
    match (Role::of(id.index), id.sub) {
        (Role::PdoCommunication, SubIndex(1)) => entry.default.as_ref().or(Some(&NOT_VALID)),
        (Role::ErrorHistory, SubIndex(0)) => Some(&NONE_YET),
        _ => entry.default.as_ref(),
    }
}

/// The value of an entry that never changes: a constant, or what follows from the shape of the dictionary.
fn constant(object: &Object, entry: &Entry) -> Option<Vec<u8>> {
    let counts = object.is_structured() && entry.sub == SubIndex(0) && object.role() != Role::ErrorHistory;
    let derived = !entry.access.is_writable() && (counts || object.role().is_pdo_parameter());
    let plain = !matches!(entry.default, Some(Value::NodeId(_)));
    if plain && (entry.access == Access::Const || derived) {
        return entry.default.as_ref()?.bytes_for(entry.data_type, NO_NODE);
    }
    None
}

/// Bytes of a value that is not a constant; of a string its capacity, of a DOMAIN 0.
fn size(id: EntryId, entry: &Entry, diagnostics: &mut Diagnostics) -> Option<usize> {
    if let Some(bits) = entry.data_type.bits() {
        return Some(usize::from(bits.div_ceil(8)));
    }
    if entry.data_type.family() == Family::Domain {
        return Some(0);
    }
    if let Some(capacity) = entry.capacity {
        return Some(capacity.into());
    }
    diagnostics.push(
        Diagnostic::new(
            codes::NO_CAPACITY,
            entry.span,
            format!("{id} ({}) is a {} without a capacity", entry.name, entry.data_type),
        )
        .help("add `capacity:`, the most bytes that the device can hold"),
    );
    None
}

/// Alignment of a value: its size where that is a power of two.
fn align(data_type: DataType) -> usize {
    match data_type.bits() {
        Some(16) => 2,
        Some(32) => 4,
        Some(64) => 8,
        _ => 1,
    }
}

/// Bytes before a value: an OCTET_STRING has its length there.
const fn prefix(data_type: DataType) -> usize {
    match data_type.family() {
        Family::OctetString => 2,
        Family::Boolean
        | Family::Signed
        | Family::Unsigned
        | Family::Real
        | Family::VisibleString
        | Family::UnicodeString
        | Family::Time
        | Family::Domain => 0,
    }
}

/// FNV-1a of 32 bits.
struct Fnv(u32);

impl Fnv {
    const fn new() -> Self {
        Self(0x811C_9DC5)
    }

    fn add(&mut self, number: usize) {
        for byte in u32::try_from(number).unwrap_or(u32::MAX).to_le_bytes() {
            self.0 = (self.0 ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use od_spec::source::SourceMap;
    use od_spec::{NoFiles, compile};
    use proptest::prelude::*;

    use super::*;

    const TYPES: [&str; 12] = [
        "boolean",
        "integer8",
        "unsigned16",
        "integer24",
        "unsigned32",
        "integer40",
        "unsigned48",
        "integer64",
        "real32",
        "visible-string, capacity: 5",
        "octet-string, capacity: 7",
        "time-of-day",
    ];
    const STORED: [&str; 5] = ["no", "communication", "application", "manufacturer", "remanent"];

    /// A device with objects of these types, groups and numbers of elements (0: a VAR).
    fn device(objects: &[(usize, usize, u8)]) -> Dictionary {
        let mut text = String::from(
            "od-spec: 1\ntitle: Random\nuses: [cia301]\ndevices: {d: {name: D, bit-rates: [125]}}\nobjects:\n",
        );
        for (number, (data_type, stored, count)) in objects.iter().enumerate() {
            let entry = format!("type: {}, access: rw, stored: {}", TYPES[*data_type], STORED[*stored]);
            let _ = match count {
                0 => writeln!(text, "  0x{:X}: {{name: v {number}, {entry}}}", 0x2000 + number),
                n => writeln!(
                    text,
                    "  0x{:X}: {{name: a {number}, array: {{count: {n}, name: \"e {{n}}\", {entry}}}}}",
                    0x2000 + number
                ),
            };
        }
        let mut sources = SourceMap::new();
        let root = sources.add("random.od.yaml", text);
        compile(&mut sources, root, &mut NoFiles).system.unwrap().devices.remove(0)
    }

    proptest! {
        #[test]
        fn values_lie_apart_aligned_and_in_their_groups(
            objects in prop::collection::vec((0..TYPES.len(), 0..STORED.len(), 0..4u8), 1..40),
        ) {
            let device = device(&objects);
            let mut diagnostics = Diagnostics::new();
            let layout = lay_out(&device, &mut diagnostics);
            prop_assert!(diagnostics.is_empty());
            let mut used = vec![false; layout.factory.len()];
            for (id, _, entry) in device.entries() {
                let Placed { place, size } = layout.places[&id];
                let Place::Image(at) = place else { continue };
                prop_assert_eq!(at % align(entry.data_type), 0, "{} is not aligned", id);
                let end = at + size + prefix(entry.data_type);
                for byte in &mut used[at..end] {
                    prop_assert!(!*byte, "{} overlaps", id);
                    *byte = true;
                }
                for region in &layout.regions {
                    let inside = at >= region.start && end <= region.end;
                    let apart = end <= region.start || at >= region.end;
                    prop_assert!(if entry.stored == region.storage { inside } else { apart }, "{} in {:?}", id, region);
                }
                if entry.stored != Storage::No {
                    prop_assert!(layout.regions.iter().any(|region| region.storage == entry.stored));
                }
            }
            // Nothing is lost but what aligns the groups and the end.
            let unused = used.iter().filter(|byte| !**byte).count();
            prop_assert!(unused < 8 * (layout.regions.len() + 2), "{} bytes of {}", unused, used.len());
        }
    }

    #[test]
    fn the_number_of_a_group_identifies_its_layout() {
        let layout = |objects: &[(usize, usize, u8)]| {
            let layout = lay_out(&device(objects), &mut Diagnostics::new());
            layout
                .regions
                .iter()
                .find(|region| region.storage == Storage::Application)
                .map(|region| region.layout)
        };
        let first = layout(&[(2, 2, 0), (4, 0, 0)]);
        assert_eq!(first, layout(&[(2, 2, 0), (1, 0, 0)]), "what is not stored does not count");
        for changed in [&[(1, 2, 0)][..], &[(2, 2, 1)], &[(2, 2, 0), (2, 2, 0)], &[(2, 1, 0), (2, 2, 0)]] {
            assert_ne!(first, layout(changed), "{changed:?}");
        }
        assert_eq!(layout(&[(2, 1, 0)]), None);
    }
}
