//! `odgen dbc`.

use insta::assert_snapshot;

use crate::{LAMP, PITCH, Scratch, code, odgen, stderr, stdout};

/// Two nodes of the pitch system: which of them has a PDO, and what is not one.
#[test]
fn nodes_of_a_bus_share_a_file() {
    let scratch = Scratch::new("dbc");
    let output = odgen(&scratch.0, &["dbc", PITCH, "--node", "5=pmc", "--node", "1=pmm"]);
    assert_eq!(code(&output), 0);
    assert_snapshot!("dbc-pitch", format!("{}{}", stdout(&output), stderr(&output)));
    let text = String::from_utf8_lossy(&std::fs::read(scratch.0.join("bus.dbc")).unwrap()).into_owned();
    assert!(text.contains("\nBU_: pmm_1 pmc_5\r\n"), "{text}");
    assert!(text.contains("BO_ 389 pmc_5_TPDO1: 2 pmc_5\r\n"), "{text}");
}

#[test]
fn a_node_has_a_file_of_its_name() {
    let scratch = Scratch::new("dbc-lamp");
    let lamp = LAMP.replace("max: 100 %", "max: 100 %, special: {0xFF: dazzling}");
    scratch.file("lamp.od.yaml", &lamp);
    let output = odgen(&scratch.0, &["dbc", "lamp.od.yaml", "--node", "7"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""), "{lamp}");
    let bytes = std::fs::read(scratch.0.join("lamp-7.dbc")).unwrap();
    assert_snapshot!("dbc-lamp", String::from_utf8(bytes).unwrap().replace('\r', ""));
    // Again, over what it made itself; and not over anything else.
    assert_eq!(code(&odgen(&scratch.0, &["dbc", "lamp.od.yaml", "--node", "7"])), 0);
    scratch.file("lamp-7.dbc", "VERSION \"another tool\"");
    let output = odgen(&scratch.0, &["dbc", "lamp.od.yaml", "--node", "7"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("lamp-7.dbc"), "{}", stderr(&output));
    assert_eq!(code(&odgen(&scratch.0, &["dbc", "lamp.od.yaml", "--node", "7", "--force"])), 0);
    let output = odgen(&scratch.0, &["dbc", "lamp.od.yaml", "--node", "7", "--out", "lamp.od.yaml"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("the DBC is made from this file"), "{}", stderr(&output));
}
