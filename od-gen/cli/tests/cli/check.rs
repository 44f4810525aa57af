//! `odgen check`.

use insta::assert_snapshot;

use crate::{FAN, LAMP, MIXER, PITCH, Scratch, code, odgen, stderr, stdout};

#[test]
fn check_says_when_all_is_well() {
    let scratch = Scratch::new("check");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["check", "lamp.od.yaml"]);
    let said = "lamp.od.yaml: nothing found, 7 objects\n".to_owned();
    assert_eq!((code(&output), stdout(&output), stderr(&output)), (0, String::new(), said));
    for format in ["short", "json", "github"] {
        let output = odgen(&scratch.0, &["check", "lamp.od.yaml", "--format", format]);
        assert_eq!(
            (code(&output), stdout(&output), stderr(&output)),
            (0, String::new(), String::new()),
            "{format}"
        );
    }
}

/// What departs from a standard is not a mistake; users see the number, and get the list when they ask.
#[test]
fn departures_from_a_standard_are_notes() {
    let scratch = Scratch::new("notes");
    let output = odgen(&scratch.0, &["check", PITCH, "--deny-warnings"]);
    assert_eq!((code(&output), stdout(&output)), (0, String::new()));
    let said = stderr(&output);
    let (_, notes) = said.split_once("nothing found, 206 objects; ").unwrap();
    assert!(notes.ends_with(" notes, `--notes` shows them\n") && said.lines().count() == 1, "{said}");
    let output = odgen(&scratch.0, &["check", PITCH, "--notes"]);
    let list = stderr(&output);
    let listed = list.lines().filter(|line| line.contains(": note[")).count();
    assert_eq!(notes.split(' ').next().unwrap(), listed.to_string());
    assert!(list.contains("note[OD0811]: 1003h pre defined error field departs from cia301: name"), "{list}");
    let output = odgen(&scratch.0, &["check", PITCH, "--format", "json"]);
    assert_eq!(stderr(&output), "");
}

#[test]
fn warnings_fail_only_when_denied() {
    let scratch = Scratch::new("warn");
    scratch.file("lamp.od.yaml", LAMP.replace(", features: [heartbeat producer]", ""));
    let output = odgen(&scratch.0, &["check", "lamp.od.yaml", "--format", "short"]);
    assert_eq!(code(&output), 0);
    assert_snapshot!(stderr(&output));
    assert_eq!(code(&odgen(&scratch.0, &["check", "lamp.od.yaml", "--deny-warnings"])), 1);
}

#[test]
fn json_messages_are_one_object_a_line() {
    let scratch = Scratch::new("json");
    scratch.file("lamp.od.yaml", LAMP.replace("unsigned8", "unsigned9").replace("125, 500", "124"));
    let output = odgen(&scratch.0, &["--format", "json", "check", "lamp.od.yaml"]);
    assert_eq!(code(&output), 1);
    let text = stderr(&output);
    assert_eq!(text.lines().count(), 2, "{text}");
    assert!(text.lines().all(|line| line.starts_with("{\"code\":\"OD0") && line.ends_with('}')), "{text}");
}

/// A foreign EDS can have hundreds of places with one fault; the first three show what it is.
#[test]
fn a_fault_in_many_places_is_shown_in_three() {
    let scratch = Scratch::new("volume");
    scratch.file("mixer.eds", MIXER);
    let output = odgen(&scratch.0, &["check", "mixer.eds"]);
    assert_eq!((code(&output), stdout(&output)), (1, String::new()));
    assert_snapshot!(stderr(&output));
    let shown = |arguments: &[&str]| {
        let said = stderr(&odgen(&scratch.0, &[&["check", "mixer.eds"], arguments].concat()));
        (said.matches("EDS506").count(), said.contains("more like it"))
    };
    assert_eq!(shown(&[]), (4, true), "three, and the line with the rest");
    assert_eq!(shown(&["--all"]), (4, false));
    assert_eq!(shown(&["--format", "short"]), (4, false));
    // Of one's own specification every mistake is wanted.
    let entry = |n| format!("  0x210{n}: {{name: x {n}, type: unsigned9, access: rw}}\n");
    let entries = (1..6).map(entry).collect::<Vec<_>>().concat();
    scratch.file("lamp.od.yaml", LAMP.replace("objects:\n", &format!("objects:\n{entries}")));
    let said = stderr(&odgen(&scratch.0, &["check", "lamp.od.yaml"]));
    assert_eq!(said.matches("unsigned9`").count(), 5, "{said}");
}

