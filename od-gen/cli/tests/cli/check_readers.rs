//! Who stumbles: `odgen check --for`, and what findings say of readers.

use crate::{FAN, LAMP, Scratch, code, odgen, stderr, stdout};

/// An EDS that every reader takes, except for an access type and a vendor's key.
const LEVEL: &str = "\
[2000]
ParameterName=level
ObjectType=0x7
DataType=0x0005
AccessType=R
PDOMapping=0
Unit=mm
";

fn check(scratch: &Scratch, arguments: &[&str]) -> (i32, String) {
    let output = odgen(&scratch.0, &[&["check", "level.eds"], arguments].concat());
    (code(&output), stderr(&output))
}

#[test]
fn only_what_a_reader_minds_is_an_error_for_it() {
    let scratch = Scratch::new("for");
    scratch.file("level.eds", LEVEL);
    for (reader, expected) in [
        ("python-canopen", 0),
        ("eds-utils", 0),
        ("node-canopen", 0),
        ("canopen-host", 1),
        ("lely", 1),
        ("dcfchk", 1),
    ] {
        let (code, said) = check(&scratch, &["--for", reader, "--format", "short"]);
        assert_eq!(code, expected, "{reader}: {said}");
        assert_eq!(said.contains("error[EDS406]"), expected == 1, "{reader}: {said}");
        assert_eq!(said.contains("error[EDS118]"), matches!(reader, "lely" | "dcfchk"), "{reader}: {said}");
        assert!(!said.contains("warning["), "{reader}: {said}");
    }
    let (code, _) = check(&scratch, &["--for", "python-canopen", "--for", "canopen-host"]);
    assert_eq!(code, 1, "one of several is enough");
    let (code, said) = check(&scratch, &["--for", "canopen-host", "--allow", "EDS406"]);
    assert_eq!((code, said.contains("EDS406")), (0, false));
}

#[test]
fn a_specification_has_no_foreign_readers() {
    let scratch = Scratch::new("for-specification");
    scratch.file("lamp.od.yaml", LAMP.replace("access: rw", "acess: rw"));
    let output = odgen(&scratch.0, &["check", "lamp.od.yaml", "--for", "python-canopen"]);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
}

#[test]
fn a_finding_names_the_readers_in_every_format() {
    let scratch = Scratch::new("readers");
    scratch.file("level.eds", LEVEL);
    let (_, human) = check(&scratch, &[]);
    assert!(human.contains("note: dcfchk and canopen-host refuse the file because of this\n"), "{human}");
    assert!(human.contains("note: CANopenEditor is reported to stumble over this\n"), "{human}");
    let (_, json) = check(&scratch, &["--format", "json"]);
    let access = json.lines().find(|line| line.contains("EDS406")).unwrap();
    assert!(access.contains(r#","minded-by":["dcfchk","canopen-host","CANopenEditor"]"#), "{access}");
    let sarif = stdout(&odgen(&scratch.0, &["check", "level.eds", "--format", "sarif"]));
    let reported: String = sarif.split_whitespace().collect();
    assert!(
        reported.contains(r#""properties":{"mindedBy":["dcfchk","canopen-host","CANopenEditor"]}"#),
        "{sarif}"
    );
}

#[test]
fn a_code_names_the_readers_that_fail() {
    let scratch = Scratch::new("explain-readers");
    let said = stdout(&odgen(&scratch.0, &["explain", "EDS406"]));
    assert!(said.contains("- canopen-host: it knows the six access types only\n"), "{said}");
    assert!(said.contains("Who is reported to stumble:\n\n- CANopenEditor: "), "{said}");
    assert!(!stdout(&odgen(&scratch.0, &["explain", "EDS410"])).contains("refuse an EDS"));
}

/// What no reader refuses is not an error.
#[test]
fn a_file_that_is_wrong_may_be_read_all_the_same() {
    let scratch = Scratch::new("for-fan");
    scratch.file("level.eds", FAN.replace("internal", "ro"));
    assert_eq!(check(&scratch, &["--for", "python-canopen"]).0, 0);
}
