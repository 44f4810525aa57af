//! The printed text; what it does on a controller, tests/readers/st.py evaluates.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::sync::LazyLock;

use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::wording::{Language, Texts};
use od_spec::{NoFiles, compile};

use super::device::Device;
use super::phrases::Phrase;
use super::{Written, write, written as written_as};

fn system(text: &str) -> System {
    let mut sources = SourceMap::new();
    let name = if text.starts_with("[DeviceInfo]") { "valve.eds" } else { "valve.od.yaml" };
    let root = sources.add(name, text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    compiled
        .system
        .unwrap_or_else(|| panic!("{}", render(&compiled.diagnostics, &sources, Format::Human, false)))
}

fn written(text: &str, node: Option<u8>) -> (Written, String) {
    let system = system(text);
    let written = write(&system, &system.devices[0], node, None);
    let all = written.artifacts.iter().map(|file| String::from_utf8(file.bytes.clone()).unwrap());
    let all = all.collect::<Vec<_>>().concat();
    (written, all)
}

/// Names that are words of the language, that differ in nothing but case, and that are too long; texts that could end a comment.
const NAMES: &str = "
od-spec: 1
title: Valve
uses: [cia301]
devices:
  24v-valve: {name: Valve *) x, bit-rates: [125], granularity: 1, features: [heartbeat producer]}
units: {step: {symbol: mm, scale: 1/3}, far: {symbol: m, scale: 1/36028797018963968}}
types:
  way: {base: unsigned8, values: {0: on, 1: At, 2: Ω}}
  flags: {base: unsigned8, bits: {0: type, 1: ready, 2: Ready, 3..4: {name: r, values: {0: slow}}, 5..7: unused}}
objects:
  0x2000: {name: Set Point, type: unsigned8, unit: step, access: rw, pdo: receive, about: 'ends *) here (* or \"not\"'}
  0x2001: {name: set-point, type: unsigned8, unit: far, access: rw, pdo: receive}
  0x2002: {name: way, type: way, access: rw, pdo: receive}
  0x2003: {name: flags, type: flags, access: ro, pdo: transmit}
  0x2004: {name: part of the plant that is described by a name which no reader wants to see twice or type even once, type: integer24, access: rw, pdo: receive}
  0x2005: {name: a real, type: real32, access: rw, pdo: receive}
pdos:
  24v-valve:
    receive: {1: {map: [0x2000, 0x2001, 0x2002, 0x2004]}, 2: {map: [0x2005]}}
    transmit: {1: {map: [0x2003]}}
";

#[test]
fn names_are_names_of_the_language() {
    let (written, text) = written(NAMES, Some(5));
    for line in [
        "    N24V_VALVE_SET_POINT_2000_0_INDEX : UINT := 16#2000;",
        "    N24V_VALVE_SET_POINT_2001_0_INDEX : UINT := 16#2001;",
        "    on_0 := 0, (* on *)",
        "    at_1 := 1, (* At *)",
        "    ohm := 2 (* Ω *)",
        "    type_b0 : BOOL; (* Bit 0; type *)",
        "    ready_b1 : BOOL; (* Bit 1; ready *)",
        "    ready_b2 : BOOL; (* Bit 2; Ready *)",
        "    r_b3 : USINT; (* Bits 3..4; r *)",
    ] {
        assert!(text.contains(&line.replace("Bit", "bit")), "{line}\n{text}");
    }
    let long = text.lines().filter_map(|line| line.trim().split(' ').next()).map(str::len).max();
    assert!(long <= Some(super::names::LONGEST), "{long:?}");
    let names: Vec<String> = text
        .lines()
        .filter_map(|line| line.strip_prefix("    N24V").and_then(|rest| rest.split(' ').next()))
        .map(str::to_ascii_uppercase)
        .collect();
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
    let reported: Vec<String> = written.left_out.iter().map(ToString::to_string).collect();
    assert_eq!(
        reported,
        [
            "the bytes of RPDO2 of 24v-valve: it carries a REAL, and tools differ in what converts its bits",
            "conversions of 2001h set-point of 24v-valve: LREAL does not have the numbers in the scale of `far` exactly",
        ]
    );
}

#[test]
fn code_is_ascii_and_no_text_ends_a_comment() {
    let (_, text) = written(NAMES, None);
    let mut code = String::new();
    let mut rest = text.as_str();
    while let Some((before, behind)) = rest.split_once("(*") {
        let (comment, after) = behind.split_once("*)").expect("an end");
        assert!(!comment.contains("(*"), "{comment}");
        code.push_str(before);
        rest = after;
    }
    code.push_str(rest);
    assert!(code.is_ascii() && !code.contains("*)"), "{code}");
    assert!(text.contains("ends * ) here ( * or \"not\""), "{text}");
}

#[test]
fn the_same_specification_gives_the_same_bytes() {
    let system = system(NAMES);
    let first = write(&system, &system.devices[0], None, Some("de"));
    assert_eq!(first, write(&system, &system.devices[0], None, Some("de")));
}

