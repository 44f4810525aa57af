//! What is said of a file is true, helps, and is said once.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use od_spec::diag::render::{Format, render};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, add_source, compile};

/// What is said about a file, one line each.
fn said(name: &str, text: &str) -> String {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, name, text.into()).unwrap();
    let compiled = compile(&mut sources, root, &mut NoFiles);
    render(&compiled.diagnostics, &sources, Format::Short, false)
}

const HEAD: &str = "[FileInfo]\nFileVersion=1\nFileRevision=1\n[DeviceInfo]\nVendorName=Lamps\nVendorNumber=7\n\
    ProductName=Lamp\nProductNumber=5\nRevisionNumber=0\nBaudRate_125=1\nGranularity=8\nNrOfRXPDO=0\nNrOfTXPDO=0\n";

fn var(section: &str, data_type: u8, default: &str) -> String {
    format!(
        "[{section}]\nParameterName=entry {section}\nObjectType=7\nDataType={data_type}\nAccessType=rw\nDefaultValue={default}\nPDOMapping=0\n"
    )
}

#[test]
fn a_number_with_a_zero_in_front_is_octal_and_has_no_nine() {
    let text = HEAD.to_owned()
        + "[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n"
        + &var("2000", 6, "1")
        + "LowLimit=1\nHighLimit=1\nParameterValue=1\nObjFlags=1\n"
        + "[2001]\nParameterName=compact\nObjectType=8\nDataType=6\nAccessType=rw\nDefaultValue=1\nCompactSubObj=1\n"
        + "[2001Value]\nNrOfEntries=1\n1=1\n"
        + "[DeviceComissioning]\nNodeID=1\nBaudrate=125\nNetNumber=1\nLSS_SerialNumber=1\n"
        + "[DummyUsage]\nDummy0005=1\n[SupportedModules]\nNrOfEntries=0\n";
    let keys = [
        "FileVersion",
        "FileRevision",
        "VendorNumber",
        "ProductNumber",
        "RevisionNumber",
        "BaudRate_125",
        "Granularity",
        "NrOfRXPDO",
        "NrOfTXPDO",
        "1",
        "DefaultValue",
        "LowLimit",
        "HighLimit",
        "ParameterValue",
        "ObjFlags",
        "PDOMapping",
        "ObjectType",
        "DataType",
        "CompactSubObj",
        "NodeID",
        "Baudrate",
        "NetNumber",
        "LSS_SerialNumber",
        "Dummy0005",
    ];
    for key in keys {
        for (number, written, digit) in
            [("009", "9", '9'), ("0128", "128", '8'), ("-08", "-8", '8'), ("09 ; nine", "9", '9')]
        {
            let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
            let line = lines
                .iter_mut()
                .rfind(|line| line.split_once('=').is_some_and(|(name, _)| name == key))
                .unwrap();
            *line = format!("{key}={number}");
            let said = said("lamp.dcf", &lines.join("\n"));
            let help = format!(
                "write `{written}`; a leading 0 makes a number octal in CiA 306, and {digit} is not an octal digit"
            );
            assert!(said.contains(&help), "{key}={number}: {said}");
        }
    }
    // What is not a number otherwise has no such help.
    for number in ["0x09G", "0a9", "nine", "09,5"] {
        let said = said("lamp.eds", &(HEAD.to_owned() + &var("2000", 6, number)));
        assert!(said.contains("EDS501") && !said.contains("octal"), "{number}: {said}");
    }
}

