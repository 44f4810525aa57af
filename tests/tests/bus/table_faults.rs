//! Parts that do not make a table are refused, and what is not refused can be used.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use firmware_glue::pdo;
use firmware_glue::table::{Attributes, Block, EntryRow, Flags, Place};
use firmware_glue::{DataType, Dictionary, EntryId, Fault, Storage, Table, TableDictionary, TableError};
use proptest::prelude::*;
use proptest::sample::Index as Pick;

use crate::node::{Log, Owned, OwnedSparse, RW, id, node, plain};

fn error(owned: &Owned) -> Option<TableError> {
    owned.with(|parts| Table::checked(parts).err())
}

impl Owned {
    /// A block of the directory, by ascending index.
    fn block(&mut self, at: usize) -> &mut Block {
        &mut self.blocks[usize::from(self.order[at])]
    }

    /// The free place of the directory.
    fn free(&self) -> u16 {
        let free = self.blocks.iter().position(|block| *block == Block::FREE);
        u16::try_from(free.unwrap()).unwrap()
    }
}

/// What a program can get wrong, with the fault that it gets.
struct Mistake {
    fault: Fault,
    at: usize,
    make: fn(&mut Owned),
}

const fn mistake(fault: Fault, at: usize, make: fn(&mut Owned)) -> Mistake {
    Mistake { fault, at, make }
}

