//! What commands do to the files that are there.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::{FAN, LAMP, Scratch, code, files, odgen, stderr, stdout};

/// Runs killed in a test: an eighth of them, all in a long run, or as many as the environment says.
pub(crate) fn kills(all: u64) -> u64 {
    let otherwise = if std::env::var_os("OD_TESTS_LONG").is_some() { all } else { all.div_ceil(8) };
    std::env::var("ODGEN_KILLS").ok().and_then(|number| number.parse().ok()).unwrap_or(otherwise)
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
fn a_build_that_is_killed_at_any_time_leaves_whole_files_and_the_next_completes_them() {
    let scratch = Scratch::new("killed");
    let mixed = killed_at_any_time(&scratch, "lamps.od.yaml", &["a", "b"].map(fleet), &BUILD, kills(25));
    println!("{mixed} were killed between two files");
}

/// Kills a command that makes `out` of one of two texts, at times that differ, and runs it again.
/// Returns how often it had made some of the files.
pub(crate) fn killed_at_any_time(
    scratch: &Scratch,
    source: &str,
    texts: &[String; 2],
    command: &[&str],
    kills: u64,
) -> usize {
    let out = scratch.0.join("out");
    let build = |text: &str| {
        scratch.file(source, text);
        let output = odgen(&scratch.0, command);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        tree(&out)
    };
    let began = std::time::Instant::now();
    let first = build(&texts[0]);
    let whole = u64::try_from(began.elapsed().as_micros()).unwrap().max(1000);
    let sets = [build(&texts[1]), build(&texts[0])];
    assert!(first.len() > 15 && sets[1] == first && sets[0] != first, "{}", first.len());
    let (name, _) = first.iter().find(|file| !sets[0].contains(file)).unwrap();
    // Numbers that look random, the same in every run (Knuth's MMIX).
    let mut random = 1_u64;
    let mut mixed = 0;
    for round in 0..kills {
        let new = usize::try_from(round % 2).unwrap();
        scratch.file(source, &texts[1 - new]);
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mut child = Command::new(env!("CARGO_BIN_EXE_odgen"))
            .current_dir(&scratch.0)
            .args(command)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // Writing takes little of the time: of three, two are killed soon after a file has changed.
        let mut most = whole;
        if round % 3 != 0 {
            let before = fs::read(out.join(name)).unwrap();
            while fs::read(out.join(name)).unwrap() == before && child.try_wait().unwrap().is_none() {
                std::hint::spin_loop();
            }
            most = whole / 50;
        }
        std::thread::sleep(Duration::from_micros((random >> 33) % most));
        child.kill().unwrap();
        child.wait().unwrap();
        let found = tree(&out);
        for file in found.iter().filter(|(name, _)| !name.contains(".odgen-new-")) {
            assert!(sets.iter().any(|set| set.contains(file)), "round {round}: {}", file.0);
        }
        mixed += usize::from(!sets.contains(&found));
        assert!(build(&texts[1 - new]) == sets[new], "round {round}");
    }
    mixed
}

/// A limit on the size of written files, in the place of a disk that is full.
#[cfg(target_os = "linux")]
#[test]
fn where_the_disk_is_full_the_message_names_what_is_written_and_the_next_run_completes_it() {
    let scratch = Scratch::new("full");
    let out = scratch.0.join("out");
    scratch.file("lamps.od.yaml", fleet("b"));
    assert_eq!(code(&odgen(&scratch.0, &BUILD)), 0);
    let old = tree(&out);
    scratch.file("lamps.od.yaml", fleet("a"));
    let limited =
        format!("trap '' XFSZ; ulimit -f 16; exec {} {}", env!("CARGO_BIN_EXE_odgen"), BUILD.join(" "));
    let output = Command::new("sh").current_dir(&scratch.0).args(["-c", &limited]).output().unwrap();
    assert_eq!(code(&output), 1);
    let text = stderr(&output);
    for part in [
        "error[OD0709]: cannot write out/",
        "File too large",
        "; written before it: out/",
        "run it again: it writes the rest",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let found = tree(&out);
    assert_eq!(code(&odgen(&scratch.0, &BUILD)), 0);
    let new = tree(&out);
    assert!(found.iter().all(|file| old.contains(file) || new.contains(file)));
    assert!(found != old && found != new);
}

/// "Nothing was changed" is true of folders, too.
#[cfg(target_os = "linux")]
#[test]
fn where_the_disk_is_full_from_the_start_no_folder_stays() {
    let scratch = Scratch::new("full-folder");
    scratch.file("lamps.od.yaml", fleet("b"));
    let limited =
        format!("trap '' XFSZ; ulimit -f 0; exec {} {}", env!("CARGO_BIN_EXE_odgen"), BUILD.join(" "));
    let output = Command::new("sh").current_dir(&scratch.0).args(["-c", &limited]).output().unwrap();
    let text = stderr(&output);
    assert_eq!(code(&output), 1, "{text}");
    assert!(text.contains("nothing was changed"), "{text}");
    assert!(!scratch.0.join("out").exists(), "{text}");
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

/// Windows takes 260 characters in a path, unless a program asks for more.
#[test]
fn paths_may_be_long() {
    let scratch = Scratch::new("long-path");
    let deep = ["a-directory-with-quite-a-long-name"; 10].join("/");
    fs::create_dir_all(scratch.0.join(&deep)).unwrap();
    let (specification, out) = (format!("{deep}/lamp.od.yaml"), format!("{deep}/out"));
    scratch.file(&specification, LAMP);
    let output = odgen(&scratch.0, &["build", &specification, "--out", &out, "--rust"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains(&format!("{out}/eds/lamp.eds")), "{}", stdout(&output));
    assert!(scratch.0.join(&out).join("src/lamp.rs").is_file());
}

// Windows refuses to create some of these files.
#[cfg(not(windows))]
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
