//! Faults that are planted into a file of ours: each gives its code at its line, and what can be mended is as before.

use od_spec::eds::Document;
use od_spec::fix;
use od_spec::source::SourceMap;
use od_tests::root;

use crate::format_rules::agreement::difference;
use crate::format_rules::{codes, said};

/// What becomes of a planted fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// The file is as it was, byte by byte.
    Restored,
    /// The file says the same again, in other words or another order.
    SaysTheSame,
    /// The message stays, or the file says something else: a person has to decide.
    Left,
}
use Outcome::{Left, Restored, SaysTheSame};

/// A fault: `old` becomes `new`, at its first place. The message is at the line that holds `at`.
struct Fault {
    code: &'static str,
    old: &'static str,
    new: &'static str,
    at: &'static str,
    outcome: Outcome,
}

const fn fault(
    code: &'static str,
    old: &'static str,
    new: &'static str,
    at: &'static str,
    outcome: Outcome,
) -> Fault {
    Fault { code, old, new, at, outcome }
}

/// Lines and names.
const LINES: &[Fault] = &[
    fault("EDS101", "\r\n[1000]", "\r\n; 40 °C\r\n[1000]", "40 °C", SaysTheSame),
    fault(
        "EDS103",
        "\r\n[1000]",
        "\r\n;12345678901234567890123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890\r\n[1000]",
        ";1234",
        Left,
    ),
    fault("EDS104", "[DeviceInfo]\r\n", "[DeviceInfo]\n", "[DeviceInfo]", Restored),
    fault("EDS104", "[DeviceInfo]\r\n", "[DeviceInfo]\r", "[DeviceInfo]", Restored),
    fault("EDS105", "[DummyUsage]", "[DummyUsage", "[DummyUsage", Restored),
    fault("EDS105", "[DummyUsage]", "DummyUsage]", "DummyUsage]", Restored),
    fault("EDS106", "[1018]", "  [1018]", "  [1018]", Restored),
    fault("EDS107", "[1018]", "[1018] ; identity", "; identity", SaysTheSame),
    fault("EDS108", "[1018]\r\n", "[1018]\r\nnonsense\r\n", "nonsense", Left),
    fault("EDS109", "[FileInfo]", "Stray=1\r\n[FileInfo]", "Stray=1", Left),
    fault("EDS110", "[Comments]\r\n", "[Comments]\r\n[COMMENTS]\r\n", "[COMMENTS]", Left),
    fault("EDS110", "[1018]\r\n", "[Comments]\r\n\r\n[1018]\r\n", "[Comments]\r\n\r\n[1018]", SaysTheSame),
    fault(
        "EDS111",
        "[1018]\r\n",
        "[1018]\r\nObjectType=0x9\r\n",
        "ObjectType=0x9\r\n\r\n[1018sub0]",
        SaysTheSame,
    ),
    fault("EDS111", "EDSVersion=4.0\r\n", "EDSVersion=4.0\r\nEDSVersion=3.0\r\n", "EDSVersion=3.0", Left),
    fault("EDS112", "LSS_Supported=0", "LSS_Supported =0", "LSS_Supported =0", Restored),
    fault("EDS112", "LSS_Supported=0", "\tLSS_Supported=0", "\tLSS_Supported=0", Restored),
    fault("EDS113", "SupportedObjects=3", "Supported Objects=3", "Supported Objects=3", Restored),
    fault("EDS114", "\r\n[1018]", "\r\n# found by\r\n[1018]", "# found by", SaysTheSame),
    fault(
        "EDS115",
        "ParameterName=Identity object",
        "ParameterName=\"Identity object\"",
        "\"Identity object\"",
        Left,
    ),
    fault("EDS116", "[1018]\r\n", "[Secret]\r\nA=1\r\n[1018]\r\n", "[Secret]", Left),
    fault("EDS117", "GroupMessaging=0", "GroupMessaging=0\r\nBaudRate_100=1", "BaudRate_100=1", Left),
    fault("EDS118", "[1018]\r\n", "[1018]\r\nUnit=mV\r\n", "Unit=mV", Left),
    fault("EDS119", "GroupMessaging=0", "GroupMessaging=0\r\nProductVersion=1", "ProductVersion=1", Left),
    fault("EDS120", "[1018sub1]", "[1018SUB1]", "[1018SUB1]", Restored),
    fault("EDS121", "[1018sub1]", "[1018sub01]", "[1018sub01]", Restored),
    fault("EDS121", "[1018]", "[0x1018]", "[0x1018]", Restored),
    fault("EDS121", "[1018]", "[ 1018 ]", "[ 1018 ]", Restored),
    fault("EDS122", "NrOfRXPDO=", "NrOfRxPDO=", "NrOfRxPDO=", Restored),
    fault("EDS123", "Description=", "Description=\u{7}", "Description=", Left),
];

