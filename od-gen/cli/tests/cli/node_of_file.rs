//! What a DCF sets for its node, in every command that acts for a node.

use std::fs;

use crate::{Scratch, code, odgen, stderr, stdout};

/// The DCF of node 5. Its COB-IDs are those of its formulas; TPDO 2 is off by default. TPDO 1 carries the torque alone.
pub(crate) const PUMP: &str = include_str!("eds/pump.dcf");

/// The same without `[DeviceComissioning]`.
pub(crate) fn without_node() -> String {
    let start = PUMP.find("[DeviceComissioning]").unwrap();
    let end = PUMP.find("[DummyUsage]").unwrap();
    PUMP[..start].to_owned() + &PUMP[end..]
}

/// The same with a TPDO 2 that has no formula.
fn with_fixed_cob_id() -> String {
    PUMP.replace("$NODEID+0x80000280", "0x80000285")
}

/// A command in a folder with `pump.dcf`: how it ends, what it prints and what it reports.
fn run(scratch: &Scratch, arguments: &[&str]) -> (i32, String, String) {
    let output = odgen(&scratch.0, &[&["--format", "short"], arguments].concat());
    (code(&output), stdout(&output), stderr(&output))
}

fn text(scratch: &Scratch, name: &str) -> String {
    String::from_utf8_lossy(&fs::read(scratch.0.join(name)).unwrap()).into_owned()
}

/// The value that a DCF sets.
fn value<'a>(dcf: &'a str, section: &str) -> Option<&'a str> {
    let at = dcf.find(&format!("[{section}]\r\n"))?;
    let section = dcf[at..].split("\r\n\r\n").next()?;
    section.lines().find_map(|line| line.strip_prefix("ParameterValue="))
}

#[test]
fn values_hold_wherever_the_node_id_is_from() {
    for (name, pump, node) in [
        ("own", PUMP.to_owned(), &[][..]),
        ("given", PUMP.to_owned(), &["--node", "5"]),
        ("without", without_node(), &["--node", "5"]),
    ] {
        let scratch = Scratch::new(&format!("node-of-file-{name}"));
        scratch.file("pump.dcf", pump);
        scratch.file("trace.log", "can0 185#0102\ncan0 285#0102\n");
        let run = |arguments: &[&str]| {
            let (code, said, wrong) = run(&scratch, &[arguments, node].concat());
            assert_eq!(code, 0, "{name}: {wrong}");
            said
        };
        run(&["dbc", "pump.dcf", "--out", "pump.dbc"]);
        let dbc = text(&scratch, "pump.dbc");
        for message in [
            "BO_ 389 pump_5_TPDO1: 2 pump_5\r\n SG_ torque : 0|16",
            "BO_ 645 pump_5_TPDO2: 2 pump_5\r\n SG_ status : 0|16",
        ] {
            assert!(dbc.contains(message), "{name}: {dbc}");
        }
        let reported = run(&["decode", "pump.dcf", "--trace", "trace.log"]);
        let reported: Vec<&str> = reported.lines().collect();
        assert!(reported[0].ends_with("2002h Torque = 513"), "{name}: {reported:?}");
        assert!(reported[1].ends_with("2001h Status = 513"), "{name}: {reported:?}");
        run(&["st", "pump.dcf", "--out", "."]);
        let constants = text(&scratch, "pump-constants.st");
        assert!(constants.contains("PUMP_SET_SPEED_DEFAULT : UINT := 1500;"), "{name}: {constants}");
        assert!(constants.contains("PUMP_TPDO1_CAN_ID : UDINT := 16#185;"), "{name}: {constants}");
        run(&["build", "pump.dcf", "--docs", "md", "--out", "built"]);
        let dcf = text(&scratch, "built/eds/pump.dcf");
        assert_eq!(value(&dcf, "2000"), Some("1500"), "{name}");
        assert!(text(&scratch, "built/pump.json").contains("\"node-id\": 5,"), "{name}");
    }
}

