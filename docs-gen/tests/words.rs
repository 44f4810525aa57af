//! Every fixed word of the documents is in some document, and documents have no fixed word that no language file has.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::LazyLock;

use docs_gen::{Format, Options, Templates, context};
use minijinja::value::{Serde, Value};
use od_spec::model::{Dictionary, System};
use od_spec::source::SourceMap;
use od_spec::wording::{Language, Texts};
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

/// A specification, and the texts of all its files.
struct Specification {
    system: System,
    texts: String,
}

fn system(name: &str, text: &str) -> Specification {
    let mut sources = SourceMap::new();
    let file = sources.add(name, text);
    let system = compile(&mut sources, file, &mut Devices).system;
    let system = system.unwrap_or_else(|| panic!("{name} has mistakes"));
    Specification {
        system,
        texts: sources.files().map(|(_, file)| file.text()).collect::<Vec<_>>().join("\n"),
    }
}

fn systems() -> Vec<Specification> {
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
    context.words = BTreeMap::new();
    // Words that the view itself brings stand in it as they are.
    let view = Value::from(Serde(&context)).to_string();
    let in_view = |text: &str| text.split("{1}").all(|part| has_words(&view, part.trim()));
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
    for language in Language::ALL {
        let mut missing: BTreeSet<&str> = BTreeSet::new();
        let mut found: BTreeSet<&str> = BTreeSet::new();
        for Specification { system, .. } in &systems {
            let Words { known, shown } = words(system, language.code());
            missing.extend(known);
            found.extend(shown);
        }
        missing.retain(|word| !found.contains(word));
        assert!(missing.is_empty(), "no document shows these words in {language:?}: {missing:?}");
    }
}

/// A language whose texts are those of English in brackets.
static BRACKETED: LazyLock<Texts> = LazyLock::new(|| {
    let mut file = String::new();
    // German has a line for each word that English takes from specifications.
    for line in Language::GERMAN.lines() {
        let text = Language::ENGLISH.text(line.section, line.key);
        write!(file, "[{}]\n{} = ⟦{text}⟧\n", line.section, line.key).unwrap();
    }
    Texts::read(file.leak())
});

/// What a page shows: without tags, styles, scripts and the targets of links, but with what tags show or say of themselves.
fn shown(page: &str) -> String {
    let mut text = page.to_owned();
    for (start, end) in [("<!--", "-->"), ("<style", "</style>"), ("<script", "</script>"), ("](", ")")] {
        while let Some(at) = text.find(start) {
            let length = text[at..].find(end).map_or(text.len() - at, |length| length + end.len());
            text.replace_range(at..at + length, " ");
        }
    }
    let mut shown = String::new();
    for piece in text.split('<') {
        let (tag, rest) = piece.split_once('>').unwrap_or(("", piece));
        for attribute in [" title=\"", " aria-label=\"", " placeholder=\"", " alt=\""] {
            shown.extend(tag.split_once(attribute).and_then(|(_, value)| value.split('"').next()));
            shown.push(' ');
        }
        shown.push_str(rest);
    }
    shown
}

/// What is outside of all brackets.
fn outside_brackets(text: &str) -> String {
    let (mut depth, mut outside) = (0_usize, String::new());
    for sign in text.chars() {
        match sign {
            '⟦' => depth += 1,
            '⟧' => depth = depth.saturating_sub(1),
            _ if depth == 0 => outside.push(sign),
            _ => {}
        }
    }
    outside
}

/// The words of a text; without hexadecimal numbers, and without abbreviations in upper case, which are the same in every
/// language.
fn words_of(text: &str) -> impl Iterator<Item = &str> {
    let is_number =
        |word: &str| word.strip_suffix('h').is_some_and(|word| !word.contains(char::is_lowercase));
    let words = text.split(|sign: char| !sign.is_alphabetic());
    words.filter(move |word| word.contains(char::is_lowercase) && word.len() > 1 && !is_number(word))
}

/// Units and signs of HTML, which are the same in every language.
const TERMS: [&str; 5] = ["kbit", "amp", "gt", "lt", "quot"];

#[test]
fn every_fixed_text_is_in_the_language_files() {
    let mut hard_coded: BTreeMap<String, String> = BTreeMap::new();
    // The shipped devices show nothing else, and take long.
    for Specification { system, texts } in systems().into_iter().skip(2) {
        let mut known: BTreeSet<&str> = words_of(&texts).chain(TERMS).collect();
        // `unknown` where the specification names none.
        known.extend(words_of(&system.vendor.name));
        for (_, object, entry) in system.devices.iter().flat_map(Dictionary::entries) {
            let about = entry.about.iter().map(|(_, text)| text);
            known.extend(about.chain([&*object.name, &*entry.name]).flat_map(words_of));
        }
        let words = Some(Language::new("xx", || &BRACKETED));
        let context = context(&system, &Options { words, errata: true, ..Options::default() });
        for format in [Format::Markdown, Format::Html, Format::Print] {
            for page in Templates::new(Some(format), &[]).unwrap().print(&context).unwrap() {
                for line in outside_brackets(&shown(&page.text)).lines() {
                    // A table without number and title is called by its anchor.
                    let called = line.split(' ').filter(|part| !part.contains("section-"));
                    for word in called.flat_map(words_of).filter(|word| !known.contains(word)) {
                        hard_coded
                            .entry(word.to_owned())
                            .or_insert_with(|| format!("{}, {}: {line}", system.title, page.path));
                    }
                }
            }
        }
    }
    assert!(hard_coded.is_empty(), "no language file has these words: {hard_coded:#?}");
}
