//! What CANopenEditor writes into an EDS in addition to the standard: comments with a key, among the keys of an object.

use od_formats::eds::write_eds;
use od_formats::json::dump;
use od_import::import;
use od_spec::eds::{Document, Owner};
use od_spec::model::{Index, Storage, SubIndex};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

use super::{compiled, device};

/// A VAR, an ARRAY in which only the object's own group counts, and a VAR with a plain key as another program writes it.
const LAMP: &str = "[1017]\nParameterName=heartbeat\nObjectType=0x7\n;StorageLocation=PERSIST_COMM\nDataType=0x0006\n\
    AccessType=rw\nDefaultValue=1000\nPDOMapping=0\n;CO_countLabel=HB_PROD\n\n\
    [2000]\nParameterName=steps\nObjectType=0x8\n;StorageLocation=PERSIST_MFR\nSubNumber=2\n\n\
    [2000sub0]\nParameterName=count\nObjectType=0x7\n;StorageLocation=RAM\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\n\
    PDOMapping=0\n\n\
    [2000sub1]\nParameterName=step\nObjectType=0x7\n;StorageLocation=RAM\nDataType=0x0006\nAccessType=rw\nDefaultValue=5\n\
    PDOMapping=1\n;TPDODetectCos=1\n;CO_accessSRDO=rx\n\n\
    [2001]\nParameterName=mode\nObjectType=0x7\nStorageLocation=PERSIST_APP\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\n\
    PDOMapping=0\n";

/// What is stored, by object, and the notes of each.
fn kept(text: &str) -> Vec<String> {
    let device = device("lamp.eds", text);
    let line = |object: &od_spec::model::Object| {
        let notes = object.editor.as_ref();
        let mut words: Vec<String> = notes
            .iter()
            .flat_map(|notes| notes.of_object())
            .map(|(property, value)| format!("{}={value}", property.name()))
            .collect();
        for entry in object.entries.iter().filter(|entry| entry.stored != Storage::No) {
            words.push(format!("{} {}", entry.sub, entry.stored.word()));
        }
        words.extend(
            notes.and_then(|notes| notes.of_entry(SubIndex(1))).map(|(_, word)| format!("srdo {word}")),
        );
        format!("{} {}", object.index, words.join(" "))
    };
    device.objects.values().map(line).collect()
}

const KEPT: [&str; 3] = [
    "1017h CO_countLabel=HB_PROD CO_storageGroup=PERSIST_COMM 0 communication",
    "2000h CO_storageGroup=PERSIST_MFR CO_flagsPDO=true 1 manufacturer srdo rx",
    "2001h CO_storageGroup=PERSIST_APP 0 application",
];

#[test]
fn comments_of_the_editor_are_read() {
    assert_eq!(kept(LAMP), KEPT);
    // What is taken out is no longer said.
    let taken_out = LAMP.replace("[2000]\n", ";[2001]\n;StorageLocation=PERSIST_APP\n\n[2000]\n");
    assert_eq!(kept(&taken_out), KEPT);
}

#[test]
fn the_dump_has_them() {
    let (read, _) = compiled("lamp.eds", LAMP);
    let dump: serde_json::Value = serde_json::from_slice(&dump(&read.system.unwrap(), &[])).unwrap();
    let notes: Vec<String> = dump["devices"][0]["objects"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|object| !object["canopennode"].is_null())
        .map(|object| format!("{} {}", object["index"], object["canopennode"]))
        .collect();
    assert_eq!(
        notes,
        [
            r#""0x1017" {"count":"HB_PROD","group":"PERSIST_COMM","requests-tpdos":false,"srdo":{}}"#,
            r#""0x2000" {"count":null,"group":"PERSIST_MFR","requests-tpdos":true,"srdo":{"1":"receive"}}"#,
            r#""0x2001" {"count":null,"group":"PERSIST_APP","requests-tpdos":false,"srdo":{}}"#,
        ]
    );
}

#[test]
fn an_eds_is_written_with_what_another_one_kept() {
    let (read, _) = compiled("lamp.eds", LAMP);
    let system = read.system.unwrap();
    let written = String::from_utf8(write_eds(&system, &system.devices[0])).unwrap();
    for line in [
        ";StorageLocation=PERSIST_COMM",
        ";CO_countLabel=HB_PROD",
        ";TPDODetectCos=true",
        ";CO_accessSRDO=rx",
    ] {
        assert_eq!(written.matches(&format!("\r\n{line}\r\n")).count(), 1, "{line}: {written}");
    }
    assert_eq!(kept(&written), KEPT);
}

#[test]
fn an_import_says_what_the_editor_keeps() {
    let mut sources = SourceMap::new();
    let root = sources.add("lamp.eds", LAMP);
    let read = compile(&mut sources, root, &mut NoFiles);
    let text = import(&read, &sources, root).unwrap().unwrap().text;
    let said = "    canopennode:\n      0x1017: {group: PERSIST_COMM, count: HB_PROD}\n      \
                0x2000: {group: PERSIST_MFR, srdo: {1: receive}, requests-tpdos: yes}\n      \
                0x2001: {group: PERSIST_APP}\n";
    assert!(text.contains(said), "{text}");
    assert!(!text.contains("# StorageLocation") && !text.contains("# CO_"), "{text}");
    let root = sources.add("lamp.od.yaml", text);
    let system = compile(&mut sources, root, &mut NoFiles).system.unwrap();
    let written = String::from_utf8(write_eds(&system, &system.devices[0])).unwrap();
    assert_eq!(kept(&written), KEPT);
}

#[test]
fn a_comment_after_the_keys_is_about_its_own_object() {
    let mut sources = SourceMap::new();
    let file = sources.add("lamp.eds", LAMP);
    let document = Document::scan(file, LAMP);
    let remarks = document.remarks();
    let label = remarks.iter().find(|remark| remark.text == "CO_countLabel=HB_PROD").unwrap();
    assert_eq!(label.owner, Owner::Object(Index(0x1017)));
}

/// Comments of ours say what stores an entry, and a user named another group since.
#[test]
fn a_group_against_what_stores_its_entries_is_reported() {
    let text = "[2000]\nParameterName=level\nObjectType=0x7\n;StorageLocation=PERSIST_MFR\nDataType=0x0005\nAccessType=rw\n\
        DefaultValue=1\nPDOMapping=0\n";
    let mut sources = SourceMap::new();
    let root = sources.add("lamp.eds", format!("; stored with the application parameters\n{text}"));
    let read = compile(&mut sources, root, &mut NoFiles);
    let entry = &read.system.as_ref().unwrap().devices[0].objects[&Index(0x2000)].entries[0];
    assert_eq!(entry.stored, Storage::Application);
    let text = import(&read, &sources, root).unwrap().unwrap().text;
    assert!(text.contains("stored: application") && !text.contains("canopennode:"), "{text}");
    let reported = "# - the group PERSIST_MFR of 2000h, whose entries are stored otherwise\n";
    assert!(text.contains(reported), "{text}");
}
