//! Every key of an EDS or DCF comes out again, or a message is about it: those of CiA 306, and those that it does not have.

use std::collections::BTreeMap;

use od_formats::eds::{write_dcf, write_eds};
use od_import::import;
use od_spec::eds::Document;
use od_spec::source::{FileId, SourceMap};
use od_spec::{NoFiles, compile};

use super::{compiled, device};

/// Every section and every key of the standard, and some that it does not have.
const EVERYTHING: &str = "\
[FileInfo]\nFileName=all.dcf\nFileVersion=2\nFileRevision=3\nEDSVersion=4.0\nDescription=all keys\nCreationTime=09:45AM\n\
CreationDate=01-31-2020\nCreatedBy=me\nModificationTime=01:00PM\nModificationDate=02-01-2020\nModifiedBy=you\nLastEDS=all.eds\n\
Author=we\n\
[DeviceInfo]\nVendorName=Lamps\nVendorNumber=0x1FF\nProductName=Lamp\nProductNumber=5\nRevisionNumber=0x10002\nOrderCode=L5\n\
BaudRate_10=1\nBaudRate_20=1\nBaudRate_50=1\nBaudRate_100=1\nBaudRate_125=1\nBaudRate_250=1\nBaudRate_500=1\nBaudRate_800=1\n\
BaudRate_1000=1\nSimpleBootUpMaster=1\nSimpleBootUpSlave=1\nGranularity=8\nDynamicChannelsSupported=1\nGroupMessaging=1\n\
NrOfRXPDO=1\nNrOfTXPDO=0\nLSS_Supported=1\nCompactPDO=3\nCANopenSafetySupported=1\nNG_Slave=1\nNG_Master=1\n\
NrOfNG_MonitoredNodes=4\nProductVersion=1\nProductRevision=1\nLMT_ManufacturerName=L\nLMT_ProductName=P\n\
ExtendedBootUpMaster=1\nExtendedBootUpSlave=1\n\
[DummyUsage]\nDummy0001=1\nDummy0002=1\nDummy0003=1\nDummy0004=1\nDummy0005=1\nDummy0006=1\nDummy0007=1\n\
[Comments]\nLines=2\nLine1=one; two\nLine2=three\n\
[Tools]\nItems=1\n[Tool1]\nName=editor\nCommand=edit $DCF\n\
[DeviceComissioning]\nNodeID=7\nNodeName=lamp 7\nNodeRefd=+A1-K7\nBaudrate=125\nNetNumber=2\nNetworkName=hall\nNetRefd=+A1\n\
CANopenManager=1\nLSS_SerialNumber=9\nRoom=12\n\
[DynamicChannels]\nNrOfSeg=1\nType1=0x0005\nDir1=ro\nRange1=0xA080-0xA0BF\nPPOffset1=4\n\
[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n\
[1000]\nParameterName=Device type\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0\nPDOMapping=0\n\
[OptionalObjects]\nSupportedObjects=1\n1=0x1027\n\
[1027]\nParameterName=Module list\nObjectType=0x8\nSubNumber=1\nNote=empty\n\
[1027sub0]\nParameterName=count\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\nPDOMapping=0\n\
[ManufacturerObjects]\nSupportedObjects=4\n1=0x2000\n2=0x2001\n3=0x2002\n4=0x2003\n\
[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nLowLimit=1\nHighLimit=9\nAccessType=rwr\nDefaultValue=2\n\
PDOMapping=1\nObjFlags=2\nParameterValue=3\nDenotation=tank\nParamRefd=-B1\nSRDOMapping=1\nInvertedSRAD=0x200101\nUnit=mm\n\
[2000ObjectLinks]\nObjectLinks=1\n1=0x2001\n\
[2001]\nParameterName=limits\nObjectType=0x9\nSubNumber=2\nObjFlags=1\nDenotation=pair\nParamRefd=-B2\nGroup=x\n\
[2001sub0]\nParameterName=count\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\nPDOMapping=0\n\
[2001sub1]\nParameterName=low\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=1\nPDOMapping=0\nSRDOMapping=0\n\
Factor=0.1\n\
[2002]\nParameterName=cell\nObjectType=0x8\nDataType=0x0006\nAccessType=ro\nDefaultValue=5\nPDOMapping=1\nCompactSubObj=3\n\
SRDOMapping=1\nUnit=mV\n\
[2002Name]\nNrOfEntries=1\n2=middle\n[2002Value]\nNrOfEntries=1\n1=8\n[2002Denotation]\nNrOfEntries=1\n3=last\n\
[2003]\nParameterName=log\nObjectType=0x2\nDataType=0x000F\nAccessType=rw\nUploadFile=log.bin\nDownloadFile=new.bin\n\
[SupportedModules]\nNrOfEntries=1\n\
[M1ModuleInfo]\nProductName=8 inputs\nProductVersion=1\nProductRevision=2\nOrderCode=DI8\n\
[M1Comments]\nLines=1\nLine1=slow\n\
[M1FixedObjects]\nNrOfEntries=1\n1=0x6005\n\
[M1Fixed6005]\nParameterName=interrupt\nObjectType=0x7\nDataType=0x0001\nAccessType=rw\nSRDOMapping=1\n\
[M1SubExtends]\nNrOfEntries=2\n1=0x1027\n2=0x6000\n\
[M1SubExt1027]\nParameterName=module \nObjectType=0x7\nDataType=0x0006\nAccessType=ro\nDefaultValue=0xA001\nCount=1\n\
[M1SubExt6000]\nParameterName=input \nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nPDOMapping=1\nCount=1\nObjExtend=8\n\
SRDOMapping=1\n\
[ConnectedModules]\nNrOfEntries=2\n1=1\n2=1\n\
[Vendor Specific]\nColor=red\n[vendor specific]\nShape=round\n";