#[test]
fn values_hold_without_a_node_id() {
    let scratch = Scratch::new("node-of-file-nobody");
    scratch.file("pump.dcf", without_node());
    let done = |arguments: &[&str]| {
        let (code, said, wrong) = run(&scratch, arguments);
        assert_eq!(code, 0, "{wrong}");
        (said, wrong)
    };
    done(&["st", "pump.dcf", "--out", "."]);
    assert!(text(&scratch, "pump-constants.st").contains("PUMP_SET_SPEED_DEFAULT : UINT := 1500;"));
    let (dump, _) = done(&["dump", "pump.dcf"]);
    let dump: serde_json::Value = serde_json::from_str(&dump).unwrap();
    assert_eq!(dump["node"].get("node-id"), None);
    assert_eq!(dump["node"]["values"].as_array().unwrap().len(), 6);
    // A number is that of a formula only on a node that is known.
    let same_on_node_1 = without_node().replace("ParameterValue=0x185", "ParameterValue=0x181");
    scratch.file("one.dcf", same_on_node_1);
    assert!(done(&["params", "one.dcf"]).0.contains("0x181"));
    let (_, said) = done(&["docs", "pump.dcf", "--out", "docs"]);
    assert!(said.contains("note: the 6 values of the node in pump.dcf are shown as defaults"), "{said}");
    let (_, said) = done(&["build", "pump.dcf", "--docs", "md", "--out", "built"]);
    assert!(said.contains("pump.dcf states no node-ID, so no DCF is made"), "{said}");
    assert!(text(&scratch, "built/pump.json").contains("\"values\": ["));
}

#[test]
fn what_follows_the_node_id_moves_with_it() {
    let scratch = Scratch::new("node-of-file-moved");
    scratch.file("pump.dcf", PUMP);
    scratch.file("trace.log", "can0 189#0102\n");
    let run = |arguments: &[&str]| {
        let (code, said, wrong) = run(&scratch, &[arguments, &["--node", "9"]].concat());
        assert_eq!(code, 0, "{wrong}");
        assert!(!wrong.contains("OD0861"), "{wrong}");
        said
    };
    assert!(run(&["dcf", "pump.dcf", "--out", "moved.dcf"]).contains("pump node 9, 0 values set, 6 kept"));
    let dcf = text(&scratch, "moved.dcf");
    let values = ["1400sub1", "1800sub1", "1801sub1", "2000"].map(|section| value(&dcf, section).unwrap());
    assert_eq!(values, ["0x00000209", "0x00000189", "0x00000289", "1500"]);
    run(&["dbc", "pump.dcf", "--out", "pump.dbc"]);
    let dbc = text(&scratch, "pump.dbc");
    for message in ["BO_ 393 pump_9_TPDO1", "BO_ 649 pump_9_TPDO2", "BO_ 521 pump_9_RPDO1"] {
        assert!(dbc.contains(message), "{dbc}");
    }
    let reported = run(&["decode", "pump.dcf", "--trace", "trace.log"]);
    assert!(reported.contains("2002h Torque = 513"), "{reported}");
    run(&["st", "pump.dcf", "--out", "."]);
    let constants = text(&scratch, "pump-constants.st");
    assert!(constants.contains("PUMP_TPDO1_CAN_ID : UDINT := 16#189;"), "{constants}");
}

#[test]
fn a_cob_id_without_a_formula_is_reported() {
    let scratch = Scratch::new("node-of-file-fixed");
    scratch.file("pump.dcf", with_fixed_cob_id());
    let warning = "warning[OD0861]: 1801h.1: node 9 uses 285h, a COB-ID of node 5, for TPDO 2";
    for arguments in [
        &["dcf", "pump.dcf", "--node", "9", "--out", "moved.dcf"][..],
        &["dbc", "pump.dcf", "--node", "9"],
        &["decode", "pump.dcf", "--node", "9", "--trace", "pump.dcf"],
        &["st", "pump.dcf", "--node", "9", "--out", "."],
        &["build", "pump.dcf", "--node", "9", "--out", "built"],
    ] {
        let (_, _, wrong) = run(&scratch, arguments);
        assert!(wrong.contains(warning), "{arguments:?}: {wrong}");
    }
    scratch.file(
        "plant.yaml",
        "od-plant: 1\ntitle: Pumps\ndevices: {pump: pump.dcf}\ntypes:\n  station: {bit-rate: 500, positions: {A: {pump: 9}}}\n\
         sites:\n  Hall: {type: station, machines: {1: {}}}\n",
    );
    let (_, _, wrong) = run(&scratch, &["plant", "check", "plant.yaml"]);
    assert!(wrong.contains(warning), "{wrong}");
    // Without `[DeviceComissioning]`, the values show which node they were for.
    scratch.file("no-node.dcf", without_node());
    let (_, _, wrong) = run(&scratch, &["dbc", "no-node.dcf", "--node", "9"]);
    assert!(wrong.contains("node 9 uses 205h, a COB-ID of node 5, for RPDO 1; 2 more COB-IDs"), "{wrong}");
    // The node itself has its own COB-IDs, and what is set on purpose is right.
    for arguments in [
        &["dcf", "pump.dcf", "--out", "moved.dcf"][..],
        &["dcf", "pump.dcf", "--node", "9", "--set", "1801.1=0x289", "--out", "moved.dcf"],
    ] {
        let (code, _, wrong) = run(&scratch, arguments);
        assert!(code == 0 && !wrong.contains("OD0861"), "{arguments:?}: {wrong}");
    }
}

