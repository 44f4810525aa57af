//! XDD and XDC files, written and read by the commands.

use std::fs;

use insta::assert_snapshot;

use crate::{LAMP, Scratch, code, files, odgen, stderr, stdout};

/// An XDD as other programs write them, without a fault, and one with a fault of each kind.
const TANK: &str = include_str!("eds/tank.xdd");
const FAULTY: &str = include_str!("eds/faulty.xdd");

#[test]
fn a_build_makes_them_next_to_the_others() {
    let scratch = Scratch::new("xdd-build");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["build", "lamp.od.yaml", "--xdd", "--node", "5", "--out", "out"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let expected = ["eds/lamp.dcf", "eds/lamp.eds", "lamp.json", "xdd/lamp.xdc", "xdd/lamp.xdd"];
    assert_eq!(files(&scratch.0.join("out")), expected);
    assert_snapshot!("lamp_xdd", fs::read_to_string(scratch.0.join("out/xdd/lamp.xdd")).unwrap());
    let xdc =
        ["dcf", "lamp.od.yaml", "--node", "5", "--set", "2000=60", "--xdc", "--out", "out/xdd/hall.dcf"];
    let output = odgen(&scratch.0, &xdc);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = fs::read_to_string(scratch.0.join("out/xdd/hall.xdc")).unwrap();
    assert!(text.contains("actualValue=\"60\""), "{text}");
    assert!(text.contains("<deviceCommissioning NodeID=\"5\" nodeName=\"Lamp 5\""), "{text}");
    // A build without XDD files removes its own, and not those of `odgen dcf`.
    let build = ["build", "lamp.od.yaml", "--xdd", "--out", "out", "--prune"];
    assert_eq!(code(&odgen(&scratch.0, &build)), 0);
    assert!(scratch.0.join("out/xdd/hall.xdc").exists());
}

#[test]
fn an_xdd_can_be_wherever_an_eds_can() {
    let scratch = Scratch::new("xdd-read");
    scratch.file("tank.xdd", TANK);
    let run = |arguments: &[&str]| odgen(&scratch.0, arguments);
    let output = run(&["check", "."]);
    assert_eq!(
        (code(&output), stderr(&output).as_str()),
        (0, "tank.xdd: nothing found, 5 objects; 1 note, `--notes` shows it\n")
    );
    let output = run(&["import", "tank.xdd"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_snapshot!("tank_imported", fs::read_to_string(scratch.0.join("tank.od.yaml")).unwrap());
    let output = run(&["build", "tank.xdd", "--out", "out", "--rust", "--docs", "md"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(files(&scratch.0.join("out")).contains(&"src/tank.rs".to_owned()));
    // The same device by its EDS, and by the specification that was made of it.
    for other in ["out/eds/tank.eds", "tank.od.yaml"] {
        let output = run(&["diff", "tank.xdd", other, "--format", "short"]);
        assert_eq!((code(&output), stdout(&output).as_str()), (0, ""), "{other}");
    }
    let output = run(&["dcf", "tank.xdd", "--node", "3", "--set", "limit=3.0 bar", "--concise"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let output = run(&["concise", "show", "tank-3.bin", "tank.xdd"]);
    assert!(stdout(&output).contains("2000h  limit  1E 00  3.0 bar"), "{}", stdout(&output));
    assert_eq!(code(&run(&["dump", "tank.xdd"])), 0);
    // What `odgen fix` changes are lines of an EDS.
    let output = run(&["fix", "tank.xdd"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("has no section, it is no EDS or DCF"), "{}", stderr(&output));
}

#[test]
fn faults_are_shown_in_the_xml() {
    let scratch = Scratch::new("xdd-faulty");
    scratch.file("faulty.xdd", FAULTY);
    let said = stderr(&odgen(&scratch.0, &["check", "faulty.xdd"]));
    assert_snapshot!("faulty_xdd", said);
    let output = odgen(&scratch.0, &["import", "faulty.xdd"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = fs::read_to_string(scratch.0.join("faulty.od.yaml")).unwrap();
    assert!(text.contains("2001h has no data type; it is taken as DOMAIN (XDD203)"), "{text}");
}

/// A file of CANopenEditor: an object that is switched off, and properties of two others.
const KILN: &str = "<ISO15745ProfileContainer><ProfileBody><DeviceIdentity><vendorName>Kiln</vendorName><productName>Kiln</productName>\
    </DeviceIdentity><ApplicationProcess><parameterList>\n\
    <parameter uniqueID=\"A\" access=\"readWrite\"><UINT/><defaultValue value=\"500\"/><property name=\"CO_countLabel\" value=\"HB_PROD\"/>\
    <property name=\"CO_storageGroup\" value=\"PERSIST_COMM\"/></parameter>\n\
    <parameter uniqueID=\"B\" access=\"readWrite\"><UINT/><defaultValue value=\"7\"/><property name=\"CO_accessSRDO\" value=\"tx\"/>\
    <property name=\"CO_storageGroup\" value=\"PERSIST_OVEN\"/></parameter>\n\
    <parameter uniqueID=\"C\" access=\"readWrite\"><UINT/><defaultValue value=\"6\"/><property name=\"CO_disabled\" value=\"true\"/>\
    </parameter>\n</parameterList></ApplicationProcess><CANopenObjectList>\n\
    <CANopenObject index=\"1017\" name=\"heartbeat\" objectType=\"7\" uniqueIDRef=\"A\"/>\n\
    <CANopenObject index=\"2000\" name=\"curve\" objectType=\"7\" uniqueIDRef=\"B\"/>\n\
    <CANopenObject index=\"2001\" name=\"spare\" objectType=\"7\" uniqueIDRef=\"C\"/>\n\
    </CANopenObjectList></ProfileBody></ISO15745ProfileContainer>\n";

#[test]
fn what_is_switched_off_is_left_out_or_taken_by_every_command() {
    let scratch = Scratch::new("xdd-disabled");
    scratch.file("kiln.xdd", KILN);
    let run = |arguments: &[&str]| odgen(&scratch.0, arguments);
    let reported = stderr(&run(&["check", "kiln.xdd"]));
    assert!(
        reported.contains("warning[XDD208]: 1 object is switched off and left out: 2001h\n"),
        "{reported}"
    );
    for arguments in [&["dump", "kiln.xdd"][..], &["dcf", "kiln.xdd", "--node", "3"]] {
        let made = |more: &[&str]| {
            let printed = stdout(&run(&[arguments, more].concat()));
            printed + &fs::read_to_string(scratch.0.join("kiln-3.dcf")).unwrap_or_default()
        };
        let (without, with) = (made(&[]), made(&["--disabled"]));
        assert!(without.contains("curve") && !without.contains("spare"), "{arguments:?}: {without}");
        assert!(with.contains("spare"), "{arguments:?}: {with}");
    }
    let reported = stderr(&run(&["check", "kiln.xdd", "--disabled"]));
    assert!(!reported.contains("XDD208") && reported.contains("3 objects"), "{reported}");
    // A file is read twice in one way.
    let reported = stdout(&run(&["diff", "kiln.xdd", "kiln.xdd", "--disabled", "--format", "short"]));
    assert_eq!(reported, "");
}

#[test]
fn an_import_keeps_what_the_specification_has_keys_for_and_lists_the_rest() {
    let scratch = Scratch::new("xdd-kept");
    scratch.file("kiln.xdd", KILN);
    assert_eq!(code(&odgen(&scratch.0, &["import", "kiln.xdd"])), 0);
    let text = fs::read_to_string(scratch.0.join("kiln.od.yaml")).unwrap();
    let objects = &text[text.find("objects:").unwrap()..];
    assert_snapshot!("kiln_imported", objects);
}
