//! `odgen st`.

use insta::assert_snapshot;

use crate::{LAMP, PITCH, Scratch, code, odgen, stderr, stdout};

fn read(scratch: &Scratch, path: &str) -> String {
    std::fs::read_to_string(scratch.0.join(path)).unwrap()
}

#[test]
fn a_device_has_its_files() {
    let scratch = Scratch::new("st");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["st", "lamp.od.yaml", "--node", "7", "--out", "plc"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
    assert_snapshot!("st-lamp-output", stdout(&output).replace('\\', "/"));
    assert_snapshot!("st-lamp", read(&scratch, "plc/lamp.st"));
    assert!(
        read(&scratch, "plc/lamp-constants.st").contains("LAMP_RPDO1_CAN_ID : UDINT := 16#207; (* CAN-ID *)")
    );
    // Again, over what it made itself; and not over anything else.
    let again = ["st", "lamp.od.yaml", "--out", "plc", "--lang", "de"];
    assert_eq!(code(&odgen(&scratch.0, &again)), 0);
    let constants = read(&scratch, "plc/lamp-constants.st");
    assert!(
        constants.contains("LAMP_RPDO1_CAN_ID_BASE : UDINT := 16#200; (* CAN-ID ohne die Node-ID"),
        "{constants}"
    );
    scratch.file("plc/lamp.st", "(* another tool *)");
    let output = odgen(&scratch.0, &again);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("lamp.st"), "{}", stderr(&output));
}

#[test]
fn only_some_devices_are_made_in_a_language_that_there_is() {
    let scratch = Scratch::new("st-pitch");
    let output = odgen(&scratch.0, &["st", PITCH, "--device", "pmc", "--out", "."]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(!scratch.0.join("pmm.st").exists());
    assert!(read(&scratch, "pmc-enums.st").contains("profile_position_mode := 1,"));
    for (arguments, message) in [
        (["--device", "pmx"], "pmx"),
        (["--lang", "tlh"], "there is no language `tlh`"),
        (["--node", "128"], "128"),
    ] {
        let output = odgen(&scratch.0, &[&["st", PITCH, "--out", "."], &arguments[..]].concat());
        assert_ne!(code(&output), 0, "{arguments:?}");
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }
}

/// A DCF says what its own node is set to.
#[test]
fn a_dcf_brings_its_node_and_its_values() {
    let scratch = Scratch::new("st-dcf");
    scratch.file("lamp.od.yaml", LAMP);
    let arguments = ["dcf", "lamp.od.yaml", "--node", "9", "--set", "brightness=25 %", "--out", "lamp.dcf"];
    let output = odgen(&scratch.0, &arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(code(&odgen(&scratch.0, &["st", "lamp.dcf", "--out", "."])), 0);
    let constants = read(&scratch, "lamp-constants.st");
    assert!(constants.contains("LAMP_RPDO1_CAN_ID : UDINT := 16#209;"), "{constants}");
    assert!(constants.contains("LAMP_BRIGHTNESS_DEFAULT : USINT := 25;"), "{constants}");
    // With another node-ID it is set alike; the COB-ID has lost its formula, which is reported.
    let output = odgen(&scratch.0, &["st", "lamp.dcf", "--node", "3", "--out", "."]);
    assert!(
        code(&output) == 0 && stderr(&output).contains("node 3 uses 209h, a COB-ID of node 9"),
        "{}",
        stderr(&output)
    );
    let constants = read(&scratch, "lamp-constants.st");
    assert!(constants.contains("LAMP_BRIGHTNESS_DEFAULT : USINT := 25;"), "{constants}");
}

#[test]
fn what_is_left_out_is_reported() {
    let scratch = Scratch::new("st-left-out");
    scratch.file("lamp.od.yaml", LAMP.replace("type: unsigned8", "type: real32"));
    let output = odgen(&scratch.0, &["st", "lamp.od.yaml", "--out", "."]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_snapshot!("st-left-out", stderr(&output));
}
