//! What rules say about cases that are easily missed: values through views, formulas of a configured node, what is mapped
//! but cannot be, conditions across devices.

use od_spec::diag::Language;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

use crate::{codes, said_with};

/// The codes of what is said about a specification, and about settings of node `node` of its first device.
fn said(text: &str, node: u8, settings: &[&str]) -> Vec<&'static str> {
    codes(&said_with(&Language::Specification.whole(text), node, settings))
}

const NONE: [&str; 0] = [];

#[test]
fn what_has_no_length_is_not_mapped() {
    for data_type in ["visible-string", "octet-string", "domain"] {
        let text = format!(
            "objects:\n  0x2000: {{name: label, type: {data_type}, access: ro}}\npdos:\n  io: {{transmit: {{1: {{map: [label]}}}}}}"
        );
        assert_eq!(said(&text, 1, &[]), ["OD0502"], "{data_type}");
    }
    let text = "objects:\n  0x2000: {name: label, type: visible-string, access: ro}\n  0x2001: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}}}";
    assert_eq!(said(text, 1, &["1A00.1=0x20000018"]), ["OD0502"]);
}

#[test]
fn a_fixed_mapping_counts_all_of_its_entries() {
    let map = vec!["flag"; 65].join(", ");
    let text = format!(
        "devices:\n  io: {{name: Example, bit-rates: [125], granularity: 0, features: [heartbeat producer]}}\nobjects:\n  0x2000: {{name: flag, type: boolean, access: ro, pdo: transmit}}\npdos:\n  io: {{transmit: {{1: {{mapping: fixed, map: [{map}]}}}}}}"
    );
    assert_eq!(said(&text, 1, &[]), ["OD0507"]);
}

/// An array may say that it has no elements; a rule speaks of it, so that a device that is so can be allowed to be.
#[test]
fn an_array_without_elements_is_a_finding() {
    assert_eq!(said("objects:\n  0x2000: {name: schedule, array: {count: 0}}", 1, &[]), ["OD0314"]);
}

/// Settings of a node are numbers: a formula is what it is on that node.
#[test]
fn formulas_of_a_configured_node_are_numbers() {
    let text = "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {sync-start: 0, map: [level]}}}";
    assert_eq!(said(text, 5, &["1A00.0=$NODEID+60"]), ["OD0508"]);
    assert_eq!(said(text, 5, &["1A00.2=$NODEID+0x20990003"]), ["OD0502"]);
    assert_eq!(said(text, 125, &["1800.2=$NODEID+120"]), ["OD0505"]);
    assert_eq!(said(text, 125, &["1800.6=$NODEID+120"]), ["OD0508"]);
    // That the entry is mapped twice shows that the formula was read as 20000008h.
    assert_eq!(said(text, 5, &["1A00.0=2", "1A00.2=$NODEID+0x20000003"]), ["OD0819"]);
}

const VIEWS: &str = "units:\n  volt: {symbol: V}\n  millivolt: {symbol: mV, base: 1/1000 V}\nobjects:
  0x2000: {name: fixed, type: unsigned16, access: rw locked, unit: volt, default: 5, max: 60}
  0x2001: {name: fine fixed, alias: fixed, type: unsigned16, unit: millivolt}
  0x2002: {name: free, type: unsigned16, access: rw, unit: volt, default: 5, max: 60}
  0x2003: {name: fine free, alias: free, type: unsigned16, unit: millivolt}
  0x2004: {name: count, type: unsigned16, access: rw, default: 5, max: 1000}
  0x2005: {name: short count, alias: count, type: unsigned8, max: 50}";

#[test]
fn a_view_opens_no_way_around_a_rule() {
    assert_eq!(said(VIEWS, 5, &["2001=$NODEID"]), ["OD0704"]);
    assert_eq!(said(VIEWS, 5, &["2001=1500"]), ["OD0704"], "a lock is said before what else is wrong");
    assert_eq!(said(VIEWS, 5, &["2003=$NODEID+0xEA60"]), ["OD0412"]);
    assert_eq!(said(VIEWS, 5, &["2003=61000"]), ["OD0406"]);
    // The limits of a view are those of what is written through it.
    assert_eq!(said(VIEWS, 5, &["2004=60"]), NONE);
    assert_eq!(said(VIEWS, 5, &["2005=60"]), ["OD0406"]);
}

