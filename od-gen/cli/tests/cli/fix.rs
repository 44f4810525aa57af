//! `odgen fix`.

use std::fs;

use insta::assert_snapshot;

use crate::{LAMP, Scratch, code, files, odgen, stderr, stdout};

/// An EDS of our own, with a few faults.
fn messy(scratch: &Scratch) -> String {
    scratch.file("lamp.od.yaml", LAMP);
    assert_eq!(code(&odgen(&scratch.0, &["build", "lamp.od.yaml", "--out", "out"])), 0);
    let clean = fs::read_to_string(scratch.0.join("out/eds/lamp.eds")).unwrap();
    fs::remove_dir_all(scratch.0.join("out")).unwrap();
    fs::remove_file(scratch.0.join("lamp.od.yaml")).unwrap();
    clean
        .replace("[1018sub1]", "[1018SUB01]")
        .replace("CreationTime=12:00AM", "CreationTime=00:00")
        .replacen("SupportedObjects=3", "Supported Objects=4", 1)
        .replacen("[1000]", "# 20 °C\r\n[1000]", 1)
}

#[test]
fn fix_shows_what_changes_and_changes_nothing() {
    let scratch = Scratch::new("fix-diff");
    let text = messy(&scratch);
    let path = scratch.file("lamp.eds", &text);
    let output = odgen(&scratch.0, &["fix", "lamp.eds"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_snapshot!("fix_diff", stdout(&output));
    assert_snapshot!("fix_summary", stderr(&output));
    assert_eq!(fs::read_to_string(path).unwrap(), text);
}

#[test]
fn fix_writes_and_then_has_nothing_to_do() {
    let scratch = Scratch::new("fix-write");
    // A file as many editors store it: with a mark, in a code page or in UTF-16.
    let text = messy(&scratch);
    scratch.file("mark.eds", [b"\xEF\xBB\xBF", text.replace('°', "deg ").as_bytes()].concat());
    let latin: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    let path = scratch.file("latin.eds", latin);
    let output = odgen(&scratch.0, &["fix", "--write", "mark.eds", "latin.eds"]);
    assert_eq!((code(&output), stdout(&output)), (0, String::new()), "{}", stderr(&output));
    assert!(stderr(&output).contains("EDS102"), "{}", stderr(&output));
    assert_eq!(files(&scratch.0), ["latin.eds", "mark.eds"], "no other file is left");
    let fixed = fs::read_to_string(&path).unwrap();
    assert!(fixed.is_ascii() && fixed.contains("; 20 degC\r\n[1000]"), "{fixed}");
    let again = odgen(&scratch.0, &["fix", "--write", "--diff", "mark.eds", "latin.eds"]);
    assert_eq!((code(&again), stdout(&again)), (0, String::new()));
    assert_eq!(stderr(&again).matches("there is nothing to fix").count(), 2, "{}", stderr(&again));
    assert_eq!(fs::read_to_string(&path).unwrap(), fixed);
}

#[test]
fn fix_leaves_to_people_what_people_decide() {
    let scratch = Scratch::new("fix-left");
    let text = messy(&scratch);
    scratch.file("lamp.eds", text.replacen("1=0x1000", "1=0x100G", 1));
    let output = odgen(&scratch.0, &["fix", "lamp.eds", "--write"]);
    // What could be done is done; whether the file is right, `odgen check` reports.
    assert_eq!(code(&output), 0);
    assert_eq!(code(&odgen(&scratch.0, &["check", "lamp.eds"])), 1);
    assert!(stderr(&output).contains("error[EDS304]"), "{}", stderr(&output));
}

#[test]
fn fix_takes_nothing_but_eds_files() {
    let scratch = Scratch::new("fix-refused");
    scratch.file("lamp.od.yaml", LAMP);
    for (file, said) in [("lamp.od.yaml", "is no EDS or DCF"), ("missing.eds", "cannot read `missing.eds`")] {
        let output = odgen(&scratch.0, &["fix", file]);
        assert_eq!((code(&output), stdout(&output)), (1, String::new()));
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
    assert_eq!(code(&odgen(&scratch.0, &["fix"])), 2);
}

/// What is named as an EDS and is something else is left alone by every command.
#[test]
fn files_of_others_are_named_and_left_alone() {
    let scratch = Scratch::new("fix-others");
    let odva = "$ adapter\n[File]\n  DescText = \"Adapter\";\n[Device]\n  VendCode = 9999;\n";
    let gbk =
        [b"[FileInfo]\nFileName=g.eds\n[2000]\nParameterName=".as_slice(), b"\xCE\xC2\xB6\xC8\n"].concat();
    scratch.file("odva.eds", odva);
    scratch.file("gbk.eds", &gbk);
    scratch.file("two.eds", "??");
    for (file, said) in [
        ("odva.eds", "error[OD0121]: `odva.eds` is an EDS of EtherNet/IP or DeviceNet"),
        ("gbk.eds", "error[OD0102]: the texts of `gbk.eds` are in GBK"),
        ("two.eds", "error[OD0121]: `two.eds` is no EDS or DCF: it has no section"),
    ] {
        for command in [&["fix", "--write"][..], &["check"], &["build"], &["import"], &["dcf", "--node", "5"]]
        {
            let output = odgen(&scratch.0, &[command, &[file]].concat());
            let reported = stderr(&output);
            assert_eq!(
                (code(&output), reported.matches("error[").count()),
                (1, 1),
                "{command:?}: {reported}"
            );
            assert!(reported.contains(said), "{command:?}: {reported}");
        }
    }
    assert_eq!(files(&scratch.0), ["gbk.eds", "odva.eds", "two.eds"], "nothing is written");
    assert_eq!(fs::read(scratch.0.join("gbk.eds")).unwrap(), gbk);
    assert_eq!(fs::read_to_string(scratch.0.join("odva.eds")).unwrap(), odva);
}