static MISTAKES: &[Mistake] = &[
    mistake(Fault::BlockOrder, 2, |owned| owned.order.swap(2, 3)),
    mistake(Fault::BlockOrder, 5, |owned| owned.order[5] = 7),
    mistake(Fault::BlockOrder, 1, |owned| owned.order[1] = owned.free()),
    mistake(Fault::BlockOrder, 5, |owned| owned.block(5).number = 0x800),
    mistake(Fault::BlockOrder, 3, |owned| owned.block(2).present = 0b111),
    mistake(Fault::BlockOrder, 3, |owned| owned.block(3).objects = 5),
    mistake(Fault::BlockPlace, 0, |owned| owned.block(0).number = 0xA1),
    mistake(Fault::BlockPlace, 0, |owned| owned.seeds.clear()),
    mistake(Fault::BlockPlace, 0, |owned| owned.seeds.fill(0)),
    mistake(Fault::BlockCount, 6, |owned| owned.block(5).present = 0b11),
    mistake(Fault::BlockCount, 5, |owned| owned.order.truncate(5)),
    mistake(Fault::BlockCount, 0, |owned| owned.order.clear()),
    mistake(Fault::BlockCount, 6, |owned| {
        let free = usize::from(owned.free());
        owned.blocks[free] = Block::new(0x400, 7, 1);
    }),
    mistake(Fault::ObjectOrder, 0, |owned| owned.objects.clear()),
    mistake(Fault::ObjectOrder, 0, |owned| owned.objects[0] = 1),
    mistake(Fault::ObjectOrder, 1, |owned| owned.objects[2] = 3),
    mistake(Fault::ObjectOrder, 7, |owned| owned.objects[7] = 14),
    mistake(Fault::EntryCount, 65_535, |owned| {
        owned.entries.resize(65_535, EntryRow { attributes: 0, place: 0 });
    }),
    mistake(Fault::EntryAttributes, 1, |owned| owned.entries[1].attributes = 10),
    mistake(Fault::EntryPlace, 1, |owned| owned.entries[1].place = 31),
    mistake(Fault::EntryPlace, 7, |owned| owned.entries[7].place = 2),
    mistake(Fault::EntryPlace, 10, |owned| owned.entries[10].place = 1),
    mistake(Fault::EntryPlace, 6, |owned| owned.factory.truncate(33)),
    mistake(Fault::EntryPlace, 12, |owned| owned.attributes[9].page = 1),
    mistake(Fault::EntryOverlap, 3, |owned| owned.entries[3].place = 18),
    mistake(Fault::EntryOverlap, 4, |owned| owned.entries[4].place = 7),
    mistake(Fault::EntryStorage, 12, |owned| owned.attributes[9].storage = Storage::No),
    mistake(Fault::EntryStorage, 12, |owned| owned.attributes[9].storage = Storage::Manufacturer),
    mistake(Fault::EntryStorage, 1, |owned| owned.regions[0].end = 5),
    mistake(Fault::EntryStorage, 12, |owned| owned.regions.clear()),
    mistake(Fault::EntryType, 10, |owned| {
        owned.attributes[7] = Attributes { data_type: DataType::Unsigned16, ..owned.attributes[7] }
    }),
    mistake(Fault::AttributeSize, 1, |owned| owned.attributes[1].size = 2),
    mistake(Fault::AttributeSize, 3, |owned| {
        owned.attributes[3] = Attributes { size: 11, ..plain(DataType::UnicodeString, 11, RW) };
    }),
    mistake(Fault::AttributePlace, 1, |owned| owned.attributes[1].place = Place::Application),
    mistake(Fault::AttributePlace, 3, |owned| owned.attributes[3].place = Place::Alias),
    mistake(Fault::AttributeAccess, 0, |owned| owned.attributes[0].flags = RW),
    mistake(Fault::AttributeLimits, 9, |owned| owned.attributes[9].limits = 1),
    mistake(Fault::AttributeLimits, 9, |owned| owned.attributes[9].values = 1),
    mistake(Fault::AttributeLimits, 3, |owned| owned.attributes[3].limits = 0),
    mistake(Fault::AttributeLimits, 1, |owned| owned.attributes[1].flags = RW.with(Flags::ONLY_VALUES)),
    mistake(Fault::SparseOrder, 0, |owned| owned.sparse[0].subs.truncate(2)),
    mistake(Fault::SparseOrder, 1, |owned| owned.sparse.push(OwnedSparse { first: 3, subs: vec![0] })),
    mistake(Fault::SparseSubs, 0, |owned| owned.sparse[0].subs[2] = 1),
    mistake(Fault::SparseFlag, 7, |owned| owned.sparse.clear()),
    mistake(Fault::SparseFlag, 6, |owned| owned.attributes[3].flags = RW.with(Flags::SPARSE)),
    mistake(Fault::AliasTarget, 0, |owned| owned.aliases[0].target = 10),
    mistake(Fault::AliasTarget, 0, |owned| owned.aliases[0].target = 6),
    mistake(Fault::AliasTarget, 0, |owned| owned.aliases[0].target = 99),
    mistake(Fault::AliasView, 0, |owned| owned.aliases[0].view.denominator = 0),
    mistake(Fault::AliasView, 0, |owned| owned.aliases[0].view.numerator = 0),
    mistake(Fault::AliasView, 0, |owned| {
        owned.aliases[0].target = 1;
        owned.aliases[0].view.numerator = u32::MAX;
    }),
    mistake(Fault::LimitOrder, 0, |owned| owned.limits[0].low = 1001),
    mistake(Fault::ValueOrder, 0, |owned| owned.values[0] = vec![2, 2]),
    mistake(Fault::NodeIdPlace, 0, |owned| owned.node_id_places[0].offset = 5),
    mistake(Fault::NodeIdPlace, 0, |owned| owned.node_id_places[0].size = 2),
    mistake(Fault::RegionOrder, 0, |owned| owned.regions[0].end = 35),
    mistake(Fault::RegionOrder, 0, |owned| owned.regions[0].storage = Storage::No),
    mistake(Fault::RegionOrder, 1, |owned| owned.regions.push(owned.regions[0])),
    mistake(Fault::PdoIndex, 0, |owned| owned.pdos[0].index = 0x1600),
    mistake(Fault::PdoIndex, 1, |owned| owned.pdos.push(owned.pdos[0].clone())),
    mistake(Fault::PdoRows, 0, |owned| owned.pdos[0].index = 0x1401),
    mistake(Fault::PdoRows, 0, |owned| owned.pdos[0].cob_id = 2),
    mistake(Fault::PdoRows, 0, |owned| owned.pdos[0].mapping = 4),
    mistake(Fault::PdoMapping, 0, |owned| owned.pdos[0].rows[1] = 11),
    mistake(Fault::PdoMapping, 0, |owned| owned.pdos[0].rows.truncate(1)),
    mistake(Fault::PdoMapping, 0, |owned| owned.factory[8] = 8),
    mistake(Fault::FirstApplicationRow, 0, |owned| owned.first_application_row = 7),
    mistake(Fault::Granularity, 0, |owned| owned.granularity = 65),
];

