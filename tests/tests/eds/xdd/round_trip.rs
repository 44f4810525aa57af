//! Specification → XDD → model, and DCF → XDC → DCF: everything that an EDS carries comes back, and texts in every language.

use od_formats::eds::{write_dcf, write_eds};
use od_formats::xdd::{write_xdc, write_xdd};
use od_import::import;
use od_spec::diag::{Diagnostic, Diagnostics};
use od_spec::model::{Dictionary, Object, System};
use od_spec::model::{EntryId, Index, SubIndex};
use od_spec::source::{SourceMap, Spanned};
use od_spec::{Commissioning, Compiled, Denoted, add_source, assign, compile};
use od_tests::{OfWorkspace, compile_clean, root};

use crate::xdd::compiled;

const EVERYTHING: &str = "tests/readers/everything.od.yaml";
const SPECIFICATIONS: [&str; 11] = [
    "od-spec/devices/pitch-control-system.od.yaml",
    "od-spec/devices/fullmo-drive.od.yaml",
    EVERYTHING,
    "tests/shared/physical.od.yaml",
    "tests/shared/texts.od.yaml",
    "tests/shared/nasty.od.yaml",
    "tests/shared/special-values.od.yaml",
    "tests/shared/settings.od.yaml",
    "tests/shared/coarse.od.yaml",
    "tests/book/lift.od.yaml",
    "tests/book/valve.od.yaml",
];

/// The only device of a file, with its system.
fn read(name: &str, bytes: Vec<u8>) -> (System, Compiled) {
    let (mut compiled, _) = compiled(name, bytes);
    let system = compiled.system.take().unwrap();
    (system, compiled)
}

/// The EDS of what a file is read as.
fn eds_of(system: &System) -> String {
    without_what_xdd_lacks(write_eds(system, &system.devices[0]))
}

/// An EDS or DCF without the links of objects, the comments of the file and the sections of a maker, which an XDD has no place
/// for.
fn without_what_xdd_lacks(eds: Vec<u8>) -> String {
    String::from_utf8(eds)
        .unwrap()
        .split("\r\n\r\n")
        .filter(|section| !section.contains("ObjectLinks]"))
        .filter(|section| {
            !section.starts_with("[Comments]") && !section.starts_with("[Section of the maker]")
        })
        .collect::<Vec<_>>()
        .join("\r\n\r\n")
        .trim_end()
        .to_owned()
}

/// The systems of the specifications above, which may have warnings.
fn systems() -> impl Iterator<Item = (&'static str, System)> {
    SPECIFICATIONS.into_iter().map(|path| {
        let mut sources = SourceMap::new();
        let file = sources.add(path, std::fs::read_to_string(root().join(path)).unwrap());
        (path, compile(&mut sources, file, &mut OfWorkspace).system.unwrap())
    })
}

#[test]
fn an_xdd_says_what_the_eds_says() {
    let mut devices = 0;
    for (path, system) in systems() {
        for device in &system.devices {
            let (by_xdd, _) = read(&format!("{}.xdd", device.key), write_xdd(&system, device));
            let (by_eds, _) = read(&format!("{}.eds", device.key), write_eds(&system, device));
            let (found, expected) = (eds_of(&by_xdd), eds_of(&by_eds));
            let differs = found.lines().zip(expected.lines()).find(|(found, expected)| found != expected);
            assert_eq!(differs, None, "{path}: {}", device.key);
            assert_eq!(found.len(), expected.len(), "{path}: {}", device.key);
            devices += 1;
        }
    }
    assert!(devices >= 7, "{devices} devices");
}

/// The texts of an object, by language.
fn texts(object: &Object) -> Vec<Vec<(String, String)>> {
    let of = |text: &od_spec::model::Text| {
        text.iter().map(|(language, text)| (language.to_owned(), text.to_owned())).collect()
    };
    // Of a VAR, the object's texts are its entry's.
    let entries = object.entries.iter().flat_map(|entry| [of(&entry.about), of(&entry.warning)]);
    if object.is_structured() { entries.chain([of(&object.about)]).collect() } else { entries.collect() }
}

#[test]
fn texts_come_back_in_every_language() {
    let mut compared = 0;
    for (path, system) in systems() {
        for device in &system.devices {
            let (again, _) = read(&format!("{}.xdd", device.key), write_xdd(&system, device));
            for (index, object) in &device.objects {
                let found = texts(&again.devices[0].objects[index]);
                for (found, expected) in found.iter().zip(texts(object)) {
                    let plain = |texts: &[(String, String)]| -> Vec<(String, String)> {
                        texts.iter().map(|(lang, text)| (lang.clone(), text.replace('\n', " "))).collect()
                    };
                    // A warning is in the main language only.
                    let languages: Vec<&String> = found.iter().map(|(language, _)| language).collect();
                    let expected: Vec<_> = plain(&expected)
                        .into_iter()
                        .filter(|(language, _)| languages.contains(&language))
                        .collect();
                    assert_eq!(plain(found), expected, "{path}: {} {index}", device.key);
                    compared += expected.len();
                }
            }
        }
    }
    assert!(compared > 500, "{compared} texts");
}

