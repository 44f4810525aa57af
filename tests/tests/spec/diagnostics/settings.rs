//! Settings of a node: how they are read, and what is said about wrong ones.

use od_spec::diag::Diagnostics;
use od_spec::source::{SourceMap, Spanned};
use od_spec::{ParameterValues, assign};
use od_tests::shipped::PITCH;

use crate::diagnostics::wording_rules::check_wording;
use crate::diagnostics::{human, run};

/// Settings of node 5, read.
pub(crate) struct Assigned {
    pub(crate) values: ParameterValues,
    pub(crate) diagnostics: Diagnostics,
    pub(crate) sources: SourceMap,
}

/// Reads settings for a device, given as on a command line.
pub(crate) fn assigned(spec: &str, device: &str, list: &[&str]) -> Assigned {
    let (mut sources, _, compiled) = run("spec.od.yaml", spec);
    let system = compiled.system.expect("a specification without mistakes");
    let mut settings = Vec::new();
    for (at, text) in list.iter().enumerate() {
        let name = if list.len() == 1 { "--set".to_owned() } else { format!("--set #{}", at + 1) };
        let file = sources.add(name, *text);
        settings.push(Spanned::new((*text).to_owned(), sources.whole(file)));
    }
    let mut diagnostics = Diagnostics::new();
    let values = assign(&system, system.device(device).unwrap(), 5, &settings, &mut diagnostics);
    diagnostics.sort();
    for diagnostic in &diagnostics {
        check_wording(diagnostic, &sources, &list.join(" "));
    }
    Assigned { values, diagnostics, sources }
}

/// What is said about settings, or the values that they give.
pub(crate) fn settings(spec: &str, device: &str, list: &[&str]) -> String {
    let Assigned { values, diagnostics, sources } = assigned(spec, device, list);
    if diagnostics.is_empty() {
        return values.iter().map(|(id, value)| format!("{id} = {value:?}\n")).collect::<Vec<_>>().concat();
    }
    human(&diagnostics, &sources)
}

/// A small specification with an entry of every kind that settings can touch.
pub(crate) const HEATER: &str = "\
od-spec: 1
title: Heater
uses: [cia301]
devices:
  heater: {name: Heater, bit-rates: [125], features: [heartbeat producer, store parameters]}
units:
  decicelsius: {symbol: °C, scale: 1/10}
types:
  mode:
    base: unsigned8
    values: {0: off, 1: manual, 2: automatic}