/// What the file says about itself and the device.
const INFORMATION: &[Fault] = &[
    fault("EDS201", "[FileInfo]", "[Fileinformation]", "; @generated", Left),
    fault("EDS202", "[DummyUsage]", "[Dummies]", "; @generated", Left),
    fault("EDS203", "FileVersion=1\r\n", "", "[FileInfo]", Left),
    fault("EDS204", "ProductNumber=", "ProductNumber=\r\nX=", "ProductNumber=\r\nX", Left),
    fault("EDS205", "GroupMessaging=0\r\n", "", "[DeviceInfo]", Left),
    fault("EDS206", "Granularity=8", "Granularity=65", "Granularity=65", Left),
    fault("EDS206", "Granularity=8", "Granularity=eight", "Granularity=eight", Left),
    fault("EDS207", "Granularity=8", "Granularity=010", "Granularity=010", Left),
    fault("EDS207", "Granularity=8", "Granularity=8U", "Granularity=8U", Restored),
    fault("EDS208", "FileVersion=1", "FileVersion=1.0", "FileVersion=1.0", Left),
    fault("EDS209", "EDSVersion=4.0", "EDSVersion=404", "EDSVersion=404", Left),
    fault("EDS210", "CreationDate=05-27-2009", "CreationDate=2009-05-27", "CreationDate=2009", Restored),
    fault("EDS210", "CreationDate=05-27-2009", "CreationDate=27.05.2009", "CreationDate=27", Restored),
    fault("EDS210", "CreationDate=05-27-2009", "CreationDate=02/03/2009", "CreationDate=02", Left),
    fault("EDS210", "CreationTime=09:00AM", "CreationTime=09:00:59", "CreationTime=", Restored),
    fault("EDS211", "ModificationDate=", "ModificationDate=01-01-2001\r\nX=", "ModificationDate=01-01", Left),
    fault("EDS212", "FileName=pmc.eds", "FileName=pmm.eds", "FileName=pmm.eds", Left),
    fault("EDS212", "FileName=pmc.eds", "FileName=C:\\eds\\pmc.eds", "FileName=C:", Restored),
    fault("EDS214", "NrOfTXPDO=", "NrOfTXPDO=9\r\nX=", "NrOfTXPDO=9", Left),
    fault("EDS215", "GroupMessaging=0", "GroupMessaging=0\r\nCompactPDO=1", "CompactPDO=1", Left),
    fault(
        "EDS216",
        "DynamicChannelsSupported=0",
        "DynamicChannelsSupported=1",
        "DynamicChannelsSupported=1",
        Left,
    ),
    fault("EDS217", "Dummy0005=0", "Dummy0005=no", "Dummy0005=no", Left),
    fault("EDS218", "Dummy0001=0\r\n", "", "[DummyUsage]", SaysTheSame),
    fault("EDS219", "Dummy0001=0", "Dummy0001=0\r\nDummy001B=1", "Dummy001B=1", Left),
    fault(
        "EDS220",
        "[1018]\r\n",
        "[DynamicChannels]\r\nNrOfSeg=2\r\nRange1=0xA000-0xA0FF\r\nrange2=0x1000\r\n[1018]\r\n",
        "[1000]",
        Left,
    ),
];

