//! What commands do to the files that are there.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::{FAN, LAMP, Scratch, code, files, odgen, stderr, stdout};

/// Runs killed in a test; as many as the environment says, for a long one.
fn kills() -> u64 {
    std::env::var("ODGEN_KILLS").ok().and_then(|number| number.parse().ok()).unwrap_or(25)
}

/// Three devices that all show `mark`, with many documents.
fn fleet(mark: &str) -> String {
    let devices = (1..=3)
        .map(|n| {
            format!(
                "  lamp-{n}: {{name: Lamp {n} {mark}, bit-rates: [125], features: [heartbeat producer]}}\n"
            )
        })
        .collect::<Vec<_>>()
        .concat();
    LAMP.replace("  lamp: {name: Lamp, bit-rates: [125, 500], features: [heartbeat producer]}\n", &devices)
        .replace("pdos:\n  lamp:\n    receive: {1: {map: [brightness]}}\n", "")
        .replace("pdo: receive, ", "")
        .replace("title: Lamp", &format!("title: Lamps {mark}"))
}

const BUILD: [&str; 9] =
    ["build", "lamps.od.yaml", "--out", "out", "--rust", "--docs", "md", "--docs", "html"];

/// Every file below a directory with its contents.
fn tree(directory: &Path) -> Vec<(String, Vec<u8>)> {
    files(directory).into_iter().map(|name| (name.clone(), fs::read(directory.join(name)).unwrap())).collect()
}

#[test]
fn a_build_that_is_killed_at_any_time_leaves_no_mixture_to_the_next() {
    let scratch = Scratch::new("killed");
    let built = |mark: &str| {
        scratch.file("lamps.od.yaml", fleet(mark));
        let output = odgen(&scratch.0, &BUILD);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        tree(&scratch.0.join("out"))
    };
    let began = std::time::Instant::now();
    let mut now = built("a");
    let whole = u64::try_from(began.elapsed().as_micros()).unwrap().max(1000);
    let sets = [built("b"), built("a")];
    assert!(now.len() > 15 && sets[1] == now, "{}", now.len());
    // Numbers that look random, the same in every run (Knuth's MMIX).
    let mut random = 1_u64;
    let journal = scratch.0.join("out/.odgen-journal");
    let (mut completed, mut kept) = (0, 0);
    for round in 0..kills() {
        let set = usize::try_from(round % 2).unwrap();
        scratch.file("lamps.od.yaml", fleet(["b", "a"][set]));
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mut child = Command::new(env!("CARGO_BIN_EXE_odgen"))
            .current_dir(&scratch.0)
            .args(BUILD)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // Most of the time goes into the documents: of three, two are killed while they write.
        let mut most = whole;
        if round % 3 != 0 {
            while !journal.exists() && child.try_wait().unwrap().is_none() {
                std::hint::spin_loop();
            }
            most = whole / 4;
        }
        std::thread::sleep(Duration::from_micros((random >> 33) % most));
        child.kill().unwrap();
        child.wait().unwrap();
        // The next command has a mistake in its specification, and puts the directory in order all the same.
        scratch.file("lamps.od.yaml", "od-spec: 1\n");
        assert_eq!(code(&odgen(&scratch.0, &BUILD)), 1);
        let found = tree(&scratch.0.join("out"));
        let names: Vec<&String> = found.iter().map(|(name, _)| name).collect();
        assert!(found == now || found == sets[set], "round {round}: {names:?}");
        if found == now {
            kept += 1;
        } else {
            completed += 1;
        }
        now = found;
    }
    // Of few runs, chance may have hit one half only.
    assert!(kills() < 100 || kept.min(completed) > 10, "{completed} completed, {kept} as before");
    println!("{completed} completed, {kept} as before");
}

