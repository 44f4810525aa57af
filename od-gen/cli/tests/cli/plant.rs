//! `odgen plant`.

use std::fs;

use crate::files::{killed_at_any_time, kills};
use crate::{Scratch, code, files, odgen, stderr, stdout};

const PRESS: &str = include_str!("../../../../tests/shared/press.od.yaml");
const PLANT: &str = include_str!("../../../../tests/ui/plant/ok_everything.yaml");
const BUILD: [&str; 5] = ["plant", "build", "plant.yaml", "--out", "out"];

/// A directory with the presses.
pub(crate) fn presses(name: &str) -> Scratch {
    let scratch = Scratch::new(name);
    scratch.file("press.od.yaml", PRESS);
    scratch.file("plant.yaml", PLANT);
    scratch
}

/// Every file below `out` with its contents.
fn tree(scratch: &Scratch) -> Vec<(String, Vec<u8>)> {
    let out = scratch.0.join("out");
    files(&out).into_iter().map(|name| (name.clone(), fs::read(out.join(name)).unwrap())).collect()
}

#[test]
fn a_plant_is_built_twice_with_the_same_bytes() {
    let scratch = presses("plant-build");
    let output = odgen(&scratch.0, &BUILD);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
    insta::assert_snapshot!("built", stdout(&output));
    let built = tree(&scratch);
    let again = stdout(&odgen(&scratch.0, &BUILD));
    assert!(again.contains("0 changed, 190 unchanged"), "{again}");
    // Elsewhere, from another directory, and with the specification somewhere else.
    let other = Scratch::new("plant-elsewhere");
    fs::create_dir_all(other.0.join("a/b")).unwrap();
    other.file("a/press.od.yaml", PRESS);
    other.file("a/b/plant.yaml", PLANT.replace("press.od.yaml", "../press.od.yaml"));
    let output = odgen(&other.0, &["plant", "build", "a/b/plant.yaml", "--out", "out"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(tree(&other) == built);
    let text = |name: &str| String::from_utf8(fs::read(scratch.0.join("out").join(name)).unwrap()).unwrap();
    insta::assert_snapshot!("overview", text("overview.md"));
    insta::assert_snapshot!("nodelist", text("Hall/6/nodelist.cpj").replace("\r\n", "\n"));
    let sheet = text("values.csv");
    assert!(sheet.starts_with('\u{FEFF}'));
    let of_six: Vec<&str> = sheet.lines().filter(|line| line.contains("Hall;6;")).collect();
    insta::assert_snapshot!("sheet", of_six.join("\n"));
    // A locked entry is marked in the DCF.
    assert!(text("Hall/6/right-supply.dcf").contains("; LOCKED PARAMETER, set on request"));
    assert!(text("Hall/6/right-drive.dcf").contains("LSS_SerialNumber=0x00001267"));
}

/// What a plant makes of a node, `odgen dcf` makes of the same settings.
#[test]
fn a_dcf_of_a_plant_is_the_one_of_the_node() {
    let scratch = presses("plant-dcf");
    assert_eq!(code(&odgen(&scratch.0, &BUILD)), 0);
    let arguments = [
        "dcf",
        "press.od.yaml",
        "--device",
        "drive",
        "--node",
        "12",
        "--bit-rate",
        "250",
        "--node-name",
        "Drive right",
        "--net-name",
        "Hall 5",
        "--set",
        "lowest voltage=510.0 V",
        "--set",
        "1017=500",
        "--concise",
        "--out",
        "right-drive.dcf",
    ];
    let output = odgen(&scratch.0, &arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for name in ["right-drive.dcf", "right-drive.bin"] {
        let one = fs::read(scratch.0.join(name)).unwrap();
        assert!(one == fs::read(scratch.0.join("out/Hall/5").join(name)).unwrap(), "{name}");
    }
}

#[test]
fn files_of_nodes_that_are_gone_are_named_and_removed_on_request() {
    let scratch = presses("plant-prune");
    scratch.file("plant.yaml", PLANT.replace("  Hall:", "  Yard: {type: P1, machines: {1..2: {}}}\n  Hall:"));
    assert_eq!(code(&odgen(&scratch.0, &BUILD)), 0);
    scratch.file("out/Yard/1/notes.txt", "of the fitter");
    scratch.file("plant.yaml", PLANT);
    let said = stdout(&odgen(&scratch.0, &BUILD));
    assert!(said.contains("of no node of the plant any more: out/Yard/1/left-drive.bin"), "{said}");
    let said = stdout(&odgen(&scratch.0, &[&BUILD[..], &["--prune"]].concat()));
    assert!(said.contains("removed, as no node"), "{said}");
    let left: Vec<String> =
        files(&scratch.0.join("out")).into_iter().filter(|name| name.contains("Yard")).collect();
    assert_eq!(left, ["Yard/1/notes.txt"]);
    let said = stdout(&odgen(&scratch.0, &BUILD));
    assert!(!said.contains("any more"), "{said}");
}

#[test]
fn what_was_changed_is_seen_whatever_its_size_and_time() {
    let scratch = presses("plant-changed");
    assert_eq!(code(&odgen(&scratch.0, &BUILD)), 0);
    let built = tree(&scratch);
    let path = scratch.0.join("out/Hall/3/left-drive.dcf");
    let time = fs::metadata(&path).unwrap().modified().unwrap();
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("ParameterValue=5000", "ParameterValue=9000")).unwrap();
    fs::File::options().write(true).open(&path).unwrap().set_modified(time).unwrap();
    let said = stdout(&odgen(&scratch.0, &BUILD));
    assert!(said.contains("1 changed"), "{said}");
    assert!(tree(&scratch) == built);
}

#[test]
fn a_wrong_plant_writes_nothing() {
    let scratch = presses("plant-wrong");
    scratch.file("plant.yaml", PLANT.replace("650.0 V", "990.0 V"));
    let output = odgen(&scratch.0, &BUILD);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("error[OD0406]"), "{}", stderr(&output));
    assert!(!scratch.0.join("out").exists());
    let output = odgen(&scratch.0, &["plant", "check", "plant.yaml", "--format", "short"]);
    assert_eq!(code(&output), 1);
    assert_eq!(stderr(&output).lines().count(), 1, "{}", stderr(&output));
    let output = odgen(&scratch.0, &["plant", "check", "press.od.yaml"]);
    assert!(stderr(&output).contains("a plant has no key `od-spec`"), "{}", stderr(&output));
}

#[test]
fn each_value_reports_the_level_that_gives_it() {
    let scratch = presses("plant-show");
    let show = |arguments: &[&str]| {
        let output = odgen(&scratch.0, &[&["plant", "show", "plant.yaml"], arguments].concat());
        stdout(&output) + &stderr(&output)
    };
    insta::assert_snapshot!("shown", show(&["--site", "Hall", "--machine", "6", "--position", "right"]));
    insta::assert_snapshot!("shown_entry", show(&["--device", "drive", "--entry", "lowest voltage"]));
    insta::assert_snapshot!(
        "shown_json",
        show(&[
            "--machine",
            "6",
            "--device",
            "drive",
            "--position",
            "right",
            "--entry",
            "lowest voltage",
            "--format",
            "json"
        ])
    );
    let unset = show(&["--machine", "1", "--position", "left", "--entry", "calibration"]);
    assert!(unset.contains("2001h  calibration: no level sets it; the default 100"), "{unset}");
    let wrong = show(&["--machine", "6", "--position", "rihgt"]);
    assert!(
        wrong.contains("there is no position `rihgt`") && wrong.contains("did you mean `right`?"),
        "{wrong}"
    );
}

#[test]
fn a_plant_that_is_killed_leaves_whole_files_and_the_next_completes_them() {
    let scratch = presses("plant-killed");
    let plant = PLANT.replace("1..20", "1..120");
    let texts = [plant.clone(), plant.replace("510.0 V", "511.0 V").replace("500}", "501}")];
    let mixed = killed_at_any_time(&scratch, "plant.yaml", &texts, &BUILD, kills(15));
    println!("{mixed} were killed between two files");
}
