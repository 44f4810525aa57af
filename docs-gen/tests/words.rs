//! Every fixed word of the documents is in some document, and documents have no fixed word that no language file has.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::LazyLock;

use docs_gen::portal::{Document, Edition, Portal};
use docs_gen::{Changed, Context, Format, Gaps, Options, Origin, Since, Templates, context};
use minijinja::value::{Serde, Value};
use od_spec::model::{Dictionary, Index, System};
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

/// An EDS: what it has no keys for is not known.
const EDS: &str = "\
[DeviceInfo]
ProductName=Lamp
[2000]
ParameterName=level
ObjectType=7
DataType=5
AccessType=rw
";

/// A bus coupler, with modules that bring objects and sub-indices.
const COUPLER: &str = "\
od-spec: 1
title: Coupler
uses: [cia301]
devices:
  coupler:
    name: Coupler
    bit-rates: [125]
    features: [heartbeat producer]
    eds:
      created: 2024-02-29 12:00
      sections:
        SupportedModules: {NrOfEntries: 1}
        M1ModuleInfo: {ProductName: 8 inputs, OrderCode: DI8}
        M1SubExtends: {NrOfEntries: 1, 1: \"0x2000\"}
        M1SubExt2000: {ParameterName: level, DataType: \"0x0005\", AccessType: ro, Count: 1}
        M1FixedObjects: {NrOfEntries: 1, 1: \"0x2001\"}
        M1Fixed2001: {ParameterName: way, ObjectType: \"0x7\", DataType: \"0x0005\", AccessType: rw}
objects:
  0x2000: {name: levels, array: {count: 1, name: \"level {n}\", type: unsigned8, access: ro}}
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
    let own = [("views", VIEWS), ("lamp", SAVED_TOGETHER), ("coupler", COUPLER), ("lamp.eds", EDS)];
    SPECIFICATIONS.iter().map(read).chain(own.map(|(name, text)| system(name, text))).collect()
}

/// A change of every device.
fn since() -> Since {
    let changed = Changed {
        device: None,
        index: None,
        sign: '~',
        place: "2000h level".to_owned(),
        values: "default: 1 → 2".to_owned(),
        consequences: "changes behaviour".to_owned(),
    };
    let of_type = Changed { index: Some(Index(0x1000)), ..changed.clone() };
    Since { name: "lamp-1.od.yaml".to_owned(), changes: vec![changed, of_type] }
}

/// What replaces a word in a document, to see where templates print it.
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

/// The keys whose markers a page has.
fn marked(page: &str) -> impl Iterator<Item = &str> {
    page.split('\u{ab}').skip(1).filter_map(|rest| Some(rest.split_once('\u{bb}')?.0))
}

/// Takes the words that the documents of a specification show out of these, by their keys.
fn take_shown(missing: &mut BTreeMap<&'static str, &str>, mut context: Context) {
    let markers: Vec<(&'static str, &'static str)> =
        context.words.keys().map(|key| (*key, &*marker(key).leak())).collect();
    context.words = BTreeMap::new();
    // Words that the view itself has are in it as they are.
    let view = Value::from(Serde(&context)).to_string();
    missing.retain(|_, text| !text.split("{1}").all(|part| has_words(&view, part.trim())));
    context.words = markers.into_iter().collect();
    for format in [Format::Markdown, Format::Html, Format::Print] {
        if missing.is_empty() {
            return;
        }
        let templates = Templates::new(Some(format), &[]).unwrap();
        let portal = Portal::new(&context, vec![Document { editions: vec![Edition::of("a", &context)] }]);
        let start_page = templates.print_portal(&portal).unwrap();
        for page in templates.print(&context).unwrap().into_iter().chain(start_page) {
            for key in marked(&page.text) {
                missing.remove(key);
            }
        }
    }
}

#[test]
fn every_word_is_shown_in_every_language() {
    let systems = systems();
    for language in Language::ALL {
        let options = Options {
            language: Some(language.code().to_owned()),
            origin: Some(Origin { file: "lamp.od.yaml".to_owned(), checksum: "CBF43926".to_owned() }),
            since: Some(since()),
            ..Options::default()
        };
        let mut contexts: Vec<_> = systems.iter().map(|one| context(&one.system, &options)).collect();
        let gathered = Options { gaps: Gaps::Gathered, ..options };
        contexts.insert(0, context(&systems[0].system, &gathered));
        let mut missing: BTreeMap<&'static str, &str> =
            contexts.iter().flat_map(|context| context.words.clone()).collect();
        // The last are small; what they show need not be looked for in the others.
        for context in contexts.into_iter().rev() {
            take_shown(&mut missing, context);
        }
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
        let mut parts = text.split(start);
        let first = parts.next().unwrap_or_default().to_owned();
        // A start within such a part belongs to it.
        let mut is_inside = false;
        text = parts.fold(first, |mut text, part| {
            let begins = !is_inside;
            let behind = part.split_once(end);
            is_inside = behind.is_none();
            if begins {
                text.push(' ');
            }
            text + behind.map_or("", |(_, behind)| behind)
        });
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

/// Units, signs of HTML, keys, names, access types and data types, which are the same in every language.
const TERMS: [&str; 15] = [
    "kbit", "amp", "gt", "lt", "quot", "odgen", "eds", "Enter", "Esc", "ro", "wo", "rwr", "rww", "const",
    "unsigned",
];

#[test]
fn every_fixed_text_is_in_the_language_files() {
    let mut hard_coded: BTreeMap<String, String> = BTreeMap::new();
    // The shipped devices show nothing else, and take long.
    for Specification { system, texts } in systems().into_iter().skip(2) {
        let mut known: BTreeSet<&str> = words_of(&texts).chain(TERMS).collect();
        // `unknown` where the specification names none.
        known.extend(words_of(&system.vendor.name));
        // What languages call themselves.
        known.extend(Language::ALL.iter().map(|language| language.text("language", "name")));
        for (_, object, entry) in system.devices.iter().flat_map(Dictionary::entries) {
            let about = entry.about.iter().map(|(_, text)| text);
            known.extend(about.chain([&*object.name, &*entry.name]).flat_map(words_of));
        }
        let words = Some(Language::new("xx", || &BRACKETED));
        let context = context(&system, &Options { words, errata: true, ..Options::default() });
        for format in [Format::Markdown, Format::Html, Format::Print] {
            let templates = Templates::new(Some(format), &[]).unwrap();
            let portal = Portal::new(&context, vec![Document { editions: vec![Edition::of("a", &context)] }]);
            let start_page = templates.print_portal(&portal).unwrap();
            for page in templates.print(&context).unwrap().into_iter().chain(start_page) {
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
