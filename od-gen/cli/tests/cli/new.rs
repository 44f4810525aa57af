//! `odgen new`.

use std::fs;

use insta::assert_snapshot;

use crate::{Scratch, code, files, odgen, stderr, stdout};

#[test]
fn new_writes_a_specification_that_is_clean() {
    let scratch = Scratch::new("new");
    for (name, arguments) in [
        ("io-module", &[][..]),
        ("lift", &["--profile", "cia402", "--modes", "profile position,HM"][..]),
        ("fan", &["--profile", "cia402", "--modes", "velocity mode"][..]),
        ("valves", &["--profile", "cia401"][..]),
        ("sensors", &["--profile", "cia401", "--inputs", "20", "--analogue-inputs", "6"][..]),
    ] {
        let output = odgen(&scratch.0, &[&["new", name], arguments].concat());
        assert_eq!((code(&output), stderr(&output)), (0, String::new()));
        let file = format!("{name}.od.yaml");
        assert!(stdout(&output).starts_with(&format!("  {file}  a")), "{}", stdout(&output));
        // What is the author's to say is said to be open.
        let path = scratch.0.join(&file);
        let text = fs::read_to_string(&path).unwrap();
        let output = odgen(&scratch.0, &["check", &file, "--all", "--format", "short"]);
        let gaps = text.matches("# <--").count();
        assert!(gaps > 1);
        assert_eq!(stderr(&output).matches("OD0841").count(), gaps, "{}", stderr(&output));
        fs::write(&path, text.replace("# <--", "#")).unwrap();
        let output = odgen(&scratch.0, &["check", &file, "--deny-warnings", "--rust"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert!(
            !stderr(&output).contains("error") && !stderr(&output).contains("warning"),
            "{}",
            stderr(&output)
        );
        // It has what its comments say.
        let output = odgen(&scratch.0, &["build", &file, "--docs", "html", "--rust"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
    let lift = fs::read_to_string(scratch.0.join("lift.od.yaml")).unwrap();
    assert!(lift.contains("0x6502: {from: cia402, default: 0x0021}"), "{lift}");
    assert!(lift.contains("      1: {map: [Controlword, Modes of operation]}\n"), "{lift}");
    assert!(!lift.lines().any(|line| line.len() > 140 || line.ends_with(' ')), "{lift}");
}

#[test]
fn new_refuses_what_it_cannot_make() {
    let scratch = Scratch::new("new-refused");
    let kept = scratch.file("there.od.yaml", "mine");
    let drive = ["--profile", "cia402", "--modes"];
    let mut said = String::new();
    for (arguments, expected) in [
        (vec!["there"], 1),
        (vec!["../outside"], 2),
        (vec!["Big"], 2),
        (vec!["lift", "--modes", "pp"], 2),
        (vec!["lift", "--profile", "cia402"], 2),
        (vec!["lift", drive[0], drive[1], drive[2], "pp,sideways"], 2),
        (vec!["lift", drive[0], drive[1], drive[2], ""], 2),
        (vec!["lift", "--out", "there.od.yaml"], 1),
        (vec!["valves", "--outputs", "8"], 2),
        (vec!["valves", "--profile", "cia401", "--outputs", "0"], 2),
        (vec!["valves", "--profile", "cia401", "--modes", "pp"], 2),
        (vec!["valves", "--profile", "cia401", "--outputs", "3000"], 2),
    ] {
        let output = odgen(&scratch.0, &[vec!["new"], arguments, vec!["--format", "short"]].concat());
        assert_eq!(code(&output), expected, "{}", stderr(&output));
        said.push_str(&stderr(&output));
    }
    assert_snapshot!(said);
    assert_eq!(fs::read_to_string(kept).unwrap(), "mine");
    assert_eq!(files(&scratch.0), ["there.od.yaml"]);
}