/// Keys whose meaning is written in another form, by section: the implied PDO and the elements of the array are described.
const IN_ANOTHER_FORM: [(&str, &str); 7] = [
    ("deviceinfo", "compactpdo"),
    ("2002", "compactsubobj"),
    ("2002", "datatype"),
    ("2002", "accesstype"),
    ("2002", "defaultvalue"),
    ("2002", "pdomapping"),
    ("2002", "srdomapping"),
];

/// The keys by section and name, each with its value and where its line is.
fn keys(file: FileId, text: &str) -> BTreeMap<(String, String), (String, u32)> {
    let document = Document::scan(file, text);
    let (document, mut found) = (&document, BTreeMap::new());
    for section in document.sections() {
        let name = section.name().to_ascii_lowercase().replace("comm", "com");
        for line in section.keys() {
            let key = (name.clone(), line.key().unwrap().to_ascii_lowercase());
            found.insert(key, (line.value().unwrap().to_owned(), document.place(line).unwrap().start));
        }
    }
    found
}

/// The keys of a file that are in nothing that is made from it, and that no message is about.
fn lost(name: &str, text: &str) -> Vec<String> {
    let (read, _) = compiled(name, text);
    let mut again = SourceMap::new();
    let file = again.add(name, text);
    let (system, node) = (read.system.unwrap(), read.node.map(|node| node.at(None)));
    let device = &system.devices[0];
    let written = match &node {
        Some(node) => write_dcf(&system, device, node, name),
        None => write_eds(&system, device),
    };
    let written = String::from_utf8(written).unwrap();
    let out = keys(again.add("written", written.as_str()), &written);
    let is_told = |start: u32| {
        let line = text[start as usize..].lines().next().unwrap();
        let end = start + u32::try_from(line.len()).unwrap();
        let mut labels = read.diagnostics.iter().flat_map(|one| &one.labels);
        labels.any(|label| (start..=end).contains(&label.span.start))
    };
    let lost = keys(file, text).into_iter().filter(|((section, key), (_, start))| {
        let is_list = section.starts_with("2002") && section.len() > 4;
        let other = IN_ANOTHER_FORM.contains(&(section.as_str(), key.as_str())) || is_list;
        !other && !out.contains_key(&(section.clone(), key.clone())) && !is_told(*start)
    });
    lost.map(|((section, key), (value, _))| format!("[{section}] {key}={value}")).collect()
}

#[test]
fn every_key_comes_out_again_or_a_message_is_about_it() {
    assert_eq!(lost("all.dcf", EVERYTHING), [""; 0]);
    // Without a node, what belongs to one is reported: the modules that are plugged in with the other settings.
    let commissioning = EVERYTHING.find("[DeviceComissioning]").unwrap();
    let end = EVERYTHING.find("[DynamicChannels]").unwrap();
    let eds = format!("{}{}", &EVERYTHING[..commissioning], &EVERYTHING[end..]);
    let of_a_dcf = [
        "[connectedmodules] 1=1",
        "[connectedmodules] 2=1",
        "[connectedmodules] nrofentries=2",
        "[fileinfo] lasteds=all.eds",
    ];
    assert_eq!(lost("all.eds", &eds), of_a_dcf);
}