#[test]
fn a_message_that_does_not_exist_may_have_any_identifier() {
    // Index, sub-index, and a bit that switches the message off.
    let places = [
        (0x1014, 0),
        (0x1028, 3),
        (0x1201, 1),
        (0x1201, 2),
        (0x1280, 1),
        (0x1280, 2),
        (0x1400, 1),
        (0x1800, 1),
        (0x1803, 1),
        (0x15FF, 1),
    ];
    let object = |index: u16, sub: u8, value: &str| match sub {
        0 => var(&format!("{index:X}"), 7, value),
        _ => {
            let subs = (1..=sub).map(|one| {
                var(&format!("{index:X}sub{one}"), 7, if one == sub { value } else { "0x80000000" })
            });
            format!("[{index:X}]\nParameterName=object\nObjectType=9\nSubNumber={}\n", sub + 1)
                + &var(&format!("{index:X}sub0"), 5, &sub.to_string())
                + &subs.collect::<String>()
        }
    };
    for (index, sub) in places {
        for id in [0x000, 0x001, 0x07F, 0x101, 0x180, 0x6E0, 0x701, 0x780, 0x7FF] {
            for flags in [0x8000_0000_u32, 0xC000_0000] {
                // On every node, the identifier has to have 11 bits.
                for front in if id + 0x7F > 0x7FF { &[""][..] } else { &["", "$NODEID+"] } {
                    let value = format!("{front}0x{:X}", flags | id);
                    let said = said("lamp.eds", &(HEAD.to_owned() + &object(index, sub, &value)));
                    assert!(!said.contains("OD0503"), "{index:X}.{sub} = {value}: {said}");
                }
            }
            let value = format!("0x{id:X}");
            let said = said("lamp.eds", &(HEAD.to_owned() + &object(index, sub, &value)));
            assert!(said.contains("OD0503"), "{index:X}.{sub} = {value}: {said}");
        }
    }
    // Bit 31 of SYNC says nothing.
    let said = said("lamp.eds", &(HEAD.to_owned() + &var("1005", 7, "0x80000180")));
    assert!(said.contains("OD0503"), "{said}");
}

#[test]
fn what_a_file_does_not_say_disagrees_with_nothing() {
    let identity = |vendor, product, revision| {
        "[1018]\nParameterName=identity\nObjectType=9\nSubNumber=4\n".to_owned()
            + &var("1018sub0", 5, "3")
            + &var("1018sub1", 7, vendor)
            + &var("1018sub2", 7, product)
            + &var("1018sub3", 7, revision)
    };
    let without = |key: &str| {
        let lines = HEAD.lines().filter(|line| !line.starts_with(key));
        lines.map(|line| format!("{line}\n")).collect::<Vec<_>>().concat()
    };
    for key in ["VendorNumber", "ProductNumber", "RevisionNumber"] {
        let with = said("lamp.eds", &(HEAD.to_owned() + &identity("8", "6", "1")));
        assert_eq!(with.matches("OD0611").count(), 3, "{with}");
        let said = said("lamp.eds", &(without(key) + &identity("8", "6", "1")));
        assert_eq!(said.matches("OD0611").count(), 2, "{key}: {said}");
        assert!(said.contains("EDS204") && said.contains(key), "{said}");
    }
}

#[test]
fn a_name_of_all_elements_is_reported_once() {
    let element = |sub: u8, name: &str| {
        var(&format!("2000sub{sub:X}"), 5, "0").replace(&format!("entry 2000sub{sub:X}"), name)
    };
    let array = |names: &[&str]| {
        HEAD.to_owned()
            + &format!("[2000]\nParameterName=levels\nObjectType=8\nSubNumber={}\n", names.len() + 1)
            + &var("2000sub0", 5, &names.len().to_string())
            + &(1..).zip(names).map(|(sub, name)| element(sub, name)).collect::<String>()
    };
    let same = said("lamp.eds", &array(&["level"; 100]));
    assert_eq!(same.matches("OD0303").count(), 1, "{same}");
    assert!(same.contains("2000h.1 and 2000h.2 are both named `level`; 98 more entries like this"), "{same}");
    // Two names are two findings.
    let two = said("lamp.eds", &array(&["low", "high", "low", "high", "low"]));
    assert_eq!(two.matches("OD0303").count(), 2, "{two}");
    assert!(two.contains("2000h.1 and 2000h.3 are both named `low`; 1 more entry like this"), "{two}");
    assert!(two.contains("2000h.2 and 2000h.4 are both named `high` ("), "{two}");
}
