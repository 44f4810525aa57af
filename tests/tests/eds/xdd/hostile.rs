//! Files that are cut off, changed by chance, deep or long: a message or a model, and never a panic.

use od_formats::xdd::write_xdd;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, add_source, compile};
use od_tests::compile_clean;
use proptest::prelude::*;

use crate::xdd::{compiled, said};

fn lift() -> Vec<u8> {
    let system = compile_clean("tests/shared/physical.od.yaml").unwrap();
    write_xdd(&system, &system.devices[0])
}

#[test]
fn a_file_that_is_cut_off_is_no_xml_and_the_place_is_reported() {
    let whole = lift();
    // After the last element nothing is missing.
    let end = whole.len() - "\n".len();
    for at in (0..end).step_by(97) {
        let (compiled, _) = compiled("cut.xdd", &whole[..at]);
        assert!(compiled.system.is_none(), "cut at {at}");
        assert!(compiled.diagnostics.iter().any(|one| one.code.id == "XDD101"), "cut at {at}");
    }
}

#[test]
fn depth_has_a_limit_and_a_document_type_is_refused() {
    let deep = format!("{}{}", "<a>".repeat(200_000), "</a>".repeat(200_000));
    assert!(said("deep.xdd", deep).contains("XDD103"));
    let bomb =
        "<?xml version=\"1.0\"?>\n<!DOCTYPE a [<!ENTITY b \"bbbb\"><!ENTITY c \"&b;&b;\">]>\n<a>&c;</a>";
    assert_eq!(
        said("bomb.xdd", bomb),
        "bomb.xdd:2:1: error[XDD102]: found a document type, expected an element (remove it: an XDD needs none)\n"
    );
}

/// Bytes may be a text in an encoding that is not read; then the message says so.
fn bytes_are_read_or_refused(bytes: Vec<u8>) {
    let mut sources = SourceMap::new();
    match add_source(&mut sources, "any.xdd", bytes) {
        Ok(root) => drop(compile(&mut sources, root, &mut NoFiles)),
        Err(refusal) => assert_eq!(refusal.code.id, "OD0102"),
    }
}

#[test]
fn few_bytes_may_be_a_text_in_gbk() {
    bytes_are_read_or_refused(vec![0x81, 0x80, 0x81, 0x40]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: od_tests::cases(200), ..ProptestConfig::default() })]

    #[test]
    fn whatever_a_value_is_changed_into_it_is_read(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), 0usize..TOKENS.len()), 1..6),
    ) {
        let mut text = String::from_utf8(lift()).unwrap();
        for (at, token) in changes {
            // The values of attributes begin after `="`.
            let places: Vec<usize> = text.match_indices("=\"").map(|(at, _)| at + 2).collect();
            let start = places[at.index(places.len())];
            let end = start + text[start..].find('"').unwrap();
            text.replace_range(start..end, TOKENS[token]);
        }
        let (compiled, _) = compiled("changed.xdd", text);
        prop_assert!(compiled.system.is_some() || compiled.diagnostics.has_errors());
    }

    #[test]
    fn any_bytes_are_read(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        bytes_are_read_or_refused(bytes);
    }
}

/// What is where something else belongs.
const TOKENS: [&str; 16] = [
    "",
    "0",
    "FFFFF",
    "-1",
    "ZZ",
    "7",
    "9",
    "rw",
    "TPDO",
    "$NODEID+0x180",
    "UID_OBJ_1000",
    "0x",
    "1e400",
    "&lt;&#10;&amp;",
    "99999999999999999999999999",
    "ä",
];