#[test]
fn two_nodes_do_not_send_with_one_cob_id() {
    let scratch = Scratch::new("node-of-file-shared");
    scratch.file("pump.dcf", PUMP);
    let both = ["dbc", "pump.dcf", "--node", "5", "--node", "9", "--out", "bus.dbc"];
    let (code, _, wrong) = run(&scratch, &both);
    assert_eq!(code, 0, "{wrong}");
    fs::remove_file(scratch.0.join("bus.dbc")).unwrap();
    // Without a node-ID, no formula gives the COB-ID of TPDO 1.
    for (pump, number, cob_id) in [(with_fixed_cob_id(), 2, "285h"), (without_node(), 1, "185h")] {
        scratch.file("pump.dcf", pump);
        let tpdo = format!("TPDO {number} of pump");
        let refused = format!("error[OD0741]: {tpdo} (node 5) and {tpdo} (node 9) have the COB-ID {cob_id}");
        for command in ["dbc", "decode", "serve"] {
            let (code, _, wrong) = run(&scratch, &[&[command], &both[1..6]].concat());
            assert!(code == 1 && wrong.contains(&refused), "{command}: {wrong}");
        }
    }
    assert!(!scratch.0.join("bus.dbc").exists());
}

/// `odgen fix` writes 500, and so the file is read.
#[test]
fn a_bit_rate_in_bit_per_second_is_read_as_it_is_mended() {
    let scratch = Scratch::new("node-of-file-rate");
    scratch.file("pump.dcf", PUMP.replace("Baudrate=500", "Baudrate=500000"));
    let (code, _, wrong) = run(&scratch, &["dcf", "pump.dcf", "--out", "made.dcf"]);
    assert_eq!(code, 0, "{wrong}");
    assert!(text(&scratch, "made.dcf").contains("\r\nBaudrate=500\r\n"));
}

/// An EDS describes a device, and takes no values of a node.
#[test]
fn values_in_an_eds_are_left_out_and_reported_once() {
    let scratch = Scratch::new("node-of-file-eds");
    scratch.file("pump.eds", without_node());
    let (code, _, wrong) = run(&scratch, &["dbc", "pump.eds", "--node", "5"]);
    assert_eq!(code, 0, "{wrong}");
    assert_eq!(wrong.matches("left out").count(), 1, "{wrong}");
    assert!(wrong.contains("`ParameterValue` belongs to a DCF, and is left out; 5 more settings"), "{wrong}");
    assert!(text(&scratch, "pump-5.dbc").contains("SG_ status"));
}

/// The lists of compact storage are values too: they make the same node as a section for each entry.
#[test]
fn a_mapping_in_compact_form_is_whole() {
    let scratch = Scratch::new("node-of-file-compact");
    let start = PUMP.find("[1A00]").unwrap();
    let end = start + PUMP[start..].find("[1A01]").unwrap();
    let compact = "[1A00]\nParameterName=TPDO 1 mapping\nObjectType=9\nDataType=7\nAccessType=rw\nCompactSubObj=1\n\n\
        [1A00Value]\nNrOfEntries=1\n1=0x20020010\n\n";
    let compact = PUMP[..start].to_owned() + compact + &PUMP[end..];
    let [of_sections, of_lists] = [("sections.dcf", PUMP), ("compact.dcf", &compact)].map(|(name, dcf)| {
        scratch.file(name, dcf);
        let (code, _, wrong) = run(&scratch, &["dbc", name, "--out", "node.dbc"]);
        assert_eq!(code, 0, "{wrong}");
        text(&scratch, "node.dbc").replace("sections", "compact")
    });
    assert!(of_sections.contains("_5_TPDO1: 2 "), "{of_sections}");
    assert_eq!(of_lists, of_sections);
}
