//! Whatever the bytes are, there is a text, a document and a model, and nothing panics.

use std::fmt::Write as _;

use od_spec::eds::Document;
use od_spec::encoding::{decode, encode};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, Strictness, add_source, compile_as};
use od_tests::{break_lines, root};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

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
    "0x",
    "sub",
    "sub0",
    "1000",
    "1018",
    "1400",
    "1600",
    "1A00",
    "2000",
    "FFFF",
    "$NODEID",
    "+",
    "-",
    "0",
    "1",
    "7",
    "8",
    "9",
    "254",
    "255",
    "256",
    "0xFFFFFFFF",
    "\"",
    "ä",
    "\0",
    "ParameterName",
    "ObjectType",
    "DataType",
    "AccessType",
    "DefaultValue",
    "LowLimit",
    "HighLimit",
    "PDOMapping",
    "SubNumber",
    "CompactSubObj",
    "CompactPDO",
    "NrOfRXPDO",
    "NrOfEntries",
    "Name",
    "Value",
    "ObjFlags",
    "ParameterValue",
    "FileInfo",
    "DeviceInfo",
    "DeviceComissioning",
    "MandatoryObjects",
    "SupportedModules",
    "M1ModuleInfo",
    "M1SubExt6000",
    "M1Fixed6000",
    "ConnectedModules",
    "rw",
    "ro",
    "unit mm",
    "bit 3: on",
    "bits 0..70: x",
    "1: on",
];

/// Compiles bytes at both levels, and makes every output of what comes out.
fn go_through(name: &str, bytes: &[u8]) {
    // What is refused is refused by all commands.
    let Ok((text, encoding)) = decode(bytes.to_vec()) else { return };
    assert_eq!(encode(&text, encoding).as_deref(), Ok(bytes));
    let mut sources = SourceMap::new();
    let Ok(root) = add_source(&mut sources, name, bytes.to_vec()) else { return };
    let file = sources.file(root);
    assert_eq!(Document::scan(root, file.text()).to_string(), file.text());
    for strictness in [Strictness::Foreign, Strictness::Standard] {
        let compiled = compile_as(strictness, &mut sources, root, &mut NoFiles);
        for label in compiled.diagnostics.iter().flat_map(|diagnostic| &diagnostic.labels) {
            let text = sources.file(label.span.file).text();
            assert!(text.get(label.span.start as usize..label.span.end as usize).is_some(), "{label:?}");
        }
        for edit in compiled.diagnostics.iter().flat_map(|diagnostic| &diagnostic.edits) {
            let text = sources.file(edit.span.file).text();
            assert!(text.get(edit.span.start as usize..edit.span.end as usize).is_some(), "{edit:?}");
        }
        assert!(strictness == Strictness::Standard || compiled.system.is_some());
        let Some(system) = compiled.system else { continue };
        let device = &system.devices[0];
        let eds = od_formats::eds::write_eds(&system, device);
        assert!(eds.is_ascii());
        let _ = od_formats::json::dump(&system, &[]);
        let _ = od_gen::rust::tokens(&system, device, &mut od_spec::diag::Diagnostics::new());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: od_tests::cases(100), ..ProptestConfig::default() })]

    #[test]
    fn any_bytes(bytes in vec(any::<u8>(), 0..300)) {
        go_through("any.eds", &bytes);
    }

    #[test]
    fn any_pieces(pieces in vec(select(PIECES), 0..120)) {
        go_through("pieces.dcf", pieces.concat().as_bytes());
    }

    /// A good file with lines taken out, doubled, moved and replaced.
    #[test]
    fn a_good_file_with_faults(
        faults in vec((any::<prop::sample::Index>(), 0..5u8, select(PIECES), select(PIECES)), 1..12),
        name in select(&["generated/eds/pmc.eds", "generated/eds/pmm.dcf", "generated/eds/fullmo.eds"][..]),
    ) {
        let text = std::fs::read_to_string(root().join(name)).unwrap();
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for (at, kind, one, other) in faults {
            let at = at.index(lines.len());
            break_lines(&mut lines, at, kind, one, other);
        }
        let text = lines.iter().fold(String::new(), |mut text, line| {
            let _ = write!(text, "{line}\r\n");
            text
        });
        go_through(name, text.as_bytes());
    }
}
