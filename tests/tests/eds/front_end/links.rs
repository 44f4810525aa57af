//! Object links: from a specification into an EDS, and from there back.

use od_formats::eds::{write_dcf, write_eds};
use od_import::import;
use od_spec::Commissioning;
use od_spec::model::{Dictionary, Index};
use od_spec::source::SourceMap;

use super::{compiled, device};

const LAMP: &str = "\
od-spec: 1
title: Lamp
vendor: {name: Example, number: 0x1FF}
uses: [cia301]
devices: {lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer], eds: {created: 2024-02-29 12:00}}}
objects:
  0x2000: {name: level, type: unsigned8, access: rw, default: 1, links: [0x2002, 0x2001]}
  0x2001: {name: range, links: [0x2000], record: {1: {name: low, type: unsigned8, access: rw, default: 0}}}
  0x2002: {name: step, type: unsigned8, access: rw, default: 1}
";

fn links(device: &Dictionary) -> Vec<(u16, Vec<u16>)> {
    let linked = device.objects.values().filter(|object| !object.links.is_empty());
    linked.map(|object| (object.index.0, object.linked().map(|index| index.0).collect())).collect()
}

/// The codes of what is said about a file.
fn codes(name: &str, text: &str) -> Vec<&'static str> {
    let about = compiled(name, text).0.diagnostics;
    about.iter().map(|found| found.code.id).collect()
}

#[test]
fn they_come_back_from_eds_and_dcf() {
    let system = compiled("lamp.od.yaml", LAMP).0.system.unwrap();
    let lamp = &system.devices[0];
    let eds = String::from_utf8(write_eds(&system, lamp)).unwrap();
    for section in [
        "[2000ObjectLinks]\r\nObjectLinks=2\r\n1=0x2002\r\n2=0x2001\r\n",
        "[2001ObjectLinks]\r\nObjectLinks=1\r\n1=0x2000\r\n",
    ] {
        assert!(eds.contains(section), "{eds}");
    }
    let node = Commissioning::of_node(lamp, 5);
    let dcf = String::from_utf8(write_dcf(&system, lamp, &node, "lamp.dcf")).unwrap();
    let expected = [(0x2000, vec![0x2002, 0x2001]), (0x2001, vec![0x2000])];
    for (name, text) in [("lamp.eds", &eds), ("lamp.dcf", &dcf)] {
        assert_eq!(links(&device(name, text)), expected, "{name}");
        assert_eq!(codes(name, text), [""; 0], "{name}");
    }
}

/// A specification made of the EDS, and the EDS that is made of that, say the same.
#[test]
fn an_import_keeps_them() {
    let system = compiled("lamp.od.yaml", LAMP).0.system.unwrap();
    let eds = write_eds(&system, &system.devices[0]);
    let text = String::from_utf8(eds.clone()).unwrap();
    let mut sources = SourceMap::new();
    let root = sources.add("lamp.eds", text);
    let read = od_spec::compile(&mut sources, root, &mut od_spec::NoFiles);
    let imported = import(&read, &sources, root).unwrap().unwrap();
    assert_eq!(imported.without_place, 0, "{}", imported.text);
    assert!(imported.text.contains("links: [0x2002, 0x2001]"), "{}", imported.text);
    let again = compiled("lamp.od.yaml", &imported.text).0.system.unwrap();
    assert_eq!(String::from_utf8(write_eds(&again, &again.devices[0])), String::from_utf8(eds));
}

/// A list of links as the world may write it.
#[test]
fn lists_are_read_as_far_as_they_can_be() {
    const OBJECT: &str = "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\n[2001]\nParameterName=b\nDataType=5\nAccessType=ro\n";
    let read = |list: &str| {
        let text = format!("{OBJECT}{list}");
        let of_lists = ["EDS302", "EDS303", "EDS304", "EDS427", "OD0323"];
        let about = codes("a.eds", &text).into_iter().filter(|id| of_lists.contains(id));
        (links(&device("a.eds", &text)), about.collect::<Vec<_>>())
    };
    let one = |linked: &[u16]| vec![(0x2000, linked.to_vec())];
    // Out of order, and counted wrongly.
    let (found, about) = read("[2000objectlinks]\nObjectLinks=1\n2=0x2000\n1=8193\n");
    // The second leads to the object itself.
    assert_eq!((found, about), (one(&[0x2001, 0x2000]), vec!["EDS302", "OD0323"]));
    let (found, about) = read("[2000ObjectLinks]\nObjectLinks=2\n1=2001h\n2=0x2002\n");
    assert_eq!((found, about), (one(&[0x2002]), vec!["EDS304", "OD0323"]));
    // An object that is not described loses its links, and its sub-indices alone make one.
    let (found, about) = read("[2002ObjectLinks]\nObjectLinks=1\n1=0x2000\n");
    assert_eq!((found, about), (Vec::new(), vec!["EDS427"]));
    // Data types are not objects here.
    let (found, about) = read("[2000ObjectLinks]\nObjectLinks=1\n1=0x0005\n");
    assert_eq!((found, about), (one(&[5]), Vec::new()));
    let linked = device("a.eds", &format!("{OBJECT}[2000ObjectLinks]\nObjectLinks=1\n1=0\n"));
    assert_eq!(linked.objects[&Index(0x2000)].linked().next(), Some(Index(0)));
}

/// What an import cannot keep of a list, it says.
#[test]
fn an_import_says_what_is_lost() {
    let text = "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\n[2000ObjectLinks]\nObjectLinks=1\n1=2001h\n\
        [2002ObjectLinks]\nObjectLinks=1\n1=0x2000\n";
    let mut sources = SourceMap::new();
    let root = sources.add("a.eds", text);
    let read = od_spec::compile(&mut sources, root, &mut od_spec::NoFiles);
    let imported = import(&read, &sources, root).unwrap().unwrap();
    for line in [
        "# line 7: found `2001h`, expected an index such as 0x2000 (EDS304)",
        "# - line 8: the links of 2002h are there, but no section describes it",
    ] {
        assert!(imported.text.contains(line), "{}", imported.text);
    }
}
