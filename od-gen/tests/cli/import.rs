//! `odgen import`, and the way from a maker's EDS to code.

use std::fs;

use crate::{FAN, LAMP, MIXER, ROOF_FAN, Scratch, code, odgen, stderr, stdout};

/// The four commands of the README, on files that were not made for them.
#[test]
fn from_an_eds_to_documents_and_rust_in_four_commands() {
    for (name, eds) in [("mixer", MIXER), ("fan", FAN)] {
        let scratch = Scratch::new(&format!("four-{name}"));
        let file = format!("{name}.eds");
        scratch.file(&file, eds);
        let checked = odgen(&scratch.0, &["check", &file]);
        assert_eq!(code(&checked), 1, "{}", stderr(&checked));
        odgen(&scratch.0, &["fix", &file, "--write"]);
        let imported = odgen(&scratch.0, &["import", &file]);
        assert_eq!(code(&imported), 0, "{}", stderr(&imported));
        let specification = format!("{name}.od.yaml");
        assert!(
            stdout(&imported).ends_with(&format!("next: odgen build --rust --docs html ./{specification}\n"))
        );
        let built = odgen(&scratch.0, &["build", &specification, "--rust", "--docs", "html", "--out", "out"]);
        assert_eq!(code(&built), 0, "{}", stderr(&built));
        for made in [format!("eds/{name}.eds"), format!("src/{name}.rs"), format!("docs/{name}/{name}.html")]
        {
            assert!(scratch.0.join("out").join(&made).is_file(), "{made}: {}", stdout(&built));
        }
        let again =
            odgen(&scratch.0, &["check", &format!("out/eds/{name}.eds"), "--strict", "--format", "short"]);
        assert_eq!(code(&again), 0, "{}", stderr(&again));
    }
}

#[test]
fn a_specification_that_is_there_is_not_overwritten() {
    let scratch = Scratch::new("import-there");
    scratch.file("fan.eds", FAN);
    let path = scratch.file("fan.od.yaml", "mine");
    let output = odgen(&scratch.0, &["import", "fan.eds"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("fan.od.yaml is there already"), "{}", stderr(&output));
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    assert_eq!(code(&odgen(&scratch.0, &["import", "fan.eds", "--force"])), 0);
    assert!(fs::read_to_string(&path).unwrap().starts_with("# Made from fan.eds.\n"));
}

#[test]
fn values_of_a_node_stand_at_the_end() {
    let scratch = Scratch::new("import-node");
    scratch.file("fan.dcf", ROOF_FAN);
    assert_eq!(code(&odgen(&scratch.0, &["import", "fan.dcf"])), 0);
    let text = fs::read_to_string(scratch.0.join("fan.od.yaml")).unwrap();
    let (_, values) = text.split_once("# The values of the node, for `odgen dcf`:\n").unwrap();
    assert!(values.lines().all(|line| line.starts_with("# --set \"")) && !values.is_empty(), "{values}");
}

#[test]
fn only_eds_and_dcf_files_are_imported() {
    let scratch = Scratch::new("import-no");
    scratch.file("lamp.od.yaml", LAMP);
    for (file, message) in [("lamp.od.yaml", "lamp.od.yaml is no EDS or DCF"), ("none.eds", "no such file")] {
        let output = odgen(&scratch.0, &["import", file, "--out", "out"]);
        assert_eq!(code(&output), 1);
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }
    assert!(!scratch.0.join("out").exists());
}
