//! What the corpus of foreign files is held to (`cargo xtask corpus`), with the files of this repository, and with small ones
//! of what an import once lost.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::PathBuf;

use od_tests::foreign::{Checked, Step, check};
use od_tests::root;

const DIRECTORIES: [&str; 3] = ["tests/eds", "od-gen/cli/tests/cli/eds", "generated/eds"];

fn files() -> Vec<PathBuf> {
    let entries = DIRECTORIES.iter().flat_map(|directory| std::fs::read_dir(root().join(directory)).unwrap());
    let paths = entries.map(|entry| entry.unwrap().path());
    // A DCF of a shipped device is its EDS with the values of a node: tried in a long run.
    let is_tried = |path: &PathBuf| od_tests::is_long() || !path.starts_with(root().join("generated"));
    let is_eds = |path: &PathBuf| {
        path.extension().is_some_and(|ending| ending == "eds" || ending == "dcf" && is_tried(path))
    };
    let mut paths: Vec<PathBuf> = paths.filter(is_eds).collect();
    paths.sort();
    paths
}

#[test]
fn the_files_of_this_repository_are_without_a_problem() {
    let files = files();
    assert!(files.len() > 20, "{files:?}");
    let checked = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let problems = check(&name, &std::fs::read(path).unwrap()).problems;
        problems.into_iter().map(move |problem| format!("{name}: {}: {}", problem.step, problem.what))
    };
    let half = files.len() / 2;
    let (first, second) = std::thread::scope(|scope| {
        let first = scope.spawn(|| files[..half].iter().flat_map(checked).collect::<Vec<_>>());
        let second: Vec<String> = files[half..].iter().flat_map(checked).collect();
        (first.join().unwrap(), second)
    });
    assert_eq!([first, second].concat(), [""; 0]);
}

/// A small EDS with these objects.
fn lamp(objects: &str) -> Checked {
    let head = "[FileInfo]\nFileVersion=1\n[DeviceInfo]\nVendorNumber=7\nProductName=Lamp\nProductNumber=5\nBaudRate_125=1\nGranularity=8\n";
    check("lamp.eds", format!("{head}{objects}").as_bytes())
}

/// Nothing is lost, and nothing is excepted.
fn comes_back(objects: &str) {
    let Checked { problems, excepted, .. } = lamp(objects);
    assert_eq!((problems, excepted), (Vec::new(), Vec::new()));
}

fn object(index: &str, kind: u8, facts: &str) -> String {
    format!("[{index}]\nParameterName=object {index}\nObjectType={kind}\n{facts}\n")
}

fn entry(index: &str, facts: &str) -> String {
    object(index, 7, &format!("PDOMapping=0\n{facts}"))
}

#[test]
fn values_that_the_file_leaves_open_stay_open() {
    let member = |sub: u8| entry(&format!("1018sub{sub}"), "DataType=7\nAccessType=ro");
    comes_back(
        &[
            entry("1000", "DataType=7\nAccessType=ro"),
            entry("1008", "DataType=9\nAccessType=const"),
            object("1018", 9, "SubNumber=4"),
            entry("1018sub0", "DataType=5\nAccessType=ro\nDefaultValue=3"),
            member(1),
            member(2),
            member(3),
        ]
        .concat(),
    );
}

#[test]
fn a_number_of_entries_that_can_change_keeps_its_value() {
    for index in ["1003", "1010", "2000"] {
        comes_back(
            &[
                object(index, 8, "SubNumber=2"),
                entry(&format!("{index}sub0"), "DataType=5\nAccessType=rw\nDefaultValue=1"),
                entry(&format!("{index}sub1"), "DataType=7\nAccessType=ro"),
            ]
            .concat(),
        );
    }
}

#[test]
fn an_array_or_record_without_entries_stays_one() {
    for kind in [8, 9] {
        comes_back(
            &[
                object("2000", kind, "SubNumber=1"),
                entry("2000sub0", "DataType=5\nAccessType=ro\nDefaultValue=0"),
            ]
            .concat(),
        );
    }
}

