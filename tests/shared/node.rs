// A small node whose table is made at run time: lists that a program owns, and that a table borrows.

use firmware_glue::image::NodeIdPlace;
use firmware_glue::table::{
    Alias, Attributes, Block, Directory, Dummies, EntryRow, Flags, Limits, NONE, Parts, Pdo, Place, Region,
    Row, SparseObject,
};
use firmware_glue::{Application, DataType, Entries, EntryId, Outside, Storage, View};

/// What a program owns that makes a table: the lists that [`Parts`] points at.
#[derive(Debug, Clone)]
pub(crate) struct Owned {
    pub(crate) blocks: Vec<Block>,
    pub(crate) seeds: Vec<u8>,
    pub(crate) order: Vec<u16>,
    pub(crate) pdos: Vec<OwnedPdo>,
    pub(crate) first_application_row: Row,
    pub(crate) objects: Vec<Row>,
    pub(crate) entries: Vec<EntryRow>,
    pub(crate) attributes: Vec<Attributes>,
    pub(crate) sparse: Vec<OwnedSparse>,
    pub(crate) aliases: Vec<Alias>,
    pub(crate) limits: Vec<Limits>,
    pub(crate) values: Vec<Vec<i64>>,
    pub(crate) constants: Vec<u8>,
    pub(crate) factory: Vec<u8>,
    pub(crate) node_id_places: Vec<NodeIdPlace>,
    pub(crate) regions: Vec<Region>,
    pub(crate) granularity: u8,
    pub(crate) dummies: Dummies,
}

/// What [`Pdo`] points at.
#[derive(Debug, Clone)]
pub(crate) struct OwnedPdo {
    pub(crate) index: u16,
    pub(crate) cob_id: Row,
    pub(crate) mapping: Row,
    pub(crate) rows: Vec<Row>,
}

/// What [`SparseObject`] points at.
#[derive(Debug, Clone)]
pub(crate) struct OwnedSparse {
    pub(crate) first: Row,
    pub(crate) subs: Vec<u8>,
}

