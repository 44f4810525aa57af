//! The firmware in the book does what it says, and the files that CONTRIBUTING names exist.

mod fragment {
    include!("../../book/firmware.rs");

    #[test]
    fn the_fragment_takes_a_set_point_and_sends_a_pressure() {
        let mut od = Valve::new(3);
        let mut hardware = Hardware { set_point: od.set_pressure() };
        assert_eq!(hardware.set_point, Decibar(25));
        let sent = cycle(&mut od, &mut hardware, &[120, 0], 118).expect("both PDOs are valid");
        assert_eq!(*sent, [118, 0]);
        assert_eq!(hardware.set_point, Decibar(120));
        // 16.1 bar is refused, and the set-point stays.
        assert!(cycle(&mut od, &mut hardware, &[161, 0], 119).is_some());
        assert_eq!(hardware.set_point, Decibar(120));
        assert_eq!(od.actual_pressure(), Special::Value(Decibar(119)));
        assert_eq!(format!("{:?}", hardware.set_point), "12.0 bar");
        assert_eq!(od.set_pressure(), Decibar(120));
    }
}

/// A front page is read in a minute.
#[test]
fn the_front_page_is_short_and_names_the_versions_of_rust() {
    let read = |path: &str| std::fs::read_to_string(od_tests::root().join(path)).expect("it can be read");
    let version = |manifest: &str| {
        let manifest = read(manifest);
        let line = manifest.lines().find_map(|line| line.strip_prefix("rust-version = "));
        line.expect("a version of Rust").trim_matches('"').to_owned()
    };
    let (tools, firmware) = (version("Cargo.toml"), version("firmware-glue/Cargo.toml"));
    let readme = read("README.md");
    assert!(readme.len() <= 10_000, "{} bytes", readme.len());
    assert!(
        readme.contains(&format!("{tools} for the tools, {firmware} for generated code")),
        "{tools}, {firmware}"
    );
    let stability = read("docs/book/stability.md");
    assert!(stability.contains(&format!("need Rust {tools}, `firmware-glue` and generated code {firmware}")));
}

/// A browser shows nothing of a picture that is no XML.
#[test]
fn pictures_are_well_formed() {
    for name in ["page", "message"] {
        let path = od_tests::root().join(format!("docs/book/images/{name}.svg"));
        let text = std::fs::read_to_string(path).expect("it can be read");
        let picture = roxmltree::Document::parse(&text).expect("it is XML");
        assert_eq!(picture.root_element().tag_name().name(), "svg");
    }
}

/// Names in upper case represent any; what is before them has to exist.
#[test]
fn files_that_contributors_look_for_exist() {
    let root = od_tests::root();
    let text = std::fs::read_to_string(root.join("CONTRIBUTING.md")).expect("it can be read");
    let quoted = text.split('`').skip(1).step_by(2);
    let tops = ["docs/", "docs-gen/", "firmware-glue/", "od-gen/", "od-macros/", "od-spec/", "tests/"];
    let paths = quoted.filter(|path| tops.iter().any(|top| path.starts_with(top)) && !path.contains(' '));
    let is_any = |part: &str| part.contains('*') || part.starts_with(|sign: char| sign.is_ascii_uppercase());
    let is_there = |path: &str| {
        let parts: Vec<&str> = path.split('/').take_while(|part| !is_any(part)).collect();
        root.join(parts.join("/")).exists()
    };
    let paths: Vec<&str> = paths.collect();
    assert!(paths.len() > 30, "{paths:?}");
    let missing: Vec<&&str> = paths.iter().filter(|path| !is_there(path)).collect();
    assert!(missing.is_empty(), "there is no {missing:?}");
}