/// Lists and objects.
const LISTS: &[Fault] = &[
    fault("EDS301", "[ManufacturerObjects]", "[ManufacturerObject]", "; @generated", Left),
    fault("EDS302", "SupportedObjects=3", "SupportedObjects=4", "SupportedObjects=4", Restored),
    fault("EDS302", "SupportedObjects=3", "SupportedObjects=2", "SupportedObjects=2", Restored),
    fault("EDS302", "SupportedObjects=3\r\n", "", "[MandatoryObjects]", Restored),
    fault("EDS303", "3=0x1018", "4=0x1018", "4=0x1018", Restored),
    fault("EDS303", "1=0x1000\r\n", "0=0x1000\r\n", "0=0x1000", Restored),
    fault("EDS304", "3=0x1018", "3=1018h", "3=1018h", Left),
    fault("EDS305", "SupportedObjects=3\r\n", "SupportedObjects=4\r\n4=0x1018\r\n", "4=0x1018", Restored),
    fault("EDS306", "SupportedObjects=3\r\n", "SupportedObjects=4\r\n4=0x1019\r\n", "4=0x1019", Left),
    fault(
        "EDS307",
        "SupportedObjects=3\r\n1=0x1000\r\n2=0x1001\r\n3=0x1018",
        "SupportedObjects=2\r\n1=0x1000\r\n2=0x1001",
        "[1018]",
        Restored,
    ),
    fault("EDS309", "SupportedObjects=3\r\n", "SupportedObjects=4\r\n4=0x1005\r\n", "4=0x1005", Left),
    fault("EDS310", "SupportedObjects=3\r\n", "SupportedObjects=4\r\n4=0x0007\r\n", "4=0x0007", Left),
    fault("EDS311", "1=0x1000\r\n2=0x1001", "1=0x1001\r\n2=0x1000", "2=0x1000", Left),
    fault("EDS420", "[1018]\r\n", "[1018]\r\nAccessType=ro\r\n", "AccessType=ro\r\nSubNumber=5", Left),
    fault(
        "EDS421",
        "[1000]\r\n",
        "[1000]\r\nSubNumber=1\r\n",
        "SubNumber=1\r\nParameterName=Device type",
        Restored,
    ),
    fault("EDS422", "[1018]\r\n", "[1018]\r\nCompactSubObj=4\r\n", "CompactSubObj=4", Left),
    fault("EDS423", "SubNumber=5\r\n", "", "[1018]", SaysTheSame),
    fault("EDS424", "[1018sub4]", "[2FFFsub4]", "SubNumber=5", Left),
    fault("EDS425", "[1000]\r\n", "[1000]\r\nObjFlags=4\r\n", "ObjFlags=4", Left),
    fault(
        "EDS426",
        "[1000]\r\n",
        "[1000]\r\nObjFlags=0\r\n",
        "ObjFlags=0\r\nParameterName=Device type",
        Left,
    ),
    fault(
        "EDS427",
        "[1018]\r\n",
        "[1FFFObjectLinks]\r\nObjectLinks=1\r\n1=0x1000\r\n[1018]\r\n",
        "[1FFFObjectLinks]",
        Left,
    ),
    fault("EDS428", "AccessType=rww", "AccessType=RW", "AccessType=RW", Left),
    fault("EDS708", "[1000]\r\n", "[1000]\r\nUploadFile=a.bin\r\n", "UploadFile=a.bin", Left),
    fault("EDS709", "[1000]\r\n", "[1000]\r\nParameterValue=5\r\n", "ParameterValue=5", Left),
];

