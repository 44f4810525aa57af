//! The extension next to the stack, as an application meets it: rules, locks, conditions, views, extensions of its own,
//! storage.

use crate::canopennode::project::{CUSTOM, of_text, run_together, with_prefix};

const SPECIFICATION: &str = "
od-spec: 1
title: Extension
uses: [cia301]
devices:
  thing: {name: Thing, bit-rates: [125], features: [emergency, heartbeat producer, store parameters, restore defaults]}
units:
  decivolt: {symbol: V, scale: 1/10}
  volt: {symbol: V}
  millivolt: {symbol: mV, base: 1/1000 V}
types:
  mode: {base: unsigned8, values: {0: off, 1: on, 2: {name: fast, supported: no}, 3: slow}}
objects:
  0x2000: {name: set point, identifier: set_point, type: unsigned16, access: rw, unit: decivolt, min: 1.0 V, max: 100.0 V, special: {65535: none}}
  0x2001: {name: mode, type: mode, access: rw, default: off}
  0x2002: {name: switch, type: boolean, access: rw}
  0x2003: {name: text, type: visible-string, capacity: 8, access: rw, default: abc}
  0x2004: {name: list, array: {count: 4, name: \"part {n}\", type: unsigned16, access: rw, max: 7}}
  0x2005: {name: protected, type: unsigned16, access: rw locked}
  0x2006: {name: limit, type: unsigned16, access: rw, unit: millivolt, writable-when: 0x2000 >= 2}
  0x2007: {name: wide, type: unsigned32, access: rw, unit: millivolt, max: 100000000}
  0x2008: {alias: 0x2007, name: narrow, type: unsigned16, unit: volt}
  0x2009: {name: program, type: domain, access: rw}
  0x200A: {name: identifier, type: unsigned32, access: rw, default: $NODEID + 0x700}
  0x200B: {name: free, type: unsigned16, access: rw}
  0x200C:
    name: kept
    record:
      1: {name: first, type: unsigned16, access: rw, default: 1, stored: application}
      2: {name: second, type: unsigned16, access: rw, default: 2}
  0x200D: {name: hours, type: unsigned32, access: ro, stored: remanent}
  0x200E: {name: measured, type: unsigned16, access: ro, pdo: transmit}
  0x200F: {name: counted, type: unsigned16, access: rw, pdo: both, max: 9}
  0x2010:
    name: many
    record:
      1: {name: one, type: unsigned8, access: ro, pdo: transmit}
      40: {name: forty, type: unsigned8, access: ro, pdo: transmit}
pdos:
  thing: {transmit: {1: {map: [measured, counted, many.one, many.forty]}}}
";

#[test]
fn an_application_meets_the_rules() {
    let project = of_text("extension.od.yaml", SPECIFICATION);
    assert_eq!(project.run("try_extension.c", &[]), "done\n");
}

/// A project that requests no TPDO by an entry saves the flags.
#[test]
fn flags_can_be_left_out() {
    let project = of_text("extension.od.yaml", SPECIFICATION);
    for file in ["OD_extension.c", "OD_rules.c"] {
        assert_eq!(project.complaints(file, &[CUSTOM, "-DOD_FLAGS_PDO_SIZE=0"]), "");
    }
}

#[test]
fn what_shows_views_is_compiled_where_there_is_one() {
    let views = |text: &str| {
        let project = of_text("extension.od.yaml", text);
        let has = ["OD.h", "OD_rules.c"].map(|file| {
            project.file(file).contains(if file == "OD.h" {
                "#define OD_HAS_VIEWS\n"
            } else {
                "OD_ruleViews[]"
            })
        });
        (has, project.complaints("OD_extension.c", &[CUSTOM, "-Wall", "-Wextra", "-Werror"]))
    };
    let lines: Vec<&str> = SPECIFICATION.lines().filter(|line| !line.contains("alias:")).collect();
    let without = lines.join("\n") + "\n";
    assert_eq!(views(SPECIFICATION), ([true; 2], String::new()));
    assert_eq!(views(&without), ([false; 2], String::new()));
}

/// Two dictionaries with one name for everything but the prefix: each has its own values, rules and extension.
#[test]
fn two_dictionaries_are_in_one_program() {
    let two = ["ODA", "ODB"].map(|prefix| with_prefix("extension.od.yaml", SPECIFICATION, prefix));
    assert_eq!(run_together(&two, "try_two.c", &[]), "done\n");
    for (project, prefix) in two.iter().zip(["ODA", "ODB"]) {
        let custom = project.file("CO_driver_custom.h");
        assert!(custom.contains(&format!("#ifndef {prefix}_CO_DRIVER_CUSTOM_H")), "{custom}");
        for file in [".h", ".c", "_rules.c", "_extension.h", "_extension.c"] {
            let text = project.file(&format!("{prefix}{file}"));
            for own in
                ["OD_RAM", "OD_ENTRY_", "OD_CNT_", "OD_rule", "OD_NUMBER_", "OD_extend", "OD.h", "OD->"]
            {
                assert!(!text.contains(own), "{prefix}{file} has {own}");
            }
        }
    }
}

/// The first file makes a setting, and the second one says what it lacks for its dictionary.
#[test]
fn settings_that_do_not_fit_two_dictionaries_are_an_error() {
    let more = SPECIFICATION.replace("emergency, ", "emergency, heartbeat consumer, ");
    let [first, second] = [("ODA", SPECIFICATION), ("ODB", &more)]
        .map(|(prefix, text)| with_prefix("settings.od.yaml", text, prefix));
    let included = |files: [&str; 2]| {
        let text: String = files.map(|file| format!("#include \"{file}\"\n")).concat();
        first.beside("both/CO_driver_custom.h", text.as_bytes());
        first.complaints(
            "ODA_extension.c",
            &["-DCO_DRIVER_CUSTOM", "-DCO_MULTIPLE_OD", &format!("-I{}", first.path("both").display())],
        )
    };
    let [of_first, of_second] =
        [&first, &second].map(|project| project.path("CO_driver_custom.h").display().to_string());
    assert_eq!(included([&of_second, &of_first]), "");
    let complaint = included([&of_first, &of_second]);
    assert!(
        complaint.contains("CO_CONFIG_HB_CONS_ENABLE: set by another dictionary or the project without"),
        "{complaint}"
    );
}