#[test]
fn one_mistake_is_said_once() {
    let view = |target: &str| {
        format!(
            "objects:\n  0x2000: {{name: aa, type: unsigned16, {target}}}\n  0x2001: {{name: bb, alias: aa, type: unsigned8}}"
        )
    };
    assert_eq!(said(&view("access: rw, default: 120, max: 100"), 1, &[]), ["OD0406"]);
    assert_eq!(said(&view("access: rw, min: 100, max: 10"), 1, &[]), ["OD0407"]);
    assert_eq!(said(&view("access: rwr, pdo: receive"), 1, &[]), ["OD0417"]);
    // And two mistakes are said, even at one place.
    let rates = "devices:\n  io: {name: Example, bit-rates: [100, 300], features: [heartbeat producer]}";
    assert_eq!(said(rates, 1, &[]), ["OD0601", "OD0601"]);
    let mappable = "objects:\n  0x2000: {name: aa, type: unsigned8, access: rw, pdo: both}";
    assert_eq!(said(mappable, 1, &[]), ["OD0802", "OD0802"]);
    let length = "objects:\n  0x2000: {name: aa, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [aa]}}}";
    assert_eq!(said(length, 1, &["1A00.2=0x20000007"]), ["OD0502"]);
}

#[test]
fn an_emcy_that_does_not_exist_has_no_cob_id() {
    let text = "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, emergency]}\nobjects:\n  0x2000: {name: aa, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [aa]}}}";
    assert_eq!(said(text, 5, &["1014=0x80000185"]), NONE);
    assert_eq!(said(text, 5, &["1800.1=0x85"]), ["OD0504"]);
}

#[test]
fn an_enum_has_the_special_values_of_its_entry() {
    let text = "types:\n  mode: {base: unsigned16, values: {0: off, 1: on}}\nobjects:\n  0x2000: {name: mode, type: mode, access: rw, special: {7: none}}\n  0x2001: {name: short mode, alias: mode, type: unsigned8}";
    assert_eq!(said(text, 5, &["2000=7"]), NONE);
    assert_eq!(said(text, 5, &["2001=7"]), NONE);
    assert_eq!(said(text, 5, &["2000=8"]), ["OD0403"]);
    assert_eq!(said(text, 5, &["2001=8"]), ["OD0403"]);
}

const THREE: &str = "devices:
  io: {name: One, bit-rates: [125], features: [heartbeat producer], product: 5}
  jo: {name: Two, bit-rates: [125], features: [heartbeat producer], product: 1}
  zo: {name: Three, bit-rates: [125], features: [heartbeat producer], product: 1}
objects:
  0x2000: {devices: [io, jo], name: aa, type: unsigned8, access: rw, default: 5}
  0x2001: {devices: [zo], name: bb, type: unsigned8, access: rw, default: 1}
constraints:\n";

#[test]
fn a_condition_is_tried_where_it_belongs() {
    let said = |constraint: &str| said(&format!("{THREE}  order: {constraint}"), 1, &[]);
    // Seen from the device that has what is named without one.
    assert_eq!(said("{require: \"io:0x2000 < jo:0x2000\", when: \"0x2001 == 1\"}"), ["OD0606"]);
    assert_eq!(said("{devices: [jo], require: \"0x1018.2 < 3\", when: \"io:0x2000 == 5\"}"), NONE);
    // Two devices share the entry: one message.
    assert_eq!(said("{require: \"0x2000 < 3\"}"), ["OD0606"]);
    assert_eq!(said("{require: \"io:0x2000 < jo:0x2000\"}"), ["OD0606"]);
}

