//! Dictionaries for the tests of services, made of short lists.

extern crate std;

use std::boxed::Box;
use std::vec;
use std::vec::Vec;

use crate::access::table_dictionary::TableDictionary;
use crate::table::{
    Attributes, Block, Directory, EntryRow, Flags, Limits, NONE, Parts, Pdo, Place, Region, Row, Storage,
    Table,
};
use crate::value::data_type::DataType;
use crate::value::image::NodeIdPlace;

/// A dictionary of a test.
pub(crate) type TestDictionary = TableDictionary<'static, Vec<u8>>;

/// An entry: an unsigned number of 1, 2 or 4 bytes, which can be read, written and mapped.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TestValue {
    index: u16,
    sub: u8,
    size: u16,
    factory: u32,
    storage: Storage,
    follows: Follows,
    most: Option<i64>,
}

/// Whether the node-ID is added to the factory value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Follows {
    Nothing,
    NodeId,
}

impl TestValue {
    /// With the node-ID added to its factory value.
    #[cfg(feature = "storage")]
    pub(crate) fn and_node_id(self) -> Self {
        Self { follows: Follows::NodeId, ..self }
    }

    /// With a largest value.
    #[cfg(feature = "storage")]
    pub(crate) fn at_most(self, most: i64) -> Self {
        Self { most: Some(most), ..self }
    }

    /// Where it is.
    pub(crate) fn id(&self) -> (u16, u8) {
        (self.index, self.sub)
    }
}

/// An entry that is not stored.
pub(crate) fn value(index: u16, sub: u8, size: u16, factory: u32) -> TestValue {
    stored(index, sub, size, factory, Storage::No)
}

/// An entry of a storage group.
pub(crate) fn stored(index: u16, sub: u8, size: u16, factory: u32, storage: Storage) -> TestValue {
    TestValue { index, sub, size, factory, storage, follows: Follows::Nothing, most: None }
}

/// A dictionary of entries in order, the sub-indices of an object without gaps.
pub(crate) fn dictionary(values: &[TestValue]) -> TestDictionary {
    dictionary_of_layout(values, 0x1234)
}

/// A dictionary whose storage groups have a layout number.
pub(crate) fn dictionary_of_layout(values: &[TestValue], layout: u32) -> TestDictionary {
    let table: &'static Table<'static> = Box::leak(Box::new(table(values, layout)));
    let image = vec![0; table.parts().factory.len()];
    TableDictionary::new(table, image, 5).expect("the image has the size")
}

fn leak<T>(list: Vec<T>) -> &'static [T] {
    Box::leak(list.into_boxed_slice())
}

fn table(values: &[TestValue], layout: u32) -> Table<'static> {
    const GROUPS: [Storage; 5] =
        [Storage::Communication, Storage::Application, Storage::Manufacturer, Storage::Remanent, Storage::No];
    let mut places = vec![0; values.len()];
    let (mut factory, mut regions) = (Vec::new(), Vec::new());
    for group in GROUPS {
        let start = u32::try_from(factory.len()).expect("a short image");
        for (value, place) in values.iter().zip(&mut places).filter(|(value, _)| value.storage == group) {
            *place = u16::try_from(factory.len()).expect("a short image");
            factory.extend(value.factory.to_le_bytes().into_iter().take(value.size.into()));
        }
        let end = u32::try_from(factory.len()).expect("a short image");
        if group != Storage::No && start < end {
            regions.push(Region { storage: group, start, end, layout: layout + start });
        }
    }
    let attributes = (0..).zip(values).map(|(row, value)| attributes(row, value)).collect();
    let limits = values.iter().map(|value| Limits { low: 0, high: value.most.unwrap_or(u32::MAX.into()) });
    let follow = values.iter().zip(&places).filter(|(value, _)| value.follows == Follows::NodeId);
    let node_id_places = follow.map(|(value, place)| NodeIdPlace {
        offset: (*place).into(),
        size: u8::try_from(value.size).expect("a number"),
    });
    let numbered = (0..).zip(&places);
    let entries = numbered.map(|(attributes, place)| EntryRow { attributes, place: *place }).collect();
    let first = |value: &&TestValue| value.sub == 0;
    let indices: Vec<u16> = values.iter().filter(first).map(|value| value.index).collect();
    let rows = (0..).zip(values).filter(|(_, value)| value.sub == 0).map(|(row, _)| row);
    let end = Row::try_from(values.len()).expect("few entries");
    let objects: Vec<Row> = rows.chain([end]).collect();
    let row = |index, sub| {
        let at = values.iter().position(|value| value.index == index && value.sub == sub);
        Row::try_from(at.expect("a parameter of a PDO")).expect("few entries")
    };
    let pdos = indices.iter().filter(|index| matches!(index, 0x1400..0x1600 | 0x1800..0x1A00));
    let pdos = pdos.map(|index| Pdo {
        index: *index,
        cob_id: row(*index, 1),
        mapping: row(*index + 0x200, 0),
        rows: &[],
    });
    let (blocks, seeds, order) = (vec![Block::FREE; 64], vec![0; 32], vec![0; 64]);
    let directory = Directory::arrange(
        leak(indices.clone()),
        Box::leak(blocks.into_boxed_slice()),
        Box::leak(seeds.into_boxed_slice()),
        Box::leak(order.into_boxed_slice()),
    );
    Table::checked(Parts {
        directory: directory.expect("few blocks"),
        pdos: leak(pdos.collect()),
        first_application_row: objects
            .iter()
            .zip(&indices)
            .find_map(|(row, index)| (*index >= 0x2000).then_some(*row))
            .unwrap_or(end),
        objects: leak(objects),
        entries: leak(entries),
        attributes: leak(attributes),
        factory: leak(factory),
        regions: leak(regions),
        limits: leak(limits.collect()),
        node_id_places: leak(node_id_places.collect()),
        ..Parts::EMPTY
    })
    .expect("parts that fit")
}

fn attributes(row: Row, value: &TestValue) -> Attributes {
    let data_type = match value.size {
        1 => DataType::Unsigned8,
        2 => DataType::Unsigned16,
        _ => DataType::Unsigned32,
    };
    let flags = Flags::READ.with(Flags::WRITE).with(Flags::RECEIVE).with(Flags::TRANSMIT);
    let size = data_type.size().expect("a number");
    Attributes {
        data_type,
        flags,
        place: Place::Image,
        storage: value.storage,
        page: 0,
        size,
        limits: if value.most.is_some() { row } else { NONE },
        values: NONE,
        condition: NONE,
    }
}

mod tests {
    use super::*;
    use crate::abort::AbortCode;

    #[test]
    fn the_device_holds_what_an_entry_can_have() {
        let mut held = dictionary(&[value(0x2000, 0, 2, 7)]);
        let read =
            |held: &TestDictionary| held.held(0).map(|value| value.bytes().first().copied()).ok().flatten();
        assert_eq!((held.hold(0, &[9, 0]), read(&held)), (Ok(()), Some(9)));
        assert!(held.hold(0, &[1]).is_err() && held.hold(0, &[1, 2, 3]).is_err());
        assert_eq!((held.hold(7, &[1, 0]), read(&held)), (Err(AbortCode::UNSUPPORTED_ACCESS), Some(9)));
    }
}