#[test]
fn what_a_file_says_in_its_own_words_stays_as_it_is() {
    let (read, _) = compiled("all.dcf", EVERYTHING);
    let (system, node) = (read.system.unwrap(), read.node.unwrap().at(None));
    let written = String::from_utf8(write_dcf(&system, &system.devices[0], &node, "all.dcf")).unwrap();
    for lines in [
        "LastEDS=all.eds\nAuthor=we\n",
        "LSS_Supported=1\nBaudRate_100=1\nCANopenSafetySupported=1\nNG_Slave=1\nNG_Master=1\nNrOfNG_MonitoredNodes=4\n",
        "[Comments]\nLines=2\nLine1=one; two\nLine2=three\n",
        "NodeName=lamp 7\nNodeRefd=+A1-K7\n",
        "NetworkName=hall\nNetRefd=+A1\nCANopenManager=1\nLSS_SerialNumber=0x00000009\nRoom=12\n",
        "ParameterValue=3\nDenotation=tank\nParamRefd=-B1\nSRDOMapping=1\nInvertedSRAD=0x200101\nUnit=mm\n",
        "ObjectType=0x9\nDenotation=pair\nParamRefd=-B2\nObjFlags=1\nGroup=x\n",
        "SRDOMapping=0\nFactor=0.1\n",
        "[Tools]\nItems=1\n\n[Tool1]\nName=editor\nCommand=edit $DCF\n",
        "[M1Fixed6005]\nParameterName=interrupt\nObjectType=0x7\nDataType=0x0001\nAccessType=rw\nSRDOMapping=1\n",
        "Count=1\nObjExtend=8\nSRDOMapping=1\n",
        "[Vendor Specific]\nColor=red\nShape=round\n",
        "[ConnectedModules]\nNrOfEntries=2\n1=1\n2=1\n",
    ] {
        assert!(written.replace("\r\n", "\n").contains(lines), "{lines}\nin\n{written}");
    }
    // What an array in short form says of SRDOs, its elements say; and so do the objects of a module.
    let with_srdo = |section: &str| {
        let start = written.find(&format!("[{section}]\r\n")).unwrap_or_else(|| panic!("[{section}]"));
        written[start..].split("\r\n\r\n").next().unwrap().contains("SRDOMapping=1")
    };
    let sections =
        ["2002", "2002sub0", "2002sub1", "2002sub2", "2002sub3", "6000sub1", "6000sub2", "6005", "1027sub1"];
    assert_eq!(sections.map(with_srdo), [false, false, true, true, true, true, true, true, false]);
    // Read again, it is the same.
    let (read, _) = compiled("all.dcf", &written);
    let (system, node) = (read.system.unwrap(), read.node.unwrap().at(None));
    let again = write_dcf(&system, &system.devices[0], &node, "all.dcf");
    assert_eq!(String::from_utf8(again).unwrap(), written);
}

#[test]
fn misspelled_and_repeated_keys_are_kept_once() {
    let text = "[2000]\nParameterName=a\nData Type=5\nAccessType=ro\nUnit=m\nunit=mm\nSRDOMAPPING=1\nUnit =cm\nEmpty=\n=5\n\
                [2001]\nParameterName=b\nDataType=5\nAccessType=ro\nObjFlags=NV\n[2001sub0]\nSubNumber=1\n\
                [Größe]\nBreite=3 µm\n";
    let read = device("a.eds", text);
    let further = read.further.unwrap();
    let line = |key: &od_spec::model::KeyValue| format!("{}={}", key.key, key.value);
    assert_eq!(further.keys.len(), 1);
    let kept: Vec<String> = further.keys["2000"].iter().map(line).collect();
    assert_eq!(kept, ["SRDOMapping=1", "Unit=cm"]);
    let system = compiled("a.eds", text).0.system.unwrap();
    let written = String::from_utf8(write_eds(&system, &system.devices[0])).unwrap();
    assert!(written.ends_with("[Groesse]\r\nBreite=3 um\r\n"), "{written}");
}

#[test]
fn an_import_lists_what_belongs_to_the_node() {
    let text = imported("all.dcf", EVERYTHING);
    for line in ["# - 2000h: ParamRefd=-B1\n", "# - NodeRefd=+A1-K7\n", "# - CANopenManager=1\n"] {
        assert!(text.contains(line), "{line}\nin\n{text}");
    }
    assert!(!text.contains("no place in a specification"), "{text}");
}

/// The specification of a file.
fn imported(name: &str, text: &str) -> String {
    let mut sources = SourceMap::new();
    let root = sources.add(name, text);
    let read = compile(&mut sources, root, &mut NoFiles);
    import(&read, &sources, root).unwrap().unwrap().text
}

