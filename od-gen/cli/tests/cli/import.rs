//! `odgen import`, and the way from a maker's EDS to code.

use std::fs;

use crate::{FAN, LAMP, MIXER, ROOF_FAN, Scratch, code, odgen, stderr, stdout};

/// The four commands of the book, on files that were not made for them.
#[test]
fn from_an_eds_to_documents_and_rust_in_four_commands() {
    for (name, eds) in [("mixer", MIXER), ("fan", FAN)] {
        let scratch = Scratch::new(&format!("four-{name}"));
        let file = format!("{name}.eds");
        scratch.file(&file, eds);
        let checked = odgen(&scratch.0, &["check", &file]);
        assert_eq!(code(&checked), 1, "{}", stderr(&checked));
        odgen(&scratch.0, &["fix", &file, "--write"]);
        let imported = odgen(&scratch.0, &["import", &file]);
        assert_eq!(code(&imported), 0, "{}", stderr(&imported));
        let specification = format!("{name}.od.yaml");
        assert!(
            stdout(&imported).ends_with(&format!("next: odgen build --rust --docs html ./{specification}\n"))
        );
        let built = odgen(&scratch.0, &["build", &specification, "--rust", "--docs", "html", "--out", "out"]);
        assert_eq!(code(&built), 0, "{}", stderr(&built));
        for made in [format!("eds/{name}.eds"), format!("src/{name}.rs"), format!("docs/{name}/{name}.html")]
        {
            assert!(scratch.0.join("out").join(&made).is_file(), "{made}: {}", stdout(&built));
        }
        // Names are kept as the maker gave them, also where two are equal.
        let made = format!("out/eds/{name}.eds");
        let again = odgen(&scratch.0, &["check", &made, "--strict", "--format", "short"]);
        assert_eq!(code(&again), 0, "{}", stderr(&again));
    }
}

