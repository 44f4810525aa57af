//! `odgen check --deny` and `--allow`.

use crate::{FAN, LAMP, Scratch, code, odgen, stderr};

/// Exit code and the findings of a check in short: severity and code.
fn check(scratch: &Scratch, arguments: &[&str]) -> (i32, Vec<String>) {
    let output = odgen(&scratch.0, &[&["check", "--format", "short"], arguments].concat());
    let word = |line: &str| {
        let (before, _) = line.split_once("]: ").unwrap_or((line, ""));
        before.rsplit(' ').next().unwrap_or_default().to_owned()
    };
    (code(&output), stderr(&output).lines().map(word).collect())
}

#[test]
fn findings_are_denied_and_allowed_by_code_and_group() {
    let scratch = Scratch::new("policy");
    scratch.file("fan.eds", FAN.replace("internal", "ro"));
    let check = |arguments: &[&str]| check(&scratch, &[&["fan.eds"], arguments].concat());
    let found = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>();
    assert_eq!(check(&[]), (0, found(&["warning[EDS506"])));
    assert_eq!(check(&["--deny", "EDS506"]), (1, found(&["error[EDS506"])));
    assert_eq!(check(&["--deny", "eds5", "--notes"]), (1, found(&["error[EDS503", "error[EDS506"])));
    assert_eq!(check(&["--deny", "warnings"]), (1, found(&["error[EDS506"])));
    assert_eq!(check(&["--deny-warnings"]), (1, found(&["error[EDS506"])));
    assert_eq!(
        check(&["--deny", "notes"]),
        (1, found(&["error[EDS503", "warning[EDS506"])),
        "denied notes are shown"
    );
    assert_eq!(check(&["--allow", "EDS506"]), (0, found(&[])));
    assert_eq!(check(&["--allow", "EDS", "--notes"]), (0, found(&[])));
    assert_eq!(check(&["--allow", "warnings"]), (0, found(&[])));
    // The more particular word counts, whichever comes first; of two that are equal the stricter one.
    assert_eq!(check(&["--deny", "warnings", "--allow", "EDS506"]), (0, found(&[])));
    assert_eq!(check(&["--allow", "EDS5", "--deny", "EDS506"]), (1, found(&["error[EDS506"])));
    assert_eq!(check(&["--deny", "EDS506", "--allow", "EDS506"]), (1, found(&["error[EDS506"])));
}

#[test]
fn an_error_is_allowed_where_the_file_can_be_used_all_the_same() {
    let scratch = Scratch::new("errors");
    scratch.file("fan.eds", FAN);
    scratch.file("lamp.od.yaml", LAMP.replace("access: rw", "acess: rw"));
    assert_eq!(check(&scratch, &["fan.eds"]).0, 1);
    assert_eq!(check(&scratch, &["fan.eds", "--allow", "EDS406"]).0, 0);
    let (code, found) = check(&scratch, &["lamp.od.yaml", "--allow", "OD02"]);
    assert_eq!(code, 1);
    assert!(found.contains(&"error[OD0201".to_owned()), "{found:?}");
    assert_eq!(check(&scratch, &["missing.eds", "--allow", "OD0101"]), (1, vec!["error[OD0101".to_owned()]));
}

#[test]
fn unknown_codes_are_refused_with_a_suggestion() {
    let scratch = Scratch::new("unknown-code");
    scratch.file("lamp.od.yaml", LAMP);
    let refused = |arguments: &[&str]| {
        let output =
            odgen(&scratch.0, &[&["check", "lamp.od.yaml", "--format", "short"], arguments].concat());
        assert_eq!(code(&output), 2);
        stderr(&output)
    };
    let said = refused(&["--deny", "OD0240"]);
    assert!(
        said.starts_with("error[OD0207]: --deny: no code begins with `OD0240` (did you mean `OD0"),
        "{said}"
    );
    let said = refused(&["--allow", "warning"]);
    assert!(said.contains("--allow: no code begins with `warning` (did you mean `warnings`?)"), "{said}");
    assert!(refused(&["--allow", ""]).contains("--allow: no code begins with ``"));
    assert!(refused(&["--deny", "nonsense"]).contains("(`odgen explain all` lists the codes)"));
}