#[test]
fn every_part_that_does_not_fit_is_refused() {
    assert_eq!(error(&node()), None);
    for (number, Mistake { fault, at, make }) in MISTAKES.iter().enumerate() {
        let mut owned = node();
        make(&mut owned);
        assert_eq!(error(&owned), Some(TableError { fault: *fault, at: *at }), "mistake {number}");
    }
    let error = TableError { fault: Fault::BlockPlace, at: 2 };
    assert_eq!(error.to_string(), "directory.order[2]: a block is where it is looked for");
}

/// Does everything to a dictionary that can be done.
fn exercise(table: &Table<'_>, data: &[u8]) {
    let mut od = TableDictionary::new(table, vec![0; table.parts().factory.len()], 127).unwrap();
    let mut application = Log { unlocked: true, ..Log::default() };
    let ids: Vec<EntryId> = (0..=u16::MAX).map_while(|row| od.entry(row)).collect();
    for EntryId { index, sub } in ids.iter().copied().chain([id(0, 0), id(0xFFFF, 255), id(0x1600, 64)]) {
        for length in 0..=data.len() {
            let _ = od.write(index, sub, &data[..length], &mut application);
        }
        let _ = od.upload(index, sub, &mut application).map(|value| value.to_vec());
        let _ = od.download_domain(index, sub, 0, data, true, &mut application);
        let _ = od.info(id(index, sub)).limits();
    }
    for number in [0, 1, 2, 512, 513, u16::MAX] {
        let _ = pdo::unpack(&mut od, number, data, &mut application);
        let _ = pdo::pack(&mut od, number, &mut application);
    }
    // The bytes may say anything, too: a restored image is not checked.
    od.image_mut().fill(data.first().copied().unwrap_or(0xFF));
    for number in [1, 512] {
        let _ = pdo::unpack(&mut od, number, data, &mut application);
        let _ = pdo::pack(&mut od, number, &mut application);
    }
    for storage in [Storage::Communication, Storage::Application, Storage::No] {
        od.reset_stored(storage, 1);
        let saved = od.stored(storage).to_vec();
        let _ = od.restore(storage, od.layout(storage), &saved);
    }
}

const FLAGS: [Flags; 6] =
    [Flags::NONE, Flags::READ, RW, RW.with(Flags::SPARSE), RW.with(Flags::ONLY_VALUES), Flags::TRANSMIT];
const STORAGES: [Storage; 3] = [Storage::No, Storage::Communication, Storage::Application];
const PLACES: [Place; 4] = [Place::Image, Place::Constant, Place::Alias, Place::Application];
const TYPES: [DataType; 9] = [
    DataType::Boolean,
    DataType::Integer8,
    DataType::Integer64,
    DataType::Unsigned64,
    DataType::Real32,
    DataType::OctetString,
    DataType::UnicodeString,
    DataType::TimeOfDay,
    DataType::Domain,
];

/// One number somewhere in the parts that becomes another.
#[derive(Debug, Clone)]
struct Change {
    part: u8,
    item: Pick,
    field: u8,
    number: u32,
}

impl Change {
    /// Changes an item of a list that has any.
    fn item<T>(&self, list: &mut [T], change: impl FnOnce(&mut T)) {
        if !list.is_empty() {
            change(self.item.get_mut(list));
        }
    }

    /// Whether the first of two fields is the one to change.
    fn is_first(&self) -> bool {
        self.field.is_multiple_of(2)
    }

    /// One of a few.
    fn one_of<T: Copy>(&self, list: &[T]) -> T {
        list[usize::try_from(self.number).unwrap() % list.len()]
    }

