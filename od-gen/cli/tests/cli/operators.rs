//! What the commands of operators say of a specification that is not theirs.

use std::process::Stdio;

use crate::served::Served;
use crate::{LAMP, Scratch, code, odgen, stderr, stdout};

/// A lamp whose specification has a warning.
fn lamp() -> String {
    let receive = LAMP.replace("{1: {map: [brightness]}}", "{5: {cob-id: 0x6F5, map: [brightness]}}");
    assert_ne!(receive, LAMP);
    receive
}

#[test]
fn warnings_of_a_specification_are_counted_where_it_is_only_used() {
    let scratch = Scratch::new("operators");
    scratch.file("lamp.od.yaml", lamp());
    let checked = odgen(&scratch.0, &["check", "lamp.od.yaml"]);
    assert!(stderr(&checked).contains("warning[OD0823]"), "{}", stderr(&checked));
    let served = Served::start(&scratch, &["lamp.od.yaml", "--node", "5"], Stdio::null());
    let read = ["node", "read", "lamp.od.yaml", "--node", "5", "2000", "--slcan", served.address()];
    let short = odgen(&scratch.0, &read);
    assert_eq!((code(&short), stdout(&short).as_str()), (0, "2000h brightness = 80 %  [50]\n"));
    assert_eq!(stderr(&short), "note: lamp.od.yaml: 1 warning; `odgen check lamp.od.yaml` shows them\n");
    // Programs choose for themselves.
    let all = odgen(&scratch.0, &[&read[..], &["--format", "json"]].concat());
    assert!(stderr(&all).contains("OD0823"), "{}", stderr(&all));
    // An error is shown whole, with the warnings.
    let mode = "types:\n  mode: {base: unsigned8, values: {0: off, 1: {name: on, supported: no}}}\nunits:";
    let entry = "objects:\n  0x2001: {name: mode, type: mode, access: rw, default: on}";
    scratch.file("lamp.od.yaml", lamp().replace("units:", mode).replace("objects:", entry));
    let refused = odgen(&scratch.0, &read);
    assert_eq!(code(&refused), 1);
    assert!(
        stderr(&refused).contains("error[") && stderr(&refused).contains("warning[OD0823]"),
        "{}",
        stderr(&refused)
    );
}
