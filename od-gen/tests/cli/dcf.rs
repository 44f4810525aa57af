//! `odgen dcf`.

use std::fs;

use insta::assert_snapshot;

use crate::{LAMP, PITCH, Scratch, code, files, odgen, stderr, stdout};

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
fn a_sub_index_is_written_as_in_the_language_as_in_an_eds_or_behind_a_colon() {
    let scratch = Scratch::new("sub-index");
    let run = |setting: &str| {
        let start = ["--format", "short", "dcf", PITCH, "--device", "pmc", "--node", "5", "--set"];
        let output = odgen(&scratch.0, &[&start[..], &[setting]].concat());
        (code(&output), stderr(&output))
    };
    let written = || fs::read(scratch.0.join("pmc-5.dcf")).unwrap();
    assert_eq!(run("607D.2=9500").0, 0);
    let expected = written();
    for same in [
        "607Dsub2=9500",
        "607dSub02=9500",
        "0x607D:2=9500",
        "607Dh:02=9500",
        "607Dh:0x2=9500",
        "607D:2h=9500",
    ] {
        assert_eq!(run(same), (0, String::new()), "{same}");
        assert_eq!(written(), expected, "{same}");
    }
    // In an EDS sub-indices are hexadecimal; behind a colon they are either.
    for (text, sub) in [("6510sub0A=1", "6510h.10"), ("6510.10=1", "6510h.10"), ("6510:0A=1", "6510h.10")] {
        assert!(run(text).1.contains(sub), "{:?}", run(text));
    }
    let (code, said) = run("6510:10=1");
    assert_eq!(code, 1);
    assert_snapshot!(said);
}

#[test]
fn settings_come_from_files_with_their_places() {
    let scratch = Scratch::new("set-file");
    scratch.file("lamp.od.yaml", LAMP);
    scratch.file("lamps.txt", "# The lamp in the hall.\r\n\r\n  brightness = 60 %\r\n");
    let run = |more: &[&str]| {
        let start = ["--format", "short", "dcf", "lamp.od.yaml", "--node", "5", "--set-file", "lamps.txt"];
        let output = odgen(&scratch.0, &[&start[..], more].concat());
        (code(&output), stderr(&output))
    };
    assert_eq!(run(&[]), (0, String::new()));
    let dcf = fs::read_to_string(scratch.0.join("lamp-5.dcf")).unwrap();
    assert!(dcf.contains("ParameterValue=60\r\n"), "{dcf}");
    // A setting of the command line does not silently win over one of a file.
    assert_snapshot!("set_in_a_file_and_on_the_command_line", run(&["--set", "2000=70"]).1);
    scratch.file("more.txt", "# Too bright.\n1017 = 1000\n  2000=120 %");
    scratch.file("lamps.txt", "");
    assert_snapshot!("set_in_a_file", run(&["--set-file", "more.txt"]).1);
    let (code, said) = run(&["--set-file", "none.txt"]);
    assert_eq!(code, 1);
    assert!(said.starts_with("error[OD0101]: cannot read none.txt: no such file"), "{said}");
    let (code, said) = run(&["--out", "lamps.txt"]);
    assert_eq!((code, said.contains("cannot write `lamps.txt`: the DCF is made from this file")), (1, true));
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