/// What the device is, and no matter of form: the rules of specifications judge it.
const MEANING: &[Fault] = &[
    fault(
        "OD0313",
        "DefaultValue=4\r\nPDOMapping=0\r\n\r\n; Number of the manufacturer",
        "DefaultValue=3\r\nPDOMapping=0\r\n\r\n; Number of the manufacturer",
        "DefaultValue=3\r\nPDOMapping=0\r\n\r\n; Number of the manufacturer",
        Left,
    ),
    // More than 64 bits, an entry that cannot be mapped, and one of the other direction.
    fault(
        "OD0507",
        "=0x60410010",
        "=0x60410048",
        "DefaultValue=1\r\nPDOMapping=0\r\n\r\n; bits 31..16 index, 15..8 sub-index, 7..0 length in bits\r\n; stored with the communication parameters\r\n[1A00sub1]",
        Left,
    ),
    fault("OD0502", "=0x60410010", "=0x60650020", "=0x60650020", Left),
    fault("OD0502", "=0x60410010", "=0x60400008", "=0x60400008", Left),
    // RPDO 1 has the identifier.
    fault("OD0504", "=$NODEID+0x40000180", "=$NODEID+0x40000200", "=$NODEID+0x40000200", Left),
    fault(
        "OD0303",
        "ParameterName=Statusword",
        "ParameterName=Controlword",
        "[6041]\r\nParameterName=Controlword",
        Left,
    ),
    fault(
        "OD0318",
        "ParameterName=Statusword",
        "ParameterName=very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very very long",
        "[6041]\r\nParameterName=very",
        Left,
    ),
    fault("EDS101", "ParameterName=Statusword", "ParameterName=Statuswört", "ParameterName=Statuswört", Left),
];

/// The sections with their keys, in an order that does not depend on the text's.
fn facts(text: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut sources = SourceMap::new();
    let file = sources.add("facts", text);
    let document = Document::scan(file, sources.file(file).text());
    let mut facts: Vec<_> = document
        .sections()
        .map(|section| {
            let keys = section.keys();
            let mut keys: Vec<_> =
                keys.map(|line| (line.key().unwrap().to_owned(), line.value().unwrap().to_owned())).collect();
            keys.sort();
            (section.name().to_owned(), keys)
        })
        .collect();
    facts.sort();
    facts
}

#[test]
fn a_planted_fault_is_found_at_its_line_and_mended() {
    let name = "pmc.eds";
    let clean = std::fs::read_to_string(root().join("generated/eds").join(name)).unwrap();
    assert!(fix(name, clean.as_bytes()).unwrap().changes.is_empty());
    let said_before = facts(&clean);
    let mut wrong = Vec::new();
    for (number, fault) in LINES.iter().chain(INFORMATION).chain(LISTS).chain(MEANING).enumerate() {
        let what = format!("{} {:?}", fault.code, fault.new.chars().take(40).collect::<String>());
        assert!(clean.contains(fault.old), "{what}: the file holds no such text");
        let text = clean.replacen(fault.old, fault.new, 1);
        let (found, sources) = said(name, text.as_bytes());
        let Some(one) = found.iter().find(|one| one.code.id == fault.code) else {
            wrong.push(format!("{what}: found {:?}", codes(&found)));
            continue;
        };
        let file = sources.file(one.labels[0].span.file);
        let line = file.line_col(one.labels[0].span.start).line;
        let at = u32::try_from(text.find(fault.at).unwrap()).unwrap();
        if file.line_col(at).line != line {
            wrong.push(format!("{what}: found in line {line}, expected {}", file.line_col(at)));
        }
        let fixed = fix(name, text.as_bytes()).unwrap();
        let outcome = match fixed.text() {
            _ if codes(&fixed.left).contains(fault.code) => Left,
            text if text == clean => Restored,
            text if facts(text) == said_before => SaysTheSame,
            _ => Left,
        };
        if outcome != fault.outcome {
            wrong.push(format!("{what}: {outcome:?}, expected {:?}", fault.outcome));
        }
        // Small files are compared for every rule; of this large one, some.
        if od_tests::is_tried(number, 18) {
            let differs = difference(name, text.as_bytes(), &fixed);
            wrong.extend(differs.map(|differs| format!("{what}: {differs}")));
        }
        if !fixed.changes.is_empty() && fixed.text() != clean {
            let again = fix(name, &fixed.to_bytes()).unwrap();
            assert!(again.changes.is_empty(), "{what}: {:?}", again.changes);
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