#[test]
fn two_builds_into_one_directory_take_turns() {
    let scratch = Scratch::new("turns");
    for mark in ["a", "b"] {
        fs::create_dir(scratch.0.join(mark)).unwrap();
        scratch.file(&format!("{mark}/lamps.od.yaml"), fleet(mark));
    }
    let children: Vec<_> = ["a", "b", "a", "b", "a", "b"]
        .into_iter()
        .map(|mark| {
            Command::new(env!("CARGO_BIN_EXE_odgen"))
                .current_dir(scratch.0.join(mark))
                .args(["build", "lamps.od.yaml", "--out", "../out", "--docs", "md"])
                .stdout(Stdio::null())
                .spawn()
                .unwrap()
        })
        .collect();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    let texts = tree(&scratch.0.join("out"))
        .into_iter()
        .map(|(_, bytes)| String::from_utf8_lossy(&bytes).into_owned());
    let marks: Vec<bool> =
        texts.filter(|text| text.contains("Lamps ")).map(|text| text.contains("Lamps a")).collect();
    assert!(marks.len() > 3 && marks.iter().all(|mark| *mark == marks[0]), "{marks:?}");
}

#[test]
fn files_that_odgen_did_not_make_are_refused_by_name() {
    let scratch = Scratch::new("foreign-files");
    scratch.file("main.od.yaml", LAMP.replace("lamp:", "main:"));
    fs::create_dir(scratch.0.join("src")).unwrap();
    scratch.file("src/main.rs", "fn main() {}\n");
    let build = ["build", "main.od.yaml", "--rust", "--out", "."];
    let output = odgen(&scratch.0, &build);
    assert_eq!(code(&output), 1);
    assert!(
        stderr(&output).contains("src/main.rs") && stderr(&output).contains("`--force`"),
        "{}",
        stderr(&output)
    );
    assert_eq!(fs::read_to_string(scratch.0.join("src/main.rs")).unwrap(), "fn main() {}\n");
    assert_eq!(files(&scratch.0), ["main.od.yaml", "src/main.rs"]);
    assert_eq!(code(&odgen(&scratch.0, &[&build[..], &["--force"]].concat())), 0);
    assert!(fs::read_to_string(scratch.0.join("src/main.rs")).unwrap().contains("@generated"));
}