#[test]
fn a_condition_across_devices_sees_the_settings_of_one() {
    let text =
        format!("{THREE}  order: {{devices: [jo], require: \"0x1018.2 < 3\", when: \"io:0x2000 == 7\"}}");
    assert_eq!(said(&text, 1, &[]), NONE);
    assert_eq!(said(&text, 1, &["2000=7"]), NONE, "product 1 of `jo` is below 3");
    let text = format!(
        "{THREE}  order: {{require: \"0x2001 == 1\", when: \"io:0x2000 == 7\"}}\n  other: {{require: \"io:0x2000 < 6\", when: \"0x2001 == 1\"}}"
    );
    assert_eq!(said(&text, 1, &["2000=7"]), ["OD0606"]);
}

#[test]
fn a_library_is_judged_by_itself() {
    let text = "od-spec: 1\ntitle: Library\nprofile: mylib\nobjects:
  0x2000: {name: aa, type: unsigned8, access: rw, default: 120, max: 100}
  0x2001: {name: bb, type: unsigned8, access: ro locked}
  0x2002: {name: cc, type: unsigned8, access: ro, pdo: receive}
  0x2003: {name: dd, type: visible-string, access: ro, pdo: transmit}
  0x2004: {name: ee, type: unsigned8, access: rw, min: 9, max: 3}
  0x2005: {name: ff, type: unsigned8, access: const, default: 1, stored: application}
  0x2006: {name: gg, type: visible-string, access: rw, capacity: 2, default: abcd}
  0x2007: {name: hh, array: {count: 2, name: element, type: unsigned8, access: ro}}\n";
    let mut sources = SourceMap::new();
    let root = sources.add("mylib.od.yaml", text);
    let found = codes(&compile(&mut sources, root, &mut NoFiles).diagnostics);
    assert_eq!(found, ["OD0406", "OD0414", "OD0417", "OD0416", "OD0407", "OD0415", "OD0404", "OD0303"]);
}

/// Parameter objects of PDOs in shapes that no device should have are refused, and nothing is missed or breaks over them.
#[test]
fn odd_parameter_objects_are_refused_one_by_one() {
    let level = "\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}";
    let communication = "\n  0x1800: {name: PDO, record: {1: {name: COB-ID, type: unsigned32, access: rw}, 2: {name: kind, type: unsigned8, access: rw}}}";
    let mapping = "\n  0x1A00: {name: map, sub0: {access: rw}, record: {1: {name: mapped, type: unsigned32, access: rw}}}";
    let said = |objects: &[&str]| said(&format!("objects:{}{level}", objects.concat()), 1, &[]);
    // Of a PDO whose parameters have no values, nothing is known that could be wrong.
    assert_eq!(said(&[communication, mapping]), NONE);
    assert_eq!(said(&[communication]), ["OD0322"]);
    assert_eq!(said(&[mapping]), ["OD0322", "OD0802"]);
    let var = "\n  0x1800: {name: PDO, type: unsigned32, access: rw, default: 0x20000000}";
    assert_eq!(said(&[var, mapping]), ["OD0320"]);
    let var = "\n  0x1A00: {name: map, type: unsigned8, access: rw, default: 200}";
    assert_eq!(said(&[communication, var]), ["OD0320", "OD0508"]);
    let domain = "\n  0x1A00: {name: map, type: domain, access: rw}";
    assert_eq!(said(&[communication, domain]), ["OD0320"]);
    let text = "\n  0x1A00: {name: map, sub0: {access: rw, default: 2}, record: {1: {name: mapped, type: visible-string, access: rw, default: no}}}";
    assert_eq!(said(&[communication, text]), ["OD0508", "OD0320"]);
    let text = "\n  0x1800: {name: PDO, record: {1: {name: COB-ID, type: visible-string, access: rw, default: no}, 2: {name: kind, type: unsigned8, access: rw}}}";
    assert_eq!(said(&[text, mapping]), ["OD0320"]);
    // What follows an entry without a value is judged, too.
    let second = "\n  0x1A00: {name: map, sub0: {access: rw, default: 2}, record: {1: {name: mapped, type: unsigned32, access: rw}, 2: {name: mapped 2, type: unsigned32, access: rw, default: 0x20000010}}}";
    assert_eq!(said(&[communication, second]), ["OD0502"]);
    let empty = "\n  0x1A00: {name: map, sub0: {access: rw}, record: {}}";
    assert_eq!(said(&[communication, empty]), ["OD0314"]);
}

