//! The SDO server with values of every length, and a buffer as large as the largest.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use firmware_glue::table::{Attributes, Block, Directory, EntryRow, Flags, NONE, Parts, Place};
use firmware_glue::{AbortCode, DataType, Dictionary, Storage, Table, TableDictionary};

#[path = "../../shared/server.rs"]
mod server;

use server::Server;

const LARGEST: usize = 300;

/// 2000h: an OCTET_STRING of up to 300 bytes.
const TEXT: Attributes = Attributes {
    data_type: DataType::OctetString,
    flags: Flags::READ.with(Flags::WRITE),
    place: Place::Image,
    storage: Storage::No,
    page: 0,
    size: 300,
    limits: NONE,
    values: NONE,
    condition: NONE,
};

/// The abort code of an answer.
fn code(answer: [u8; 8]) -> Option<AbortCode> {
    let [command, _, _, _, code @ ..] = answer;
    (command == 0x80).then_some(AbortCode(u32::from_le_bytes(code)))
}

/// Downloads a value of 2000h in segments; the code of the abort, if there was one.
fn download<'t, const BUFFER: usize>(
    server: &mut Server<impl Dictionary<'t>, (), BUFFER>,
    value: &[u8],
) -> Option<AbortCode> {
    let mut aborted = code(server.answer([0x20, 0, 0x20, 0, 0, 0, 0, 0]).unwrap());
    for (number, segment) in value.chunks(7).enumerate() {
        let last = (number + 1) * 7 >= value.len();
        let (toggle, unused) =
            (u8::try_from(number % 2).unwrap() << 4, u8::try_from(7 - segment.len()).unwrap() << 1);
        let mut request = [toggle | unused | u8::from(last); 8];
        request[1..=segment.len()].copy_from_slice(segment);
        aborted = aborted.or_else(|| code(server.answer(request).unwrap()));
    }
    aborted
}

#[test]
fn a_value_of_more_than_255_bytes_is_announced_with_its_length() {
    let factory = [0; LARGEST + 2];
    let table = Table::checked(Parts {
        directory: Directory {
            blocks: &[Block { number: 0x100, objects: 0, present: 1 }],
            seeds: &[0],
            order: &[0],
        },
        objects: &[0, 1],
        entries: &[EntryRow { attributes: 0, place: 0 }],
        attributes: &[TEXT],
        factory: &factory,
        ..Parts::EMPTY
    })
    .unwrap();
    let dictionary = TableDictionary::new(&table, factory, 1).unwrap();
    let mut server = Server::<_, _, LARGEST>::new(dictionary, ());
    assert_eq!(download(&mut server, &[7; LARGEST]), None);
    let [command, _, _, _, length @ ..] = server.answer([0x40, 0, 0x20, 0, 0, 0, 0, 0]).unwrap();
    assert_eq!((command, u32::from_le_bytes(length)), (0x41, 300));
    // One byte more than the buffer has is one more than the value may have.
    assert_eq!(download(&mut server, &[8; LARGEST + 1]), Some(AbortCode::TOO_LONG));
    assert_eq!(*server.dictionary.read(0x2000, 0).unwrap(), [7; LARGEST]);
}
