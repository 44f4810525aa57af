//! What a DCF says about its node in addition to the values: names in the application, and files of DOMAINs.

use od_formats::eds::write_dcf;
use od_formats::json::{dump, dump_node};
use od_import::import;
use od_spec::model::{EntryId, Index, SubIndex};
use od_spec::source::SourceMap;
use od_spec::{Commissioning, Denoted};

use super::compiled;

/// A value, a structure, a compact array and a DOMAIN, each with what belongs to the node.
const PUMP: &str = "[DeviceInfo]\nBaudRate_125=1\nGranularity=8\n[DeviceComissioning]\nNodeID=7\nBaudrate=125\n\
    [2000]\nParameterName=level\nDataType=5\nAccessType=rw\nDenotation=Level of tank 3\n\
    [2001]\nParameterName=limits\nObjectType=9\nSubNumber=2\nDenotation=limits of tank 3\n\
    [2001sub0]\nParameterName=n\nDataType=5\nAccessType=const\nDefaultValue=1\nDenotation=count\n\
    [2001sub1]\nParameterName=low\nDataType=5\nAccessType=rw\nParameterValue=4\nDenotation=empty\n\
    [2002]\nParameterName=valve\nObjectType=8\nDataType=5\nAccessType=rw\nCompactSubObj=3\nDenotation=valves\n\
    [2002Denotation]\nNrOfEntries=2\n1=inlet\n3=outlet\n\
    [2003]\nParameterName=program\nObjectType=2\nAccessType=rw\nUploadFile=out/old.bin\nDownloadFile=C:\\new.bin\n";

fn node(name: &str, text: &str) -> Commissioning {
    compiled(name, text).0.node.unwrap().at(None)
}

/// Names with what they belong to.
fn denotations(node: &Commissioning) -> Vec<String> {
    node.denotations.iter().map(|(of, name)| format!("{of} {name}")).collect()
}

/// What is said to have no place.
fn without_place(name: &str, text: &str) -> Vec<String> {
    let about = compiled(name, text).0.diagnostics;
    about.iter().filter(|found| found.code.id == "EDS512").map(|found| found.message.clone()).collect()
}

#[test]
fn a_dcf_made_of_a_dcf_keeps_them() {
    let read = node("pump.dcf", PUMP);
    let expected = [
        "2000h Level of tank 3",
        "2001h limits of tank 3",
        "2001h.0 count",
        "2001h.1 empty",
        "2002h valves",
        "2002h.1 inlet",
        "2002h.3 outlet",
    ];
    assert_eq!(denotations(&read), expected);
    let program = EntryId { index: Index(0x2003), sub: SubIndex(0) };
    let files = &read.files[&program];
    assert_eq!(
        (files.upload.as_deref(), files.download.as_deref()),
        (Some("out/old.bin"), Some("C:\\new.bin"))
    );
    assert_eq!(without_place("pump.dcf", PUMP), [""; 0]);

    let system = compiled("pump.dcf", PUMP).0.system.unwrap();
    let dcf = write_dcf(&system, &system.devices[0], &read, "pump.dcf");
    let text = String::from_utf8(dcf.clone()).unwrap();
    for keys in [
        "ParameterValue=4\r\nDenotation=empty\r\n",
        "ObjectType=0x9\r\nDenotation=limits of tank 3\r\n",
        "UploadFile=out/old.bin\r\nDownloadFile=C:\\new.bin\r\n",
    ] {
        assert!(text.contains(keys), "{text}");
    }
    assert_eq!(node("pump.dcf", &text), read);
    let again = compiled("pump.dcf", &text).0.system.unwrap();
    assert_eq!(write_dcf(&again, &again.devices[0], &read, "pump.dcf"), dcf);
    // The device itself knows nothing of them.
    let eds = String::from_utf8(od_formats::eds::write_eds(&system, &system.devices[0])).unwrap();
    assert!(!eds.contains("Denotation") && !eds.contains("File="), "{eds}");
}

