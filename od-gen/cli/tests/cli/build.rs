//! `odgen build`: which files it writes, and that an error writes none.

use std::fs;

use insta::assert_snapshot;

use crate::{LAMP, Scratch, code, files, odgen, stderr, stdout};

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
    assert!(code_of.starts_with("// Object dictionary `lamp` of lamp.od.yaml.\n"), "{code_of}");
    assert!(code_of.contains("pub fn brightness(&self) -> units::Percent<u8> {"), "{code_of}");
}

#[test]
fn build_makes_c_when_asked() {
    let scratch = Scratch::new("c");
    scratch.file("lamp.od.yaml", LAMP);
    scratch.file("torch.od.yaml", LAMP.replace("lamp:", "torch:"));
    // One runtime for all devices, and each kind once.
    let output =
        odgen(&scratch.0, &["build", "--c", "plain", "--c", "plain", "lamp.od.yaml", "torch.od.yaml"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let c: Vec<String> = files(&scratch.0.join("generated/c"));
    assert_eq!(
        c,
        [
            "lamp/OD_types.h",
            "lamp/lamp_od.c",
            "lamp/lamp_od.h",
            "od_runtime.c",
            "od_runtime.h",
            "torch/OD_types.h",
            "torch/torch_od.c",
            "torch/torch_od.h",
        ]
    );
    let header = fs::read_to_string(scratch.0.join("generated/c/lamp/lamp_od.h")).unwrap();
    assert!(header.starts_with("/*\n * The object dictionary of `lamp`, from lamp.od.yaml.\n"), "{header}");
    assert!(header.contains("static inline uint8_t lamp_get_brightness(const lamp_od_t *od)"), "{header}");
}

#[test]
fn a_prefix_is_that_of_one_dictionary() {
    let scratch = Scratch::new("prefix");
    let spec = "od-spec: 1\ntitle: Lamps\nuses: [cia301]\ndevices:\n\
                \x20 lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}\n\
                \x20 torch: {name: Torch, bit-rates: [125], features: [heartbeat producer]}\n";
    scratch.file("lamps.od.yaml", spec);
    let build =
        |more: &[&str]| odgen(&scratch.0, &[&["build", "lamps.od.yaml", "--prefix", "ODA"], more].concat());
    let lacking = build(&[]);
    assert_eq!(code(&lacking), 2, "{}", stderr(&lacking));
    let plain = build(&["--c", "plain"]);
    assert_eq!(code(&plain), 2);
    assert!(stderr(&plain).contains("the prefix `ODA` is for no file"), "{}", stderr(&plain));
    let two = build(&["--c", "canopennode"]);
    assert_eq!(code(&two), 2);
    assert!(stderr(&two).contains("`ODA` cannot begin the names of 2 dictionaries"), "{}", stderr(&two));
    assert!(!scratch.0.join("generated").exists());
    let one = build(&["--c", "canopennode", "--device", "lamp"]);
    assert_eq!(code(&one), 0, "{}", stderr(&one));
    assert!(stdout(&one).contains("C     generated/c/lamp/ODA.h"), "{}", stdout(&one));
    assert_eq!(
        files(&scratch.0.join("generated/c/lamp")),
        [
            "CO_driver_custom.h",
            "ODA.c",
            "ODA.h",
            "ODA_extension.c",
            "ODA_extension.h",
            "ODA_rules.c",
            "OD_types.h",
        ]
    );
    let word = odgen(&scratch.0, &["build", "lamps.od.yaml", "--c", "canopennode", "--prefix", "int"]);
    assert_eq!(code(&word), 2);
    assert!(stderr(&word).contains("names in C begin with a letter"), "{}", stderr(&word));
}

#[test]
fn names_of_two_devices_do_not_meet_in_c() {
    let scratch = Scratch::new("c-names");
    let spec = LAMP
        .replace("devices:\n", "devices:\n  lamp-get: {name: Other, bit-rates: [125]}\n")
        .replace("objects:\n", "objects:\n  0x2001: {name: get x, type: unsigned8, access: rw, devices: [lamp]}\n  0x2002: {name: x, type: unsigned8, access: rw, devices: [lamp-get]}\n");
    scratch.file("lamp.od.yaml", spec);
    let output = odgen(&scratch.0, &["build", "--c", "plain", "lamp.od.yaml"]);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    assert!(stderr(&output).contains("error[OD0901]: `lamp_get_get_x` would name"), "{}", stderr(&output));
    assert!(!scratch.0.join("generated").exists());
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
fn build_makes_documents_when_asked() {
    let scratch = Scratch::new("build-docs");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["build", "lamp.od.yaml", "--out", "out", "--docs", "html"]);
    assert_eq!(code(&output), 0);
    let names = ["docs/lamp/index.html", "docs/lamp/lamp.html", "eds/lamp.eds", "lamp.json"];
    assert_eq!(files(&scratch.0.join("out")), names);
}

#[test]
fn what_would_not_compile_is_refused_by_check_as_by_build() {
    let scratch = Scratch::new("not-rust");
    let head = LAMP.split("objects:").next().unwrap();
    let large =
        "objects:\n  0x2000..0x2110: {name: \"s {n}\", type: visible-string, access: rw, capacity: 65535}\n";
    scratch.file("large.od.yaml", format!("{head}{large}"));
    scratch
        .file("none.od.yaml", "od-spec: 1\ntitle: Lamp\ndevices:\n  lamp: {name: Lamp, bit-rates: [125]}\n");
    let many = "objects:\n  0x2000..0x2103: {name: \"bank {n}\", array: {count: 254, name: \"cell {n}\", type: unsigned8, access: ro}}\n";
    scratch.file("many.od.yaml", format!("{head}{many}"));
    for name in ["large.od.yaml", "none.od.yaml", "many.od.yaml"] {
        for arguments in [&["check", "--rust", name][..], &["build", "--rust", name]] {
            let output = odgen(&scratch.0, arguments);
            assert_eq!(code(&output), 1, "{}", stderr(&output));
            assert!(stderr(&output).contains("error[OD0904]"), "{}", stderr(&output));
        }
        assert_eq!(code(&odgen(&scratch.0, &["check", name])), 0);
    }
}

#[test]
fn names_that_code_cannot_distinguish_are_reported_once_and_where_they_are() {
    let scratch = Scratch::new("alike");
    let errors = "errors:\n  0xFF01..0xFF08: {name: lamp broken}\n";
    scratch.file("lamp.od.yaml", format!("{LAMP}{errors}"));
    for (arguments, ends, severity) in [
        (&["check"][..], 0, "warning"),
        (&["check", "--rust"], 1, "error"),
        (&["build", "--rust"], 1, "error"),
    ] {
        let output = odgen(&scratch.0, &[arguments, &["lamp.od.yaml"]].concat());
        let said = stdout(&output) + &stderr(&output);
        assert_eq!(code(&output), ends, "{said}");
        assert_eq!(said.matches(&format!("{severity}[OD")).count(), 1, "{said}");
        assert!(
            said.contains(&format!("{severity}[OD0898]: 8 error codes are named `lamp broken`")),
            "{said}"
        );
        assert!(said.contains("lamp.od.yaml:14:3"), "{said}");
    }
}

#[test]
fn what_is_no_longer_made_is_named_and_removed_when_that_is_wanted() {
    let scratch = Scratch::new("prune");
    let second = LAMP
        .replace(
            "objects:\n",
            "objects:\n  0x2001: {name: hue, type: unsigned8, access: ro, devices: [spot]}\n",
        )
        .replace(
            "units:\n",
            "  spot: {name: Spot, bit-rates: [125], features: [heartbeat producer]}\nunits:\n",
        );
    scratch.file("lamp.od.yaml", &second);
    let build = |more: &[&str]| {
        let output =
            odgen(&scratch.0, &[&["build", "lamp.od.yaml", "--out", "out", "--node", "5"], more].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let output = stdout(&output);
        let after = output.lines().skip_while(|line| !line.contains("unchanged")).skip(1);
        after.take_while(|line| *line != "to open:").collect::<String>()
    };
    assert_eq!(build(&["--rust", "--docs", "md"]), "");
    // Not made by a build: a node's DCF, a file of the user's, and what the mark is missing in.
    let dcf = ["dcf", "lamp.od.yaml", "--device", "lamp", "--node", "7", "--out", "out/eds/lamp-7.dcf"];
    assert_eq!(code(&odgen(&scratch.0, &dcf)), 0);
    for (path, text) in [("out/src/lib.rs", "pub mod lamp;\n"), ("out/eds/own.eds", "[FileInfo]\n")] {
        fs::write(scratch.0.join(path), text).unwrap();
    }
    scratch.file("lamp.od.yaml", LAMP);
    let before = files(&scratch.0.join("out"));
    // What was not asked for this time, is not spoken of.
    assert_eq!(build(&["--device", "lamp"]), "");
    assert_eq!(
        build(&[]),
        "  made before, and not by this command: out/eds/spot.dcf, out/eds/spot.eds; `--prune` removes it"
    );
    assert_eq!(files(&scratch.0.join("out")), before);
    let removed = build(&["--rust", "--docs", "md", "--prune"]);
    assert!(
        removed.contains("out/docs/lamp/spot.md, out/eds/spot.dcf, out/eds/spot.eds, out/src/spot.rs"),
        "{removed}"
    );
    let kept = before.iter().filter(|path| !path.contains("spot."));
    assert_eq!(files(&scratch.0.join("out")), kept.cloned().collect::<Vec<_>>());
    assert_eq!(build(&["--rust", "--docs", "md"]), "");
}