/// The EDS of the only device of a file.
fn eds_of(name: &str, text: &str) -> String {
    let mut sources = SourceMap::new();
    let root = sources.add(name, text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let errors: Vec<&str> = compiled.diagnostics.iter().map(|one| one.message.as_str()).collect();
    let system = compiled.system.unwrap_or_else(|| panic!("{errors:?}"));
    String::from_utf8(write_eds(&system, &system.devices[0])).unwrap()
}

#[test]
fn the_eds_of_an_import_has_every_key_that_the_eds_of_the_file_has() {
    let (of_file, of_import) =
        (eds_of("all.dcf", EVERYTHING), eds_of("all.od.yaml", &imported("all.dcf", EVERYTHING)));
    let mut sources = SourceMap::new();
    let file = sources.add("eds", of_file.as_str());
    let values = |text: &str| -> BTreeMap<(String, String), String> {
        keys(file, text).into_iter().map(|(key, (value, _))| (key, value)).collect()
    };
    assert_eq!(values(&of_import), values(&of_file));
}

#[test]
fn a_file_without_comments_gives_an_eds_without_comments() {
    let text =
        "[FileInfo]\nFileName=a.eds\n[2000]\nParameterName=a\nDataType=5\nAccessType=ro\nPDOMapping=0\n";
    assert!(eds_of("a.eds", text).contains("[Comments]\r\nLines=0\r\n"));
    let text = imported("a.eds", text);
    assert!(text.contains("comments: []"), "{text}");
    assert!(eds_of("a.od.yaml", &text).contains("[Comments]\r\nLines=0\r\n"));
    // A specification that says nothing about them leaves them to us.
    let of_ours = eds_of("a.od.yaml", &text.replace("comments: []", "file-version: 1"));
    assert!(of_ours.contains("[Comments]\r\nLines="), "{of_ours}");
    assert!(!of_ours.contains("[Comments]\r\nLines=0"), "{of_ours}");
}

#[test]
fn an_import_lists_keys_that_no_line_can_hold() {
    let long = "x".repeat(300);
    let text = format!(
        "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\nUnit={long}\nScale=2\nTab=a\tb\n\
         [Größe]\nBreite=3 µm\n[速度]\nA=1\n"
    );
    let text = imported("a.eds", &text);
    assert!(
        text.contains("sections: {2000: {Scale: 2}, ") && text.contains("Größe: {Breite: 3 µm}"),
        "{text}"
    );
    assert!(text.contains(&format!("# - [2000]\n# Unit={long}\n# - [2000] Tab=a")), "{text}");
    assert!(text.contains("# - [速度] A=1\n"), "{text}");
    assert!(eds_of("a.od.yaml", &text).contains("\r\nScale=2\r\n"));
}

#[test]
fn what_a_specification_says_in_addition_to_the_facts_is_in_its_eds() {
    let written = eds_of(
        "lamp.od.yaml",
        "od-spec: 1\ntitle: Lamp\nuses: [cia301]\ndevices:\n  lamp:\n    name: Lamp\n    bit-rates: [125]\n    \
         features: [heartbeat producer]\n    eds:\n      created: 2024-02-29 00:05\n      comments: [one; two, three]\n      \
         sections:\n        deviceinfo: {ng_slave: 1, Ours: 2}\n        2000: {srdomapping: 1}\n        \
         2001: {ObjFlags: 1}\n        2001sub1: {InvertedSRAD: 0x200101}\n        Tools: {Items: 1}\n        \
         tool1: {Name: editor, Command: edit $EDS}\n        Own Section: {Größe: 3 µm}\n\
         objects:\n  0x2000: {name: level, type: unsigned8, access: rw}\n  \
         0x2001: {name: limits, record: {1: {name: low, type: unsigned8, access: rw}}}\n",
    );
    let section = |name: &str| {
        let start = written.find(&format!("[{name}]\r\n")).unwrap_or_else(|| panic!("[{name}] in {written}"));
        written[start..].split("\r\n\r\n").next().unwrap().trim_end().to_owned()
    };
    assert!(section("DeviceInfo").ends_with("\r\nNG_Slave=1\r\nOurs=2"), "{written}");
    assert_eq!(section("Comments"), "[Comments]\r\nLines=2\r\nLine1=one; two\r\nLine2=three");
    assert!(section("2000").ends_with("\r\nSRDOMapping=1"), "{written}");
    assert!(section("2001").ends_with("\r\nObjFlags=1"), "{written}");
    assert!(section("2001sub1").ends_with("\r\nInvertedSRAD=0x200101"), "{written}");
    assert_eq!(section("Tool1"), "[Tool1]\r\nName=editor\r\nCommand=edit $EDS");
    assert!(section("Own Section").starts_with("[Own Section]\r\nGroesse=3 um"), "{written}");
}
