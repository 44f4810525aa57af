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

/// The files of a firmware, below the directory of its device.
const FIRMWARE: [(&str, &[&str]); 3] = [
    (
        "rust",
        &[
            ".cargo/config.toml",
            "Cargo.toml",
            "build.rs",
            "memory.x",
            "my-fan.od.yaml",
            "src/can.rs",
            "src/main.rs",
        ],
    ),
    (
        "c",
        &[
            "Makefile",
            "board.ld",
            "my-fan.od.yaml",
            "src/board.c",
            "src/can.c",
            "src/can.h",
            "src/main.c",
            "src/sdo.c",
            "src/sdo.h",
        ],
    ),
    ("canopennode", &["main.c", "my-fan.od.yaml", "sources.mk"]),
];

#[test]
fn new_writes_a_firmware() {
    for (language, expected) in FIRMWARE {
        let scratch = Scratch::new(&format!("new-firmware-{language}"));
        let arguments = ["new", "my-fan", "--firmware", language];
        let output = odgen(&scratch.0, &arguments);
        assert_eq!((code(&output), stderr(&output)), (0, String::new()));
        assert!(stdout(&output).contains("next: `cd my-fan`, then `"), "{}", stdout(&output));
        let mut made = files(&scratch.0.join("my-fan"));
        made.sort();
        assert_eq!(made, expected, "{language}");
        for file in expected {
            let text = fs::read_to_string(scratch.0.join("my-fan").join(file)).unwrap();
            // No mark of a template is left.
            assert!(!text.contains("{{"), "{language}: {file}:\n{text}");
            assert!(
                text.ends_with('\n') && !text.lines().any(|line| line.ends_with(' ')),
                "{language}: {file}"
            );
        }
        // What is there is the user's.
        let main = expected.iter().find(|file| file.contains("main.")).unwrap();
        let main = scratch.0.join("my-fan").join(main);
        fs::write(&main, "mine").unwrap();
        fs::remove_file(scratch.0.join("my-fan/my-fan.od.yaml")).unwrap();
        let output = odgen(&scratch.0, &arguments);
        assert_eq!(code(&output), 1, "{}", stdout(&output));
        assert_eq!(fs::read_to_string(main).unwrap(), "mine");
        assert!(!scratch.0.join("my-fan/my-fan.od.yaml").exists());
    }
}

#[test]
fn a_firmware_in_rust_takes_the_crates_from_where_glue_says() {
    let scratch = Scratch::new("new-glue");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
    let glue = root.to_str().unwrap();
    let output = odgen(&scratch.0, &["new", "fan", "--firmware", "rust", "--glue", glue]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    let cargo = fs::read_to_string(scratch.0.join("fan/Cargo.toml")).unwrap();
    assert!(cargo.contains("/od-gen\" }") && !cargo.contains("../odgen"), "{cargo}");
    for arguments in [
        &["--firmware", "rust", "--glue", "nowhere"][..],
        &["--firmware", "c", "--glue", glue],
        &["--glue", glue],
    ] {
        let output = odgen(&scratch.0, &[&["new", "other"], arguments].concat());
        assert_ne!(code(&output), 0);
        assert!(stderr(&output).contains("help: "), "{}", stderr(&output));
        assert!(!scratch.0.join("other").exists());
    }
}

/// The server of the book is the one that is tried with every entry of a dictionary.
#[test]
fn a_firmware_in_c_has_the_sdo_server_of_the_book() {
    let scratch = Scratch::new("new-sdo");
    assert_eq!(code(&odgen(&scratch.0, &["new", "valve", "--firmware", "c"])), 0);
    let made = fs::read_to_string(scratch.0.join("valve/src/sdo.c")).unwrap();
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
    let book = fs::read_to_string(root.join("tests/book/sdo_server.c")).unwrap();
    let server = |text: &str| text.split_once("static enum").unwrap().1.replace(", NULL)", ", &application)");
    let about = "/** Answers a request; false for an abort, which has no answer. */\n";
    assert_eq!(server(&made), server(&book).replace(about, ""));
}
