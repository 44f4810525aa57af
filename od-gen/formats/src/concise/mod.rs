//! Concise DCF (CiA 302-3): the SDO downloads that configure a node, in their order, as a master keeps them in object 1F22h.
//!
//! All numbers are little-endian. The number of records in 4 bytes, then for each its index (2 bytes), sub-index (1), number of
//! bytes (4), and the value as it goes over the bus. There is no padding and nothing after the last record.

mod fault;
mod listing;
mod reading;

pub use fault::Fault;
pub use listing::Listing;
pub use reading::words;
pub use reading::{Reading, Remark, Values, reading, values};

use od_spec::model::{EntryId, Index, SubIndex, Write};

/// Bytes of the number of records.
const NUMBER: usize = 4;
/// Bytes of a record before its value.
const HEAD: usize = 7;

/// The concise DCF of writes, in their order.
///
/// ```
/// use od_formats::concise;
/// use od_spec::source::SourceMap;
/// use od_spec::{Commissioning, NoFiles, compile};
/// use od_spec::model::{EntryId, Index, SubIndex, Value};
///
/// let mut sources = SourceMap::new();
/// let root = sources.add("lamp.od.yaml", "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices:
///   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
/// objects:
///   0x2000: {name: brightness, type: unsigned16, access: rw}
/// ");
/// let system = compile(&mut sources, root, &mut NoFiles).system.expect("no errors");
/// let lamp = &system.devices[0];
/// let mut node = Commissioning::of_node(lamp, 5);
/// node.values.insert(EntryId { index: Index(0x2000), sub: SubIndex(0) }, Value::Integer(300));
/// let writes = node.download(&system, lamp).expect("the values fit");
/// assert_eq!(concise::write(&writes), [1, 0, 0, 0, 0x00, 0x20, 0, 2, 0, 0, 0, 44, 1]);
/// ```
pub fn write(writes: &[Write]) -> Vec<u8> {
    // What specifications hold is smaller than 4 GiB.
    let number = |length: usize| u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes();
    let size: usize = writes.iter().map(|write| HEAD + write.bytes.len()).sum();
    let mut bytes = Vec::with_capacity(NUMBER + size);
    bytes.extend(number(writes.len()));
    for write in writes {
        bytes.extend(write.id.index.0.to_le_bytes());
        bytes.push(write.id.sub.0);
        bytes.extend(number(write.bytes.len()));
        bytes.extend(&write.bytes);
    }
    bytes
}

/// What a concise DCF holds: its records, as far as they can be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Concise<'b> {
    /// How many records it says it has.
    pub stated: u32,
    /// The records in their order.
    pub records: Vec<Record<'b>>,
    /// What is wrong after the last of them.
    pub fault: Option<Fault>,
}

/// One SDO download.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Record<'b> {
    /// The byte of the file at which it begins.
    pub offset: usize,
    /// The entry.
    pub id: EntryId,
    /// Its value on the bus, least significant byte first.
    pub bytes: &'b [u8],
}

/// Reads a concise DCF. Whatever the bytes are, the records before the first fault are given.
pub fn read(bytes: &[u8]) -> Concise<'_> {
    let Some((number, _)) = bytes.split_first_chunk::<NUMBER>() else {
        // An empty DOMAIN is nothing to configure.
        let fault = (!bytes.is_empty()).then_some(Fault::NoNumber { length: bytes.len() });
        return Concise { stated: 0, records: Vec::new(), fault };
    };
    let stated = u32::from_le_bytes(*number);
    let mut records = Vec::new();
    let mut offset = NUMBER;
    let mut fault = None;
    for found in 0..stated {
        match record(bytes, offset) {
            Ok(read) => {
                offset += HEAD + read.bytes.len();
                records.push(read);
            }
            Err(Cut::End) => fault = Some(Fault::Missing { offset, stated, found }),
            Err(Cut::Head { left }) => fault = Some(Fault::Head { offset, left }),
            Err(Cut::Value { id, size, left }) => fault = Some(Fault::Value { offset, id, size, left }),
        }
        if fault.is_some() {
            break;
        }
    }
    let left = bytes.len() - offset;
    if fault.is_none() && left > 0 {
        fault = Some(Fault::Rest { offset, left, records: whole_records(bytes, offset) });
    }
    Concise { stated, records, fault }
}

/// Why there is no record at a place.
enum Cut {
    /// The file ends there.
    End,
    /// The file ends within the head.
    Head { left: usize },
    /// The file ends within the value.
    Value { id: EntryId, size: u32, left: usize },
}

/// The record at a place.
fn record(bytes: &[u8], offset: usize) -> Result<Record<'_>, Cut> {
    let rest = bytes.get(offset..).unwrap_or_default();
    let Some((head, rest)) = rest.split_first_chunk::<HEAD>() else {
        return Err(if rest.is_empty() { Cut::End } else { Cut::Head { left: rest.len() } });
    };
    let [low, high, sub, size @ ..] = *head;
    let id = EntryId { index: Index(u16::from_le_bytes([low, high])), sub: SubIndex(sub) };
    let size = u32::from_le_bytes(size);
    let value = usize::try_from(size).ok().and_then(|size| rest.get(..size));
    let bytes = value.ok_or(Cut::Value { id, size, left: rest.len() })?;
    Ok(Record { offset, id, bytes })
}

/// As how many records the rest of a file reads, if it is nothing else.
fn whole_records(bytes: &[u8], mut offset: usize) -> Option<usize> {
    let mut number = 0;
    while offset < bytes.len() {
        offset += HEAD + record(bytes, offset).ok()?.bytes.len();
        number += 1;
    }
    Some(number)
}

#[cfg(test)]
mod tests;