objects:
  0x2000: {name: mode of operation, type: mode, access: rw, default: off}
  0x2001:
    name: temperature
    type: integer16
    unit: decicelsius
    access: rw
    record:
      1: {name: low limit, default: 5.0 °C}
      2: {name: high limit, default: 40.0 °C, min: 0.0 °C, max: 60.0 °C, special: {32767: no limit}}
      3: {name: target, default: 20.0 °C, writable-when: \"0x2000 == 2\"}
      4: {name: measured, access: ro}
  0x2002: {name: calibration, type: unsigned16, access: rw locked, default: 100}
  0x2003: {name: position, type: integer32, access: rw, default: 0}
  0x5003: {name: short position, alias: 0x2003, type: integer16}
constraints:
  limits keep their order: {require: \"0x2001.1 < 0x2001.2\"}
";

#[test]
fn settings_that_are_right() {
    insta::assert_snapshot!(
        settings(HEATER, "heater", &["2000=automatic", "temperature.target = 21.5 °C", "2001.2=32767", "short position=-5"]),
        @r#"
        2000h = Integer(2)
        2001h.2 = Integer(32767)
        2001h.3 = Integer(215)
        5003h = Integer(-5)
        "#
    );
}

#[test]
fn settings_that_cannot_be_understood() {
    insta::assert_snapshot!(settings(HEATER, "heater", &["2000"]), @r#"
        error[OD0702]: found `2000`, expected ENTRY=VALUE
         --> --set:1:1
          |
        1 | 2000
          | ^^^^
          |
        help: write an index or a name, `=`, and a value: `607D.2=9000`
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2999=5"]), @r#"
        error[OD0310]: `heater` has no entry `2999`
         --> --set:1:1
          |
        1 | 2999=5
          | ^^^^
          |
        help: write an index in hexadecimal (`607D.2`), an object's name, or `object.entry`
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["temperature.targte=5"]), @r#"
        error[OD0310]: `heater` has no entry `temperature.targte`
         --> --set:1:1
          |
        1 | temperature.targte=5
          | ^^^^^^^^^^^^^^^^^^
          |
        help: did you mean `temperature.target`?
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2000=automatc"]), @r#"
        error[OD0403]: `automatc` is not a value of this enum
         --> --set:1:6
          |
        1 | 2000=automatc
          |      ^^^^^^^^
          |
        help: did you mean `automatic`?
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["temperature.low limit=5.05 °C"]), @r#"
        error[OD0412]: the value does not fit the unit's scale
         --> --set:1:23
          |
        1 | temperature.low limit=5.05 °C
          |                       ^^^^^^^ 50.5 steps of 0.1 °C
          |
        help: write 5.0 °C (raw 50) or 5.1 °C (raw 51), or a raw value
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2001.1=5 K", "2001.2=40000"]), @r#"
        error[OD0405]: `K` is not the symbol of unit `decicelsius`
         --> --set #1:1:8
          |
        1 | 2001.1=5 K
          |        ^^^
          |
        help: write the value in `°C`

        error[OD0404]: 40000 does not fit INTEGER16
         --> --set #2:1:8
          |
        1 | 2001.2=40000
          |        ^^^^^ allowed: -32768 to 32767
          |
        help: correct the value or the type
        note: as a bit pattern this would be -25536; write signed values in decimal
        "#);
}

#[test]
fn settings_that_are_refused() {
    insta::assert_snapshot!(settings(HEATER, "heater", &["temperature.measured=5"]), @r#"
        error[OD0703]: 2001h.4 (measured) is `ro`
         --> --set:1:22
          |
        1 | temperature.measured=5
          |                      ^
          |
        help: only entries that can be written over the bus can be set
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2002=101"]), @r#"
        error[OD0704]: 2002h (calibration) is locked: factory-set, writable only in service
         --> --set:1:6
          |
        1 | 2002=101
          |      ^^^
          |
        help: leave the entry out, because a PLC cannot write it; for service, name it with `--unlock` or under `unlock:`
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["1010.1=save"]), @r#"
        error[OD0707]: 1010h.1 (Save all parameters) must not be written by configuration tools
         --> --set:1:1
          |
        1 | 1010.1=save
          | ^^^^^^^^^^^
          |
        help: leave the entry out; writing it triggers a command
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2001.2=-0.5 °C"]), @r#"
        error[OD0406]: 2001h.2 (high limit): -0.5 °C is outside 0.0 °C to 60.0 °C
         --> --set:1:8
          |
        1 | 2001.2=-0.5 °C
          |        ^^^^^^^
          |
        help: write a value within the limits; the device refuses any other
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2000=off", "mode of operation=manual"]), @r#"
        error[OD0708]: 2000h is set twice
         --> --set #2:1:1
          |
        1 | mode of operation=manual
          | ^^^^^^^^^^^^^^^^^^^^^^^^ again here
          |
         ::: --set #1:1:1
          |
        1 | 2000=off
          | -------- first here
          |
        help: keep one of the two
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2003=7", "5003=8"]), @r#"
        error[OD0708]: 2003h is set twice
         --> --set #2:1:1
          |
        1 | 5003=8
          | ^^^^^^ again here, as 5003h
          |
         ::: --set #1:1:1
          |
        1 | 2003=7
          | ------ first here
          |
        help: keep one of the two
        "#);
}

#[test]
fn settings_that_break_conditions() {
    insta::assert_snapshot!(settings(HEATER, "heater", &["2001.1=50.0 °C"]), @r#"
        error[OD0606]: the values of `heater` break `limits keep their order`
          --> --set:1:8
           |
         1 | 2001.1=50.0 °C
           |        ^^^^^^^ 2001h.1 is 50, 2001h.2 is 40: not <
           |
          ::: spec.od.yaml:21:38
           |
        21 |       2: {name: high limit, default: 40.0 °C, min: 0.0 °C, max: 60.0 °C, special: {32767: no limit}}
           |                                      ------- 2001h.2 is 40
        ...
        28 |   limits keep their order: {require: "0x2001.1 < 0x2001.2"}
           |                                      --------------------- the constraint
           |
        help: set values that meet the condition; entries that are not set have their defaults
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2001.3=25.0 °C", "2000=manual"]), @r#"
        warning[OD0710]: the device accepts 2001h.3 only while `0x2000 == 2`
         --> --set #1:1:8
          |
        1 | 2001.3=25.0 °C
          |        ^^^^^^^
          |
        help: a download at boot will be refused unless the device is brought into that state first
        "#);
}

#[test]
fn settings_of_a_large_specification() {
    // The first line only: the others show lines of a file that grows.
    let said = |setting| {
        settings(&PITCH, "pmm", &[setting]).lines().next().map(ToOwned::to_owned).unwrap_or_default()
    };
    insta::assert_snapshot!(said("30FA.3=700 V"), @"error[OD0606]: the values of `pmm` break `dc-link voltage ladder`");
    insta::assert_snapshot!(
        said("dc-link voltage.nominal valu=1"),
        @"error[OD0310]: `pmm` has no entry `dc-link voltage.nominal valu`"
    );
}

/// As in a specification, where they are at most written as escapes.
#[test]
fn invisible_characters_are_refused() {
    let label = "od-spec: 1\ntitle: Lamp\nuses: [cia301]\ndevices:\n  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}\n\
        objects:\n  0x2000: {name: label, type: unicode-string, access: rw, capacity: 20}\n";
    for hidden in ["\u{202e}", "\u{2069}", "\u{200f}", "\u{1b}", "\u{7}", "\n", "\t", "\u{9b}", "\u{2028}"] {
        for text in [format!("2000=a{hidden}b"), format!("{hidden}2000=a"), format!("la{hidden}bel=a")] {
            let assigned = assigned(label, "lamp", &[&text]);
            let codes: Vec<_> = assigned.diagnostics.iter().map(|one| one.code.id).collect();
            assert_eq!(codes, ["OD0115"], "{text:?}");
        }
    }
    assert!(assigned(label, "lamp", &["2000=a b"]).diagnostics.is_empty());
}