#[test]
fn notes_are_counted_and_listed_on_demand() {
    let scratch = Scratch::new("eds-notes");
    scratch.file("fan.eds", FAN);
    let said = stderr(&odgen(&scratch.0, &["check", "fan.eds"]));
    assert!(said.contains("; 1 note, `--notes` shows it and `odgen fix` repairs it; "), "{said}");
    assert!(!said.contains("EDS503"), "{said}");
    let said = stderr(&odgen(&scratch.0, &["check", "fan.eds", "--notes"]));
    assert!(said.contains("fan.eds:137:10: note[EDS503]: `0xFC18` as INTEGER16 is -1000"), "{said}");
    assert!(!said.contains("`--notes`"), "{said}");
}

#[test]
fn the_summary_counts_what_can_be_repaired() {
    let scratch = Scratch::new("repairs");
    let repairs = |text: &str| {
        scratch.file("fan.eds", text);
        let said = stderr(&odgen(&scratch.0, &["check", "fan.eds"]));
        said.split_once("(`odgen fix` repairs ").map(|(_, rest)| rest.split(')').next().unwrap().to_owned())
    };
    let word = "DefaultValue=false";
    let one = FAN.replace("internal", "ro");
    let more = |count: usize| {
        let section = |n: usize| {
            format!(
                "\n[210{n}]\nParameterName=Flag {n}\nObjectType=7\nDataType=1\nAccessType=ro\n{word}\nPDOMapping=0\n"
            )
        };
        (0..count).map(section).collect::<String>()
    };
    assert!(one.contains(word));
    assert_eq!(repairs(FAN).as_deref(), Some("1 of them"));
    assert_eq!(repairs(&one).as_deref(), Some("it"));
    assert_eq!(repairs(&one.replace(word, "DefaultValue=0")), None);
    // What is in no list of objects may be a finding of its own, so only the number is looked at.
    assert!(repairs(&(one + &more(3))).is_some());
}

/// The same faults weigh more in a file of one's own.
#[test]
fn strict_holds_an_eds_to_the_standard() {
    let scratch = Scratch::new("strict");
    scratch.file("fan.eds", FAN.replace("internal", "ro").replace("=false", "=0"));
    scratch.file("lamp.od.yaml", LAMP);
    let severity = |arguments: &[&str]| {
        let output =
            odgen(&scratch.0, &[&["check", "fan.eds", "--notes", "--format", "short"], arguments].concat());
        let said = stderr(&output);
        said.split("[EDS503]").next().and_then(|before| before.rsplit(' ').next()).unwrap().to_owned()
    };
    assert_eq!((severity(&[]).as_str(), severity(&["--strict"]).as_str()), ("note", "warning"));
    let output = odgen(&scratch.0, &["check", "lamp.od.yaml", "--strict", "--format", "short"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

/// `odgen fix` takes EDS and DCF files; of a specification, an editor makes the changes.
#[test]
fn repairs_are_promised_for_files_that_are_repaired() {
    let scratch = Scratch::new("no-repairs");
    scratch.file("lamp.od.yaml", LAMP.replace("name: Lamp", "name: L\u{430}mp"));
    let said = stderr(&odgen(&scratch.0, &["check", "--notes", "lamp.od.yaml"]));
    assert!(said.contains("warning[OD0866]") && !said.contains("odgen fix"), "{said}");
}