#[test]
fn a_pdo_of_placeholders_has_no_structure() {
    let text = "
od-spec: 1
title: Valve
uses: [cia301]
devices:
  valve: {name: Valve, bit-rates: [125], granularity: 8, dummies: [unsigned8], features: [heartbeat producer]}
objects:
  0x2000: {name: a, type: unsigned8, access: rw, pdo: receive}
pdos:
  valve: {receive: {1: {map: [unsigned8]}, 2: {map: [unsigned8, a]}}}
";
    let (written, text) = written(text, Some(5));
    let reported: Vec<String> = written.left_out.iter().map(ToString::to_string).collect();
    assert_eq!(reported, ["RPDO1 of valve: it carries nothing but placeholders"]);
    assert!(!text.contains("TYPE VALVE_RPDO1 "), "{text}");
    assert!(text.contains("data[0] := 16#00;\ndata[1] := USINT_TO_BYTE(u1);"), "{text}");
}

/// What no specification says, and an EDS does: a CAN-ID of 29 bits, nothing of an entry, a part of one, and an entry that there is not.
#[test]
fn a_foreign_mapping_is_taken_as_it_is() {
    let mut text = "[DeviceInfo]\nProductName=Valve\n".to_owned();
    let var = |section: &str, data_type: u8, value: &str| {
        format!(
            "[{section}]\nParameterName=p {section}\nObjectType=7\nDataType={data_type}\nAccessType=rw\nPDOMapping=1\nDefaultValue={value}\n"
        )
    };
    text += &var("2000", 3, "-2");
    for (index, subs) in [
        ("1400", &[(5, "2"), (7, "0x20000181"), (5, "255")][..]),
        ("1600", &[(5, "3"), (7, "0x20000000"), (7, "0x2000000C"), (7, "0x30000010")][..]),
    ] {
        let _ = write!(text, "[{index}]\nParameterName=p{index}\nObjectType=9\n");
        for (sub, (data_type, value)) in subs.iter().enumerate() {
            text += &var(&format!("{index}sub{sub}"), *data_type, value);
        }
    }
    let (written, text) = written(&text, Some(5));
    assert_eq!(written.left_out, []);
    assert!(text.contains("VALVE_RPDO1_CAN_ID : UDINT := 16#181; (* CAN-ID of 29 bits *)"), "{text}");
    assert!(text.contains("    p_2000 : UINT; (* 2000h p 2000; 12 of 16 bits are mapped *)"), "{text}");
    assert!(text.contains("    entry : UINT; (* 3000h no entry of the device *)"), "{text}");
    assert!(text.contains("IF raw.p_2000 > 4095 THEN"), "{text}");
}

#[test]
fn the_sentences_are_those_of_the_language_files() {
    let in_file: BTreeSet<&str> = Language::ENGLISH.section("structured text").map(|(key, _)| key).collect();
    assert_eq!(Phrase::ALL.iter().map(|phrase| phrase.key()).collect::<BTreeSet<_>>(), in_file);
}

/// A language whose texts are those of English in brackets.
static BRACKETED: LazyLock<Texts> = LazyLock::new(|| {
    let mut file = String::new();
    for line in Language::GERMAN.lines() {
        let text = Language::ENGLISH.text(line.section, line.key);
        write!(file, "[{}]\n{} = ⟦{text}⟧\n", line.section, line.key).unwrap();
    }
    Texts::read(file.leak())
});

/// The words that no bracket encloses.
fn words_outside_brackets(text: &str) -> BTreeSet<String> {
    let (mut depth, mut outside) = (0_usize, String::new());
    for sign in text.chars() {
        match sign {
            '⟦' => depth += 1,
            '⟧' => depth -= 1,
            _ if depth == 0 => outside.push(sign),
            _ => {}
        }
    }
    let is_number =
        |word: &str| word.strip_suffix('h').is_some_and(|word| !word.contains(char::is_lowercase));
    let words = outside.split(|sign: char| !sign.is_alphabetic());
    let words = words.filter(|word| word.contains(char::is_lowercase) && word.len() > 1 && !is_number(word));
    words.map(str::to_owned).collect()
}

#[test]
fn every_word_of_a_comment_is_in_the_language_files() {
    let system = system(NAMES);
    let mut known = words_outside_brackets(NAMES);
    for (_, object, entry) in system.devices[0].entries() {
        let texts = format!("{} {} {:?} {:?}", object.name, entry.name, entry.about, entry.named_type);
        known.extend(words_outside_brackets(&texts));
    }
    let device = Device::new(&system, &system.devices[0], Some(5), "en", Language::new("xx", || &BRACKETED));
    for file in written_as(device).artifacts {
        let text = String::from_utf8(file.bytes).unwrap().replace(super::GENERATED, "");
        let comments = text.split("(*").skip(1).filter_map(|comment| comment.split("*)").next());
        let words: BTreeSet<String> = comments.flat_map(words_outside_brackets).collect();
        let hard_coded: Vec<&String> = words.difference(&known).collect();
        assert!(hard_coded.is_empty(), "{}: {hard_coded:?}", file.path);
    }
}