impl Owned {
    /// Lends the parts, for as long as the caller looks at them.
    pub(crate) fn with<R>(&self, look: impl FnOnce(Parts<'_>) -> R) -> R {
        let pdos: Vec<Pdo<'_>> = self
            .pdos
            .iter()
            .map(|OwnedPdo { index, cob_id, mapping, rows }| Pdo {
                index: *index,
                cob_id: *cob_id,
                mapping: *mapping,
                rows,
            })
            .collect();
        let sparse: Vec<_> = self
            .sparse
            .iter()
            .map(|object| SparseObject { first: object.first, subs: &object.subs })
            .collect();
        let values: Vec<&[i64]> = self.values.iter().map(Vec::as_slice).collect();
        look(Parts {
            directory: Directory { blocks: &self.blocks, seeds: &self.seeds, order: &self.order },
            pdos: &pdos,
            first_application_row: self.first_application_row,
            objects: &self.objects,
            entries: &self.entries,
            attributes: &self.attributes,
            sparse: &sparse,
            aliases: &self.aliases,
            limits: &self.limits,
            values: &values,
            constants: &self.constants,
            factory: &self.factory,
            node_id_places: &self.node_id_places,
            regions: &self.regions,
            granularity: self.granularity,
            dummies: self.dummies,
        })
    }
}

/// Attributes without limits, values, condition and storage, in the image.
pub(crate) fn plain(data_type: DataType, size: u16, flags: Flags) -> Attributes {
    let (place, storage) = (Place::Image, Storage::No);
    Attributes {
        data_type,
        flags,
        place,
        storage,
        page: 0,
        size,
        limits: NONE,
        values: NONE,
        condition: NONE,
    }
}

pub(crate) const RW: Flags = Flags::READ.with(Flags::WRITE);

/// A small node:
///
/// ```text
/// 1400h RPDO 1: 0 const 2, 1 COB-ID (node-ID added), 2 transmission type
/// 1600h its mapping: 0 number, 1 and 2 parameters (6040h.0 and 607Ah.0)
/// 2000h a name: VISIBLE_STRING of 12
/// 2001h a record with gaps: sub-indices 0, 1 and 5; 5 is locked
/// 507Ah 607Ah in 16 bits
/// 6040h UNSIGNED16, mapped
/// 607Ah INTEGER32 from -1000 to 1000 or 5000, mapped, stored
/// ```
pub(crate) fn node() -> Owned {
    let mapped = RW.with(Flags::RECEIVE);
    let sparse = Flags::READ.with(Flags::SPARSE);
    let constant = Attributes { place: Place::Constant, ..plain(DataType::Unsigned8, 1, Flags::READ) };
    let alias = Attributes { place: Place::Alias, ..plain(DataType::Integer16, 2, RW) };
    let limited = Attributes {
        limits: 0,
        values: 0,
        storage: Storage::Application,
        ..plain(DataType::Integer32, 4, mapped)
    };
    let attributes = vec![
        constant,                                                                     // 0
        plain(DataType::Unsigned32, 4, RW),                                           // 1
        plain(DataType::Unsigned8, 1, RW),                                            // 2
        plain(DataType::VisibleString, 12, RW),                                       // 3
        Attributes { flags: sparse, ..constant },                                     // 4
        plain(DataType::Unsigned8, 1, sparse.with(Flags::WRITE)),                     // 5
        plain(DataType::Unsigned8, 1, sparse.with(Flags::WRITE).with(Flags::LOCKED)), // 6
        alias,                                                                        // 7
        plain(DataType::Unsigned16, 2, mapped),                                       // 8
        limited,                                                                      // 9
    ];
    let entry = |attributes, place| EntryRow { attributes, place };
    let mut factory = vec![0, 0, 0, 0]; // 607Ah at 0, stored
    factory.extend(0x200u32.to_le_bytes()); // 1400h.1 at 4
    factory.extend(0x6040_0010u32.to_le_bytes()); // 1600h.1 at 8
    factory.extend(0x607A_0020u32.to_le_bytes()); // 1600h.2 at 12
    factory.extend([0, 0]); // 6040h at 16
    factory.extend([255, 2, 7, 8]); // 1400h.2, 1600h.0, 2001h.1, 2001h.5 at 18 to 21
    factory.extend(*b"virtual\0\0\0\0\0"); // 2000h at 22
    let (mut blocks, mut seeds, mut order) = (vec![Block::FREE; 7], vec![0; 3], vec![0; 6]);
    let indices = [0x1400, 0x1600, 0x2000, 0x2001, 0x507A, 0x6040, 0x607A];
    Directory::arrange(&indices, &mut blocks, &mut seeds, &mut order).expect("seven indices have room");
    Owned {
        blocks,
        seeds,
        order,
        pdos: vec![OwnedPdo { index: 0x1400, cob_id: 1, mapping: 3, rows: vec![11, 12] }],
        first_application_row: 6,
        objects: vec![0, 3, 6, 7, 10, 11, 12, 13],
        entries: vec![
            entry(0, 0),
            entry(1, 4),
            entry(2, 18),
            entry(2, 19),
            entry(1, 8),
            entry(1, 12),
            entry(3, 22),
            entry(4, 1),
            entry(5, 20),
            entry(6, 21),
            entry(7, 0),
            entry(8, 16),
            entry(9, 0),
        ],
        attributes,
        sparse: vec![OwnedSparse { first: 7, subs: vec![0, 1, 5] }],
        aliases: vec![Alias { target: 12, view: View::plain(DataType::Integer16, Outside::Saturate) }],
        limits: vec![Limits { low: -1000, high: 1000 }],
        values: vec![vec![5000]],
        constants: vec![2, 5],
        factory,
        node_id_places: vec![NodeIdPlace { offset: 4, size: 4 }],
        regions: vec![Region { storage: Storage::Application, start: 0, end: 4, layout: 0x1234 }],
        granularity: 8,
        dummies: Dummies::NONE.with(DataType::Unsigned8),
    }
}

/// An application that remembers what it was asked.
#[derive(Default)]
pub(crate) struct Log {
    pub(crate) unlocked: bool,
    pub(crate) changed: Vec<EntryId>,
}

impl<D: Entries<Entry = EntryId>> Application<D> for Log {
    fn is_unlocked(&self) -> bool {
        self.unlocked
    }

    fn changed(&mut self, _: &mut D, entry: EntryId) {
        self.changed.push(entry);
    }
}

pub(crate) const fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index, sub }
}
