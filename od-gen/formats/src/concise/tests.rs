use od_spec::model::{EntryId, Index, SubIndex};
use proptest::prelude::*;

use super::{Fault, read};

fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

/// Two records: 1400h.1 = 80000205h, 2001h = "ab" and 0 bytes of it.
const TWO: &[u8] =
    &[2, 0, 0, 0, 0x00, 0x14, 1, 4, 0, 0, 0, 5, 2, 0, 0x80, 0x01, 0x20, 0, 2, 0, 0, 0, b'a', b'b'];

/// The bytes as another program would lay them out.
fn laid_out(records: &[(u16, u8, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = u32::try_from(records.len()).unwrap().to_le_bytes().to_vec();
    for (index, sub, value) in records {
        bytes.extend([index.to_le_bytes()[0], index.to_le_bytes()[1], *sub]);
        bytes.extend(u32::try_from(value.len()).unwrap().to_le_bytes());
        bytes.extend(value);
    }
    bytes
}

#[test]
fn records_are_read_in_their_order_with_their_places() {
    let concise = read(TWO);
    let records: Vec<_> =
        concise.records.iter().map(|record| (record.offset, record.id, record.bytes)).collect();
    assert_eq!(records, [(4, id(0x1400, 1), &[5, 2, 0, 0x80][..]), (15, id(0x2001, 0), b"ab")]);
    assert_eq!((concise.stated, concise.fault), (2, None));
    for nothing in [&[][..], &[0; 4]] {
        let concise = read(nothing);
        assert_eq!((concise.records.len(), concise.fault), (0, None));
    }
}

#[test]
fn each_fault_has_its_place() {
    let fault = |bytes: &[u8]| {
        let concise = read(bytes);
        (concise.records.len(), concise.fault.unwrap())
    };
    assert_eq!(fault(&TWO[..3]), (0, Fault::NoNumber { length: 3 }));
    assert_eq!(fault(&TWO[..4]), (0, Fault::Missing { offset: 4, stated: 2, found: 0 }));
    assert_eq!(fault(&TWO[..10]), (0, Fault::Head { offset: 4, left: 6 }));
    let cut = Fault::Value { offset: 4, id: id(0x1400, 1), size: 4, left: 3 };
    assert_eq!(fault(&TWO[..14]), (0, cut));
    assert_eq!(fault(&TWO[..15]), (1, Fault::Missing { offset: 15, stated: 2, found: 1 }));
    let cut = Fault::Value { offset: 15, id: id(0x2001, 0), size: 2, left: 1 };
    assert_eq!(fault(&TWO[..23]), (1, cut));
    let mut fewer = TWO.to_vec();
    fewer[0] = 1;
    assert_eq!(fault(&fewer), (1, Fault::Rest { offset: 15, left: 9, records: Some(1) }));
    let longer = [TWO, &[0]].concat();
    assert_eq!(fault(&longer), (2, Fault::Rest { offset: 24, left: 1, records: None }));
    // Sizes beyond every address.
    let huge = [&[1, 0, 0, 0, 0, 0x20, 0][..], &[0xFF; 4]].concat();
    let cut = Fault::Value { offset: 4, id: id(0x2000, 0), size: u32::MAX, left: 0 };
    assert_eq!(fault(&huge), (0, cut));
    assert_eq!(fault(&[0xFF; 4]), (0, Fault::Missing { offset: 4, stated: u32::MAX, found: 0 }));
}

#[test]
fn messages_name_the_place() {
    let said = |bytes: &[u8]| read(bytes).fault.unwrap().diagnostic("a.bin").message;
    assert_eq!(
        said(&TWO[..23]),
        "`a.bin`, byte 0x000F: the value of 2001h has 2 bytes by its size, and the file 1 more"
    );
    assert_eq!(
        said(&TWO[..15]),
        "`a.bin`, byte 0x000F: the file ends after 1 of the 2 records that it says it has"
    );
}

fn records() -> impl Strategy<Value = Vec<(u16, u8, Vec<u8>)>> {
    proptest::collection::vec(
        (any::<u16>(), any::<u8>(), proptest::collection::vec(any::<u8>(), 0..20)),
        0..10,
    )
}

proptest! {
    #[test]
    fn what_is_laid_out_is_read_back(records in records()) {
        let bytes = laid_out(&records);
        let concise = read(&bytes);
        let found: Vec<_> = concise
            .records
            .iter()
            .map(|record| (record.id.index.0, record.id.sub.0, record.bytes.to_vec()))
            .collect();
        prop_assert_eq!(found, records);
        prop_assert_eq!(concise.fault, None);
    }

    #[test]
    fn every_cut_is_noticed_and_what_is_before_is_read(records in records(), at in any::<prop::sample::Index>()) {
        let bytes = laid_out(&records);
        let cut = at.index(bytes.len());
        let (whole, part) = (read(&bytes), read(&bytes[..cut]));
        prop_assert!(cut == 0 || part.fault.is_some());
        prop_assert!(whole.records.starts_with(&part.records));
    }

    #[test]
    fn any_bytes_are_read(bytes in proptest::collection::vec(any::<u8>(), 0..200), number in 0u8..5) {
        let bytes = [&[number, 0, 0, 0][..], &bytes].concat();
        let concise = read(&bytes);
        let size: usize = concise.records.iter().map(|record| 7 + record.bytes.len()).sum();
        prop_assert!(4 + size <= bytes.len());
        // Nothing is left over without a word.
        prop_assert_eq!(concise.fault.is_none(), 4 + size == bytes.len() && concise.records.len() == usize::from(number));
    }
}
