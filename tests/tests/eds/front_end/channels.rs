//! Dynamic channels: from a specification into an EDS, and from there back.

use od_formats::eds::write_eds;
use od_import::import;
use od_spec::source::SourceMap;

use super::{compiled, device};

const PLC: &str = "\
od-spec: 1
title: PLC
vendor: {name: Example, number: 0x1FF}
uses: [cia301]
devices:
  plc:
    name: PLC
    bit-rates: [125]
    features: [heartbeat producer]
    eds: {created: 2024-02-29 12:00}
    dynamic-channels:
      0xA4C0..0xA4FF: {type: unsigned8, access: ro, offset: 0x40}
      0xA000: {type: boolean, access: rww, offset: 0, difference: 1}
";

/// The segments as a person would say them.
fn channels(name: &str, text: &str) -> Vec<String> {
    let info = device(name, text).info;
    let shown = info.dynamic_channels.iter().map(|one| {
        let (data_type, access) = (one.data_type.name(), one.access.word());
        format!("{}-{} {data_type} {access} {} {:?}", one.first, one.last, one.offset, one.difference)
    });
    shown.collect()
}

/// What is said to have no place.
fn without_place(text: &str) -> Vec<String> {
    let about = compiled("a.eds", text).0.diagnostics;
    about.iter().filter(|found| found.code.id == "EDS512").map(|found| found.message.clone()).collect()
}

#[test]
fn they_come_back_from_an_eds() {
    let system = compiled("plc.od.yaml", PLC).0.system.unwrap();
    let eds = String::from_utf8(write_eds(&system, &system.devices[0])).unwrap();
    assert!(eds.contains("DynamicChannelsSupported=1\r\n"), "{eds}");
    assert!(
        eds.contains(
            "[DynamicChannels]\r\nNrOfSeg=2\r\nType1=0x0005\r\nDir1=ro\r\nRange1=0xA4C0-0xA4FF\r\nPPOffset1=0x00000040\r\n\
             Type2=0x0001\r\nDir2=rww\r\nRange2=0xA000-0xA000\r\nPPOffset2=0x00000000,0x00000001\r\n"
        ),
        "{eds}"
    );
    let expected = ["A4C0h-A4FFh unsigned8 ro 64 None", "A000h-A000h boolean rww 0 Some(1)"];
    assert_eq!(channels("plc.od.yaml", PLC), expected);
    assert_eq!(channels("plc.eds", &eds), expected);
    let about = compiled("plc.eds", &eds).0.diagnostics;
    assert!(about.iter().next().is_none(), "{:?}", about.iter().map(|one| &one.message).collect::<Vec<_>>());

    // A specification made of the EDS, and the EDS that is made of that, say the same.
    let mut sources = SourceMap::new();
    let root = sources.add("plc.eds", eds.as_str());
    let read = od_spec::compile(&mut sources, root, &mut od_spec::NoFiles);
    let imported = import(&read, &sources, root).unwrap().unwrap();
    assert_eq!(imported.without_place, 0, "{}", imported.text);
    let again = compiled("plc.od.yaml", &imported.text).0.system.unwrap();
    assert_eq!(String::from_utf8(write_eds(&again, &again.devices[0])).unwrap(), eds);
    let node = od_spec::Commissioning::of_node(&system.devices[0], 5);
    let dcf = od_formats::eds::write_dcf(&system, &system.devices[0], &node, "plc.dcf");
    assert_eq!(channels("plc.dcf", &String::from_utf8(dcf).unwrap()), expected);
}

#[test]
fn documents_show_them_in_a_table() {
    let system = compiled("plc.od.yaml", PLC).0.system.unwrap();
    let context = od_documents_context(&system);
    let table = &context["devices"][0]["dynamic_channels"];
    let cells = |row: usize| -> Vec<String> {
        let cells = table["grids"][0]["rows"][row]["cells"].as_array().unwrap();
        cells.iter().map(|cell| cell["text"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(cells(0), ["A4C0h–A4FFh", "unsigned8", "ro", "64", ""]);
    assert_eq!(cells(1), ["A000h", "boolean", "rww", "0", "1"]);
}

fn od_documents_context(system: &od_spec::model::System) -> serde_json::Value {
    let options = od_documents::options(system, &[], None);
    serde_json::from_slice(&od_documents::dump_context(system, &options)).unwrap()
}

/// A file as the world may write it, with what of it is kept.
#[test]
fn what_cannot_be_read_is_said() {
    let file = |supported: &str, channels: &str| {
        format!("[DeviceInfo]\nDynamicChannelsSupported={supported}\n[DynamicChannels]\n{channels}\n")
    };
    let segment = "Type1=5\nDir1=RO\nRange1=0xA080 - 0xA0BF\nPPOffset1=0, 8\n";
    let text = file("1", &format!("NrOfSeg=1\n{segment}"));
    assert_eq!(channels("a.eds", &text), ["A080h-A0BFh unsigned8 ro 0 Some(8)"]);
    assert_eq!(without_place(&text), [""; 0]);
    for (supported, channels_text, expected) in [
        (
            "0",
            format!("NrOfSeg=1\n{segment}"),
            "the dynamic channels are left out: `DynamicChannelsSupported` is 0",
        ),
        ("0", "NrOfSeg=0".to_owned(), ""),
        ("1", "NrOfSeg=0".to_owned(), "`DynamicChannelsSupported` is left out: no segment is described"),
    ] {
        let text = file(supported, &channels_text);
        assert_eq!(channels("a.eds", &text), [""; 0]);
        assert_eq!(without_place(&text).join("; "), expected);
    }
    let second = |keys: &str| {
        let text = file("1", &format!("NrOfSeg=2\n{segment}{keys}"));
        (channels("a.eds", &text).len(), without_place(&text))
    };
    let keys = |range: &str, data_type: &str, direction: &str, offset: &str| {
        format!("Range2={range}\nType2={data_type}\nDir2={direction}\nPPOffset2={offset}\n")
    };
    let right = keys("0xA0C0", "1", "rww", "0x10");
    assert_eq!(second(&right), (2, Vec::new()));
    let left_out = |why: &str| (1, vec![format!("segment 2 of the dynamic channels is left out: {why}")]);
    let more = |text: &str| (2, vec![format!("`{text}` of the dynamic channels is left out")]);
    assert_eq!(second(&format!("{right}MaxCnt2=4")), more("MaxCnt2"));
    assert_eq!(second("Range2=0xA0C0\nType2=5\nDir2=ro"), left_out("there is no `PPOffset2`"));
    for (range, data_type, direction, offset, why) in [
        ("0xA0BF-0xA0FF", "5", "ro", "0", "it has indices of the segment A080h to A0BFh"),
        ("0xA0FF-0xA0C0", "5", "ro", "0", "found `0xA0FF-0xA0C0`, expected indices such as 0xA080-0xA0BF"),
        ("0-1", "5", "ro", "0", "found `0-1`, expected indices such as 0xA080-0xA0BF"),
        ("0xA0C0", "0x0000", "ro", "0", "found `0x0000`, expected the index of a data type"),
        ("0xA0C0", "5", "const", "0", "found `const`, expected `ro`, `wo`, `rw`, `rwr` or `rww`"),
        ("0xA0C0", "5", "ro", "1,2,3", "found `1,2,3`, expected one or two numbers"),
        ("0xA0C0", "5", "ro", "-1", "found `-1`, expected one or two numbers"),
    ] {
        assert_eq!(second(&keys(range, data_type, direction, offset)), left_out(why));
    }
}
