//! The firmware in the book does what it says, and the files that CONTRIBUTING names exist.

use std::path::Path;

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

fn read(path: &str) -> String {
    std::fs::read_to_string(od_tests::root().join(path)).expect("it can be read")
}

/// The value of a key in a file in TOML, the first of its lines.
fn value(path: &str, key: &str) -> String {
    let text = read(path);
    let line = text.lines().find_map(|line| line.strip_prefix(&format!("{key} = ")));
    line.expect("the file has the key").trim_matches('"').to_owned()
}

/// A front page is read in a minute.
#[test]
fn the_front_page_is_short_and_names_the_versions_of_rust() {
    let (tools, firmware) =
        (value("Cargo.toml", "rust-version"), value("firmware-glue/Cargo.toml", "rust-version"));
    let readme = read("README.md");
    assert!(readme.len() <= 10_000, "{} bytes", readme.len());
    assert!(
        readme.contains(&format!("{tools} for the tools, {firmware} for generated code")),
        "{tools}, {firmware}"
    );
    let toolchain = value("rust-toolchain.toml", "channel");
    let toolchain = toolchain.strip_suffix(".0").expect("the first release of a version");
    for page in ["README.md", "docs/book/installation.md"] {
        assert!(read(page).contains(&format!("Rust {toolchain}")), "{page}: {toolchain}");
    }
    assert!(readme.contains(&format!("this is {}", value("Cargo.toml", "version"))));
    let stability = read("docs/book/stability.md");
    assert!(stability.contains(&format!("need Rust {tools}, `firmware-glue` and generated code {firmware}")));
}

/// The front page rounds what the table of firmware-glue has.
#[test]
fn the_front_page_has_the_sizes_of_a_node() {
    let glue = read("firmware-glue/README.md");
    let numbers = |row: &str| -> Vec<f64> {
        let cells = row.split('|').filter_map(|cell| cell.trim().replace(',', "").parse().ok());
        cells.collect()
    };
    let nodes: Vec<_> =
        glue.lines().filter(|line| line.starts_with("| complete `Node`")).map(numbers).collect();
    assert!(nodes.len() >= 3, "{nodes:?}");
    let range = |column: usize| {
        let sizes = nodes.iter().map(|sizes| sizes[column] / 1000.0);
        (sizes.clone().fold(f64::MAX, f64::min), sizes.fold(0.0, f64::max))
    };
    let ((flash, most_flash), (ram, most_ram)) = (range(3), range(4));
    let expected = format!("{flash:.0} to {most_flash:.0} kB of flash, {ram:.1} to {most_ram:.1} kB of RAM");
    assert!(read("README.md").contains(&expected), "the front page lacks: {expected}");
}

/// A manifest that a reader copies fits the traits that firmware-glue uses.
#[test]
fn the_manifest_of_firmware_glue_has_its_versions() {
    let glue = read("firmware-glue/README.md");
    for name in ["embedded-can", "embedded-storage", "nb"] {
        let line = format!("{name} = \"{}\"", value("Cargo.toml", name));
        assert!(glue.lines().any(|found| found.starts_with(&line)), "{line}");
    }
}

/// What a code host calls the place of a heading.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|sign| sign.is_alphanumeric() || " -_".contains(*sign));
    kept.collect::<String>().trim().to_lowercase().replace(' ', "-")
}

/// MkDocs checks the links of the built book; these are followed in a clone.
#[test]
fn links_lead_somewhere_in_a_clone() {
    let root = od_tests::root();
    let mut pages: Vec<_> = ["README.md", "CONTRIBUTING.md", "firmware-glue/examples/README.md"]
        .map(|page| root.join(page))
        .to_vec();
    for folder in ["docs/book", "docs/book/guides"] {
        let files = std::fs::read_dir(root.join(folder)).expect("it can be listed");
        let files = files.map(|file| file.expect("it can be listed").path());
        pages.extend(files.filter(|path| path.extension().is_some_and(|extension| extension == "md")));
    }
    let text = |path: &Path| std::fs::read_to_string(path).expect("it can be read");
    // Every second part is code.
    let prose = |path: &Path| text(path).split("```").step_by(2).collect::<String>();
    let mut count = 0;
    for page in pages {
        let prose_of_page = prose(&page);
        let links = prose_of_page.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0));
        for link in links.filter(|link| !link.contains("://")) {
            let (path, place) = link.split_once('#').unwrap_or((link, ""));
            let target = if path.is_empty() { page.clone() } else { page.with_file_name(path) };
            assert!(target.exists(), "{}: {link}", page.display());
            let leads = place.is_empty()
                || prose(&target).lines().any(|line| line.starts_with('#') && anchor(line) == place);
            assert!(leads, "{}: {link}", page.display());
            count += 1;
        }
    }
    assert!(count > 200, "{count}");
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
