//! Backends know devices and makers by their model only: with other names, the shipped specifications give the same outputs
//! with those names.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use od_documents::{self as docs, Format, Templates};
use od_formats::{Selection, artifacts};
use od_gen::Artifact;
use od_gen::rust::{self, Provenance};
use od_spec::diag::Diagnostics;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};
use od_tests::generate::SPECS;
use od_tests::shipped::in_one_file;

/// Names of devices, products and makers, and others of the same length that keep their place in the alphabet.
const NAMES: [(&str, &str); 6] = [
    ("fullmo", "fullmp"),
    ("pitch", "pitci"),
    ("pmc", "pmd"),
    ("pmm", "pmn"),
    ("oat", "oau"),
    ("osterholz", "osterholy"),
];

/// As pages write the bytes of a default.
fn bytes(text: &str) -> String {
    text.bytes().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().concat()
}

/// As generated code writes the bytes of a text.
fn escaped(text: &str) -> String {
    text.bytes().map(|byte| format!("\\x{byte:02X}")).collect::<Vec<_>>().concat()
}

/// The text with the other names, in small and large letters, and as bytes.
fn renamed(text: &str) -> String {
    let title = |word: &str| format!("{}{}", word[..1].to_uppercase(), &word[1..]);
    let text = NAMES.iter().fold(text.to_owned(), |text, (name, other_name)| {
        let spellings = [
            (str::to_owned(name), str::to_owned(other_name)),
            (title(name), title(other_name)),
            (name.to_uppercase(), other_name.to_uppercase()),
        ];
        spellings.iter().fold(text, |text, (name, other_name)| {
            let text = text.replace(name, other_name).replace(&escaped(name), &escaped(other_name));
            text.replace(&bytes(name), &bytes(other_name))
        })
    });
    // A word of style sheets holds the name of a maker.
    text.replace("floau", "float").replace("Floau", "Float")
}

/// Everything that a specification becomes: name and contents of each file.
fn outputs(text: &str) -> Vec<(String, String)> {
    let mut sources = SourceMap::new();
    let file = sources.add("spec.od.yaml", text);
    let system = compile(&mut sources, file, &mut NoFiles).system.unwrap();
    let mut diagnostics = Diagnostics::new();
    let rust = rust::artifacts(&system, system.devices.iter(), &Provenance::of(&sources), &mut diagnostics);
    assert!(!diagnostics.has_errors());
    let templates = [Format::Markdown, Format::Html, Format::Print]
        .map(|format| Templates::new(Some(format), &[]).unwrap());
    let documents =
        docs::artifacts(&system, "docs/", "spec", &docs::options(&system, &[], None), &templates).unwrap();
    let files = artifacts(&system, "spec", &Selection { node: Some(1), ..Selection::default() });
    let all = files.into_iter().chain(rust).chain(documents);
    all.map(|Artifact { path, bytes, .. }| (path, String::from_utf8(bytes).unwrap())).collect()
}

#[test]
fn with_other_names_nothing_else_changes() {
    for stem in od_tests::sample(SPECS) {
        let text = in_one_file(stem);
        let other_text = renamed(&text);
        assert_ne!(text, other_text);
        let (files, other_files) = (outputs(&text), outputs(&other_text));
        assert_eq!(files.len(), other_files.len());
        for ((path, contents), (other_path, other_contents)) in files.iter().zip(&other_files) {
            assert_eq!(renamed(path), *other_path);
            let expected = renamed(contents);
            let difference =
                expected.lines().zip(other_contents.lines()).find(|(expected, found)| expected != found);
            assert_eq!(difference, None, "{path}");
            assert_eq!(expected.len(), other_contents.len(), "{path}");
        }
    }
}
