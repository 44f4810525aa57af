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
