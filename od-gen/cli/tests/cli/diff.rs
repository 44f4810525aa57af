//! `odgen diff`.

use std::fs;
use std::path::Path;
use std::process::Command;

use insta::assert_snapshot;

use crate::{FAN, LAMP, ROOF_FAN, Scratch, code, odgen, stderr, stdout};

/// The lamp, one with another description, and one with a narrower limit.
fn lamps(name: &str) -> Scratch {
    let scratch = Scratch::new(name);
    scratch.file("old.od.yaml", LAMP);
    scratch.file("about.od.yaml", LAMP.replace("unit: percent,", "unit: percent, about: How bright.,"));
    scratch.file("new.od.yaml", LAMP.replace("max: 100 %", "max: 90 %"));
    scratch
}

#[test]
fn differences_are_reported_with_what_they_break() {
    let scratch = lamps("diff");
    let output = odgen(&scratch.0, &["diff", "old.od.yaml", "new.od.yaml"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
    assert_snapshot!(stdout(&output));
    let output = odgen(&scratch.0, &["diff", "old.od.yaml", "new.od.yaml", "--format", "short"]);
    assert_eq!(stdout(&output), "lamp: ~ 2000h brightness: max: 100 % -> 90 % [plc]\n");
    let output = odgen(&scratch.0, &["diff", "old.od.yaml", "new.od.yaml", "--format", "markdown"]);
    assert!(
        stdout(&output).contains("| `~` | 2000h brightness | max: 100 % → 90 % |"),
        "{}",
        stdout(&output)
    );
    let output = odgen(&scratch.0, &["diff", "old.od.yaml", "new.od.yaml", "--format", "json"]);
    assert!(stdout(&output).starts_with('{') && stdout(&output).contains("\"class\": \"plc\""));
    let output = odgen(&scratch.0, &["diff", "old.od.yaml", "old.od.yaml"]);
    assert_eq!((code(&output), stdout(&output).as_str()), (0, "0 changes\n"));
}

/// A DCF says more than its device: where the node is, and what is set in it.
#[test]
fn nodes_and_their_values_are_compared() {
    let scratch = Scratch::new("diff-nodes");
    scratch.file("old.dcf", ROOF_FAN);
    let changed =
        ROOF_FAN.replace("ParameterValue=-5", "ParameterValue=7").replace("NodeID=0x21", "NodeID=0x22");
    scratch.file("new.dcf", changed.replace("Baudrate=250", "Baudrate=125"));
    scratch.file("fan.eds", FAN);
    let short = |old: &str, new: &str| {
        let output = odgen(&scratch.0, &["diff", old, new, "--format", "short"]);
        (stdout(&output), stderr(&output))
    };
    let (differs, _) = short("old.dcf", "new.dcf");
    assert_eq!(
        differs.lines().collect::<Vec<_>>(),
        [
            "new: ~ device, bit rate: node: 250 kbit/s -> 125 kbit/s [plc]",
            "new: ~ device, node-ID: node: 33 -> 34 [plc]",
            "new: ~ 2000h Speed, set for the node: default: -5 -> 7 [behaviour]",
        ]
    );
    scratch.file("unset.dcf", ROOF_FAN.replace("ParameterValue=-5\n", ""));
    let (differs, _) = short("old.dcf", "unset.dcf");
    assert_eq!(differs, "unset: ~ 2000h Speed, set for the node: default: -5 -> none [behaviour]\n");
    scratch
        .file("named.dcf", ROOF_FAN.replace("ParameterValue=-5\n", "ParameterValue=-5\nDenotation=Roof\n"));
    let (differs, _) = short("old.dcf", "named.dcf");
    assert_eq!(differs, "named: ~ device, name of 2000h: node: none -> Roof [documents]\n");
    let (_, said) = short("old.dcf", "fan.eds");
    assert!(
        said.contains("the 1 value set for the node is not compared, as the other side is about no node"),
        "{said}"
    );
    let human = stdout(&odgen(&scratch.0, &["diff", "old.dcf", "old.dcf"]));
    assert!(human.starts_with("0 changes\n"), "{human}");
}

/// A file gets no colours unless the user asks for them.
#[test]
fn colours_are_for_terminals() {
    let scratch = lamps("diff-colours");
    let plain = stdout(&odgen(&scratch.0, &["diff", "old.od.yaml", "new.od.yaml"]));
    let coloured = stdout(&odgen(&scratch.0, &["diff", "old.od.yaml", "new.od.yaml", "--color", "always"]));
    assert!(!plain.contains('\u{1b}') && coloured.contains("\u{1b}[1;31mBREAKS"), "{coloured}");
}

#[test]
fn the_exit_code_follows_the_class() {
    let scratch = lamps("diff-codes");
    let exit = |new: &str, class: &str| {
        code(&odgen(&scratch.0, &["diff", "old.od.yaml", new, "--exit-code", class]))
    };
    for (class, about, limit, same) in [
        ("documents", 3, 3, 0),
        ("addition", 0, 3, 0),
        ("behaviour", 0, 3, 0),
        ("firmware", 0, 3, 0),
        ("stored", 0, 3, 0),
        ("plc", 0, 3, 0),
    ] {
        let found = (exit("about.od.yaml", class), exit("new.od.yaml", class), exit("old.od.yaml", class));
        assert_eq!(found, (about, limit, same), "{class}");
    }
}

#[test]
fn what_cannot_be_compared_is_an_error() {
    let scratch = lamps("diff-errors");
    scratch.file("broken.od.yaml", LAMP.replace("access: rw", "acess: rw"));
    let output = odgen(&scratch.0, &["diff", "old.od.yaml", "broken.od.yaml", "--exit-code", "plc"]);
    assert_eq!((code(&output), stdout(&output).as_str()), (1, ""));
    assert!(stderr(&output).contains("OD0201"), "{}", stderr(&output));
    let output = odgen(&scratch.0, &["diff", "old.od.yaml", "missing.od.yaml"]);
    assert_eq!(code(&output), 1);
    assert_eq!(code(&odgen(&scratch.0, &["diff", "old.od.yaml"])), 2);
    assert_eq!(code(&odgen(&scratch.0, &["diff", "--git", "HEAD", "old.od.yaml", "new.od.yaml"])), 2);
    let output = odgen(&scratch.0, &["diff", "old.od.yaml", "new.od.yaml", "--device", "torch"]);
    assert_eq!((code(&output), stdout(&output).as_str()), (2, ""));
    assert!(stderr(&output).contains("the devices are `lamp`"), "{}", stderr(&output));
}

#[test]
fn one_device_of_several() {
    let scratch = Scratch::new("diff-device");
    let text = &*crate::in_one_file::PITCH;
    scratch.file("old.od.yaml", text);
    scratch.file("new.od.yaml", text.replacen("default: 3000 mAh", "default: 3100 mAh", 1));
    let lines = |key: &str| {
        let arguments = ["diff", "old.od.yaml", "new.od.yaml", "--format", "short", "--device", key];
        stdout(&odgen(&scratch.0, &arguments))
    };
    assert_eq!(lines("pmm").lines().count(), 1);
    assert_eq!(lines("pmc"), "");
}

fn git(directory: &Path, arguments: &[&str]) {
    let settings =
        ["-c", "user.name=test", "-c", "user.email=test@example.com", "-c", "commit.gpgsign=false"];
    let output = Command::new("git").current_dir(directory).args(settings).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// The specification and the library that it uses are those of the revision; the working tree is what they are compared with.
#[test]
fn a_specification_is_compared_with_its_own_past() {
    const LIBRARY: &str = "od-spec: 1\nprofile: house\ntitle: House\nunits: {lux: {symbol: lx}}\n";
    let scratch = Scratch::new("diff-git");
    fs::create_dir_all(scratch.0.join("specs")).unwrap();
    let lamp = LAMP.replace("uses: [cia301]", "uses: [cia301, ../house.od.yaml]");
    let lamp = lamp.replace(
        "unit: percent, access: rw, pdo: receive, default: 80 %, max: 100 %",
        "unit: lux, access: rw, pdo: receive, max: 100 lx",
    );
    scratch.file("house.od.yaml", LIBRARY);
    scratch.file("specs/lamp.od.yaml", &lamp);
    // Outside of any repository: git looks no further than the directory of scratches.
    let outside = |arguments: &[&str]| {
        let parent = scratch.0.parent().unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_odgen"));
        command
            .current_dir(&scratch.0)
            .env("GIT_CEILING_DIRECTORIES", parent)
            .args(arguments)
            .output()
            .unwrap()
    };
    let output = outside(&["--format", "short", "diff", "--git", "HEAD", "specs/lamp.od.yaml"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("git says: not a git repository"), "{}", stderr(&output));

    git(&scratch.0, &["init", "-q"]);
    git(&scratch.0, &["add", "."]);
    git(&scratch.0, &["commit", "-q", "-m", "first"]);
    let short = ["diff", "--format", "short", "--git", "HEAD", "specs/lamp.od.yaml"];
    let output = odgen(&scratch.0, &short);
    assert_eq!((code(&output), stdout(&output).as_str()), (0, ""), "{}", stderr(&output));
    scratch.file("house.od.yaml", LIBRARY.replace("{symbol: lx}", "{symbol: lx, scale: 1/2}"));
    scratch.file("specs/lamp.od.yaml", lamp.replace("max: 100 lx", "max: 60.0 lx"));
    let lines = stdout(&odgen(&scratch.0, &short));
    assert_eq!(
        lines.lines().collect::<Vec<_>>(),
        [
            "lamp: ~ 2000h brightness: max: 100 lx -> 60.0 lx (120) [addition]",
            "lamp: ~ unit `lux` (2000h): unit: 1 lx -> 0.5 lx [plc]",
        ]
    );
    // From another directory, too.
    let inside = stdout(&odgen(
        &scratch.0.join("specs"),
        &["diff", "--format", "short", "--git", "HEAD", "lamp.od.yaml"],
    ));
    assert_eq!(inside, lines);
    for (arguments, exit, said) in [
        (["--git", "nowhere", "specs/lamp.od.yaml"], 1, "git says: "),
        (["--git", "HEAD", "house.eds"], 1, "`--git` takes a specification"),
        (["--git", "--output=x", "specs/lamp.od.yaml"], 2, "names no revision"),
        (["--git", "HEAD", "specs/other.od.yaml"], 1, "specs/other.od.yaml"),
    ] {
        let [option, revision, path] = arguments;
        let option = format!("{option}={revision}");
        let output = odgen(&scratch.0, &["diff", &option, path]);
        assert_eq!(code(&output), exit, "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{arguments:?}: {}", stderr(&output));
    }
}