const LEVEL: &str = "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\n";

/// A maker reserves no identifier that the network's configuration has not given; a setting has.
#[test]
fn an_identifier_is_expected_of_a_device_not_of_a_node() {
    let tpdo =
        |parameters: &str| format!("{LEVEL}pdos:\n  io: {{transmit: {{{parameters}, map: [level]}}}}}}");
    for parameters in
        ["4: {cob-id: $NODEID + 0x480", "1: {valid: no, cob-id: 0x300", "5: {valid: no, cob-id: 0x300"]
    {
        assert_eq!(said(&tpdo(parameters), 1, &[]), NONE, "{parameters}");
    }
    for parameters in ["1: {cob-id: 0x181", "4: {cob-id: $NODEID + 0x180", "5: {cob-id: $NODEID + 0x180"] {
        assert_eq!(said(&tpdo(parameters), 1, &[]), ["OD0823"], "{parameters}");
    }
    assert_eq!(said(&tpdo("1: {valid: yes"), 5, &["1800.1=0x300"]), NONE);
    // That no PDO can have the identifier is said by itself.
    assert_eq!(said(&tpdo("1: {cob-id: $NODEID + 0x600"), 1, &[]), ["OD0503"]);
}

#[test]
fn a_time_that_is_set_is_kept_or_said() {
    let device =
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync consumer]}\n";
    let tpdo = format!(
        "{device}{LEVEL}pdos:\n  io: {{transmit: {{1: {{inhibit-time: 0, event-timer: 0, map: [level]}}}}}}"
    );
    assert_eq!(said(&tpdo, 5, &["1800.5=100"]), NONE);
    for kind in ["1800.2=0", "1800.2=240", "1800.2=252", "1800.2=253"] {
        assert_eq!(said(&tpdo, 5, &[kind]), NONE, "{kind}");
        assert_eq!(said(&tpdo, 5, &[kind, "1800.5=100"]), ["OD0824"], "{kind}");
        assert_eq!(said(&tpdo, 5, &[kind, "1800.3=100"]), ["OD0824"], "{kind}");
    }
    let rpdo = "objects:\n  0x2000: {name: level, type: unsigned8, access: rww, pdo: receive}\npdos:\n  io: {receive: {1: {inhibit-time: 0, event-timer: 0, map: [level]}}}";
    assert_eq!(said(rpdo, 5, &["1400.5=100"]), NONE, "an RPDO that fails to come is noticed");
    assert_eq!(said(rpdo, 5, &["1400.3=100"]), ["OD0824"]);
}

/// What is set says nothing about defaults.
#[test]
fn settings_are_no_defaults() {
    let array = "objects:\n  0x2000: {name: limits, array: {count: 2, name: \"limit {n}\", type: unsigned8, access: rw}}";
    assert_eq!(said(array, 5, &["2000.2=7"]), NONE);
    assert_eq!(said("objects:\n  0x2000: {name: key, type: unsigned8, access: wo}", 5, &["2000=7"]), NONE);
}

/// The number of mapped entries can be set to that of a multiplexed PDO where its access and its limits let it.
#[test]
fn a_mapping_that_can_be_changed_can_be_multiplexed() {
    let device = |count: &str| {
        format!(
            "devices:\n  io: {{name: Example, bit-rates: [125], group-messaging: yes, features: [heartbeat producer]}}\n{LEVEL}  0x1800:\n    name: TPDO 1\n    record:\n      1: {{name: COB-ID, type: unsigned32, access: rw, default: $NODEID + 0x180}}\n      2: {{name: transmission type, type: unsigned8, access: rw, default: 255}}\n  0x1A00:\n    name: TPDO 1 mapping\n    sub0: {{{count}, default: 1}}\n    record:\n      1: {{name: mapped entry 1, type: unsigned32, access: rw, default: 0x2000_0008}}"
        )
    };
    assert_eq!(said(&device("access: rw"), 1, &[]), NONE);
    assert_eq!(said(&device("access: rw, max: 64"), 1, &[]), ["OD0827"]);
    assert_eq!(said(&device("access: rw, max: 254"), 1, &[]), NONE);
}
