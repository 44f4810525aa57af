//! Which specifications a command takes, and what is said about those that cannot be read.

use std::fs;

use insta::assert_snapshot;

use crate::{LAMP, Scratch, code, files, odgen, stderr, stdout};

/// A directory with the lamp under two names and devices, and things that are only called alike.
fn two_lamps(name: &str) -> Scratch {
    let scratch = Scratch::new(name);
    scratch.file("b.od.yaml", LAMP);
    scratch.file("a.od.yaml", LAMP.replace("  lamp:", "  torch:"));
    scratch.file(".hidden.od.yaml", "no specification");
    scratch.file("notes.yaml", "no specification");
    fs::create_dir(scratch.0.join("folder.od.yaml")).unwrap();
    scratch
}

#[test]
fn without_a_spec_those_of_the_current_directory_are_taken() {
    const NOTE: &str = "note: no SPEC is named: taking a.od.yaml, b.od.yaml of the current directory\n";
    let scratch = two_lamps("several");
    let output = odgen(&scratch.0, &["build", "--out", "out"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, NOTE), "{}", stdout(&output));
    assert_eq!(
        files(&scratch.0.join("out")),
        ["a.json", "b.json", "eds/lamp.eds", "eds/torch.eds"],
        "and nothing of the devices that odgen's own project describes"
    );
    let output = odgen(&scratch.0, &["check", "--format", "short"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, NOTE));
    let output = odgen(&scratch.0, &["docs", "--out", "docs"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, NOTE));
    assert!(scratch.0.join("docs/a/torch.md").exists() && scratch.0.join("docs/b/lamp.md").exists());
    // Programs that read JSON get nothing else.
    let output = odgen(&scratch.0, &["check", "--format", "json"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    // A mistake is found also in files that were not named.
    scratch.file("a.od.yaml", LAMP.replace("access: rw", "acess: rw"));
    let output = odgen(&scratch.0, &["check", "--format", "short"]);
    assert_eq!(code(&output), 1);
    assert!(
        stderr(&output).starts_with(NOTE) && stderr(&output).contains("\na.od.yaml:9:"),
        "{}",
        stderr(&output)
    );
    // What is named is taken alone.
    let output = odgen(&scratch.0, &["check", "b.od.yaml", "--format", "short"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

#[test]
fn without_a_spec_a_command_for_one_takes_the_only_one() {
    let scratch = Scratch::new("only");
    scratch.file("lamp.od.yaml", LAMP);
    let note = "note: no SPEC is named: taking lamp.od.yaml of the current directory\n";
    for arguments in [&["dump"][..], &["errata"], &["dcf", "--device", "lamp", "--node", "5"]] {
        let output = odgen(&scratch.0, arguments);
        assert_eq!((code(&output), stderr(&output).as_str()), (0, note), "{arguments:?}");
    }
    assert_eq!(files(&scratch.0), ["lamp-5.dcf", "lamp.od.yaml"]);

    let scratch = two_lamps("choice");
    for arguments in [&["dump"][..], &["errata"], &["dcf", "--device", "lamp", "--node", "5"]] {
        let output = odgen(&scratch.0, arguments);
        assert_eq!((code(&output), stdout(&output)), (2, String::new()), "{arguments:?}");
        let said = stderr(&output);
        assert!(said.contains("no SPEC is named, and there are 2 in the current directory"), "{said}");
        assert!(said.contains("name one of them: a.od.yaml, b.od.yaml"), "{said}");
    }
}

#[test]
fn without_a_spec_and_without_any_there_is_nothing_to_do() {
    let scratch = Scratch::new("none");
    let commands =
        ["build", "check", "docs", "dump", "errata", "dcf --device lamp --node 5", "docs --dump-context"];
    for command in commands {
        let arguments: Vec<&str> = ["--format", "short"].into_iter().chain(command.split(' ')).collect();
        let output = odgen(&scratch.0, &arguments);
        assert_eq!((code(&output), stdout(&output)), (2, String::new()), "{command}");
        assert_eq!(
            stderr(&output),
            "error[OD0101]: no SPEC is named, and there is no `*.od.yaml` in the current directory (name a \
             specification, go to the directory where yours lie, or start one with `odgen new NAME`)\n",
            "{command}"
        );
    }
    assert!(files(&scratch.0).is_empty());
    let output = odgen(&scratch.0, &["--specs", "nowhere", "--format", "short", "check"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("and nowhere cannot be read: "), "{}", stderr(&output));
    assert_eq!(code(&odgen(&scratch.0, &["docs", "--export-templates", "templates"])), 0);
}

/// `cargo odgen` is `odgen --specs` with the directory of the project's specifications.
#[test]
fn another_directory_can_be_the_one_to_look_in() {
    let scratch = two_lamps("elsewhere");
    fs::create_dir(scratch.0.join("work")).unwrap();
    scratch.file("work/own.od.yaml", LAMP);
    let work = scratch.0.join("work");
    let output = odgen(&work, &["--specs", "..", "build"]);
    let note = "note: no SPEC is named: taking a.od.yaml, b.od.yaml of ..\n";
    assert_eq!((code(&output), stderr(&output).as_str()), (0, note));
    assert!(work.join("generated/eds/torch.eds").exists());
    let output = odgen(&work, &["--specs", "..", "check", "own.od.yaml", "--format", "short"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

#[test]
fn files_that_cannot_be_read() {
    let scratch = Scratch::new("unreadable");
    scratch.file("latin1.od.yaml", b"od-spec: 1\ntitle: Gr\xf6\xdfe\n");
    fs::create_dir(scratch.0.join("directory.od.yaml")).unwrap();
    let arguments = ["check", "--format", "short", "missing.od.yaml", "directory.od.yaml", "latin1.od.yaml"];
    let output = odgen(&scratch.0, &arguments);
    assert_eq!(code(&output), 1);
    assert_snapshot!(stderr(&output));
}

#[test]
fn a_hundred_megabytes_of_garbage_are_refused_quickly() {
    let scratch = Scratch::new("huge");
    let path = scratch.0.join("huge.od.yaml");
    let file = fs::File::create(&path).unwrap();
    file.set_len(100 << 20).unwrap();
    let output = odgen(&scratch.0, &["check", "huge.od.yaml", "--format", "short"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).starts_with("error[OD0103]"), "{}", stderr(&output));
}
