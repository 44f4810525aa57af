//! What CANopenEditor adds to an XDD: objects that are switched off, and what its code for CANopenNode is made from.

use od_formats::xdd::write_xdd;
use od_spec::model::{Dictionary, EntryId, Index, PdoMapping, Storage, SubIndex};
use od_spec::source::SourceMap;
use od_spec::xdd::Disabled;
use od_spec::{Loader, compile};

use crate::xdd::{compiled, said};

/// A parameter of a type, with what follows its default.
fn parameter(uid: &str, access: &str, element: &str, default: &str, properties: &[(&str, &str)]) -> String {
    let properties = properties
        .iter()
        .map(|(name, value)| format!("<property name=\"{name}\" value=\"{value}\"/>"))
        .collect::<Vec<_>>()
        .concat();
    let default =
        if default.is_empty() { String::new() } else { format!("<defaultValue value=\"{default}\"/>") };
    format!(
        "<parameter uniqueID=\"{uid}\" access=\"{access}\"><label lang=\"en\">{uid}</label><{element}/>{default}{properties}</parameter>\n"
    )
}

fn var(index: &str, uid: &str, more: &str) -> String {
    format!(
        "<CANopenObject index=\"{index}\" name=\"{uid}\" objectType=\"7\" uniqueIDRef=\"{uid}\"{more}/>\n"
    )
}

fn file(parameters: &[String], objects: &[String]) -> String {
    format!(
        "<ISO15745ProfileContainer><ProfileBody><DeviceIdentity><vendorName>Kiln</vendorName></DeviceIdentity>\
         <ApplicationProcess><parameterList>\n{}</parameterList></ApplicationProcess>\n\
         <CANopenObjectList>\n{}</CANopenObjectList></ProfileBody></ISO15745ProfileContainer>",
        parameters.concat(),
        objects.concat()
    )
}

/// A file with five objects that are switched off in some way, and two that are not.
fn switched_off() -> String {
    let off = |uid: &str| parameter(uid, "readWrite", "UINT", "1", &[("CO_disabled", "true")]);
    let on = |uid: &str| parameter(uid, "readWrite", "UINT", "1", &[("CO_disabled", "false")]);
    let plain = "index=\"2006\" name=\"G\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\"";
    file(
        &[off("A"), on("B"), off("C"), off("D"), off("E"), off("F")],
        &[
            var("2000", "A", ""),
            var("2001", "B", ""),
            var("2002", "C", ""),
            var("2003", "D", ""),
            var("2004", "E", ""),
            var("2005", "F", ""),
            // As the program's first files have it, and as a property of the object itself.
            format!("<CANopenObject {plain} disabled=\"true\"/>\n"),
            "<CANopenObject index=\"2007\" name=\"H\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\">\
             <property name=\"CO_disabled\" value=\"1\"/></CANopenObject>\n"
                .to_owned(),
            "<CANopenObject index=\"2008\" name=\"I\" objectType=\"7\" dataType=\"0006\" accessType=\"rw\" disabled=\"false\"/>\n"
                .to_owned(),
        ],
    )
}

/// Takes what is switched off.
struct Everything;

impl Loader for Everything {
    fn load(&mut self, _: &str, _: &str) -> Result<Vec<u8>, String> {
        Err("there is nothing else".to_owned())
    }

    fn disabled(&self) -> Disabled {
        Disabled::Taken
    }
}

fn indices(device: &Dictionary) -> Vec<u16> {
    device.objects.keys().map(|index| index.0).collect()
}

#[test]
fn what_is_switched_off_is_no_object_of_the_device() {
    let (compiled, _) = compiled("kiln.xdd", switched_off());
    assert_eq!(indices(&compiled.system.unwrap().devices[0]), [0x2001, 0x2008]);
    let reported = said("kiln.xdd", switched_off());
    let reported: Vec<&str> = reported.lines().filter(|line| line.contains("XDD20")).collect();
    assert_eq!(reported.len(), 1, "{reported:?}");
    let expected = "kiln.xdd:10:23: warning[XDD208]: 7 objects are switched off and left out: 2000h, 2002h, 2003h, 2004h and 3 more";
    assert!(reported[0].starts_with(expected), "{reported:?}");
}

#[test]
fn what_is_switched_off_is_taken_on_request() {
    let mut sources = SourceMap::new();
    let root = sources.add("kiln.xdd", switched_off());
    let compiled = compile(&mut sources, root, &mut Everything);
    let found = indices(&compiled.system.unwrap().devices[0]);
    assert_eq!(found, [0x2000, 0x2001, 0x2002, 0x2003, 0x2004, 0x2005, 0x2006, 0x2007, 0x2008]);
    assert!(compiled.diagnostics.iter().all(|one| one.code.id != "XDD208"));
}

