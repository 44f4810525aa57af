//! Whatever a text is, the rules say something about it without a panic, at places that exist, and mending it ends.

use od_spec::source::SourceMap;
use od_spec::{add_source, fix};
use od_tests::{break_lines, root};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use crate::format_rules::{errors, said};

/// Pieces of which faulty files are made.
const PIECES: &[&str] = &[
    "[",
    "]",
    "=",
    ";",
    "#",
    "\r",
    "\n",
    "\r\n",
    "\u{FEFF}",
    " ",
    "\t",
    "\u{0}",
    "é",
    "0x",
    "sub",
    "sub0",
    "1000",
    "1018",
    "1018sub1",
    "0x2000",
    "2000",
    "FFFF",
    "A0",
    "0",
    "1",
    "2",
    "255",
    "FileInfo",
    "DeviceInfo",
    "DummyUsage",
    "Comments",
    "Lines",
    "Line1",
    "SupportedObjects",
    "MandatoryObjects",
    "OptionalObjects",
    "ManufacturerObjects",
    "ObjectType=0x8\n",
    "SubNumber=2\n",
    "CompactSubObj",
    "ObjFlags=0\n",
    "ParameterName=x\n",
    "NrOfEntries",
    "Name",
    "Denotation",
    "ObjectLinks",
    "SupportedModules",
    "M1ModuleInfo",
    "M1FixedObjects",
    "M1Fixed2000",
    "M1SubExt6000",
    "ConnectedModules",
    "DeviceCommissioning",
    "NodeID=1\n",
    "Baudrate=500000\n",
    "CreationDate=2020-01-31\n",
    "CreationTime=13:51\n",
    "FileName=a\\x.eds\n",
    "[1000]\n",
    "[2000]\n",
    "1=0x1000\n",
    "2=0x2000\n",
];

fn go_through(name: &str, bytes: &[u8]) {
    // What is refused as a whole, nothing is said about.
    if add_source(&mut SourceMap::new(), name, bytes.to_vec()).is_err() {
        assert!(fix(name, bytes).is_err());
        return;
    }
    let (found, sources) = said(name, bytes);
    let places = found.iter().flat_map(|one| one.labels.iter().map(|label| label.span));
    let changed = found.iter().flat_map(|one| one.edits.iter().map(|edit| edit.span));
    for span in places.chain(changed) {
        let text = sources.file(span.file).text();
        assert!(text.get(span.start as usize..span.end as usize).is_some(), "{span:?}");
    }
    let fixed = fix(name, bytes).unwrap();
    assert!(errors(&fixed.left) <= errors(&found));
    for change in &fixed.changes {
        assert!(fixed.text().get(change.place.clone()).is_some(), "{change:?}");
    }
    let again = fix(name, &fixed.to_bytes()).unwrap();
    assert!(again.changes.is_empty(), "{:?} in {:?}", again.changes, fixed.text());
    assert_eq!(again.to_bytes(), fixed.to_bytes());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: od_tests::cases(80), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes(bytes in vec(any::<u8>(), 0..300)) {
        go_through("any.eds", &bytes);
    }

    #[test]
    fn any_pieces(pieces in vec(select(PIECES), 0..120)) {
        go_through("pieces.dcf", pieces.concat().as_bytes());
    }

    /// A good file with lines taken out, doubled, replaced and moved.
    #[test]
    fn a_good_file_with_faults(
        faults in vec((any::<prop::sample::Index>(), 0..5u8, select(PIECES), select(PIECES)), 1..12),
    ) {
        let text = std::fs::read_to_string(root().join("generated/eds/pmc.eds")).unwrap();
        // The first sections, with lists and some objects.
        let mut lines: Vec<String> = text.lines().take(300).map(str::to_owned).collect();
        for (at, kind, one, other) in faults {
            let at = at.index(lines.len());
            break_lines(&mut lines, at, kind, one, other);
        }
        go_through("pmc.eds", lines.join("\r\n").as_bytes());
    }
}
