//! Tables that a program makes at run time, of parts that no generator has made: lists that the program owns, as a virtual node
//! has them that was read from a file.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use firmware_glue::pdo::{self, PdoError, Refused};
use firmware_glue::table::{Block, Directory, Limits};
use firmware_glue::{
    AbortCode, Application, Dictionary, Entries, EntryId, OtherLayout, Storage, Table, TableDictionary,
    WrongSize,
};
use od_generated::{fullmo::Fullmo, pmc::Pmc, pmm::Pmm};

use crate::everything;
use crate::node::{Log, id, node};

#[test]
fn values_are_read_and_written_with_limits_and_access() {
    node().with(|parts| {
        let table = Table::checked(parts).unwrap();
        assert_eq!(table.largest_value(), 12);
        let mut od = TableDictionary::new(&table, vec![0; 34], 5).unwrap();
        let mut application = Log::default();
        let mut write = |index, sub, data: &[u8]| od.write(index, sub, data, &mut application);
        assert_eq!(write(0x607A, 0, &1000i32.to_le_bytes()), Ok(id(0x607A, 0)));
        assert_eq!(write(0x607A, 0, &1001i32.to_le_bytes()), Err(AbortCode::TOO_HIGH));
        assert_eq!(write(0x607A, 0, &(-1001i32).to_le_bytes()), Err(AbortCode::TOO_LOW));
        assert_eq!(write(0x607A, 0, &5000i32.to_le_bytes()), Ok(id(0x607A, 0)), "listed");
        assert_eq!(write(0x607A, 0, &[0; 3]), Err(AbortCode::TOO_SHORT));
        assert_eq!(write(0x507A, 0, &(-7i16).to_le_bytes()), Ok(id(0x607A, 0)), "an alias of it");
        assert_eq!(write(0x1400, 0, &[1]), Err(AbortCode::READ_ONLY));
        assert_eq!(write(0x2000, 0, b"thirteen byte"), Err(AbortCode::TOO_LONG));
        assert_eq!(write(0x2000, 0, b"node"), Ok(id(0x2000, 0)));
        assert_eq!(write(0x2001, 5, &[1]), Err(AbortCode::DEVICE_STATE), "locked");
        assert_eq!(write(0x2001, 2, &[1]), Err(AbortCode::NO_SUB_INDEX));
        assert_eq!(write(0x2002, 0, &[1]), Err(AbortCode::NO_OBJECT));
        application.unlocked = true;
        assert_eq!(od.write(0x2001, 5, &[1], &mut application), Ok(id(0x2001, 5)));
        assert_eq!(application.changed.last(), Some(&id(0x2001, 5)));
        let read = |index, sub| od.read(index, sub).map(|value| value.to_vec());
        assert_eq!(read(0x607A, 0).unwrap(), (-7i32).to_le_bytes());
        assert_eq!(read(0x2000, 0).unwrap(), b"node");
        assert_eq!(read(0x2001, 0).unwrap(), [5]);
        assert_eq!(read(0x1400, 1).unwrap(), 0x205u32.to_le_bytes(), "node-ID added");
        assert_eq!(od.info(id(0x2001, 5)).id(), id(0x2001, 5));
        assert_eq!(od.info_at(0x2001, 5).map(|info| info.id()), Ok(id(0x2001, 5)));
        assert_eq!(od.info_at(0x2001, 2).map(|info| info.id()), Err(AbortCode::NO_SUB_INDEX));
        assert_eq!(od.info(id(0x607A, 0)).limits(), Some(Limits { low: -1000, high: 1000 }));
        assert_eq!(od.find(0x9999, 0), Err(AbortCode::NO_OBJECT));
        let saved = od.stored(Storage::Application).to_vec();
        od.reset(5);
        assert_eq!(od.restore(Storage::Application, 0x1235, &saved), Err(OtherLayout));
        assert_eq!(od.restore(Storage::Application, od.layout(Storage::Application), &saved), Ok(()));
        assert_eq!(*od.read(0x607A, 0).unwrap(), (-7i32).to_le_bytes());
        assert_eq!(
            TableDictionary::new(&table, [0; 4], 5).unwrap_err(),
            WrongSize { found: 4, expected: 34 }
        );
    });
}

