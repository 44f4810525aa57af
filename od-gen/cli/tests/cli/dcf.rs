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
fn a_sub_index_is_written_as_in_the_language_as_in_an_eds_or_after_a_colon() {
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
    // In an EDS sub-indices are hexadecimal; after a colon they can be either.
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
fn dcf_is_written_next_to_what_it_is_made_from() {
    let scratch = Scratch::new("next-to");
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

/// The specification of an oven, with a parameter of every kind.
const OVEN: &str = include_str!("../../../../tests/shared/oven.od.yaml");
/// A parameter file that sets one of every kind.
const EVERYTHING: &str = include_str!("../../../../tests/ui/parameters/ok_everything.yaml");

/// The lines of a DCF but those that name files.
/// The lines without those that a file has of its own: its names, and what its parameter files are called.
fn without_names(text: &str) -> Vec<&str> {
    const OWN: [&str; 4] = ["FileName", "LastEDS", "; Oven in the bakery", "; The second one from the left."];
    text.lines().filter(|line| OWN.iter().all(|own| !line.starts_with(own))).collect()
}

#[test]
fn a_parameter_file_gives_what_settings_give() {
    let scratch = Scratch::new("params");
    scratch.file("oven.od.yaml", OVEN);
    scratch.file("oven.yaml", EVERYTHING);
    let run = |more: &[&str]| {
        let output = odgen(&scratch.0, &[&["dcf", "oven.od.yaml"], more].concat());
        (code(&output), stdout(&output), stderr(&output))
    };
    let (code, said, wrong) = run(&["--params", "oven.yaml", "--out", "a.dcf"]);
    assert_eq!((code, wrong.as_str()), (0, ""));
    assert_snapshot!("written_of_a_parameter_file", said);
    let by_settings = [
        "--device",
        "oven",
        "--node",
        "7",
        "--bit-rate",
        "500",
        "--node-name",
        "Oven 7",
        "--net-number",
        "3",
        "--net-name",
        "Bakery",
        "--set",
        "2000=2",
        "--set",
        "2001.1=100",
        "--set",
        "2001.2=32767",
        "--set",
        "2001.3=215",
        "--set",
        "2004=0x25",
        "--set",
        "2005=no",
        "--set",
        "2006.1=190",
        "--set",
        "2006.2=240",
        "--set",
        "2006.3=260",
        "--set",
        "2007=0.5",
        "--set",
        "2008=01A1",
        "--set",
        "5003=-5",
        "--set",
        "1016.1=0x50BB8",
        "--set",
        "2002=101",
        "--unlock",
        "2002",
        "--out",
        "b.dcf",
    ];
    assert_eq!(run(&by_settings).0, 0);
    let dcf = |name: &str| fs::read_to_string(scratch.0.join(name)).unwrap();
    let serial = "LSS_SerialNumber=0x00001A2B";
    assert!(dcf("a.dcf").contains(serial));
    let without_serial = dcf("a.dcf").replace(serial, "LSS_SerialNumber=0x00000000");
    assert!(without_names(&without_serial) == without_names(&dcf("b.dcf")));
    let about_it = "; Oven in the bakery\r\n; The second one from the left.\r\n[DeviceComissioning]\r\n";
    assert!(dcf("a.dcf").contains(about_it) && !dcf("b.dcf").contains("bakery\r\n; "));
    // What is the default is left out on request.
    assert!(dcf("a.dcf").contains("ParameterValue=260"));
    let (code, said, _) = run(&["--params", "oven.yaml", "--since-default", "--out", "c.dcf"]);
    assert!(code == 0 && said.contains("14 values set, 1 as the default left out"), "{said}");
    assert!(!dcf("c.dcf").contains("ParameterValue=260"));
    // The locked entry is open to tools, and marked.
    let section = dcf("a.dcf").replace("\r\n", "\n");
    let section = section.split("\n\n").find(|section| section.contains("[2002]")).unwrap().to_owned();
    assert_snapshot!("section_of_an_unlocked_entry", section);
    // In an XDC, too.
    assert_eq!(run(&["--params", "oven.yaml", "--xdc", "--out", "d.dcf"]).0, 0);
    let xdc = fs::read_to_string(scratch.0.join("d.xdc")).unwrap();
    let element = xdc.lines().find(|line| line.contains("index=\"2002\"")).unwrap();
    assert!(element.contains("accessType=\"rw\"") && element.contains("actualValue=\"101\""), "{element}");
    assert!(xdc.contains("LOCKED PARAMETER"), "{xdc}");
    let eds = odgen(&scratch.0, &["check", "a.dcf"]);
    assert!(
        eds.status.code().unwrap_or(1) == 0 && stderr(&eds).contains("nothing found"),
        "{}",
        stderr(&eds)
    );
}

#[test]
fn a_parameter_file_sets_what_an_eds_describes() {
    let scratch = Scratch::new("params-eds");
    scratch.file("oven.od.yaml", OVEN);
    assert_eq!(code(&odgen(&scratch.0, &["build", "oven.od.yaml", "--device", "oven", "--out", "."])), 0);
    // The specification is gone: all that is known is in the EDS.
    fs::remove_file(scratch.0.join("oven.od.yaml")).unwrap();
    let run = |parameters: &str| {
        scratch.file("site.yaml", format!("od-parameters: 1\nnode: 5\nparameters:\n{parameters}"));
        let output =
            odgen(&scratch.0, &["dcf", "eds/oven.eds", "--params", "site.yaml", "--out", "site.dcf"]);
        (code(&output), stderr(&output))
    };
    assert_eq!(run("  2006.2: 232\n  mode of operation: 2\n"), (0, String::new()));
    let text = fs::read_to_string(scratch.0.join("site.dcf")).unwrap();
    let values: Vec<&str> = text.lines().filter(|line| line.starts_with("ParameterValue")).collect();
    assert_eq!(values, ["ParameterValue=2", "ParameterValue=232"]);
    let (code, said) = run("  2006.2: 232\n  2006.3: 70000\n");
    assert!(code == 1 && said.contains("70000") && said.contains("site.yaml:5:11"), "{said}");
    let (code, said) = run("  mode of operatoin: 2\n");
    assert!(code == 1 && said.contains("did you mean `mode of operation`?"), "{said}");
}

#[test]
fn parameter_files_and_options_are_laid_over_each_other() {
    let scratch = Scratch::new("params-layers");
    scratch.file("oven.od.yaml", OVEN);
    scratch
        .file("type.yaml", "od-parameters: 1\ndevice: oven\nnode: 4\nparameters: {2003: 1, 2006.2: 231 V}\n");
    scratch.file("blade.yaml", "od-parameters: 1\nnode: 5\nparameters: {2003: 2, 2006.2: 232 V}\n");
    let run = |more: &[&str]| {
        let files = ["dcf", "oven.od.yaml", "--params", "type.yaml", "--params", "blade.yaml"];
        let output = odgen(&scratch.0, &[&files[..], more].concat());
        (code(&output), stderr(&output))
    };
    let (code, said) = run(&["--set", "5003=3"]);
    assert_eq!((code, said.as_str()), (0, "note: type.yaml says node 4, and the DCF is for node 5\n"));
    let text = fs::read_to_string(scratch.0.join("oven-5.dcf")).unwrap();
    let values: Vec<&str> = text.lines().filter(|line| line.starts_with("ParameterValue")).collect();
    assert_eq!(values, ["ParameterValue=232", "ParameterValue=3"]);
    let (code, said) = run(&["--node", "6"]);
    assert_eq!(code, 0);
    assert!(said.contains("type.yaml says node 4") && said.contains("blade.yaml says node 5"), "{said}");
    // The device of a file is not a choice between devices where the command line names another.
    let (code, said) = run(&["--device", "door"]);
    assert_eq!(code, 1);
    assert!(said.contains("OD0306") && said.contains("type.yaml:2:9"), "{said}");
    assert_eq!(run(&["--params", "none.yaml"]).0, 1);
    let (code, said) = run(&["--out", "blade.yaml"]);
    assert_eq!((code, said.contains("the DCF is made from this file")), (1, true), "{said}");
}

#[test]
fn a_dcf_gives_the_parameter_file_that_it_was_made_of() {
    let scratch = Scratch::new("params-back");
    scratch.file("oven.od.yaml", OVEN);
    scratch.file("oven.yaml", EVERYTHING);
    let run = |arguments: &[&str]| {
        let output = odgen(&scratch.0, arguments);
        (code(&output), stdout(&output), stderr(&output))
    };
    assert_eq!(
        run(&["dcf", "oven.od.yaml", "--params", "oven.yaml", "--since-default", "--out", "a.dcf"]).0,
        0
    );
    let back = ["params", "a.dcf", "--spec", "oven.od.yaml", "--device", "oven"];
    let (code, text, said) = run(&back);
    assert_eq!((code, said.as_str()), (0, ""));
    assert_snapshot!("parameter_file_of_a_dcf", text);
    // What comes out gives the same DCF, and that the same file.
    scratch.file("back.yaml", &text);
    assert_eq!(run(&["dcf", "oven.od.yaml", "--params", "back.yaml", "--out", "b.dcf"]).0, 0);
    let dcf = |name: &str| fs::read_to_string(scratch.0.join(name)).unwrap();
    assert!(without_names(&dcf("a.dcf")) == without_names(&dcf("b.dcf")));
    assert_eq!(run(&["params", "b.dcf", "--spec", "oven.od.yaml", "--device", "oven"]).1, text);
    // The two files say the same except for the value that is the default; so do file and DCF except for the lock.
    let (_, same, _) =
        run(&["diff", "oven.yaml", "back.yaml", "--spec", "oven.od.yaml", "--format", "short"]);
    assert_snapshot!("difference_of_parameter_files", same);
    let (_, same, _) = run(&["diff", "back.yaml", "a.dcf", "--spec", "oven.od.yaml", "--format", "short"]);
    assert_snapshot!("difference_of_a_parameter_file_and_a_dcf", same);
    let (code, _, said) = run(&["diff", "oven.yaml", "back.yaml"]);
    assert!(code == 1 && said.contains("add `--spec SPEC`"), "{said}");
    // Without a specification, the file's own names count.
    let (code, own, _) = run(&["params", "a.dcf"]);
    scratch.file("own.yaml", &own);
    assert!(code == 0 && !own.contains("device:"), "{own}");
    assert_eq!(run(&["dcf", "a.dcf", "--params", "own.yaml", "--out", "c.dcf"]).0, 0);
    // It is written, too, and nothing is replaced unasked.
    assert_eq!(run(&[&back[..], &["--out", "new.yaml"]].concat()).0, 0);
    assert_eq!(fs::read_to_string(scratch.0.join("new.yaml")).unwrap(), text);
    scratch.file("new.yaml", "mine");
    assert_eq!(run(&[&back[..], &["--out", "new.yaml"]].concat()).0, 1);
    assert_eq!(run(&["params", "oven.od.yaml"]).0, 1);
}

#[test]
fn what_a_parameter_file_cannot_say_is_reported() {
    let scratch = Scratch::new("params-left-out");
    scratch.file("oven.od.yaml", OVEN);
    scratch.file("oven.yaml", EVERYTHING);
    let run = |arguments: &[&str]| {
        let output = odgen(&scratch.0, arguments);
        (code(&output), stdout(&output), stderr(&output))
    };
    assert_eq!(run(&["dcf", "oven.od.yaml", "--params", "oven.yaml", "--out", "a.dcf"]).0, 0);
    let text = fs::read_to_string(scratch.0.join("a.dcf")).unwrap();
    let changed = text
        .replace("[2003]\r\nParameterName=position\r\n", "[2003]\r\nParameterName=position\r\nDenotation=Rack\r\n")
        .replace("ParameterName=position\r\nDenotation=Rack\r\nObjectType=0x7\r\nDataType=0x0004\r\nAccessType=rw\r\nDefaultValue=0\r\nPDOMapping=0\r\n", "ParameterName=position\r\nDenotation=Rack\r\nObjectType=0x7\r\nDataType=0x0004\r\nAccessType=rw\r\nDefaultValue=7\r\nPDOMapping=0\r\nParameterValue=9\r\n")
        .replace("ParameterName=measured\r\nObjectType=0x7\r\nDataType=0x0003\r\nAccessType=ro\r\nPDOMapping=0\r\n", "ParameterName=measured\r\nObjectType=0x7\r\nDataType=0x0003\r\nAccessType=rw\r\nPDOMapping=0\r\nParameterValue=3\r\n")
        .replace("ParameterValue=190", "ParameterValue=250");
    assert_ne!(text, changed);
    scratch.file("b.dcf", changed);
    let (code, text, _) = run(&["params", "b.dcf", "--spec", "oven.od.yaml", "--device", "oven"]);
    assert_eq!(code, 0);
    assert_snapshot!("parameter_file_with_what_is_left_out", text);
    // Of a node without a node-ID, at a bit rate that no node has.
    let dcf = fs::read_to_string(scratch.0.join("a.dcf")).unwrap();
    let nobody = dcf.replace("NodeID=7\r\n", "").replace("Baudrate=500", "Baudrate=777");
    scratch.file("c.dcf", nobody);
    let (code, text, said) = run(&["params", "c.dcf", "--spec", "oven.od.yaml", "--device", "oven"]);
    assert!(code == 0 && !text.contains("\nnode: ") && !text.contains("bit-rate:"), "{text}");
    assert!(said.contains("left out: `oven` does not support a bit rate of `777` kbit/s"), "{said}");
}

#[test]
fn what_tools_write_at_boot_is_reported() {
    let scratch = Scratch::new("explain");
    let all = OVEN.replace("{name: Oven, bit-rates", "{name: Oven, eds-defaults: all, bit-rates");
    scratch.file("oven.od.yaml", &all);
    scratch.file(
        "oven.yaml",
        EVERYTHING.replace("  short position: -5\n", "  position: 70000\n").replace("nominal: 240 V, ", ""),
    );
    let output = odgen(&scratch.0, &["dcf", "oven.od.yaml", "--params", "oven.yaml", "--explain"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
    assert_snapshot!("writes_at_boot", stdout(&output));
    assert_eq!(files(&scratch.0), ["oven.od.yaml", "oven.yaml"]);
}

/// Parameters of a drive in the units of its manual, there and back.
#[test]
fn parameters_of_the_shipped_devices_come_back() {
    let scratch = Scratch::new("params-shipped");
    scratch.file(
        "blade.yaml",
        "od-parameters: 1\ndevice: pmc\nnode: 5\nbit-rate: 500\nnode-name: Blade A\nparameters:\n  EFC target position: 91.50 °\n  607D.2: 9500\n  \
         0x607D: {1: 1.00 °}\n  position control parameter set: {p gain: 12, precontrol: 50.0 %}\n  motor data: {poles: 2, nominal voltage: 380.0 V}\n  \
         fault reaction option code: deceleration ramp\n",
    );
    let run = |arguments: &[&str]| {
        let output = odgen(&scratch.0, arguments);
        assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
        stdout(&output)
    };
    assert!(run(&["dcf", PITCH, "--params", "blade.yaml", "--out", "a.dcf"]).contains("8 values set"));
    let text = run(&["params", "a.dcf", "--spec", PITCH, "--device", "pmc"]);
    assert_snapshot!("parameter_file_of_a_blade", text);
    scratch.file("back.yaml", &text);
    run(&["dcf", PITCH, "--params", "back.yaml", "--out", "b.dcf"]);
    let dcf = |name: &str| fs::read_to_string(scratch.0.join(name)).unwrap();
    assert!(without_names(&dcf("a.dcf")) == without_names(&dcf("b.dcf")));
}

/// A bus coupler with two kinds of modules, as an EDS.
const COUPLER: &str = "[DeviceInfo]\nVendorNumber=7\nProductName=Coupler\nBaudRate_125=1\n\
    [6000]\nParameterName=inputs\nObjectType=8\nSubNumber=1\n\
    [6000sub0]\nParameterName=count\nDataType=5\nAccessType=ro\nDefaultValue=0\n\
    [SupportedModules]\nNrOfEntries=3\n\
    [M1ModuleInfo]\nProductName=8 inputs\nOrderCode=DI8\n[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n\
    [M1SubExt6000]\nParameterName=input \nDataType=5\nAccessType=ro\nDefaultValue=1\nCount=1\nSRDOMapping=1\n\
    [M2ModuleInfo]\nProductName=16 inputs\nOrderCode=DI16\n[M2SubExtends]\nNrOfEntries=1\n1=0x6000\n\
    [M2SubExt6000]\nParameterName=input \nDataType=5\nAccessType=ro\nDefaultValue=2\nCount=2\n\
    [M3ModuleInfo]\nProductName=16 inputs\nOrderCode=DI16/2\n";

#[test]
fn modules_are_plugged_in_by_number_order_code_or_name() {
    let scratch = Scratch::new("modules");
    scratch.file("coupler.eds", COUPLER);
    let run = |modules: &str, file: &str| {
        let output =
            odgen(&scratch.0, &["--format", "short", "dcf", file, "--node", "5", "--modules", modules]);
        (code(&output), stderr(&output))
    };
    let written = || fs::read_to_string(scratch.0.join("coupler-5.dcf")).unwrap().replace("\r\n", "\n");
    assert_eq!(run("1,2,1", "coupler.eds").0, 0);
    let by_number = written();
    assert!(by_number.contains("[6000]\nSubNumber=5\n"), "{by_number}");
    for sub in ["[6000sub1]\nParameterName=input1\n", "[6000sub4]\nParameterName=input4\n"] {
        let section = by_number.split(sub).nth(1).unwrap().split("\n\n").next().unwrap();
        assert!(section.ends_with("DefaultValue=1\nPDOMapping=0\nSRDOMapping=1"), "{section}");
    }
    assert!(by_number.ends_with("[ConnectedModules]\nNrOfEntries=3\n1=1\n2=2\n3=1\n"), "{by_number}");
    assert_eq!(run("di8, DI16 ,8 Inputs", "coupler.eds").0, 0);
    assert_eq!(written(), by_number);
    // What is read from it has the modules once.
    let output = odgen(&scratch.0, &["diff", "coupler-5.dcf", "coupler-5.dcf"]);
    assert!(stdout(&output).starts_with("0 changes"), "{}", stdout(&output));
    let output = odgen(&scratch.0, &["dcf", "coupler-5.dcf", "--out", "again.dcf"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let again = fs::read_to_string(scratch.0.join("again.dcf")).unwrap().replace("\r\n", "\n");
    assert_eq!(again.split("[DeviceInfo]").nth(1), by_number.split("[DeviceInfo]").nth(1));

    scratch.file("plain.eds", COUPLER.split("[SupportedModules]").next().unwrap());
    let refused = |modules: &str, file: &str| {
        let (code, said) = run(modules, file);
        assert_eq!(code, 2, "{said}");
        said.lines().find(|line| line.contains("error")).unwrap().to_owned()
    };
    assert_eq!(
        [
            refused("1,4", "coupler.eds"),
            refused("16 inputs", "coupler.eds"),
            refused("1", "plain.eds"),
            refused("1", "coupler-5.dcf"),
            refused(&["1"; 255].join(","), "coupler.eds"),
        ],
        [
            "error[EDS606]: there is no module `4` (the modules are 1 (8 inputs, DI8), 2 (16 inputs, DI16), 3 (16 inputs, DI16/2))",
            "error[EDS606]: `16 inputs` is the name of several modules: 2, 3 (name one of them by its number)",
            "error[EDS606]: plain.eds describes no modules (take the EDS of a bus coupler, which describes them under `[SupportedModules]`)",
            "error[EDS606]: coupler-5.dcf has the objects of modules already (take the EDS of the bus coupler alone)",
            "error[EDS606]: 255 modules are named, and 1027h has entries for 254 (name no more than that)",
        ]
    );
}

#[test]
fn modules_are_plugged_into_the_specification_of_a_coupler() {
    let scratch = Scratch::new("modules-of-specification");
    scratch.file("coupler.eds", COUPLER);
    let run = |arguments: &[&str]| {
        let output = odgen(&scratch.0, arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    };
    run(&["import", "coupler.eds", "--out", "imported"]);
    let dcf = |file: &str, out: &str| {
        run(&["dcf", file, "--node", "5", "--modules", "1,2,1", "--out", out]);
        fs::read_to_string(scratch.0.join(out)).unwrap().replace("\r\n", "\n")
    };
    let of_file = dcf("coupler.eds", "file.dcf");
    let of_import = dcf("imported/coupler.od.yaml", "import.dcf");
    let objects = |dcf: &str| dcf.split("[MandatoryObjects]").nth(1).unwrap().to_owned();
    assert!(of_import.ends_with("[ConnectedModules]\nNrOfEntries=3\n1=1\n2=2\n3=1\n"), "{of_import}");
    assert_eq!(objects(&of_import), objects(&of_file));
    // What is plugged in is part of what an import says.
    run(&["import", "file.dcf", "--out", "imported"]);
    run(&["dcf", "imported/file.od.yaml", "--node", "5", "--out", "again.dcf"]);
    let again = fs::read_to_string(scratch.0.join("again.dcf")).unwrap().replace("\r\n", "\n");
    assert_eq!(objects(&again), objects(&of_file));
}

#[test]
fn an_xdd_does_without_what_a_file_says_in_its_own_words_and_it_is_reported() {
    let scratch = Scratch::new("not-in-xdd");
    scratch.file("coupler.eds", COUPLER);
    for arguments in [&["build", "coupler.eds", "--xdd"][..], &["dcf", "coupler.eds", "--node", "5", "--xdc"]]
    {
        let output = odgen(&scratch.0, arguments);
        let said = stderr(&output);
        assert!(
            said.contains("22 keys of the file, with all of its 3 modules, are in no XDD or XDC"),
            "{said}"
        );
    }
}

/// Bits on a command line, as a parameter file has them; and the name of a member alone gets the whole one as a hint.
#[test]
fn a_setting_takes_bits_and_members_are_named_in_full() {
    let scratch = Scratch::new("dcf-bits");
    let objects = "types: {valves: {base: unsigned8, bits: {0: valve 1, 1: valve 2}, rest: reserved}}
objects:
  0x2001: {name: open, type: valves, access: rw, default: []}
  0x2002: {name: limits, record: {1: {name: lowest, type: unsigned8, access: rw, default: 0}}}
";
    scratch.file("lamp.od.yaml", LAMP.replace("objects:\n", objects));
    let set = |setting: &str| {
        odgen(&scratch.0, &["--format", "short", "dcf", "lamp.od.yaml", "--node", "5", "--set", setting])
    };
    let value = || {
        let text = fs::read_to_string(scratch.0.join("lamp-5.dcf")).unwrap();
        let at = text.split("[2001]").nth(1).unwrap();
        at.lines().find_map(|line| line.strip_prefix("ParameterValue=")).map(str::to_owned)
    };
    for (setting, expected) in
        [("open=[valve 2]", "0x02"), ("open=[valve 1, valve 2]", "0x03"), ("open=[]", "0x00")]
    {
        let output = set(setting);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert_eq!(value().as_deref(), Some(expected), "{setting}");
    }
    assert_snapshot!(["open=[valve]", "lowest=5"].map(|setting| stderr(&set(setting))).concat());
}
