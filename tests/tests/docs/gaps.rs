//! What a manual leaves open, and who states what: in its place on a screen, left out or gathered on paper.

use od_documents::{self as docs, Format, Gaps, Templates};
use od_tests::{compile_clean, documents};
use serde_json::Value as Json;

use super::{FULLMO, PITCH};

/// The printed manual of a specification.
fn paper(path: &str, language: &str, gaps: Gaps) -> String {
    let system = compile_clean(path).unwrap();
    let options = docs::Options { gaps, ..docs::options(&system, &[], Some(language)) };
    let templates = [Templates::new(Some(Format::Print), &[]).unwrap()];
    let files = docs::artifacts(&system, "", "s", &options, &templates).unwrap();
    String::from_utf8(files[0].bytes.clone()).unwrap()
}

/// Words by which a text says that a manual is silent.
const OPEN: [&str; 7] = [
    "not stated",
    "not said",
    "nicht angegeben",
    "nicht gesagt",
    "is not certain",
    "printed table",
    "printed text",
];

#[test]
fn the_makers_edition_does_not_say_what_it_leaves_open() {
    for (path, language, question) in [
        (PITCH, "en", "Which number means which function is not listed."),
        (FULLMO, "de", "Was AMS ist und was die Bits bedeuten, ist nicht angegeben."),
    ] {
        let page = documents::pages(path, Format::Html, language).unwrap();
        assert!(page["index.html"].contains(question), "{path}");
        let manual = paper(path, language, Gaps::LeftOut);
        let found: Vec<_> = OPEN.iter().filter(|words| manual.contains(**words)).collect();
        // The list of errors says in the words of the documents which of its columns nothing fills.
        let own = ["not stated", "nicht angegeben"];
        assert!(found.iter().all(|words| own.contains(words)), "{path}: {found:?}");
        assert!(!manual.contains(question), "{path}");
        let gathered = paper(path, language, Gaps::Gathered);
        let appendix = gathered.split("id=\"questions\"").nth(1).unwrap();
        assert!(appendix.contains(question), "{path}");
    }
}

/// The cell of a table of a context whose row begins with this text.
fn cell<'c>(table: &'c Json, first: &str, column: usize) -> &'c Json {
    let grids = table["grids"].as_array().unwrap().iter();
    let mut rows = grids.flat_map(|grid| grid["rows"].as_array().unwrap());
    let row = rows
        .find(|row| {
            // A value of a small type is shown in both notations: `-18 (EEh)`.
            let text = row["cells"][0]["text"].as_str().unwrap();
            text == first || text.split(" (").next() == Some(first)
        })
        .unwrap_or_else(|| panic!("{first}"));
    &row["cells"][column]
}

#[test]
fn what_nobody_printed_is_assumed() {
    let context = documents::context(FULLMO, "en").unwrap();
    let device = &context["devices"][0];
    for (fact, stated) in [
        ("Vendor", "manual"),
        ("Product code", "assumed"),
        ("Bit rates", "assumed"),
        ("Device type", "assumed"),
    ] {
        assert_eq!(cell(&device["facts"], fact, 1)["stated"], stated, "{fact}");
    }
    let object = |index: &str| {
        let mut objects = device["objects"].as_array().unwrap().iter();
        objects.find(|object| object["index"] == index).unwrap_or_else(|| panic!("{index}"))
    };
    let default = |index: &str, first: &str| cell(&object(index)["table"], first, 5)["stated"].clone();
    assert_eq!(default("6071h", "6071h"), "assumed");
    assert_eq!(default("1018h", "2"), "assumed");
    assert_eq!(default("1800h", "1"), "assumed");
    // What an option code does is the standard's word, how many there are the manual's.
    assert_eq!(cell(&object("605Ah")["types"][0], "0", 2)["stated"], "standard");
    assert_eq!(cell(&object("6098h")["types"][0], "17", 2)["stated"], "standard");
    assert_eq!(cell(&object("6098h")["types"][0], "-18", 2)["stated"], "manual");
    assert_eq!(cell(&device["pdos"][0]["facts"], "Active", 1)["stated"], "assumed");
}

/// A type in the maker's own words is no departure; one that puts another thing into its bits is.
#[test]
fn own_words_are_no_departure() {
    let system = compile_clean(FULLMO).unwrap();
    let departing: Vec<String> = system.devices[0]
        .objects
        .values()
        .filter(|object| object.departures.iter().any(|one| one.fact == od_spec::model::Fact::Meaning))
        .map(|object| object.index.to_string())
        .collect();
    assert_eq!(departing, ["60B8h"]);
}
