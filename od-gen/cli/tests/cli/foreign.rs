//! The commands that make something, given an EDS or DCF.

use std::fs;

use od_gen::{Builder, Expansion, expand};

use crate::{FAN, LAMP, MIXER, ROOF_FAN, Scratch, code, files, odgen, stderr, stdout};

/// One line about the findings, and the work is done.
#[test]
fn an_eds_is_used_whatever_is_wrong_with_it() {
    const NOTE: &str = "note: mixer.eds: 1 error, 5 warnings; `odgen check mixer.eds` shows them\n";
    let scratch = Scratch::new("foreign");
    scratch.file("mixer.eds", MIXER);
    let build =
        ["build", "mixer.eds", "--rust", "--docs", "md", "--docs", "html", "--node", "5", "--out", "out"];
    for arguments in
        [&build[..], &["dump", "mixer.eds"], &["docs", "mixer.eds"], &["dcf", "mixer.eds", "--node", "9"]]
    {
        let output = odgen(&scratch.0, arguments);
        assert_eq!((code(&output), stderr(&output).as_str()), (0, NOTE), "{arguments:?}");
    }
    let made = files(&scratch.0.join("out"));
    for name in ["docs/mixer/mixer.html", "eds/mixer.dcf", "eds/mixer.eds", "mixer.json", "src/mixer.rs"] {
        assert!(made.iter().any(|path| path == name), "{name}: {made:?}");
    }
    assert!(scratch.0.join("mixer-9.dcf").exists());
    // Names that clash, a name without a letter, a text whose length is not stated.
    let module = fs::read_to_string(scratch.0.join("out/src/mixer.rs")).unwrap();
    for function in ["speed_2000(&self) -> i16", "speed_2001(&self) -> i16", "object_2006(&self) -> &str"] {
        assert!(module.contains(&format!("pub fn {function}")), "{function}");
    }
    // Our own file has no fault in its values any more.
    let output = odgen(&scratch.0, &["check", "out/eds/mixer.eds", "--format", "short", "--notes"]);
    assert!(!stderr(&output).contains("[EDS4") && !stderr(&output).contains("[EDS5"), "{}", stderr(&output));
}

