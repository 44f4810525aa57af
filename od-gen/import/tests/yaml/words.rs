//! People read messages, and no program: worded otherwise, a file gives the same model, the same specification and the same repairs.

use std::path::Path;

use od_import::{Imported, import};
use od_spec::diag::{Diagnostics, Language, worded_otherwise};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, add_source, all_codes, compile};

use super::faults::broken;
use super::written;

/// A letter or a digit in the place of another one.
fn other(c: char) -> char {
    match c {
        'z' => 'a',
        'Z' => 'A',
        '9' => '0',
        c if c.is_ascii_alphanumeric() => char::from_u32(u32::from(c) + 1).unwrap_or(c),
        c => c,
    }
}

#[expect(clippy::needless_pass_by_value, reason = "it is called so")]
fn otherwise(text: String) -> String {
    text.chars().map(other).collect()
}

/// Whether two texts differ in nothing but the words of messages.
fn are_alike(one: &str, two: &str) -> bool {
    let differ = |(one, two): (char, char)| one != two && other(one) != two;
    one.chars().count() == two.chars().count() && !one.chars().zip(two.chars()).any(differ)
}

/// What is found in a file, in no certain order, the model, and the specification that is made of it.
struct Outcome {
    found: Vec<String>,
    system: Option<System>,
    imported: Option<Result<Imported, Diagnostics>>,
}

fn found(diagnostics: &Diagnostics) -> Vec<String> {
    let mut found: Vec<String> = diagnostics
        .iter()
        .map(|one| {
            let places: Vec<_> = one.labels.iter().map(|label| label.span).collect();
            format!("{} {:?} {places:?} {:?} {:?}", one.code, one.about, one.edits, one.meant)
        })
        .collect();
    found.sort();
    found
}

fn outcome(name: &str, bytes: &[u8]) -> Outcome {
    let mut sources = SourceMap::new();
    let Ok(root) = add_source(&mut sources, name, bytes.to_vec()) else { panic!("{name}") };
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let imported = import(&compiled, &sources, root);
    Outcome { found: found(&compiled.diagnostics), system: compiled.system, imported }
}

fn compare(name: &str, bytes: &[u8]) {
    let (one, two) = (outcome(name, bytes), worded_otherwise(otherwise, || outcome(name, bytes)));
    assert_eq!(one.found, two.found, "{name}");
    assert_eq!(format!("{:?}", one.system), format!("{:?}", two.system), "{name}");
    match (one.imported, two.imported) {
        (None, None) => {}
        (Some(Ok(one)), Some(Ok(two))) => {
            assert!(are_alike(&one.text, &two.text), "{name}:\n{}\n{}", one.text, two.text);
            assert!(are_alike(&format!("{:?}", one.repairs), &format!("{:?}", two.repairs)), "{name}");
            assert_eq!((one.allowed, one.without_place), (two.allowed, two.without_place), "{name}");
        }
        (Some(Err(one)), Some(Err(two))) => assert_eq!(found(&one), found(&two), "{name}"),
        (one, two) => panic!("{name}: {one:?} {two:?}"),
    }
}

#[test]
fn the_words_of_messages_change_nothing_that_is_made_of_a_file() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for folder in ["../cli/tests/cli/eds", "../../tests/eds", "../../tests/readers/selftest"] {
        for file in std::fs::read_dir(root.join(folder)).unwrap() {
            let path = file.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap();
            if path.extension().is_some_and(|end| ["eds", "dcf", "xdd"].iter().any(|one| end == *one)) {
                compare(name, &std::fs::read(&path).unwrap());
                count += 1;
            }
        }
    }
    assert!(count >= 20, "{count} files");
}

#[test]
fn the_words_of_messages_change_nothing_that_is_made_of_a_faulty_text() {
    let examples = all_codes().into_iter().filter_map(|code| code.example.map(|example| (code, example)));
    let is_file = |language| matches!(language, Language::Eds | Language::Dcf | Language::Xdd);
    let mut count = 0;
    for (_, example) in examples.filter(|(_, example)| is_file(example.language)) {
        compare(example.language.file_name(), example.language.whole(example.before).as_bytes());
        count += 1;
    }
    assert!(count > 80, "{count} texts");
}

#[test]
fn the_words_of_messages_change_nothing_that_is_mended() {
    for (what, system) in broken() {
        let (one, two) = (written(&system), worded_otherwise(otherwise, || written(&system)));
        assert!(are_alike(&one.text, &two.text), "{what}:\n{}\n{}", one.text, two.text);
        assert!(are_alike(&format!("{:?}", one.repairs), &format!("{:?}", two.repairs)), "{what}");
        assert_eq!((one.allowed, one.left_out), (two.allowed, two.left_out), "{what}");
    }
}
