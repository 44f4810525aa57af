//! Settings of entries of each kind: views, formulas, PDO parameters, texts.

use crate::diagnostics::settings::settings;

/// Entries with views, formulas, texts and PDOs.
const VIEWS: &str = "\
od-spec: 1
title: Views
uses: [cia301]
devices:
  views: {name: Views, bit-rates: [125], features: [heartbeat producer], dummies: [unsigned8]}
units:
  millivolt: {symbol: mV, base: 1/1000 V}
  volt: {symbol: V}
objects:
  0x2000: {name: mode, type: unsigned8, access: rw, default: 0}
  0x2001: {name: label, type: visible-string, access: rw, default: none}
  0x2002: {name: key, type: octet-string, access: rw}
  0x2003: {name: ratio, type: real32, access: rw}
  0x2004: {name: not in tools, type: unsigned8, access: rw, default: 0, eds: {access: ro}}
  0x2005: {name: own identifier, type: unsigned16, access: rw, default: $NODEID + 0x10, max: 0x100}
  0x2006: {name: other identifier, type: unsigned16, access: rw, default: 0x10}
  0x2007: {name: title, type: unicode-string, access: rw}
  0x5064: {alias: 0x6064, type: integer16, name: short position}
  0x5065: {alias: 0x6065, type: unsigned16, unit: volt, name: coarse voltage, writable-when: \"0x2000 == 1\"}
  0x5066: {alias: 0x6066, type: unsigned16, unit: millivolt, name: fine voltage}
  0x6064: {name: position, type: integer32, access: rw, pdo: both, default: 100, min: 0, max: 1000}
  0x6065: {name: voltage, type: unsigned32, unit: millivolt, access: rw, default: 2000 mV, max: 9000 mV}
  0x6066: {name: battery, type: unsigned16, unit: volt, access: rw, default: 12 V}
  0x6067: {name: speed, type: integer32, access: rw, pdo: transmit, default: 0}
pdos:
  views:
    receive:
      1: {map: [position]}
      2: {map: [position], valid: no}
    transmit: {1: {map: [speed], sync-start: 0}}
constraints:
  position keeps below: {require: \"0x5064 < 900\"}
  voltage keeps below: {require: \"0x6065 < 8\"}
  only in mode 0: {when: \"0x2000 == 3\", require: \"0x6066 < 12\"}
  identifiers differ: {require: \"0x2005 != 0x2006\"}
";

/// The first line about each setting: message or values.
fn first_lines(device: &str, spec: &str, list: &[&[&str]]) -> String {
    let line = |settings_of_one: &&[&str]| {
        let said = settings(spec, device, settings_of_one);
        format!("{}: {}\n", settings_of_one.join(", "), said.lines().next().unwrap_or_default())
    };
    list.iter().map(line).collect()
}

#[test]
fn settings_through_a_view_keep_the_limits_of_its_target() {
    insta::assert_snapshot!(settings(VIEWS, "views", &["5064=30000"]), @r#"
        error[OD0406]: 6064h (position): 30000 is outside 0 to 1000
         --> --set:1:6
          |
        1 | 5064=30000
          |      ^^^^^
          |
        help: write a value within the limits; the device refuses any other
        note: 5064h is a view of 6064h
        "#);
    insta::assert_snapshot!(first_lines("views", VIEWS, &[
        &["5064=-1"],
        &["5064=800"],
        &["5065=10 V", "2000=1"],
        &["5065=7 V", "2000=1"],
        &["5066=1500 mV"],
        &["5066=3000 mV"],
    ]), @r#"
        5064=-1: error[OD0406]: 6064h (position): -1 is outside 0 to 1000
        5064=800: 5064h = Integer(800)
        5065=10 V, 2000=1: error[OD0406]: 6065h (voltage): 10000 mV is outside 0 mV to 9000 mV
        5065=7 V, 2000=1: 2000h = Integer(1)
        5066=1500 mV: error[OD0412]: 5066h (fine voltage): 1500 mV is not a whole number of steps of 6066h (battery)
        5066=3000 mV: 5066h = Integer(3000)
        "#);
}

#[test]
fn settings_with_a_formula_are_those_of_the_node() {
    insta::assert_snapshot!(first_lines("views", VIEWS, &[
        &["2005=$NODEID + 0x80"],
        &["2005=$NODEID + 0xFB"],
        &["2005=$NODEID + 0xFC"],
        &["2006=0x15"],
        &["2006=$NODEID + 0x10"],
        &["2005=0x10"],
    ]), @r#"
        2005=$NODEID + 0x80: 2005h = NodeId(128)
        2005=$NODEID + 0xFB: 2005h = NodeId(251)
        2005=$NODEID + 0xFC: error[OD0406]: 2005h (own identifier): 257 is outside 0 to 256
        2006=0x15: error[OD0606]: the values of `views` break `identifiers differ`
        2006=$NODEID + 0x10: error[OD0606]: the values of `views` break `identifiers differ`
        2005=0x10: error[OD0606]: the values of `views` break `identifiers differ`
        "#);
}

#[test]
fn settings_are_seen_by_conditions_under_every_name() {
    insta::assert_snapshot!(first_lines("views", VIEWS, &[
        &["2000=3"],
        &["6064=950"],
        &["5064=950"],
        &["6065=8500 mV"],
        &["5065=8 V", "2000=1"],
        &["5065=7 V"],
        &["6065=7 V"],
    ]), @r#"
        2000=3: error[OD0606]: the values of `views` break `only in mode 0`
        6064=950: error[OD0606]: the values of `views` break `position keeps below`
        5064=950: error[OD0606]: the values of `views` break `position keeps below`
        6065=8500 mV: error[OD0606]: the values of `views` break `voltage keeps below`
        5065=8 V, 2000=1: error[OD0606]: the values of `views` break `voltage keeps below`
        5065=7 V: warning[OD0710]: the device accepts 5065h only while `0x2000 == 1`
        6065=7 V: 6065h = Integer(7000)
        "#);
}

#[test]
fn settings_of_pdo_parameters_are_checked_like_pdos() {
    insta::assert_snapshot!(first_lines("views", VIEWS, &[
        &["1400.1=0x1"],
            &["1400.1=0x80000601"],
        &["1400.1=0x800"],
        &["1400.1=0x20000300"],
        &["1400.1=0xC0000300"],
        &["1400.1=0x80000000"],
        &["1400.1=$NODEID+0x180"],
        &["1400.1=$NODEID+0x80"],
        &["1400.1=$NODEID+0x300"],
        &["1401.1=$NODEID+0x200"],
        &["1401.1=$NODEID+0x200", "1400.1=0x80000000"],
        &["1400.2=245"],
        &["1400.2=252"],
        &["1800.2=252"],
        &["1800.6=240"],
        &["1800.6=241"],
        &["1600.0=9"],
        &["1600.0=0"],
        &["1600.0=2"],
        &["1600.2=0x60670020"],
        &["1600.2=0x60640010"],
        &["1600.2=0x70640010"],
        &["1600.2=0x20000008"],
        &["1600.0=2", "1600.2=0x60640020"],
        &["1600.0=3", "1600.2=0x60640020", "1600.3=0x00050008"],
        &["1600.2=0x00060010"],
        &["1A00.2=0x00050008"],
    ]), @r#"
        1400.1=0x1: error[OD0503]: 1400h.1: 001h is kept for another service
        1400.1=0x80000601: 1400h.1 = Integer(2147485185)
        1400.1=0x800: error[OD0503]: 1400h.1: 800h is no 11-bit identifier
        1400.1=0x20000300: error[OD0503]: 1400h.1: 20000300h is no 11-bit identifier
        1400.1=0xC0000300: error[OD0508]: 1400h.1: an RPDO is not asked for by remote frames
        1400.1=0x80000000: 1400h.1 = Integer(2147483648)
        1400.1=$NODEID+0x180: error[OD0504]: RPDO 1 and TPDO 1 of `views` have one COB-ID
        1400.1=$NODEID+0x80: 1400h.1 = NodeId(128)
        1400.1=$NODEID+0x300: 1400h.1 = NodeId(768)
        1401.1=$NODEID+0x200: 1401h.1 = NodeId(512)
        1401.1=$NODEID+0x200, 1400.1=0x80000000: 1400h.1 = Integer(2147483648)
        1400.2=245: error[OD0505]: 1400h.2: transmission type 245 is reserved for RPDO 1
        1400.2=252: error[OD0505]: 1400h.2: transmission type 252 is reserved for RPDO 1
        1800.2=252: warning[OD0814]: TPDO 1 waits for SYNC, but `views` has no 1005h
        1800.6=240: warning[OD0836]: 1800h.6: TPDO 1 has a SYNC start value, but transmission type 255
        1800.6=241: error[OD0508]: 1800h.6: the SYNC counter never reaches 241
        1600.0=9: error[OD0508]: 1600h: RPDO 1 maps 9 entries, but offers 8
        1600.0=0: 1600h = Integer(0)
        1600.0=2: error[OD0508]: 1600h: RPDO 1 maps 2 entries, but entry 2 is empty
        1600.2=0x60670020: error[OD0502]: 1600h.2: 6067h (speed) cannot be mapped into RPDOs
        1600.2=0x60640010: error[OD0502]: 1600h.2: 6064h has 32 bits, not 16
        1600.2=0x70640010: error[OD0502]: 1600h.2: there is no entry 7064h
        1600.2=0x20000008: error[OD0502]: 1600h.2: 2000h (mode) cannot be mapped into PDOs
        1600.0=2, 1600.2=0x60640020: warning[OD0819]: RPDO 1 maps 6064h twice, at 1600h.1 and 1600h.2
        1600.0=3, 1600.2=0x60640020, 1600.3=0x00050008: error[OD0507]: RPDO 1 carries 72 bits
        1600.2=0x00060010: error[OD0506]: 1600h.2: RPDO 1 takes no UNSIGNED16 placeholder
        1A00.2=0x00050008: error[OD0506]: 1A00h.2: a TPDO has no placeholders
        "#);
}

#[test]
fn settings_that_a_dcf_cannot_hold() {
    let long = format!("label={}", "x".repeat(241));
    let fits = format!("label={}", "x".repeat(240));
    let octets = format!("key={}", "A5".repeat(121));
    let lines = first_lines(
        "views",
        VIEWS,
        &[
            &["not in tools=1"],
            &[&long],
            &[&fits],
            &[&octets],
            &["label=a;b"],
            &["label=a=b"],
            &["label= a"],
            &["label="],
            &["title=≤ 5"],
            &["title=Größe"],
            &["title=a\tb"],
            &["ratio=1e39"],
            &["ratio= 0.5 "],
        ],
    );
    let lines = lines.replace(&"x".repeat(230), "x…").replace(&"A5".repeat(110), "A5…").replace('\t', "→");
    insta::assert_snapshot!(lines, @r#"
        not in tools=1: error[OD0703]: 2004h (not in tools) is `ro` in the EDS
        label=x…xxxxxxxxxxx: error[OD0319]: 2001h (label): the value has 241 characters, a line holds 240
        label=x…xxxxxxxxxx: 2001h = Text("x…xxxxxxxxxx")
        key=A5…A5A5A5A5A5A5A5A5A5A5A5: error[OD0319]: 2002h (key): the value has 121 bytes, a line holds 120
        label=a;b: error[OD0319]: 2001h (label): the value holds `;`, which EDS readers misread
        label=a=b: error[OD0319]: 2001h (label): the value holds `=`, which EDS readers misread
        label= a: error[OD0319]: 2001h (label): the value has spaces at its ends, which are lost
        label=: error[OD0319]: 2001h (label): the value is empty, which reads as no value
        title=≤ 5: error[OD0319]: 2007h (title): the value holds `=`, which EDS readers misread
        title=Größe: error[OD0319]: 2007h (title): the value has characters that an EDS cannot hold
        title=a→b: error[OD0115]: found U+0009, which is invisible
        ratio=1e39: error[OD0401]: found `1e39`, expected a finite number
        ratio= 0.5 : 2003h = Real(0.5)
        "#);
}
