//! The command as its users meet it: exit codes, messages, files.

#![expect(clippy::unwrap_used, clippy::expect_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use insta::assert_snapshot;

const PITCH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../od-spec/devices/pitch-control-system.od.yaml");

const LAMP: &str = "\
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125, 500], features: [heartbeat producer]}
units:
  percent: {symbol: \"%\"}
objects:
  0x2000: {name: brightness, type: unsigned8, unit: percent, access: rw, pdo: receive, default: 80 %, max: 100 %}
pdos:
  lamp:
    receive: {1: {map: [brightness]}}
";

/// A directory of its own for one test, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("odgen-cli-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn file(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, text).unwrap();
        path
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn odgen(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_odgen")).current_dir(directory).args(arguments).output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn files(directory: &Path) -> Vec<String> {
    let mut names = Vec::new();
    for entry in fs::read_dir(directory).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.file_type().unwrap().is_dir() {
            names.extend(files(&entry.path()).into_iter().map(|below| format!("{name}/{below}")));
        } else {
            names.push(name);
        }
    }
    names.sort();
    names
}

#[test]
fn build_writes_every_file_and_says_what_it_is_for() {
    let scratch = Scratch::new("build");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["build", "lamp.od.yaml", "--out", "out", "--node", "5"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_snapshot!(stdout(&output));
    assert_eq!(files(&scratch.0.join("out")), ["eds/lamp.dcf", "eds/lamp.eds", "lamp.json"]);
    let again = odgen(&scratch.0, &["build", "lamp.od.yaml", "--out", "out", "--node", "5"]);
    assert!(stdout(&again).contains("0 files changed, 3 unchanged"), "{}", stdout(&again));
}

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
    let output = odgen(&scratch.0, &["check"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, NOTE));
    let output = odgen(&scratch.0, &["docs", "--out", "docs"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, NOTE));
    assert!(scratch.0.join("docs/a/torch.md").exists() && scratch.0.join("docs/b/lamp.md").exists());
    // Programs that read JSON get nothing else.
    let output = odgen(&scratch.0, &["check", "--format", "json"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    // A mistake is found in files that nobody named, too.
    scratch.file("a.od.yaml", LAMP.replace("access: rw", "acess: rw"));
    let output = odgen(&scratch.0, &["check", "--format", "short"]);
    assert_eq!(code(&output), 1);
    assert!(
        stderr(&output).starts_with(NOTE) && stderr(&output).contains("\na.od.yaml:9:"),
        "{}",
        stderr(&output)
    );
    // What is named is taken alone.
    let output = odgen(&scratch.0, &["check", "b.od.yaml"]);
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
    let output = odgen(&work, &["--specs", "..", "check", "own.od.yaml"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
}

#[test]
fn build_makes_rust_when_asked() {
    let scratch = Scratch::new("rust");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["build", "--rust", "lamp.od.yaml"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(
        files(&scratch.0),
        ["generated/eds/lamp.eds", "generated/lamp.json", "generated/src/lamp.rs", "lamp.od.yaml"]
    );
    let code_of = fs::read_to_string(scratch.0.join("generated/src/lamp.rs")).unwrap();
    assert!(code_of.starts_with("// Object dictionary `lamp` of lamp.od.yaml ("), "{code_of}");
    assert!(code_of.contains("pub fn brightness(&self) -> units::Percent<u8> {"), "{code_of}");
}

#[test]
fn what_cannot_be_rust_writes_nothing_at_all() {
    let scratch = Scratch::new("no-rust");
    let label = "objects:\n  0x2001: {name: label, type: visible-string, access: rw}\n";
    scratch.file("lamp.od.yaml", LAMP.replace("objects:\n", label));
    let output = odgen(&scratch.0, &["build", "--rust", "lamp.od.yaml"]);
    assert_eq!(code(&output), 1);
    assert!(!scratch.0.join("generated").exists());
    assert_snapshot!(stderr(&output));
    assert_eq!(code(&odgen(&scratch.0, &["check", "--rust", "lamp.od.yaml"])), 1);
    assert_eq!(code(&odgen(&scratch.0, &["check", "lamp.od.yaml"])), 0);
    // An EDS needs no capacity.
    assert_eq!(code(&odgen(&scratch.0, &["build", "lamp.od.yaml"])), 0);
}

#[test]
fn an_error_in_one_specification_writes_nothing_at_all() {
    let scratch = Scratch::new("nothing");
    scratch.file("good.od.yaml", LAMP);
    scratch.file("bad.od.yaml", LAMP.replace("access: rw", "acess: rw"));
    let output = odgen(&scratch.0, &["build", "good.od.yaml", "bad.od.yaml", "--out", "out"]);
    assert_eq!(code(&output), 1);
    assert_eq!(stdout(&output), "");
    assert!(!scratch.0.join("out").exists());
    assert_snapshot!(stderr(&output));
}

#[test]
fn an_output_directory_that_cannot_be_written_leaves_the_old_files() {
    let scratch = Scratch::new("unwritable");
    scratch.file("lamp.od.yaml", LAMP);
    assert_eq!(code(&odgen(&scratch.0, &["build", "lamp.od.yaml", "--out", "out"])), 0);
    let before = fs::read(scratch.0.join("out/eds/lamp.eds")).unwrap();
    scratch.file("lamp.od.yaml", LAMP.replace("default: 80 %", "default: 70 %"));
    // A directory where a file should go: the one obstacle that also stops the superuser.
    fs::remove_file(scratch.0.join("out/lamp.json")).unwrap();
    fs::create_dir(scratch.0.join("out/lamp.json")).unwrap();
    let output = odgen(&scratch.0, &["build", "lamp.od.yaml", "--out", "out"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("error[OD0709]: cannot write out/lamp.json"), "{}", stderr(&output));
    assert_eq!(fs::read(scratch.0.join("out/eds/lamp.eds")).unwrap(), before);
    assert_eq!(files(&scratch.0.join("out")), ["eds/lamp.eds"]);
}

#[test]
fn a_full_disk_leaves_the_old_files() {
    let scratch = Scratch::new("full");
    scratch.file("lamp.od.yaml", LAMP);
    assert_eq!(code(&odgen(&scratch.0, &["build", "lamp.od.yaml", "--out", "out"])), 0);
    let before = fs::read(scratch.0.join("out/lamp.json")).unwrap();
    scratch.file("lamp.od.yaml", LAMP.replace("default: 80 %", "default: 70 %"));
    // A limit on the size of written files stands for the full disk: the EDS fits, the JSON does not.
    let limited = format!(
        "ulimit -f 10; trap '' XFSZ; exec {} build lamp.od.yaml --out out",
        env!("CARGO_BIN_EXE_odgen")
    );
    let output = Command::new("bash").current_dir(&scratch.0).args(["-c", &limited]).output().unwrap();
    assert_eq!(code(&output), 1, "{}", stdout(&output));
    assert!(stderr(&output).contains("error[OD0709]"), "{}", stderr(&output));
    assert_eq!(fs::read(scratch.0.join("out/lamp.json")).unwrap(), before);
    assert_eq!(files(&scratch.0.join("out")), ["eds/lamp.eds", "lamp.json"]);
}

#[test]
fn two_devices_of_one_key_are_refused() {
    let scratch = Scratch::new("clash");
    scratch.file("a.od.yaml", LAMP);
    scratch.file("b.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["build", "a.od.yaml", "b.od.yaml", "--out", "out"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("two devices would both write eds/lamp.eds"), "{}", stderr(&output));
    assert!(!scratch.0.join("out").exists());
}

#[test]
fn check_says_nothing_when_all_is_well() {
    let scratch = Scratch::new("check");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["check", "lamp.od.yaml"]);
    assert_eq!((code(&output), stdout(&output), stderr(&output)), (0, String::new(), String::new()));
}

/// What departs from a standard is no mistake; people are told how much there is, and get the list when they ask.
#[test]
fn departures_from_a_standard_are_notes() {
    let scratch = Scratch::new("notes");
    let output = odgen(&scratch.0, &["check", PITCH, "--deny-warnings"]);
    assert_eq!((code(&output), stdout(&output)), (0, String::new()));
    let said = stderr(&output);
    assert!(said.starts_with("note: ") && said.lines().count() == 1, "{said}");
    let output = odgen(&scratch.0, &["check", PITCH, "--notes"]);
    let list = stderr(&output);
    assert_eq!(said.split(' ').nth(1).unwrap(), list.lines().count().to_string());
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

#[test]
fn dcf_takes_values_by_index_by_name_and_in_units() {
    let scratch = Scratch::new("dcf");
    let arguments = [
        "dcf",
        PITCH,
        "--device",
        "pmc",
        "--node",
        "5",
        "--bit-rate",
        "500",
        "--set",
        "607D.2=9500",
        "--set",
        "EFC target position=91.50 °",
        "--set",
        "sensor selection code=-1",
    ];
    let output = odgen(&scratch.0, &arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = fs::read_to_string(scratch.0.join("pmc-5.dcf")).unwrap();
    let section = |name: &str| {
        let start = text.find(&format!("[{name}]\r\n")).unwrap_or_else(|| panic!("no [{name}]"));
        text[start..].split("\r\n\r\n").next().unwrap().to_owned()
    };
    assert!(section("DeviceComissioning").contains("NodeID=5\r\nNodeName=PMC 5\r\nBaudrate=500\r\n"));
    assert!(section("607Dsub2").contains("ParameterValue=9500"));
    assert!(section("567A").contains("ParameterValue=9150"));
    assert!(section("606A").contains("ParameterValue=-1"));
    assert!(section("1014").contains("DefaultValue=0x00000085"), "{}", section("1014"));
    assert!(!text.contains("$NODEID"));
}

#[test]
fn dcf_refuses_what_the_device_would_refuse() {
    let scratch = Scratch::new("refuse");
    let refused = |extra: &[&str]| {
        let mut arguments = vec!["--format", "short", "dcf", PITCH, "--device", "pmc"];
        if !extra.contains(&"--node") {
            arguments.extend(["--node", "5"]);
        }
        arguments.extend(extra);
        let output = odgen(&scratch.0, &arguments);
        let expected = if extra.contains(&"--node") { 2 } else { 1 };
        assert_eq!(code(&output), expected, "{}", stdout(&output));
        assert!(files(&scratch.0).is_empty());
        stderr(&output)
    };
    assert_snapshot!(refused(&["--set", "6510.10=16"]));
    assert_snapshot!(refused(&["--set", "statusword=1", "--set", "statuswort=1"]));
    assert_snapshot!(refused(&["--set", "607D.1=9000", "--set", "607D.2=100"]));
    assert_snapshot!(refused(&["--bit-rate", "333"]));
    assert_snapshot!(refused(&["--node", "0"]));
}

#[test]
fn dcf_refuses_names_that_a_line_cannot_hold() {
    let scratch = Scratch::new("names");
    let run = |option: &str, name: &str| {
        let start = ["--format", "short", "dcf", PITCH, "--device", "pmc", "--node", "5"];
        let output = odgen(&scratch.0, &[&start[..], &[option, name]].concat());
        (code(&output), stderr(&output))
    };
    for (option, longest) in [("--node-name", 246), ("--net-name", 243)] {
        assert_eq!(run(option, &"n".repeat(longest)).0, 0);
        for name in [&"n".repeat(longest + 1), "a;b", "a#b", "a=b", "a\nb"] {
            let (code, said) = run(option, name);
            assert_eq!(code, 1);
            assert!(said.starts_with(&format!("error[OD0319]: the text of `{option}` ")), "{said}");
        }
    }
    assert_eq!(files(&scratch.0), ["pmc-5.dcf"]);
}

#[test]
fn dcf_is_written_beside_what_it_is_made_from() {
    let scratch = Scratch::new("beside");
    let library = "od-spec: 1\ntitle: Own\nprofile: own\n";
    scratch.file("own.od.yaml", library);
    let spec = LAMP.replace("uses: [cia301]", "uses: [cia301, own.od.yaml]");
    scratch.file("lamp.od.yaml", &spec);
    fs::create_dir(scratch.0.join("sub")).unwrap();
    let refused = |out: &str| {
        let start = ["--format", "short", "dcf", "lamp.od.yaml", "--device", "lamp", "--node", "5", "--out"];
        let output = odgen(&scratch.0, &[&start[..], &[out]].concat());
        assert_eq!(code(&output), 1, "{}", stderr(&output));
        stderr(&output)
    };
    for out in ["lamp.od.yaml", "sub/../lamp.od.yaml", "own.od.yaml"] {
        let said = refused(out);
        let expected = format!("error[OD0709]: cannot write `{out}`: the DCF is made from this file");
        assert!(said.contains(&expected), "{said}");
    }
    for out in ["..", "/", "sub/.."] {
        let said = refused(out);
        assert!(said.contains(&format!("error[OD0709]: cannot write `{out}`: it names no file")), "{said}");
    }
    assert_eq!(files(&scratch.0), ["lamp.od.yaml", "own.od.yaml"]);
    assert_eq!(fs::read_to_string(scratch.0.join("lamp.od.yaml")).unwrap(), spec);
    assert_eq!(fs::read_to_string(scratch.0.join("own.od.yaml")).unwrap(), library);
}

#[test]
fn the_command_line_has_its_own_exit_code() {
    let scratch = Scratch::new("usage");
    assert_eq!(code(&odgen(&scratch.0, &["frobnicate"])), 2);
    assert_eq!(code(&odgen(&scratch.0, &["explain", "OD9999"])), 2);
    assert_eq!(code(&odgen(&scratch.0, &["--help"])), 0);
}

#[test]
fn explain_errata_and_completions() {
    let scratch = Scratch::new("texts");
    assert_snapshot!(stdout(&odgen(&scratch.0, &["explain", "od0507"])));
    let errata = stdout(&odgen(&scratch.0, &["errata", PITCH, "--at", "6041", "--kind", "access"]));
    assert!(errata.contains("6041h on pmc [access]"), "{errata}");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = odgen(&scratch.0, &["completions", shell]);
        assert!(code(&output) == 0 && stdout(&output).contains("deny-warnings"), "{shell}");
    }
    for (command, start) in [("reference", "# "), ("schema", "{")] {
        assert!(stdout(&odgen(&scratch.0, &[command])).starts_with(start), "{command}");
    }
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

#[test]
fn docs_prints_both_formats_of_a_small_specification() {
    let scratch = Scratch::new("docs");
    scratch.file("lamp.od.yaml", LAMP);
    let arguments = ["docs", "lamp.od.yaml", "--format", "md", "--format", "html", "--out", "out"];
    let output = odgen(&scratch.0, &arguments);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    let names = [
        "lamp/README.md",
        "lamp/index.html",
        "lamp/lamp.html",
        "lamp/lamp.md",
        "lamp/storage.md",
        "lamp/units.md",
    ];
    assert_eq!(files(&scratch.0.join("out")), names);
    assert_snapshot!(fs::read_to_string(scratch.0.join("out/lamp/lamp.md")).unwrap());
    // In another language, with what has no words in it marked.
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--lang", "de", "--out", "de"]);
    assert_eq!(code(&output), 0);
    let german = fs::read_to_string(scratch.0.join("de/lamp/lamp.md")).unwrap();
    assert!(
        german.contains("| Index | Name") && german.contains("Zugriff") && german.contains("Vorgabe"),
        "{german}"
    );
    assert!(german.contains(" *(en)*"), "{german}");
}

#[test]
fn build_makes_documents_when_asked() {
    let scratch = Scratch::new("build-docs");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["build", "lamp.od.yaml", "--out", "out", "--docs", "html"]);
    assert_eq!(code(&output), 0);
    let names = ["docs/lamp/index.html", "docs/lamp/lamp.html", "eds/lamp.eds", "lamp.json"];
    assert_eq!(files(&scratch.0.join("out")), names);
}

#[test]
fn a_mistake_in_a_template_has_a_place_and_nothing_is_written() {
    let scratch = Scratch::new("templates");
    scratch.file("lamp.od.yaml", LAMP);
    fs::create_dir(scratch.0.join("own")).unwrap();
    let mut said = String::new();
    for template in [
        "{{ device.nmae }}\n",
        "first line\n{% for one in devices %}\n",
        "{% include \"_absent.txt\" %}\n",
        "{{ device.name|shout }}\n",
    ] {
        scratch.file("own/device.txt", template);
        let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--templates", "own", "--out", "out"]);
        assert_eq!((code(&output), stdout(&output)), (1, String::new()), "{template}");
        said.push_str(&stderr(&output));
    }
    assert_snapshot!(said);
    assert!(!scratch.0.join("out").exists());
}

#[test]
fn templates_are_exported_joined_and_replaced() {
    let scratch = Scratch::new("export");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["docs", "--export-templates", "own", "--format", "md"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert_eq!(
        files(&scratch.0.join("own")),
        ["README.md", "_macros.md", "appendix.md", "chapter.md", "device.md"]
    );
    // What was exported prints the same as what is built in.
    assert_eq!(code(&odgen(&scratch.0, &["docs", "lamp.od.yaml", "--templates", "own", "--out", "one"])), 0);
    assert_eq!(code(&odgen(&scratch.0, &["docs", "lamp.od.yaml", "--out", "two"])), 0);
    for name in files(&scratch.0.join("two")) {
        let text = |out: &str| fs::read_to_string(scratch.0.join(out).join(&name)).unwrap();
        assert_eq!(text("one"), text("two"), "{name}");
    }
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--templates", "nowhere"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("cannot read nowhere"), "{}", stderr(&output));
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--device", "lmap"]);
    assert_eq!(code(&output), 2);
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--dump-context"]);
    assert!(
        stdout(&output).starts_with("{\n  \"format\": 1,\n  \"language\": \"en\""),
        "{}",
        stdout(&output)
    );
}

/// A device may not be named like another page of the documents.
#[test]
fn two_pages_of_one_name_are_refused() {
    let scratch = Scratch::new("page-clash");
    scratch.file("lamp.od.yaml", LAMP.replace("  lamp: {", "  units: {").replace("  lamp:\n", "  units:\n"));
    let output = odgen(&scratch.0, &["--format", "short", "docs", "lamp.od.yaml", "--out", "out"]);
    assert_eq!(code(&output), 1);
    assert_snapshot!(stderr(&output));
    assert!(!scratch.0.join("out").exists());
}

#[test]
fn new_writes_a_specification_that_is_clean() {
    let scratch = Scratch::new("new");
    for (name, arguments) in [
        ("io-module", &[][..]),
        ("lift", &["--profile", "cia402", "--modes", "profile position,HM"][..]),
        ("fan", &["--profile", "cia402", "--modes", "velocity mode"][..]),
    ] {
        let output = odgen(&scratch.0, &[&["new", name], arguments].concat());
        assert_eq!((code(&output), stderr(&output)), (0, String::new()));
        let file = format!("{name}.od.yaml");
        assert!(stdout(&output).starts_with(&format!("  {file}  a ")), "{}", stdout(&output));
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
    ] {
        let output = odgen(&scratch.0, &[vec!["new"], arguments, vec!["--format", "short"]].concat());
        assert_eq!(code(&output), expected, "{}", stderr(&output));
        said.push_str(&stderr(&output));
    }
    assert_snapshot!(said);
    assert_eq!(fs::read_to_string(kept).unwrap(), "mine");
    assert_eq!(files(&scratch.0), ["there.od.yaml"]);
}

#[test]
fn libraries_are_printed() {
    let scratch = Scratch::new("library");
    assert_eq!(stdout(&odgen(&scratch.0, &["library"])), "cia301\ncia402\n");
    let output = odgen(&scratch.0, &["library", "cia402"]);
    assert!(stdout(&output).contains("\n  0x6040:"), "{}", stdout(&output));
    let output = odgen(&scratch.0, &["library", "cia999"]);
    assert_eq!((code(&output), stdout(&output)), (2, String::new()));
    assert!(stderr(&output).contains("the libraries are cia301, cia402"), "{}", stderr(&output));
}
