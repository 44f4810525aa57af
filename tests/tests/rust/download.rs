//! The values of a configured node, downloaded into a generated dictionary: in the order of `od_spec::model::download`, the
//! run-time rules take every step.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use od_formats::concise;
use od_generated::pmc::Pmc;
use od_spec::diag::Diagnostics;
use od_spec::model::{Dictionary, EntryId, Value, Write};
use od_spec::source::{SourceMap, Spanned};
use od_spec::{Commissioning, assign};
use od_tests::compile_clean;

#[path = "../../shared/server.rs"]
mod server;

use server::Server;

use crate::everything::Everything;

const NODE: u8 = 5;

/// A node with some settings, and the writes that bring them into it.
struct Configured {
    device: Dictionary,
    node: Commissioning,
    writes: Vec<Write>,
}

/// The node of a device with some settings, which have to be right.
fn configured(specification: &str, device: &str, settings: &[&str]) -> Configured {
    let system = compile_clean(specification).unwrap();
    let device = system.device(device).unwrap();
    let mut sources = SourceMap::new();
    let settings: Vec<_> = settings
        .iter()
        .map(|setting| {
            let file = sources.add("a setting", *setting);
            Spanned::new((*setting).to_owned(), sources.whole(file))
        })
        .collect();
    let mut diagnostics = Diagnostics::new();
    let mut node = Commissioning::of_node(device, NODE);
    node.values = assign(&system, device, NODE, &settings, &mut diagnostics);
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    let writes = node.download(&system, device).unwrap();
    Configured { device: device.clone(), node, writes }
}

/// Room for the largest value of the dictionaries under test.
const BUFFER: usize = if Pmc::LARGEST_VALUE > Everything::LARGEST_VALUE {
    Pmc::LARGEST_VALUE
} else {
    Everything::LARGEST_VALUE
};

/// The abort code of a refused transfer.
type Abort = u32;

/// A client: writes a value by expedited or segmented transfer.
fn write<D: firmware_glue::Dictionary<'static>>(
    server: &mut Server<D, (), BUFFER>,
    id: EntryId,
    bytes: &[u8],
) -> Result<(), Abort> {
    let ([low, high], sub) = (id.index.0.to_le_bytes(), id.sub.0);
    let mut answer = |request: [u8; 8]| {
        let answer = server.answer(request).unwrap();
        if answer[0] == 0x80 { Err(u32::from_le_bytes(answer[4..].try_into().unwrap())) } else { Ok(()) }
    };
    if let 1..=4 = bytes.len() {
        let mut data = [0; 4];
        data[..bytes.len()].copy_from_slice(bytes);
        let unused = u8::try_from(4 - bytes.len()).unwrap();
        return answer([0x23 | unused << 2, low, high, sub, data[0], data[1], data[2], data[3]]);
    }
    let length = u8::try_from(bytes.len()).unwrap();
    answer([0x21, low, high, sub, length, 0, 0, 0])?;
    let segments: Vec<&[u8]> = bytes.chunks(7).collect();
    for (at, segment) in segments.iter().enumerate() {
        let mut request = [0; 8];
        request[1..=segment.len()].copy_from_slice(segment);
        let (toggle, is_last) = (u8::from(at % 2 == 1), u8::from(at + 1 == segments.len()));
        request[0] = toggle << 4 | u8::try_from(7 - segment.len()).unwrap() << 1 | is_last;
        answer(request)?;
    }
    Ok(())
}

/// Writes one after the other; the first that is refused, with its abort code.
fn download<D: firmware_glue::Dictionary<'static>>(
    server: &mut Server<D, (), BUFFER>,
    writes: &[Write],
) -> Result<(), (EntryId, Abort)> {
    writes.iter().try_for_each(|step| write(server, step.id, &step.bytes).map_err(|code| (step.id, code)))
}

/// Sends the records of a concise DCF one after the other, as a master does.
fn download_concise<D: firmware_glue::Dictionary<'static>>(
    server: &mut Server<D, (), BUFFER>,
    bytes: &[u8],
) -> Result<(), (EntryId, Abort)> {
    let concise = concise::read(bytes);
    assert_eq!(concise.fault, None);
    let mut records = concise.records.iter();
    records.try_for_each(|record| write(server, record.id, record.bytes).map_err(|code| (record.id, code)))
}

/// Downloads twice, as a master may find a node that has been configured before, and compares what the node holds then.
fn is_taken<D: firmware_glue::Dictionary<'static>>(dictionary: D, configured: &Configured) {
    let mut server = Server::<_, _, BUFFER>::new(dictionary, ());
    let bytes = concise::write(&configured.writes);
    for _ in 0..2 {
        assert_eq!(download(&mut server, &configured.writes), Ok(()));
        assert_eq!(download_concise(&mut server, &bytes), Ok(()));
    }
    for (id, value) in &configured.node.values {
        let data_type = configured.device.entry(*id).unwrap().data_type;
        let held = server.dictionary.read(id.index.0, id.sub.0).unwrap();
        assert_eq!(*held, *value.bytes_for(data_type, NODE).unwrap(), "{id}");
    }
}

