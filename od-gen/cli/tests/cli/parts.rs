//! A specification in several files: what is done with a part is done with the whole.

use crate::{LAMP, Scratch, code, files, odgen, stderr, stdout};

/// The lamp, with its objects in a file of their own.
fn lamp_in_parts(name: &str) -> Scratch {
    let scratch = Scratch::new(name);
    let (main, objects) = LAMP.split_once("objects:").unwrap();
    scratch.file("lamp.od.yaml", main.replacen("uses:", "parts: [parts/objects.od.yaml]\nuses:", 1));
    std::fs::create_dir(scratch.0.join("parts")).unwrap();
    scratch.file(
        "parts/objects.od.yaml",
        format!("od-spec: 1\npart-of: ../lamp.od.yaml # the lamp\nobjects:{objects}"),
    );
    scratch
}

#[test]
fn outputs_are_those_of_one_file() {
    let (whole, parts) = (Scratch::new("one-file"), lamp_in_parts("parts"));
    whole.file("lamp.od.yaml", LAMP);
    for scratch in [&whole, &parts] {
        let output = odgen(&scratch.0, &["build", "--rust", "--docs", "md", "--out", "out"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
    let made = files(&whole.0.join("out"));
    assert_eq!(files(&parts.0.join("out")), made);
    assert!(made.len() > 3, "{made:?}");
    for name in made {
        let read = |scratch: &Scratch| std::fs::read_to_string(scratch.0.join("out").join(&name)).unwrap();
        assert_eq!(read(&parts), read(&whole), "{name}");
    }
}

#[test]
fn line_ends_of_windows_change_nothing() {
    let (unix, windows) = (lamp_in_parts("unix-parts"), lamp_in_parts("windows-parts"));
    for name in ["lamp.od.yaml", "parts/objects.od.yaml"] {
        let text = std::fs::read_to_string(windows.0.join(name)).unwrap();
        windows.file(name, text.replace('\n', "\r\n"));
    }
    for scratch in [&unix, &windows] {
        let output = odgen(&scratch.0, &["build", "--rust", "--docs", "md", "--node", "5", "--out", "out"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
    for name in files(&unix.0.join("out")) {
        let read = |scratch: &Scratch| std::fs::read(scratch.0.join("out").join(&name)).unwrap();
        assert!(read(&windows) == read(&unix), "{name}");
    }
}

#[test]
fn a_part_represents_its_specification() {
    let scratch = lamp_in_parts("part");
    let part = "parts/objects.od.yaml";
    let output = odgen(&scratch.0, &["check", part]);
    assert_eq!(
        (code(&output), stderr(&output).as_str()),
        (
            0,
            "note: parts/objects.od.yaml is a part of lamp.od.yaml: taking that\nlamp.od.yaml: nothing found, 7 objects\n"
        ),
    );
    // Once, whichever way it is named.
    for arguments in [&["check", "."][..], &["check"], &["check", "parts", "lamp.od.yaml"]] {
        let output = odgen(&scratch.0, arguments);
        assert_eq!(
            (code(&output), stderr(&output).matches("nothing found").count()),
            (0, 1),
            "{}",
            stderr(&output)
        );
    }
    let output = odgen(&scratch.0, &["dump", part]);
    assert!(code(&output) == 0 && stdout(&output).contains("brightness"), "{}", stderr(&output));
}

#[test]
fn a_part_without_its_specification_is_refused() {
    let scratch = lamp_in_parts("alone");
    std::fs::remove_file(scratch.0.join("lamp.od.yaml")).unwrap();
    let output = odgen(&scratch.0, &["build", "parts/objects.od.yaml", "--out", "out"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("error[OD0119]"), "{}", stderr(&output));
    assert!(!scratch.0.join("out").exists());
}