/// An EDS has no key for what a device stores, and leaves out what it does not know: the documents do not make it up.
#[test]
fn documents_say_nothing_that_an_eds_does_not() {
    let scratch = Scratch::new("unknown");
    let document = |name: &str, text: &str| {
        scratch.file(name, text);
        let output = odgen(&scratch.0, &["docs", name, "--out", "out", "--format", "md", "--format", "html"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let page = |kind: &str| {
            let base = name.trim_end_matches(".eds");
            fs::read_to_string(scratch.0.join(format!("out/{base}/{base}.{kind}"))).unwrap()
        };
        (page("md"), page("html"))
    };
    let (md, html) = document("fan.eds", FAN);
    assert!(!md.contains("| Mem. |") && !html.contains("not stored"), "{md}");
    assert!(md.contains("| Product code     | 00000007h |"), "{md}");
    let stored = FAN.replace("[2000]\n", ";stored with the application parameters\n[2000]\n");
    let (md, html) = document("stored.eds", &stored);
    let row = |index: &str| md.lines().find(|line| line.starts_with(&format!("| [{index}h]"))).unwrap();
    assert!(md.contains("| Mem. |") && row("2000").ends_with("| Y   |"), "{md}");
    assert!(row("2001").ends_with("|     |") && !html.contains("not stored"), "{md}");
    let (md, _) =
        document("unknown.eds", &FAN.replace("ProductNumber=7\n", "").replace("RevisionNumber=1\n", ""));
    assert!(!md.contains("Product code     |") && !md.contains("Product revision |"), "{md}");
}

/// A build script and the macro give one warning for all that was found.
#[test]
fn a_build_says_one_line_about_an_eds() {
    let scratch = Scratch::new("doors");
    let path = scratch.file("mixer.eds", MIXER);
    let Expansion { read, errors, warnings, tokens } = expand(&path, None);
    let shown = path.display();
    assert_eq!(warnings, [format!("{shown}: 1 error, 5 warnings; `odgen check {shown}` shows them")]);
    assert_eq!((read, errors), (vec![path.clone()], Vec::new()));
    let written = Builder::new(&path).out_dir(&scratch.0).try_generate().unwrap();
    assert_eq!(written, [scratch.0.join("mixer.rs")]);
    // As tokens, in which lines and comments do not matter.
    let [expanded, built] = [tokens.unwrap(), fs::read_to_string(&written[0]).unwrap().parse().unwrap()];
    assert_eq!(built.to_string(), expanded.to_string());
}

#[test]
fn nothing_is_written_over_what_it_is_made_from() {
    let scratch = Scratch::new("own-input");
    fs::create_dir_all(scratch.0.join("eds")).unwrap();
    scratch.file("eds/fan.eds", FAN);
    let output = odgen(&scratch.0, &["build", "eds/fan.eds", "--out", ".", "--format", "short"]);
    assert_eq!((code(&output), stdout(&output)), (1, String::new()));
    let said = stderr(&output);
    assert!(said.contains("error[OD0709]: cannot write ./eds/fan.eds: it is read to make it"), "{said}");
    assert_eq!(fs::read_to_string(scratch.0.join("eds/fan.eds")).unwrap(), FAN);
    assert_eq!(files(&scratch.0), ["eds/fan.eds"]);
}

/// The section of a DCF, without its header.
fn section(text: &str, name: &str) -> String {
    let (_, rest) = text.split_once(&format!("[{name}]\r\n")).unwrap();
    rest.split("\r\n\r\n").next().unwrap().replace("\r\n", "\n")
}

#[test]
fn a_dcf_keeps_its_node_and_its_values() {
    let scratch = Scratch::new("kept");
    scratch.file(
        "fan.dcf",
        ROOF_FAN.replace("ParameterValue=-5", "ParameterValue=-5\nDenotation=Speed in summer"),
    );
    let read = |name: &str| fs::read_to_string(scratch.0.join(name)).unwrap();
    let run = |arguments: &[&str]| {
        let output = odgen(&scratch.0, arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        stdout(&output)
    };
    let node = "NodeID=33\nNodeName=Fan in the roof\nBaudrate=250\nNetNumber=3\nNetworkName=House\n";
    run(&["build", "fan.dcf", "--out", "out"]);
    assert!(section(&read("out/eds/fan.dcf"), "DeviceComissioning").starts_with(node));
    assert!(
        section(&read("out/eds/fan.dcf"), "2000").contains("ParameterValue=-5\nDenotation=Speed in summer")
    );
    assert!(!read("out/eds/fan.eds").contains("ParameterValue"));
    assert!(
        read("out/fan.json").contains("Speed in summer") && run(&["dump", "fan.dcf"]) == read("out/fan.json")
    );

    let said = run(&["dcf", "fan.dcf"]);
    assert!(said.contains("fan-33.dcf") && said.contains("node 33, 0 values set, 1 kept"), "{said}");
    assert!(section(&read("fan-33.dcf"), "DeviceComissioning").starts_with(node));

    run(&["dcf", "fan.dcf", "--node", "7", "--bit-rate", "125", "--net-name", "Barn", "--set", "Speed=20"]);
    let changed = "NodeID=7\nNodeName=Fan in the roof\nBaudrate=125\nNetNumber=3\nNetworkName=Barn\n";
    assert!(section(&read("fan-7.dcf"), "DeviceComissioning").starts_with(changed));
    assert!(section(&read("fan-7.dcf"), "2000").contains("ParameterValue=20\nDenotation=Speed in summer"));

    // With --node, `build` makes the file of another node, with the same values.
    run(&["build", "fan.dcf", "--out", "other", "--node", "9"]);
    assert!(section(&read("other/eds/fan.dcf"), "DeviceComissioning").starts_with("NodeID=9\n"));
    assert!(section(&read("other/eds/fan.dcf"), "2000").contains("ParameterValue=-5"));
}

/// It is not guessed which node a DCF is for.
#[test]
fn a_dcf_that_states_no_node_is_for_none() {
    let (head, rest) = ROOF_FAN.split_once("[DeviceComissioning]").unwrap();
    let (_, tail) = rest.split_once("\n[").unwrap();
    let scratch = Scratch::new("no-node");
    scratch.file("fan.dcf", format!("{head}[{tail}"));
    let refused = odgen(&scratch.0, &["dcf", "fan.dcf", "--format", "short"]);
    assert_eq!(code(&refused), 2);
    let said = stderr(&refused);
    assert!(said.contains("error[OD0701]: no node-ID is given, and the DCF states none"), "{said}");
    let built = odgen(&scratch.0, &["build", "fan.dcf", "--out", "out"]);
    assert_eq!(code(&built), 0, "{}", stderr(&built));
    assert!(
        stderr(&built).contains("states no node-ID, so no DCF is made; `--node ID`"),
        "{}",
        stderr(&built)
    );
    assert!(!scratch.0.join("out/eds/fan.dcf").exists());
    let given = odgen(&scratch.0, &["dcf", "fan.dcf", "--node", "7"]);
    assert!(stdout(&given).contains("node 7, 0 values set, 1 kept"), "{}", stdout(&given));
}

#[test]
fn a_device_and_a_node_are_named_where_there_is_a_choice() {
    let scratch = Scratch::new("choice-of-device");
    scratch.file("lamp.od.yaml", LAMP);
    let two = LAMP.replace("  lamp: {", "  torch: {name: Torch, bit-rates: [125]}\n  lamp: {");
    scratch.file("two.od.yaml", two);
    assert_eq!(code(&odgen(&scratch.0, &["dcf", "lamp.od.yaml", "--node", "5"])), 0);
    assert!(scratch.0.join("lamp-5.dcf").exists());
    let refused = |arguments: &[&str]| {
        let output = odgen(&scratch.0, &[&["--format", "short", "dcf"], arguments].concat());
        assert_eq!(code(&output), 2);
        stderr(&output)
    };
    let said = refused(&["two.od.yaml", "--node", "5"]);
    assert!(
        said.contains(
            "no device is named, and the specification has 2 (add `--device KEY`: `torch`, `lamp`)"
        ),
        "{said}"
    );
    let said = refused(&["lamp.od.yaml"]);
    assert!(said.contains("error[OD0701]: no node-ID is given (add `--node ID`, 1 to 127)"), "{said}");
}

/// The EDS says nothing about the start, but code starts with something.
#[test]
fn code_that_starts_with_a_value_it_refuses_is_reported() {
    let scratch = Scratch::new("foreign-start");
    let level = |at: u16, more: &str| {
        format!("[{at:X}]\nParameterName=level {at}\nObjectType=7\nDataType=5\nAccessType=rw\n{more}\n")
    };
    let eds = |rest: &str| format!("[DeviceInfo]\nProductName=lamp\n{rest}");
    scratch.file("wrong.eds", eds(&(level(0x2000, "LowLimit=1") + &level(0x2001, "LowLimit=2"))));
    scratch.file(
        "right.eds",
        eds(&(level(0x2000, "LowLimit=1\nDefaultValue=1") + &level(0x2001, "LowLimit=0"))),
    );
    let said = |name: &str| {
        let output = odgen(&scratch.0, &["build", name, "--rust", "--out", "out"]);
        assert_eq!(code(&output), 0);
        stderr(&output)
    };
    let wrong = said("wrong.eds");
    assert!(wrong.contains("warning[OD0837]: in the code, 2000h (level 8192) starts with 0"), "{wrong}");
    assert!(
        wrong.contains("wrong.eds:8:")
            && wrong.contains("so do 2001h")
            && wrong.contains("help: write `DefaultValue`"),
        "{wrong}"
    );
    assert!(!said("right.eds").contains("OD0837"));
}