#[test]
fn a_mapping_of_what_is_not_there_stays() {
    comes_back(
        &[
            object("1400", 9, "SubNumber=3"),
            entry("1400sub0", "DataType=5\nAccessType=ro\nDefaultValue=2"),
            entry("1400sub1", "DataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x200"),
            entry("1400sub2", "DataType=5\nAccessType=rw\nDefaultValue=255"),
            object("1600", 9, "SubNumber=2"),
            entry("1600sub0", "DataType=5\nAccessType=rw\nDefaultValue=1"),
            entry("1600sub1", "DataType=7\nAccessType=rw\nDefaultValue=0x60400010"),
        ]
        .concat(),
    );
}

#[test]
fn links_and_dynamic_channels_stay() {
    let channels = "DynamicChannelsSupported=1\n[DynamicChannels]\nNrOfSeg=1\nType1=5\nDir1=ro\nRange1=0xA080-0xA0BF\nPPOffset1=4\n";
    comes_back(
        &[
            channels.to_owned(),
            entry("2000", "DataType=5\nAccessType=ro"),
            "[2000ObjectLinks]\nObjectLinks=2\n1=0x2001\n2=0x2FFF\n".to_owned(),
            entry("2001", "DataType=5\nAccessType=ro"),
        ]
        .concat(),
    );
}

#[test]
fn what_is_excepted_is_counted() {
    let checked = lamp(
        &[
            object("2000", 9, "SubNumber=2"),
            entry("2000sub0", "DataType=6\nAccessType=ro\nDefaultValue=1"),
            entry("2000sub1", "DataType=6\nAccessType=ro"),
        ]
        .concat(),
    );
    assert!(Step::ALL.into_iter().all(|step| checked.passed(step)), "{:?}", checked.problems);
    assert_eq!(checked.excepted.len(), 1, "{:?}", checked.excepted);
}

#[test]
fn a_unit_that_a_comment_names_at_the_number_of_entries_changes_no_value() {
    comes_back(
        &[
            object("2000", 8, "SubNumber=2"),
            "; unit PU\n".to_owned(),
            entry("2000sub0", "DataType=5\nAccessType=ro\nDefaultValue=6"),
            entry("2000sub1", "DataType=5\nAccessType=ro"),
        ]
        .concat(),
    );
}

/// What fixing makes of this is read as before.
fn keeps_its_meaning(objects: &str) {
    let checked = lamp(objects);
    assert!(checked.passed(Step::Fixing), "{:?}", checked.problems);
}

#[test]
fn a_key_with_a_space_is_read_as_it_is_written_when_fixed() {
    keeps_its_meaning(&entry("2000", "DataType=5\nAc\tcessType=rw\nDefault Value=7"));
    keeps_its_meaning(&entry("2000", "DataType=5\nAccess Type=rw\nAccessType=ro"));
}

#[test]
fn of_equal_keys_and_sections_none_is_removed_after_another() {
    keeps_its_meaning(&entry("2000", "DataType=5\nAccessType=rw\nAccessType=ro\nAccessType=rw"));
    let (one, other) =
        (entry("2000", "DataType=5\nAccessType=rw"), entry("2000", "DataType=6\nAccessType=rw"));
    keeps_its_meaning(&[one.clone(), other, one].concat());
}

#[test]
fn unicode_spaces_around_a_text_are_no_part_of_it() {
    keeps_its_meaning("[2000]\nParameterName=a name\u{2028}\nObjectType=7\nDataType=5\nAccessType=ro\n");
}

#[test]
fn a_section_whose_name_lacks_a_bracket_is_one() {
    for broken in ["2001]", "[2001", "  2001 ]"] {
        let (one, other) =
            (entry("2000", "DataType=5\nAccessType=rw"), entry("2001", "DataType=6\nAccessType=ro"));
        keeps_its_meaning(&[one, other.replace("[2001]", broken)].concat());
    }
}

/// A character that turns text in a name, a key that is unknown, and a comment: a specification may not hold it.
#[test]
fn text_that_turns_does_not_hinder() {
    let entry = entry("2000", "DataType=5\nAccessType=rw").replace("object 2000", "level \u{202E}3");
    let Checked { problems, .. } =
        lamp(&format!("; \u{202E}remark\n{entry}x\u{200F}y=0\n[o\u{2066}ther]\nz=1\n"));
    assert_eq!(problems, []);
}