    fn make(&self, owned: &mut Owned) {
        let [byte, high, ..] = self.number.to_le_bytes();
        let word = u16::from_le_bytes([byte, high]);
        match self.part {
            0 => match self.field % 5 {
                0 => self.item(&mut owned.blocks, |block| block.number = word),
                1 => self.item(&mut owned.blocks, |block| block.objects = word),
                2 => self.item(&mut owned.blocks, |block| block.present = self.number),
                3 => self.item(&mut owned.seeds, |seed| *seed = byte),
                _ => self.item(&mut owned.order, |place| *place = word),
            },
            1 => self.item(&mut owned.objects, |row| *row = word),
            2 => self.item(&mut owned.entries, |entry| {
                *(if self.is_first() { &mut entry.attributes } else { &mut entry.place }) = word;
            }),
            3 => self.item(&mut owned.attributes, |shared| self.attributes(shared, word, byte)),
            4 => self.item(&mut owned.sparse, |object| match self.field % 3 {
                0 => object.first = word,
                1 => object.subs.push(byte),
                _ => object.subs.fill(byte),
            }),
            5 => self.item(&mut owned.aliases, |alias| match self.field % 4 {
                0 => alias.target = word,
                1 => alias.view.numerator = self.number,
                2 => alias.view.denominator = self.number,
                _ => alias.view.data_type = self.one_of(&TYPES),
            }),
            6 => self.item(&mut owned.limits, |limits| limits.high = self.number.cast_signed().into()),
            7 => self.item(&mut owned.values, |list| list.push(self.number.into())),
            8 => owned.constants.truncate(byte.into()),
            9 => self.item(&mut owned.factory, |old| *old = byte),
            10 => self.item(&mut owned.node_id_places, |place| {
                if self.is_first() {
                    place.offset = self.number;
                } else {
                    place.size = byte;
                }
            }),
            11 => self.item(&mut owned.regions, |region| match self.field % 3 {
                0 => region.start = self.number,
                1 => region.end = self.number,
                _ => region.storage = self.one_of(&STORAGES),
            }),
            12 => self.item(&mut owned.pdos, |pdo| match self.field % 4 {
                0 => pdo.index = word,
                1 => pdo.cob_id = word,
                2 => pdo.mapping = word,
                _ => pdo.rows.push(word),
            }),
            13 => owned.granularity = byte,
            14 => owned.first_application_row = word,
            15 => owned.factory.resize(usize::from(word % 80), byte),
            _ => owned.entries.push(EntryRow { attributes: word, place: word }),
        }
    }

    fn attributes(&self, shared: &mut Attributes, word: u16, byte: u8) {
        match self.field % 9 {
            0 => shared.data_type = self.one_of(&TYPES),
            1 => shared.flags = self.one_of(&FLAGS),
            2 => shared.place = self.one_of(&PLACES),
            3 => shared.storage = self.one_of(&STORAGES),
            4 => shared.page = byte,
            5 => shared.size = word,
            6 => shared.limits = word,
            7 => shared.values = word,
            _ => shared.condition = word,
        }
    }
}

/// Changes with numbers that are often positions, indices and sub-indices.
fn changes() -> impl Strategy<Value = Vec<Change>> {
    let number = prop_oneof![0..16u32, 0x1400..0x1404u32, Just(0x2000), any::<u32>()];
    let change = (0..17u8, any::<Pick>(), any::<u8>(), number)
        .prop_map(|(part, item, field, number)| Change { part, item, field, number });
    prop::collection::vec(change, 0..3)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: od_tests::cases(4000), failure_persistence: None, ..ProptestConfig::default() })]

    /// Parts that do not fit are refused, and what is not refused can be used: no index out of range, no overflow.
    #[test]
    fn parts_are_refused_or_work(
        changes in changes(),
        data in prop::collection::vec(any::<u8>(), 0..9),
    ) {
        let mut owned = node();
        for change in changes {
            change.make(&mut owned);
        }
        owned.with(|parts| {
            if let Ok(table) = Table::checked(parts) {
                exercise(&table, &data);
            }
        });
    }
}