/// A node of `everything.od.yaml` with values in every type, and names in the application.
fn configured(system: &System, device: &Dictionary) -> Commissioning {
    let settings = [
        "2000=no",
        "2001=-127",
        "2003=-8388608",
        "2007=-36028797018963968",
        "200C=$NODEID + 0x700",
        "200F=72057594037927935",
        "2010=18446744073709551614",
        "2011=0.1",
        "2012=-2.5e300",
        "2013=<Good & \"bye\">",
        "2014=ff 00 A5",
        "2015=another text",
        "a mode=forward",
        "201B=21.5 °C",
        "201C.12=3",
        "1404.1=0x6F4",
    ];
    let mut sources = SourceMap::new();
    let settings = settings.map(|setting| {
        let file = sources.add("a setting", setting);
        Spanned::new(setting.to_owned(), sources.whole(file))
    });
    let mut diagnostics = Diagnostics::new();
    let mut node = Commissioning::of_node(device, 5);
    node.values = assign(system, device, 5, &settings, &mut diagnostics);
    assert!(!diagnostics.has_errors(), "{diagnostics:?}");
    node.node_name = "north <1>".into();
    node.net_name = "plant".into();
    node.net_number = 7;
    let id = EntryId { index: Index(0x201C), sub: SubIndex(12) };
    node.denotations.insert(Denoted::object(Index(0x2001)), "temperature of tank 3".to_owned());
    node.denotations.insert(Denoted::object(Index(0x201C)), "tanks".to_owned());
    node.denotations.insert(Denoted::entry(id), "tank 12".to_owned());
    node
}

#[test]
fn an_xdc_says_what_the_dcf_says() {
    let system = compile_clean(EVERYTHING).unwrap();
    let device = &system.devices[0];
    let node = configured(&system, device);
    let dcf = |name: &str, bytes: Vec<u8>| {
        let (system, compiled) = read(name, bytes);
        let node = compiled.node.unwrap();
        assert_eq!(node.stated_id(), Some(5), "{name}");
        let node = node.at(None);
        (write_dcf(&system, &system.devices[0], &node, "node.dcf"), node)
    };
    let (by_xdc, found) = dcf("everything.xdc", write_xdc(&system, device, &node, "everything.xdc"));
    let (by_dcf, expected) = dcf("everything.dcf", write_dcf(&system, device, &node, "everything.dcf"));
    assert_eq!(found, expected);
    assert_eq!(found.values.len(), 16);
    assert_eq!(without_what_xdd_lacks(by_xdc), without_what_xdd_lacks(by_dcf));
    // The words of parameter files about the node are comments, whatever is in them.
    let mut reported = node.clone();
    reported.remarks = vec!["Tank 3, north -- not <south>".to_owned(), "zweite\u{1} Zeile -----".to_owned()];
    let xdc = write_xdc(&system, device, &reported, "everything.xdc");
    let (_, again) = dcf("everything.xdc", xdc.clone());
    assert_eq!(again, expected);
    let text = String::from_utf8(xdc).unwrap();
    assert!(text.contains("\n<!-- Tank 3, north - - not <south> -->\n<!-- zweite Zeile - - - - - -->\n"));
    // What was read from an XDC makes the same XDC.
    let (again, compiled) = read("everything.xdc", write_xdc(&system, device, &node, "everything.xdc"));
    let first = write_xdc(&again, &again.devices[0], &compiled.node.unwrap().at(None), "everything.xdc");
    let (third, compiled) = read("everything.xdc", first.clone());
    let second = write_xdc(&third, &third.devices[0], &compiled.node.unwrap().at(None), "everything.xdc");
    assert_eq!(String::from_utf8(second).unwrap(), String::from_utf8(first).unwrap());
}

/// An XDD has the types and units of the specification; where a library says the same of an object, nothing is left to define.
#[test]
fn a_specification_of_an_xdd_defines_nothing_in_vain() {
    let mut libraries = 0;
    for path in ["od-spec/devices/pitch-control-system.od.yaml", "od-spec/devices/fullmo-drive.od.yaml"] {
        let system = compile_clean(path).unwrap();
        for device in &system.devices {
            let mut sources = SourceMap::new();
            let bytes = write_xdd(&system, device);
            let file = add_source(&mut sources, &format!("{}.xdd", device.key), bytes).unwrap();
            let xdd = compile(&mut sources, file, &mut OfWorkspace);
            let text = import(&xdd, &sources, file).unwrap().unwrap().text;
            libraries += usize::from(text.contains("from: cia301"));
            let (again, _) = compiled(&format!("{}.od.yaml", device.key), text.into_bytes());
            let unused: Vec<_> = again.diagnostics.iter().filter(|one| one.code.id == "OD0806").collect();
            assert_eq!(unused, Vec::<&Diagnostic>::new(), "{path}: {}", device.key);
        }
    }
    assert_eq!(libraries, 3);
}
