//! Every fixed word of the documents stands in some document: a word that nothing shows is a leftover.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::path::Path;

use docs_gen::{Format, Options, Templates, context};
use minijinja::value::{Serde, Value};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{Loader, compile};

/// Specifications that have, together with [`VIEWS`], everything that documents can show.
const SPECIFICATIONS: [&str; 5] = [
    "od-spec/devices/fullmo-drive.od.yaml",
    "od-spec/devices/pitch-control-system.od.yaml",
    "tests/docs/two.od.yaml",
    "tests/readers/everything.od.yaml",
    "tests/ui/ok_everything.od.yaml",
];

/// Reads the parts of shipped specifications.
struct Devices;

impl Loader for Devices {
    fn load(&mut self, path: &str, _from: &str) -> Result<Vec<u8>, String> {
        let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../od-spec/devices");
        std::fs::read(directory.join(path)).map_err(|error| error.to_string())
    }
}

/// What none of them has: views of every kind, a manufacturer's storage group, and stated bits of 1001h.
const VIEWS: &str = "\
od-spec: 1
title: Views
uses: [cia301]
devices:
  views: {name: Views, bit-rates: [125], features: [heartbeat producer, store parameters]}
units:
  millivolt: {symbol: mV, base: 1/1000 V}
  volt: {symbol: V}
objects:
  0x1010: {from: cia301, array: {elements: {4: {name: Save calibration}}}}
  0x2000: {name: voltage, type: unsigned32, unit: millivolt, access: rw, stored: manufacturer}
  0x2001: {name: position, type: integer32, access: rw}
  0x5000: {alias: 0x2000, name: rounded up, type: unsigned16, unit: volt, rounding: up}
  0x5001: {alias: 0x2000, name: rounded to nearest, type: unsigned16, unit: volt, rounding: nearest}
  0x5002: {alias: 0x2000, name: rounded to zero, type: unsigned16, unit: volt, rounding: zero}
  0x5003: {alias: 0x2001, name: refused, type: integer16, outside: abort}
  0x5004: {alias: 0x2001, name: wrapped, type: integer16, outside: wrap}
errors:
  0x4210: {name: too hot, register: [temperature, manufacturer]}
";

/// A device that saves all parameters together.
const SAVED_TOGETHER: &str = "\
od-spec: 1
title: Saved together
uses: [cia301]
devices: {lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}}
objects:
  0x1010: {from: cia301, array: {count: 1}}
  0x2000: {name: level, type: unsigned8, access: rw, pdo: receive}
pdos: {lamp: {receive: {1: {map: [level]}}}}
";

fn system(name: &str, text: &str) -> System {
    let mut sources = SourceMap::new();
    let file = sources.add(name, text);
    compile(&mut sources, file, &mut Devices).system.unwrap_or_else(|| panic!("{name} has mistakes"))
}

fn systems() -> Vec<System> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let read = |path: &&str| system(path, &std::fs::read_to_string(root.join(path)).unwrap());
    SPECIFICATIONS.iter().map(read).chain([system("views", VIEWS), system("lamp", SAVED_TOGETHER)]).collect()
}

/// What stands for a word in a document, to see where templates print it.
fn marker(key: &str) -> String {
    format!("\u{ab}{key}\u{bb}")
}

/// Whether a text holds these words, and not only as parts of others.
fn has_words(text: &str, words: &str) -> bool {
    let is_boundary = |neighbour: Option<char>| neighbour.is_none_or(|sign| !sign.is_alphanumeric());
    text.match_indices(words).any(|(at, found)| {
        is_boundary(text[..at].chars().next_back()) && is_boundary(text[at + found.len()..].chars().next())
    })
}

/// Names of the words of a language, and of those that documents show.
struct Words {
    known: BTreeSet<&'static str>,
    shown: BTreeSet<&'static str>,
}

/// The words that the documents of a specification show.
fn words(system: &System, language: &str) -> Words {
    let options = Options { language: Some(language.to_owned()), ..Options::default() };
    let mut context = context(system, &options);
    let words = context.words.clone();
    context.words = std::collections::BTreeMap::new();
    // Words that the view itself brings stand in it as they are.
    let view = Value::from(Serde(&context)).to_string();
    let in_view = |text: &str| text.split("{n}").all(|part| has_words(&view, part.trim()));
    let mut shown: BTreeSet<&'static str> =
        words.iter().filter(|(_, text)| in_view(text)).map(|(key, _)| *key).collect();
    let markers: Vec<(&'static str, String)> = words.keys().map(|key| (*key, marker(key))).collect();
    context.words = markers.iter().map(|(key, marker)| (*key, &*marker.clone().leak())).collect();
    let pages = [Format::Markdown, Format::Html, Format::Print]
        .into_iter()
        .flat_map(|format| Templates::new(Some(format), &[]).unwrap().print(&context).unwrap());
    for page in pages {
        shown.extend(markers.iter().filter(|(_, marker)| page.text.contains(marker)).map(|(key, _)| *key));
    }
    Words { known: words.into_keys().collect(), shown }
}

#[test]
fn every_word_is_shown_in_every_language() {
    let systems = systems();
    for language in docs_gen::LANGUAGES {
        let mut missing: BTreeSet<&str> = BTreeSet::new();
        let mut found: BTreeSet<&str> = BTreeSet::new();
        for system in &systems {
            let Words { known, shown } = words(system, language);
            missing.extend(known);
            found.extend(shown);
        }
        missing.retain(|word| !found.contains(word));
        assert!(missing.is_empty(), "no document shows these words in {language}: {missing:?}");
    }
}