/// That a node refuses the values alone, ascending: what is to be changed was not switched off.
fn is_refused_ascending<D: firmware_glue::Dictionary<'static>>(dictionary: D, configured: &Configured) {
    let values: Vec<Write> = configured
        .node
        .values
        .keys()
        .map(|id| configured.writes.iter().rev().find(|step| step.id == *id).cloned().unwrap())
        .collect();
    let outcome = download(&mut Server::<_, _, BUFFER>::new(dictionary, ()), &values);
    assert!(outcome.is_err(), "{:?} are taken in any order", configured.node.values);
}

/// Makes values of the concise DCF again, and a concise DCF of those: the first values are among them, and the second file is
/// the first.
fn comes_back(specification: &str, configured: &Configured) {
    let system = compile_clean(specification).unwrap();
    let bytes = concise::write(&configured.writes);
    let concise = concise::read(&bytes);
    let found = concise::values(&configured.device, &concise);
    assert_eq!(found.left, []);
    let mut again = configured.node.clone();
    again.values = found.values;
    for (id, value) in &configured.node.values {
        let data_type = configured.device.entry(*id).unwrap().data_type;
        let bytes = |value: &Value| value.bytes_for(data_type, NODE);
        assert_eq!(again.values.get(id).and_then(bytes), bytes(value), "{id}");
    }
    let again = again.download(&system, &configured.device).unwrap();
    assert_eq!(again, configured.writes);
    let remarks: Vec<_> = concise
        .records
        .iter()
        .flat_map(|record| concise::reading(&configured.device, Some(NODE), record).remarks)
        .collect();
    assert_eq!(remarks, [], "the device refuses what was made for it");
}

const PITCH: &str = "od-spec/devices/pitch-control-system.od.yaml";
const EVERYTHING: &str = "tests/readers/everything.od.yaml";

#[test]
fn a_controller_takes_its_configuration() {
    let settings = [
        "1017=500",
        "1400.1=$NODEID+0x210",
        "1400.2=1",
        "1600.0=2",
        "1600.1=0x60400010",
        "1600.2=0x60FF0020",
        "1801.1=0xC0000285",
        "1A01.0=1",
        "1A01.1=0x60410010",
    ];
    let configured = configured(PITCH, "pmc", &settings);
    is_taken(Pmc::new(NODE), &configured);
    comes_back(PITCH, &configured);
    is_refused_ascending(Pmc::new(NODE), &configured);
}

#[test]
fn a_device_with_everything_takes_its_configuration() {
    let settings = [
        "1005=0x40000081",
        "1006=10000",
        "1014=$NODEID+0x90",
        "1016.1=0x000603E8",
        "1016.2=0x000703E8",
        "1019=10",
        "1020.1=1",
        "1020.2=2",
        "1400.1=0x301",
        "1600.0=3",
        "1600.1=0x20090008",
        "1600.2=0x00050008",
        "1600.3=0x00060010",
        "1800.3=50",
        "1801.6=2",
        "2008=-9",
        "2013=a longer text",
        "2014=01 02 03",
    ];
    let first = configured(EVERYTHING, "everything", &settings);
    is_taken(Everything::new(NODE), &first);
    comes_back(EVERYTHING, &first);
    // Nodes to be watched change places.
    let second = configured(EVERYTHING, "everything", &["1016.1=0x000703E8", "1016.2=0x000603E8"]);
    let mut server = Server::<_, _, BUFFER>::new(Everything::new(NODE), ());
    assert_eq!(download(&mut server, &first.writes), Ok(()));
    assert_eq!(download(&mut server, &second.writes), Ok(()));
}

#[test]
fn values_of_every_type_come_back() {
    let settings = [
        "2000=1",
        "2001=-127",
        "2003=-8388608",
        "2005=-549755813888",
        "2006=140737488355327",
        "2007=-36028797018963968",
        "2008=9223372036854775807",
        "200B=0xFFFFFE",
        "200D=1099511627775",
        "200E=281474976710655",
        "200F=72057594037927935",
        "2010=18446744073709551614",
        "2011=0.1",
        "2012=-2.5e300",
        "2013=Good bye",
        "2014=ff 00 A5",
        "2015=another text",
        "2019=1",
        "201A=0x0007",
        "201B=21.5 °C",
        "201C.12=3",
    ];
    let configured = configured(EVERYTHING, "everything", &settings);
    is_taken(Everything::new(NODE), &configured);
    comes_back(EVERYTHING, &configured);
}

#[test]
fn each_rule_of_the_order_is_needed() {
    for setting in ["1014=$NODEID+0x90", "1400.1=0x301", "1600.1=0x20020010", "1800.3=50", "1801.6=2"] {
        is_refused_ascending(Everything::new(NODE), &configured(EVERYTHING, "everything", &[setting]));
    }
}