/// Every kind of file that a command makes is known by its mark, and replaced without a word.
#[test]
fn every_kind_of_generated_file_is_known_as_one() {
    let scratch = Scratch::new("marks");
    let build =
        ["build", "lamp.od.yaml", "--out", "out", "--rust", "--node", "5", "--docs", "md", "--docs", "html"];
    let templates = ["docs", "lamp.od.yaml", "--out", "own", "--templates", "templates"];
    fs::create_dir(scratch.0.join("templates")).unwrap();
    scratch.file("templates/page.adoc", "{{ system.title }}\n");
    for title in ["Lamp", "Another lamp"] {
        scratch.file(
            "lamp.od.yaml",
            LAMP.replace(
                "title: Lamp",
                &format!("title: {title}\ndocument:\n  - {{section: '1', title: {title}, content: [{{title: All, overview: [0x2000]}}]}}"),
            )
            .replace("name: Lamp,", &format!("name: {title},")),
        );
        for arguments in
            [&build[..], &templates, &["dcf", "lamp.od.yaml", "--node", "7", "--node-name", title]]
        {
            let output = odgen(&scratch.0, arguments);
            assert_eq!(code(&output), 0, "{}", stderr(&output));
        }
    }
    assert_eq!(fs::read_to_string(scratch.0.join("own/lamp/page.adoc")).unwrap(), "Another lamp\n");
    assert_eq!(
        fs::read_to_string(scratch.0.join("own/.odgen-files")).unwrap().lines().last(),
        Some("lamp/page.adoc")
    );
    for name in files(&scratch.0.join("out")) {
        let text = fs::read_to_string(scratch.0.join("out").join(&name)).unwrap();
        assert!(text[..text.len().min(200)].contains("@generated by odgen"), "{name}");
    }
    // An import of what odgen made does not repeat who made it.
    let output = odgen(&scratch.0, &["import", "out/eds/lamp.eds", "--out", "imported"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(!fs::read_to_string(scratch.0.join("imported/lamp.od.yaml")).unwrap().contains("@generated"));
}

#[test]
fn what_belongs_to_the_user_is_never_replaced_unasked() {
    let scratch = Scratch::new("users");
    scratch.file("fan.eds", FAN);
    for _ in 0..2 {
        assert_eq!(code(&odgen(&scratch.0, &["import", "fan.eds"])), 0);
        assert_eq!(code(&odgen(&scratch.0, &["docs", "--export-templates", "mine"])), 0);
    }
    for name in ["fan.od.yaml", "mine/chapter.md"] {
        let text = fs::read_to_string(scratch.0.join(name)).unwrap();
        scratch.file(name, text + "\n");
    }
    for arguments in [&["import", "fan.eds"][..], &["docs", "--export-templates", "mine"]] {
        let output = odgen(&scratch.0, arguments);
        assert_eq!(code(&output), 1);
        assert!(stderr(&output).contains("is there already"), "{}", stderr(&output));
        assert_eq!(code(&odgen(&scratch.0, &[arguments, &["--force"]].concat())), 0);
    }
    scratch.file("node.dcf", "mine");
    scratch.file("lamp.od.yaml", LAMP);
    let dcf = ["dcf", "lamp.od.yaml", "--node", "5", "--out", "node.dcf"];
    assert_eq!(code(&odgen(&scratch.0, &dcf)), 1);
    assert_eq!(fs::read_to_string(scratch.0.join("node.dcf")).unwrap(), "mine");
    assert_eq!(code(&odgen(&scratch.0, &[&dcf[..], &["--force"]].concat())), 0);
}

#[test]
fn no_name_leads_out_of_the_directory_or_to_what_windows_keeps() {
    let scratch = Scratch::new("bad-names");
    for name in
        ["...od.yaml", ".od.yaml", "nul.od.yaml", "com1.yaml", "a:b.od.yaml", "a\nb.od.yaml", "a..od.yaml"]
    {
        scratch.file(name, LAMP);
        let output = odgen(&scratch.0, &["build", name, "--out", "deep/out", "--docs", "md"]);
        assert_eq!(code(&output), 1, "{name:?}: {}", stdout(&output));
        assert!(stderr(&output).contains("error[OD0709]"), "{name:?}: {}", stderr(&output));
        assert!(!scratch.0.join("deep").exists(), "{name:?}");
    }
    scratch.file("a.od.yaml", LAMP.replace("lamp:", "aux:"));
    assert_eq!(code(&odgen(&scratch.0, &["build", "a.od.yaml"])), 1);
    scratch.file("b.od.yaml", LAMP.replace("lamp:", "lamp-b:"));
    scratch.file("B.od.yaml", LAMP.replace("lamp:", "lamp-c:"));
    let output = odgen(&scratch.0, &["build", "b.od.yaml", "B.od.yaml"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("some systems take for one file"), "{}", stderr(&output));
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_an_error() {
    let scratch = Scratch::new("full-output");
    scratch.file("lamp.od.yaml", LAMP);
    scratch.file("fan.eds", FAN);
    for arguments in [
        &["completions", "bash"][..],
        &["schema"],
        &["reference"],
        &["library"],
        &["explain", "OD0507"],
        &["explain", "all"],
        &["dump", "lamp.od.yaml"],
        &["errata", "lamp.od.yaml"],
        &["diff", "lamp.od.yaml", "fan.eds"],
        &["fix", "fan.eds"],
        &["docs", "lamp.od.yaml", "--dump-context"],
        &["check", "--format", "sarif", "lamp.od.yaml"],
        &["check", "--format", "github", "fan.eds"],
        &["build", "lamp.od.yaml"],
        &["import", "fan.eds"],
        &["new", "valve"],
        &["dcf", "lamp.od.yaml", "--node", "1"],
        &["--help"],
        &["--version"],
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_odgen"))
            .current_dir(&scratch.0)
            .args(arguments)
            .stdout(full)
            .output()
            .unwrap();
        assert_eq!(code(&output), 1, "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains("cannot write to standard output"), "{arguments:?}");
    }
}
