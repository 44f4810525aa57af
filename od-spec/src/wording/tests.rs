//! One value of each kind, in every notation.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use super::*;
use crate::model::{
    DataType, Departure, Dictionary, Entry, EntryId, ErratumKind, ErrorKind, Fact, Index, Part, Storage,
    SubIndex, System, Value,
};
use crate::source::SourceMap;

const SPECIFICATION: &str = "
od-spec: 1
title: Lamp
uses: [cia301]
units:
  tenth: {symbol: °C, scale: 1/10}
  volt: {symbol: V, scale: 1}
  third: {symbol: rev, scale: 1/3}
types:
  flags: {base: unsigned16, bits: {0: on, 1..15: unused}}
  mode: {base: integer8, values: {-113: motor heating, 2: ramp, 35: current position}}
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer, identity]}
objects:
  0x2000: {name: flags, type: flags, access: rw, default: 1, min: 0, max: 0xFF}
  0x2001: {name: mode, type: mode, access: rw, default: -113}
  0x2002: {name: warmth, type: integer16, unit: tenth, access: rw, default: 500, max: 900, special: {-32768: short circuit}}
  0x2003: {name: supply, type: unsigned16, unit: volt, access: rw, default: 0xFFFF, min: 10, max: 30, special: {0xFFFF: unknown, 0: off}}
  0x2004: {name: text, type: visible-string, access: const, default: \"\"}
  0x2005: {name: key, type: octet-string, access: const, default: 01 A1}
  0x2006: {name: real, type: real32, access: rw, default: 2}
  0x2007: {name: cob, type: unsigned32, access: rw, default: $NODEID+0x80000180}
  0x2008: {name: turns, type: unsigned8, unit: third, access: rw, default: 2}
  0x2009: {name: identity, type: unsigned32, access: ro, default: 4660}
";

fn lamp() -> System {
    let mut sources = SourceMap::new();
    let root = sources.add("lamp.od.yaml", SPECIFICATION);
    let compiled = crate::compile(&mut sources, root, &mut crate::NoFiles);
    let shown = crate::diag::render::render(
        &compiled.diagnostics,
        &sources,
        crate::diag::render::Format::Human,
        false,
    );
    compiled.system.unwrap_or_else(|| panic!("{shown}"))
}

fn entry(device: &Dictionary, index: u16) -> &Entry {
    device.entry(EntryId { index: Index(index), sub: SubIndex(0) }).unwrap()
}

const ALL: [Wording; 6] = [
    Wording::english(Notation::Eds),
    Wording::manual(Language::ENGLISH),
    Wording::manual(Language::GERMAN),
    Wording::english(Notation::Rust),
    Wording::english(Notation::Json),
    Wording::english(Notation::Diagnostic),
];

#[test]
fn defaults_in_every_notation() {
    let system = lamp();
    for (index, expected) in [
        (0x2000, ["0x0001", "0001h", "0001h", "0x0001", "0x0001", "0x0001"]),
        (
            0x2001,
            [
                "-113: motor heating",
                "-113 (8Fh): motor heating",
                "-113 (8Fh): motor heating",
                "motor heating",
                "motor heating",
                "motor heating",
            ],
        ),
        (0x2002, ["50.0 °C (500)", "50.0 °C (500)", "50,0 °C (500)", "50.0 °C", "50.0 °C", "50.0 °C"]),
        (
            0x2003,
            [
                "0xFFFF (unknown)",
                "FFFFh (unknown)",
                "FFFFh (unknown)",
                "0xFFFF (unknown)",
                "0xFFFF (unknown)",
                "0xFFFF (unknown)",
            ],
        ),
        (0x2004, ["\"\"", "\"\"", "\"\"", "\"\"", "", ""]),
        (0x2005, ["01A1", "01 A1", "01 A1", "01 A1", "01A1", "01A1"]),
        (0x2006, ["2.0", "2.0", "2,0", "2.0", "2.0", "2.0"]),
        (
            0x2007,
            [
                "$NODEID+0x80000180",
                "80000180h + node-ID",
                "80000180h + Node-ID",
                "$NODEID+0x80000180",
                "$NODEID+0x80000180",
                "$NODEID+0x80000180",
            ],
        ),
        (
            0x2008,
            [
                "2 × 1/3 rev (2)",
                "2 × 1/3 rev (2)",
                "2 × 1/3 rev (2)",
                "2 × 1/3 rev",
                "2 × 1/3 rev",
                "2 × 1/3 rev",
            ],
        ),
        (0x2009, ["4660", "4660", "4660", "4660", "4660", "4660"]),
    ] {
        let entry = entry(&system.devices[0], index);
        let shown =
            ALL.map(|wording| wording.value(Some(Index(index)), entry, entry.default.as_ref().unwrap()));
        assert_eq!(shown, expected, "{index:04X}h");
    }
}

#[test]
fn ranges_name_what_narrows_the_type() {
    let system = lamp();
    let [eds, manual, german, rust, ..] = ALL;
    let range = |wording: Wording, index| wording.range(Index(index), entry(&system.devices[0], index));
    assert_eq!(range(manual, 0x2000).as_deref(), Some("0000h to 00FFh"));
    assert_eq!(range(manual, 0x2001), None, "the values of an enum say more");
    assert_eq!(range(manual, 0x2002).as_deref(), Some("≤ 90.0 °C (900)"));
    assert_eq!(range(german, 0x2002).as_deref(), Some("≤ 90,0 °C (900)"));
    assert_eq!(range(rust, 0x2002).as_deref(), Some("≤ 90.0 °C"));
    assert_eq!(range(eds, 0x2002).as_deref(), Some("at most 90.0 °C (900)"));
    assert_eq!(range(german, 0x2003).as_deref(), Some("10 V bis 30 V"));
    assert_eq!(range(manual, 0x2009), None);
    assert_eq!(allowed(entry(&system.devices[0], 0x2002)), "-3276.8 °C to 90.0 °C");
}

#[test]
fn special_values_are_patterns_where_the_standards_print_one() {
    let system = lamp();
    let [eds, manual, ..] = ALL;
    let list = |wording: Wording, index| {
        let entry = entry(&system.devices[0], index);
        entry.special.iter().map(|special| wording.special(entry, special)).collect::<Vec<_>>()
    };
    assert_eq!(list(manual, 0x2002), ["-32768: short circuit"]);
    assert_eq!(list(manual, 0x2003), ["0: off", "FFFFh: unknown"]);
    assert_eq!(list(eds, 0x2003), ["0: off", "0xFFFF: unknown"]);
    let is_pattern = |raw, data_type| {
        Radix::of_special(&Entry { data_type, ..entry(&system.devices[0], 0x2009).clone() }, raw)
            == Radix::Hexadecimal
    };
    assert!(is_pattern(0xFF, DataType::Unsigned8) && !is_pattern(0xFE, DataType::Unsigned8));
    assert!(is_pattern(0xFF00, DataType::Unsigned16) && !is_pattern(0xFEFF, DataType::Unsigned16));
    assert!(is_pattern(0x6576_6173, DataType::Unsigned32) && !is_pattern(0xFFFF, DataType::Unsigned32));
    assert!(!is_pattern(-1, DataType::Integer8) && !is_pattern(0x7FFF_FFFF, DataType::Integer32));
}

#[test]
fn numbers_of_the_communication_profile_are_patterns() {
    let system = lamp();
    let vendor = EntryId { index: Index(0x1018), sub: SubIndex(1) };
    let entry = system.devices[0].entry(vendor).unwrap();
    let [eds, manual, ..] = ALL;
    let value = Value::Integer(0x319);
    assert_eq!(manual.value(Some(vendor.index), entry, &value), "00000319h");
    assert_eq!(eds.value(Some(vendor.index), entry, &value), "0x00000319");
    assert_eq!(manual.mapping_parameter(0x6040_0010), "6040 00 10h");
    assert_eq!(eds.mapping_parameter(0x6040_0010), "0x60400010");
    assert_eq!(manual.node_id_formula(0x180), "180h + node-ID");
    assert_eq!(manual.cob_id_entry(&Value::NodeId(0x8000_0300)), "80000300h + node-ID");
    assert_eq!(
        (manual.can_id(&Value::NodeId(0x8000_0300)), eds.can_id(&Value::Integer(0x4000_0180))),
        ("300h + node-ID".to_owned(), "0x180".to_owned())
    );
    // A 29-bit CAN-ID keeps all of its bits.
    assert_eq!(eds.can_id(&Value::Integer(0x2001_2345)), "0x00012345");
    assert_eq!(manual.pattern(DataType::Integer8, -1), "FFh");
}

#[test]
fn units_say_one_step() {
    let system = lamp();
    let [_, manual, german, ..] = ALL;
    let unit = |name: &str| &system.units[name];
    assert_eq!(
        (manual.step(unit("tenth")), german.step(unit("tenth"))),
        ("0.1 °C".to_owned(), "0,1 °C".to_owned())
    );
    assert_eq!(
        (manual.step(unit("volt")), manual.counted_step(unit("volt"))),
        ("V".to_owned(), "1 V".to_owned())
    );
}

#[test]
fn only_the_manual_has_degrees_without_a_space() {
    let [eds, manual, ..] = ALL;
    let quantities = |wording: Wording| ["°", "°C", "°/s", ""].map(|symbol| wording.quantity("1", symbol));
    assert_eq!(quantities(manual), ["1°", "1 °C", "1 °/s", "1"]);
    // Comments of an EDS are read back.
    assert_eq!(quantities(eds), ["1 °", "1 °C", "1 °/s", "1"]);
}

#[test]
fn facts_have_words_in_every_language() {
    let [_, english, german, rust, ..] = ALL;
    let run = Part::Entries { first: SubIndex(2), last: SubIndex(15) };
    for (part, fact, words) in [
        (Part::Object, Fact::Default, ["default", "Vorgabe"]),
        (Part::Elements, Fact::Unit, ["elements: unit", "Elemente: Einheit"]),
        (Part::Entry(SubIndex(0)), Fact::Name, ["sub-index 0: name", "Subindex 0: Name"]),
        (run, Fact::Presence, ["sub-indices 2 to 15: added", "Subindizes 2 bis 15: zusätzlich"]),
    ] {
        let departure = Departure { part, fact };
        assert_eq!([english, german].map(|wording| wording.departure(departure)), words);
    }
    // Two facts with one word could not be distinguished.
    for wording in [english, german] {
        let words: BTreeSet<&str> = Fact::ALL.iter().map(|fact| wording.fact(*fact)).collect();
        assert_eq!(words.len(), Fact::ALL.len());
    }
    assert_eq!(german.erratum_kind(ErratumKind::Gap), "Lücke");
    assert_eq!(english.erratum_kind(ErratumKind::Gap), ErratumKind::Gap.word());
    assert_eq!(german.storage(Storage::Remanent), "von selbst");
    assert_eq!(rust.storage(Storage::Application), "stored with the application parameters");
    assert_eq!(english.storage(Storage::No), "");
}

#[test]
fn dates_follow_the_language() {
    let date = crate::model::Date { year: 2009, month: 5, day: 27 };
    assert_eq!(Language::GERMAN.date(date), "27.05.2009");
    assert_eq!(Language::of("fr").date(date), "2009-05-27");
    assert_eq!(Language::of("de-AT"), Language::GERMAN);
    assert_eq!(Language::of("den"), Language::ENGLISH);
}

/// The places of a text that differ: `{1}`.
fn placeholders(text: &str) -> BTreeSet<&str> {
    text.split('{').skip(1).filter_map(|piece| Some(piece.split_once('}')?.0)).collect()
}

/// What is wrong with the texts of a language, in addition to those of English and the words of specifications.
fn problems(language: Language) -> Vec<String> {
    // Each language has phrases of its own there.
    let of_all = |line: &&Line| line.section != "search";
    let mut wanted: BTreeMap<(&str, &str), BTreeSet<&str>> = BTreeMap::new();
    for line in Language::ENGLISH.lines().filter(of_all) {
        wanted.insert((line.section, line.key), placeholders(&line.text));
    }
    let words = Fact::ALL.iter().map(|fact| ("kinds of facts", fact.word()));
    let words = words.chain(ErrorKind::WORDS.iter().map(|word| ("kinds of errors", *word)));
    let words = words.chain(ErratumKind::WORDS.iter().map(|word| ("kinds of errata", *word)));
    wanted
        .extend(words.chain(TABLES.map(|word| ("kinds of tables", word))).map(|key| (key, BTreeSet::new())));
    let mut problems = Vec::new();
    let mut seen = BTreeSet::new();
    for line in language.lines().filter(of_all) {
        let place = format!("[{}] {}", line.section, line.key);
        if !seen.insert((line.section, line.key)) {
            problems.push(format!("{place}: twice"));
        }
        match wanted.get(&(line.section, line.key)) {
            None => problems.push(format!("{place}: unknown")),
            Some(expected) if *expected != placeholders(&line.text) => {
                problems.push(format!("{place}: not the same placeholders"));
            }
            Some(_) => {}
        }
    }
    let missing = wanted.into_keys().filter(|key| !seen.contains(key));
    problems.extend(missing.map(|(section, key)| format!("[{section}] {key}: missing")));
    problems
}

/// The keys that fill tables.
const TABLES: [&str; 18] = [
    "axis",
    "bits",
    "commands",
    "errors",
    "flow",
    "glossary",
    "history",
    "hysteresis",
    "ladder",
    "objects",
    "overview",
    "pdos",
    "reactions",
    "rows",
    "states",
    "timing",
    "transitions",
    "values",
];

#[test]
fn every_language_has_every_text() {
    for language in Language::ALL.iter().filter(|language| **language != Language::ENGLISH) {
        assert_eq!(problems(*language), [""; 0], "languages/{}.txt", language.code());
    }
    // A form feed or a tab would be part of a text.
    let control = |line: &&Line| line.text.contains(char::is_control) || line.key.contains(char::is_control);
    assert_eq!(Language::ALL.iter().flat_map(|language| language.lines()).find(control), None);
}

#[test]
fn every_mistake_of_a_language_is_found() {
    static TEXTS: LazyLock<Texts> = LazyLock::new(|| {
        let right = include_str!("../../languages/de.txt");
        let wrong = right
            .replacen("\ncommunication =", "\ncomunication =", 1)
            .replacen("\nentry = Subindex {1}:", "\nentry = Subindex {3}:", 1)
            .replacen("\nmandatory =", "\noptional =", 1)
            .replacen("\nmin = ", "\nmin: ", 1);
        Texts::read(wrong.leak())
    });
    assert_eq!(
        problems(Language::new("xx", || &TEXTS)),
        [
            "[facts] comunication: unknown",
            "[facts] optional: twice",
            "[departures] entry: not the same placeholders",
            "[kinds of facts] min: kleinster Wert: unknown",
            "[facts] communication: missing",
            "[facts] mandatory: missing",
            "[kinds of facts] min: missing",
        ]
    );
}

#[test]
fn texts_are_read_line_by_line_and_filled_in() {
    static TEXTS: LazyLock<Texts> =
        LazyLock::new(|| Texts::read("# none\n[facts]\nto_range = up\n  to\n\n[language]\ndate = {2}/{1}\n"));
    let language = Language::new("xx", || &TEXTS);
    let word = Wording::manual(language).word(Word::ToRange);
    assert_eq!((word, language.text("facts", "not_stored")), ("up to", "not stored"));
    assert_eq!(language.date(crate::model::Date { year: 2009, month: 5, day: 27 }), "05/2009");
    assert_eq!(filled("{2} {x} { {1}{1} {3}", &["{2}", "b"]), "b {x} { {2}{2} {3}");
}