#[test]
fn the_dump_shows_the_node_of_a_dcf() {
    let (compiled, _) = compiled("pump.dcf", PUMP);
    let (system, node) = (compiled.system.unwrap(), compiled.node.unwrap().at(None));
    let dump_of_node: serde_json::Value =
        serde_json::from_slice(&dump_node(&system, &[], &node, Some(7))).unwrap();
    let shown = &dump_of_node["node"];
    assert_eq!((shown["node-id"].as_u64(), shown["bit-rate"].as_u64()), (Some(7), Some(125)));
    assert_eq!(shown["values"][0]["entry"], "0x2001.1");
    assert_eq!(shown["values"][0]["value"]["raw"], 4);
    let names = shown["denotations"].as_array().unwrap();
    assert_eq!(names.len(), node.denotations.len());
    assert_eq!(names[0].to_string(), r#"{"index":"0x2000","name":"Level of tank 3"}"#);
    assert_eq!(names[2].to_string(), r#"{"index":"0x2001","name":"count","sub":0}"#);
    assert_eq!(
        shown["files"].to_string(),
        r#"[{"download":"C:\\new.bin","entry":"0x2003","upload":"out/old.bin"}]"#
    );
    let device: serde_json::Value = serde_json::from_slice(&dump(&system, &[])).unwrap();
    assert!(device.get("node").is_none());
    assert_eq!(device["devices"], dump_of_node["devices"]);
}

#[test]
fn an_import_says_that_they_belong_to_the_node() {
    let mut sources = SourceMap::new();
    let root = sources.add("pump.dcf", PUMP);
    let read = od_spec::compile(&mut sources, root, &mut od_spec::NoFiles);
    let imported = import(&read, &sources, root).unwrap().unwrap();
    let (_, foot) = imported
        .text
        .split_once("# Names in the application and files of the node, which a DCF keeps:\n")
        .unwrap();
    assert_eq!(foot.lines().count(), 9, "{foot}");
    assert!(foot.starts_with("# - 2000h: Denotation=Level of tank 3\n"), "{foot}");
    assert!(
        foot.ends_with("# - 2003h: UploadFile=out/old.bin\n# - 2003h: DownloadFile=C:\\new.bin\n"),
        "{foot}"
    );
    // One value is set in addition to them.
    assert_eq!(imported.without_place, 10);
}

#[test]
fn what_has_no_place_is_said() {
    let object = |keys: &str| format!("[2000]\nParameterName=a\nDataType=5\nAccessType=rw\n{keys}\n");
    let said = |name: &str, keys: &str| without_place(name, &object(keys));
    assert_eq!(said("a.eds", "Denotation=b"), ["`Denotation` of 2000h is left out: this is no DCF"]);
    assert_eq!(said("a.eds", "UploadFile=b"), ["`UploadFile` of 2000h is left out: this is no DCF"]);
    assert_eq!(said("a.dcf", "UploadFile=b"), ["`UploadFile` of 2000h is left out: it is no DOMAIN"]);
    assert_eq!(said("a.eds", "ParamRefd=b"), ["`ParamRefd` of 2000h is left out: this is no DCF"]);
    assert_eq!(said("a.dcf", "ParamRefd=b"), [""; 0]);
    assert_eq!(said("a.dcf", "Denotation="), [""; 0]);
    let domain = |file: &str| {
        let text = format!("[2000]\nParameterName=a\nObjectType=2\nDownloadFile={file}\n");
        (without_place("a.dcf", &text), node("a.dcf", &text).files.len())
    };
    let why = |why: &str| vec![format!("`DownloadFile` of 2000h is left out: the path {why}")];
    assert_eq!(domain("größe.bin"), (why("has characters beyond ASCII"), 0));
    assert_eq!(domain(&"x".repeat(242)), (Vec::new(), 1));
    assert_eq!(domain(&"x".repeat(243)), (why("is too long for a line"), 0));
    // An element that there is not, and an object that is left out.
    let array = "[2000]\nParameterName=a\nObjectType=8\nDataType=5\nAccessType=rw\nCompactSubObj=1\n[2000Denotation]\nNrOfEntries=1\n2=b\n\
        [0020]\nParameterName=t\nObjectType=6\nDenotation=c\n";
    assert_eq!(node("a.dcf", array).denotations.len(), 0);
    let of_eds = without_place(
        "a.eds",
        "[2000]\nParameterName=a\nObjectType=8\nDataType=5\nAccessType=rw\nCompactSubObj=1\n[2000Denotation]\n1=b\n",
    );
    assert_eq!(of_eds, ["the application name of 2000h.1 is left out: this is no DCF"]);
}

/// An object and its sub-index 0 are two things in a structure, and one in a VAR.
#[test]
fn names_are_distinguished() {
    let read = node("pump.dcf", PUMP);
    let at = |index: u16, sub: u8| Denoted::entry(EntryId { index: Index(index), sub: SubIndex(sub) });
    assert_eq!(read.denotations[&Denoted::object(Index(0x2001))], "limits of tank 3");
    assert_eq!(read.denotations[&at(0x2001, 0)], "count");
    assert!(!read.denotations.contains_key(&at(0x2000, 0)));
}