#[test]
fn a_specification_that_is_there_is_not_overwritten() {
    let scratch = Scratch::new("import-there");
    scratch.file("fan.eds", FAN);
    let path = scratch.file("fan.od.yaml", "mine");
    let output = odgen(&scratch.0, &["import", "fan.eds"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("fan.od.yaml: it is there already"), "{}", stderr(&output));
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    assert_eq!(code(&odgen(&scratch.0, &["import", "fan.eds", "--force"])), 0);
    assert!(fs::read_to_string(&path).unwrap().starts_with("# Made from fan.eds.\n"));
}

/// What the end says of a node's values can be given to `odgen dcf` as it is.
#[test]
fn values_of_a_node_are_at_the_end() {
    let scratch = Scratch::new("import-node");
    let running = "ParameterName=Running\n";
    scratch.file("fan.dcf", ROOF_FAN.replace(running, "ParameterName=Running\nParameterValue=1\n"));
    assert_eq!(code(&odgen(&scratch.0, &["import", "fan.dcf"])), 0);
    let text = fs::read_to_string(scratch.0.join("fan.od.yaml")).unwrap();
    let (_, values) = text.split_once("# The values of the node; `odgen dcf fan.dcf` keeps them").unwrap();
    let (values, refused) = values.split_once("# Values of the node that cannot be set:\n").unwrap();
    assert!(refused.starts_with("# - 2001=1: 2001h (Running) is `ro`"), "{refused}");
    let settings: Vec<&str> = values.lines().filter_map(|line| line.strip_prefix("# --set ")).collect();
    assert_eq!(settings, ["\"2000=-5\""]);
    let settings = settings.iter().flat_map(|setting| ["--set", setting.trim_matches('"')]);
    let arguments: Vec<&str> = ["dcf", "fan.od.yaml", "--node", "5"].into_iter().chain(settings).collect();
    let made = odgen(&scratch.0, &arguments);
    assert_eq!(code(&made), 0, "{}", stderr(&made));
}

/// A comment that says the same everywhere is not repeated at each entry.
#[test]
fn what_all_entries_say_is_said_once() {
    let scratch = Scratch::new("import-usual");
    let marked = FAN.replace("PDOMapping=0\n", ";Checked=yes\nPDOMapping=0\n");
    scratch.file("fan.eds", marked.replacen("Checked=yes", "Checked=no", 1));
    assert_eq!(code(&odgen(&scratch.0, &["import", "fan.eds"])), 0);
    let text = fs::read_to_string(scratch.0.join("fan.od.yaml")).unwrap();
    assert_eq!(text.matches("Checked=yes").count(), 1, "{text}");
    assert!(text.contains("# Checked=yes, at 9 of 10 entries\n"), "{text}");
    assert_eq!(text.matches("# Checked=no\n").count(), 1, "{text}");
}

#[test]
fn only_eds_and_dcf_files_are_imported() {
    let scratch = Scratch::new("import-no");
    scratch.file("lamp.od.yaml", LAMP);
    for (file, message) in
        [("lamp.od.yaml", "lamp.od.yaml is no EDS, DCF, XDD or XDC"), ("none.eds", "no such file")]
    {
        let output = odgen(&scratch.0, &["import", file, "--out", "out"]);
        assert_eq!(code(&output), 1);
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }
    assert!(!scratch.0.join("out").exists());
}

/// Equal names of every kind: an import that is not edited gives an EDS with the same names, and code.
#[test]
fn an_import_changes_no_name() {
    let entry = |section: &str, name: &str, value: &str| {
        let data_type = if section.ends_with("sub0") { "0x5" } else { "0x7" };
        format!(
            "[{section}]\nParameterName={name}\nObjectType=0x7\nDataType={data_type}\nAccessType=rw\n{value}\n"
        )
    };
    let structured = |index: &str, name: &str, kind: &str, entries: &[&str], value: &str| {
        let head =
            format!("[{index}]\nParameterName={name}\nObjectType={kind}\nSubNumber={}\n", entries.len());
        let one = |(sub, name): (usize, &&str)| {
            let value =
                if sub == 0 { format!("DefaultValue={}", entries.len() - 1) } else { value.to_owned() };
            entry(&format!("{index}sub{sub}"), name, &value)
        };
        head + &entries.iter().enumerate().map(one).collect::<String>()
    };
    let mut text = "[DeviceInfo]\nProductName=Thing\nBaudRate_125=1\nGranularity=8\n".to_owned();
    for (index, name) in [
        ("2000", "Speed"),
        ("2001", "Speed"),
        ("2002", "speed"),
        ("2003", "---"),
        ("2004", "---"),
        ("2005", "unsigned8"),
        ("2006", "Level.low"),
        ("2007", "set Speed"),
    ] {
        text += &entry(index, name, "PDOMapping=1");
    }
    text += &structured("2100", "Level", "0x9", &["low", "low", "high", "low"], "");
    text += &structured("2101", "Level", "0x8", &["Error", "Error", "Error", "Error"], "");
    for base in [0x1400, 0x1800] {
        for index in [base, base + 1] {
            let index = format!("{index:04X}");
            text += &structured(&index, "PDO", "0x9", &["n", "COB-ID", "COB-ID"], "DefaultValue=0x80000000");
            text = text.replace(&format!("[{index}sub2]"), &format!("[{index}sub2]\nLowLimit=0"));
        }
        for index in [base + 0x200, base + 0x201] {
            let entries = ["PDO", "PDO", "PDO", "PDO"];
            text += &structured(&format!("{index:04X}"), "PDO", "0x9", &entries, "DefaultValue=0x20000020");
        }
    }
    let scratch = Scratch::new("import-names");
    scratch.file("thing.eds", &text);
    let imported = odgen(&scratch.0, &["import", "thing.eds"]);
    assert_eq!(code(&imported), 0, "{}", stderr(&imported));
    let specification = fs::read_to_string(scratch.0.join("thing.od.yaml")).unwrap();
    assert!(!specification.contains("original: name"), "{specification}");
    let built = odgen(&scratch.0, &["build", "thing.od.yaml", "--out", "out"]);
    assert_eq!(code(&built), 0, "{}\n{specification}", stderr(&built));
    let compared = odgen(&scratch.0, &["diff", "thing.eds", "out/eds/thing.eds", "--format", "short"]);
    assert!(!stdout(&compared).contains(": name: "), "{}\n{specification}", stdout(&compared));
}