#[test]
fn pdos_are_received_and_mapped_anew() {
    node().with(|parts| {
        let table = Table::checked(parts).unwrap();
        let mut od = TableDictionary::new(&table, vec![0; 34], 5).unwrap();
        let received = pdo::unpack(&mut od, 1, &[0x0F, 0, 0xE8, 3, 0, 0], &mut ()).unwrap();
        assert_eq!((received.too_long, received.refused), (false, None));
        assert_eq!(*od.read(0x6040, 0).unwrap(), [0x0F, 0]);
        let received = pdo::unpack(&mut od, 1, &[1, 0, 0xE9, 3, 0, 0], &mut ()).unwrap();
        assert_eq!(received.refused, Some(Refused { entry: id(0x607A, 0), code: AbortCode::TOO_HIGH }));
        assert_eq!(pdo::unpack(&mut od, 1, &[0; 5], &mut ()), Err(PdoError::TooShort));
        assert_eq!(pdo::unpack(&mut od, 2, &[], &mut ()), Err(PdoError::NoPdo));
        // Anew: a placeholder of 8 bits, then the controlword.
        let mut write = |index, sub, value: u32, size: usize| {
            od.write(index, sub, &value.to_le_bytes()[..size], &mut ()).map(drop)
        };
        assert_eq!(write(0x1600, 0, 0, 1), Err(AbortCode::UNSUPPORTED_ACCESS));
        assert_eq!(write(0x1400, 1, 1 << 31 | 0x205, 4), Ok(()));
        assert_eq!(write(0x1600, 0, 0, 1), Ok(()));
        assert_eq!(write(0x1600, 1, 0x2000_0060, 4), Err(AbortCode::NOT_MAPPABLE));
        assert_eq!(write(0x1600, 1, 0x0006_0010, 4), Err(AbortCode::NO_OBJECT), "no such placeholder");
        assert_eq!(write(0x1600, 1, 0x0005_0008, 4), Ok(()));
        assert_eq!(write(0x1600, 2, 0x6040_0010, 4), Ok(()));
        assert_eq!(write(0x1600, 0, 3, 1), Err(AbortCode::PDO_LENGTH));
        assert_eq!(write(0x1600, 0, 2, 1), Ok(()));
        assert_eq!(write(0x1400, 1, 0x205, 4), Ok(()));
        pdo::unpack(&mut od, 1, &[0xAA, 0x34, 0x12], &mut ()).unwrap();
        assert_eq!(*od.read(0x6040, 0).unwrap(), [0x34, 0x12]);
    });
}

#[test]
fn what_the_generator_makes_passes_the_checks() {
    for table in [
        Pmc::new(1).table(),
        Pmm::new(1).table(),
        Fullmo::new(1).table(),
        everything::Everything::new(1).table(),
    ] {
        assert_eq!(Table::checked(*table.parts()).err(), None);
    }
}

#[test]
fn a_program_arranges_indices_as_the_generator_does() {
    for table in [
        Pmc::new(1).table(),
        Pmm::new(1).table(),
        Fullmo::new(1).table(),
        everything::Everything::new(1).table(),
    ] {
        let generated = table.parts().directory;
        let firsts = table.parts().objects.split_last().unwrap().1;
        let indices: Vec<u16> = firsts.iter().map(|row| table.id(*row).index).collect();
        let mut blocks = vec![Block::FREE; generated.blocks.len()];
        let (mut seeds, mut order) = (vec![0; generated.seeds.len()], vec![0; generated.order.len()]);
        let arranged = Directory::arrange(&indices, &mut blocks, &mut seeds, &mut order).unwrap();
        assert_eq!(arranged.blocks, generated.blocks);
        assert_eq!((arranged.seeds, arranged.order), (generated.seeds, generated.order));
        // Every index there is has its object, and no other has one.
        for index in 0..=u16::MAX {
            let found = table.find(index, 0).map(|row| table.id(row).index);
            let expected = indices.binary_search(&index).map(|_| index);
            assert_eq!(found, expected.map_err(|_| AbortCode::NO_OBJECT));
        }
    }
    assert!(Directory::arrange(&[2, 1], &mut [Block::FREE; 4], &mut [0; 2], &mut [0; 4]).is_none());
    assert!(Directory::arrange(&[1, 99], &mut [Block::FREE; 4], &mut [0; 2], &mut [0; 1]).is_none());
    assert!(Directory::arrange(&[1, 99], &mut [Block::FREE; 1], &mut [0; 2], &mut [0; 4]).is_none());
}

/// Nothing that a dictionary gives or takes is longer, and something has this length.
fn check_largest<'t, D: Dictionary<'t>>(od: &mut D, largest: usize) {
    struct Unlocked;
    impl<D: Entries> Application<D> for Unlocked {
        fn is_unlocked(&self) -> bool {
            true
        }
    }
    let rows = 0..u16::try_from(od.table().parts().entries.len()).unwrap();
    let mut sizes = Vec::new();
    for row in rows {
        let EntryId { index, sub } = od.table().id(row);
        assert!(od.read(index, sub).map_or(0, |value| value.len()) <= largest, "{index:04X}h.{sub}");
        assert!(od.write(index, sub, &vec![0; largest + 1], &mut Unlocked).is_err(), "{index:04X}h.{sub}");
        sizes.push(usize::from(od.info(od.find(index, sub).unwrap()).size()));
    }
    assert!(sizes.contains(&largest));
    assert_eq!(od.table().largest_value(), largest);
}

#[test]
fn the_largest_value_is_what_the_constant_says() {
    check_largest(&mut Pmc::new(1), Pmc::LARGEST_VALUE);
    check_largest(&mut Pmm::new(1), Pmm::LARGEST_VALUE);
    check_largest(&mut Fullmo::new(1), Fullmo::LARGEST_VALUE);
    check_largest(&mut everything::Everything::new(1), everything::Everything::LARGEST_VALUE);
    assert_eq!(everything::Everything::LARGEST_VALUE, 32, "an OS command, 1023h.1");
}