/// A file with every other property.
fn kept() -> String {
    let group = |name: &'static str| [("CO_storageGroup", name)];
    let text = [("CO_storageGroup", "PERSIST_APP"), ("CO_stringLengthMin", "20")];
    let label = [("CO_countLabel", "LAMP"), ("CO_flagsPDO", "true")];
    let record = "<CANopenObject index=\"2007\" name=\"R\" objectType=\"9\" subNumber=\"3\" uniqueIDRef=\"R\">\
        <CANopenSubObject subIndex=\"00\" name=\"count\" objectType=\"7\" uniqueIDRef=\"R0\"/>\
        <CANopenSubObject subIndex=\"01\" name=\"set\" objectType=\"7\" uniqueIDRef=\"R1\"/>\
        <CANopenSubObject subIndex=\"02\" name=\"hours\" objectType=\"7\" uniqueIDRef=\"R2\"/>\
        <CANopenSubObject subIndex=\"03\" name=\"mean\" objectType=\"7\" uniqueIDRef=\"R3\"/></CANopenObject>\n";
    file(
        &[
            parameter("A", "read", "UDINT", "0", &group("PERSIST_COMM")),
            parameter("B", "readWrite", "UINT", "0", &group("PERSIST_COMM")),
            parameter("C", "readWrite", "UINT", "0", &group("RAM")),
            parameter("D", "readWrite", "UINT", "0", &group("OVEN_AUTO")),
            parameter("E", "readWrite", "UINT", "0", &group("PERSIST_OVEN")),
            parameter("F", "readWrite", "STRING", "short", &text),
            parameter("G", "readWrite", "UINT", "0", &label),
            parameter("R", "read", "UINT", "", &group("PERSIST_APP")),
            parameter("R0", "read", "USINT", "3", &group("PERSIST_COMM")),
            parameter("R1", "readWrite", "UINT", "7", &[("CO_accessSRDO", "trx")]),
            parameter("R2", "read", "UINT", "0", &[("CO_accessSRDO", "tx")]),
            parameter("R3", "read", "UINT", "", &[("CO_accessSRDO", "no")]),
            parameter("H", "readWrite", "WSTRING", "", &[("CO_stringLengthMin", "3")]),
            parameter("I", "const", "UINT", "1", &group("PERSIST_APP")),
            parameter(
                "J",
                "readWrite",
                "UINT",
                "1",
                &[("CO_storageGroup", "no name"), ("CO_accessSRDO", "up")],
            ),
        ],
        &[
            var("1000", "A", ""),
            var("1017", "B", ""),
            var("2002", "C", ""),
            var("2003", "D", ""),
            var("2004", "E", ""),
            var("2005", "F", ""),
            var("2006", "G", ""),
            record.to_owned(),
            var("2008", "H", ""),
            var("2009", "I", ""),
            var("200A", "J", ""),
        ],
    )
}

/// What is kept of each object and its entries, one line each.
fn notes(device: &Dictionary) -> Vec<String> {
    let mut lines = Vec::new();
    for object in device.objects.values() {
        let of_object = object.editor.iter().flat_map(|notes| notes.of_object());
        let of_object: Vec<String> =
            of_object.map(|(property, value)| format!("{}={value}", property.name())).collect();
        if !of_object.is_empty() {
            lines.push(format!("{} {}", object.index, of_object.join(" ")));
        }
        for entry in &object.entries {
            let srdo =
                object.editor.as_ref().and_then(|notes| notes.of_entry(entry.sub)).map(|(_, word)| word);
            let facts = (entry.stored, entry.capacity, srdo);
            if facts != (Storage::No, None, None) {
                let (stored, capacity, srdo) = facts;
                let id = EntryId { index: object.index, sub: entry.sub };
                let capacity = capacity.map_or(String::new(), |bytes| format!(" {bytes} bytes"));
                let srdo = srdo.map_or(String::new(), |word| format!(" srdo {word}"));
                lines.push(format!("{id} {}{capacity}{srdo}", stored.word()));
            }
        }
    }
    lines
}

const KEPT: [&str; 15] = [
    "1000h CO_storageGroup=PERSIST_COMM",
    "1017h CO_storageGroup=PERSIST_COMM",
    "1017h communication",
    "2003h CO_storageGroup=OVEN_AUTO",
    "2003h remanent",
    "2004h CO_storageGroup=PERSIST_OVEN",
    "2004h manufacturer",
    "2005h CO_storageGroup=PERSIST_APP",
    "2005h application 20 bytes",
    "2006h CO_countLabel=LAMP CO_flagsPDO=true",
    "2007h CO_storageGroup=PERSIST_APP",
    "2007h.1 application srdo trx",
    // What can only be read is kept, if it has a value to begin with.
    "2007h.2 application srdo tx",
    "2008h no 6 bytes",
    "2009h CO_storageGroup=PERSIST_APP",
];

#[test]
fn groups_labels_and_lengths_are_kept() {
    let (compiled, _) = compiled("kiln.xdd", kept());
    let system = compiled.system.unwrap();
    assert_eq!(notes(&system.devices[0]), KEPT);
    let record = &system.devices[0].objects[&Index(0x2007)];
    let srdos = &record.editor.as_ref().unwrap().srdos;
    assert_eq!(srdos.get(&SubIndex(1)), Some(&PdoMapping::Both));
    let reported: Vec<&str> = compiled
        .diagnostics
        .iter()
        .filter(|one| one.code.id == "EDS512")
        .map(|one| one.message.as_str())
        .collect();
    assert_eq!(
        reported,
        [
            "`CO_storageGroup=no name` cannot be understood; it is left out",
            "`CO_accessSRDO=up` cannot be understood; it is left out"
        ]
    );
    // None of them is something that is not read.
    assert!(compiled.diagnostics.iter().all(|one| one.code.id != "XDD207"));
}

#[test]
fn an_xdd_is_written_with_what_another_one_kept() {
    let (first, _) = compiled("kiln.xdd", kept());
    let system = first.system.unwrap();
    let written = write_xdd(&system, &system.devices[0]);
    let (second, _) = compiled("kiln.xdd", written);
    assert_eq!(notes(&second.system.unwrap().devices[0]), notes(&system.devices[0]));
}
