//! The documents say what the model says: Markdown is read back, cell by cell, by a reader that others wrote.

#![expect(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use od_documents::{self as docs, Format, Templates};
use od_tests::memo::Memo;
use od_tests::{compile_clean, documents, plant};

mod defaults;
mod figures;
mod gaps;
mod groups;
mod links;
mod machines;
mod manual;
#[path = "../../shared/markdown.rs"]
mod markdown;
mod modules;
mod numbers;
mod prose;
mod read_back;
mod svg;
mod switches;
mod timings;
mod workbench;

use markdown::{Page, Table};

const PITCH: &str = "od-spec/devices/pitch-control-system.od.yaml";
const FULLMO: &str = "od-spec/devices/fullmo-drive.od.yaml";
const EVERYTHING: &str = "tests/readers/everything.od.yaml";
/// Two devices that share indices but not all facts.
const TWO: &str = "tests/docs/two.od.yaml";

/// Whether a file's name ends like this.
fn is(name: &str, extension: &str) -> bool {
    Path::new(name).extension().is_some_and(|found| found == extension)
}

/// All Markdown pages of a specification by name, and the index of tables.
type Manual = (BTreeMap<String, Page>, serde_json::Value);

fn pages(spec: &str) -> &'static Manual {
    static READ: Memo<String, Manual> = Memo::empty();
    let read = || {
        let (mut pages, mut index) = (BTreeMap::new(), serde_json::Value::Null);
        for (name, text) in documents::pages(spec, Format::Markdown, "en")? {
            if is(name, "json") {
                index = serde_json::from_str(text)?;
            } else {
                pages.insert(name.clone(), markdown::read(text));
            }
        }
        Ok((pages, index))
    };
    READ.get(spec.to_owned(), read).unwrap()
}

/// The tables after an anchor, up to the next table's anchor.
fn behind<'a>(page: &'a Page, anchor: &str) -> Vec<&'a Table> {
    let is_table =
        |name: &String| ["table-", "figure-", "section-"].iter().any(|kind| name.starts_with(kind));
    let first = page.tables.iter().position(|table| table.anchors.iter().any(|name| name == anchor));
    let first = first.unwrap_or_else(|| panic!("no table after {anchor}"));
    let rest = page.tables[first + 1..].iter().take_while(|table| !table.anchors.iter().any(is_table));
    std::iter::once(&page.tables[first]).chain(rest).collect()
}

#[test]
fn every_table_of_the_pitch_manual_has_its_counterpart() {
    let (pages, index) = pages(PITCH);
    let tables = index["tables"].as_array().unwrap();
    let numbers: Vec<u64> = tables.iter().filter_map(|table| table["number"].as_u64()).collect();
    assert_eq!(numbers, (1..=75).collect::<Vec<u64>>());
    let unnumbered: Vec<&str> = tables
        .iter()
        .filter(|table| table["number"].is_null() && table["kind"] == "overview")
        .map(|table| table["section"].as_str().unwrap())
        .collect();
    assert_eq!(unnumbered, ["4.7.2", "4.7.3", "4.8.1", "4.9.1", "5.8.2", "5.9.1", "5.14.2", "5.16.1"]);
    let mut seen = BTreeSet::new();
    for table in tables {
        let (page, anchor) = (table["page"].as_str().unwrap(), table["anchor"].as_str().unwrap());
        assert!(seen.insert((page, anchor)), "{anchor} takes the place of two tables");
        let found = behind(&pages[&format!("{page}.md")], anchor);
        let rows: usize = found.iter().map(|table| table.rows.len()).sum();
        assert_eq!(rows as u64, table["rows"].as_u64().unwrap(), "{anchor}");
        assert!(rows > 0, "{anchor}");
    }
}

#[test]
fn the_index_of_tables_names_the_facts_that_differ() {
    let system = compile_clean(PITCH).unwrap();
    let (_, index) = pages(PITCH);
    let tables = index["tables"].as_array().unwrap();
    let of = |anchor: &str| tables.iter().find(|table| table["anchor"] == anchor).unwrap();
    // 4.1.1.5 prints 3003h at the detail table of 3004h.
    let differs = of("section-4.1.1.5-objects")["differs"].as_array().unwrap();
    let index_fact = differs.iter().find(|one| one["column"] == "index").expect("an erratum about the index");
    assert_eq!(index_fact["entries"], serde_json::json!(["3004h"]));
    assert!(index_fact["prints"].as_str().unwrap().contains("3003h"));
    // The statusword is printed as rw in the overview and in its detail table.
    for anchor in ["section-5.8.2-overview", "section-5.8.2.2-objects"] {
        let differs = of(anchor)["differs"].as_array().unwrap();
        assert!(
            differs
                .iter()
                .any(|one| one["column"] == "access" && one["entries"] == serde_json::json!(["6041h"])),
            "{anchor}: {differs:?}"
        );
    }
    // Every erratum whose words name a numbered table is listed with it, and the others are not.
    for (at, erratum) in system.errata.iter().enumerate() {
        for id in &erratum.tables {
            let section = &system.document.sections[id.section];
            let Some(number) = section.tables[id.table].number else { continue };
            let listed = of(&format!("table-{number}"))["errata"].as_array().unwrap();
            assert!(listed.contains(&serde_json::json!(at + 1)), "erratum {} and Table {number}", at + 1);
        }
    }
    let claimed: usize = tables.iter().map(|table| table["errata"].as_array().unwrap().len()).sum();
    assert_eq!(claimed, system.errata.iter().map(|erratum| erratum.tables.len()).sum::<usize>());
}

#[test]
fn tables_have_the_columns_that_a_specification_can_state() {
    for path in [PITCH, FULLMO] {
        let system = compile_clean(path).unwrap();
        let (_, index) = pages(path);
        let tables = index["tables"].as_array().unwrap();
        for (table, (.., content)) in tables.iter().zip(system.document.tables()) {
            let known = content.content.columns();
            for column in table["columns"].as_array().unwrap() {
                assert!(known.contains(&column.as_str().unwrap()), "{path}: {column} of {}", table["kind"]);
            }
        }
    }
}

#[test]
fn no_link_of_a_page_is_dead() {
    for path in [PITCH, FULLMO, EVERYTHING, TWO] {
        let system = compile_clean(path).unwrap();
        let (pages, _) = pages(path);
        let mut links = 0;
        for (name, page) in pages {
            for link in &page.links {
                let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
                let file = if file.is_empty() { name.as_str() } else { file };
                let target = pages.get(file).unwrap_or_else(|| panic!("{name} links to {link}"));
                assert!(anchor.is_empty() || target.anchors.contains(anchor), "{name} links to {link}");
                // The page of a device leads to no other device.
                let is_device =
                    |page: &str| system.devices.iter().any(|one| page == format!("{}.md", one.key));
                assert!(!(is_device(name) && is_device(file)) || file == name, "{name} links to {link}");
                links += 1;
            }
        }
        assert!(links > 50, "{path}: {links} links");
    }
}

/// Devices that differ are distinguished, numbers have their units, and odd texts break nothing: reviewed line by line.
#[test]
fn devices_that_differ_are_distinguished() {
    let files = documents::pages(TWO, Format::Markdown, "en").unwrap();
    let wanted = [
        "README",
        "1-erstes",
        "chapter-3",
        "constraints",
        "contents",
        "machines",
        "errors",
        "storage",
        "tables",
        "two",
    ];
    let mut text = String::new();
    for name in wanted {
        text.extend(["================ ", name, ".md\n", &files[&format!("{name}.md")]]);
    }
    insta::assert_snapshot!(text);
}

/// `docs/book/formats/templates.md` names everything that a template can see.
#[test]
fn the_description_of_the_context_is_complete() {
    let description =
        std::fs::read_to_string(od_tests::root().join("docs/book/formats/templates.md")).unwrap();
    let described: BTreeSet<&str> =
        description.split(|sign: char| !sign.is_ascii_alphanumeric() && sign != '_').collect();
    let mut names = BTreeSet::new();
    let mut rest = vec![documents::context(PITCH, "en").unwrap()];
    while let Some(value) = rest.pop() {
        match value {
            serde_json::Value::Object(map) => {
                for (name, value) in map {
                    names.insert(name.as_str());
                    // The names in these are words and anchors.
                    if name != "words" && name != "details" {
                        rest.push(value);
                    }
                }
            }
            serde_json::Value::Array(list) => rest.extend(list),
            _ => {}
        }
    }
    let missing: Vec<_> = names.difference(&described).collect();
    assert!(missing.is_empty() && names.len() > 60, "{missing:?}");
}

/// The templates of the AsciiDoc example.
fn asciidoc() -> Vec<(String, String)> {
    let directory = od_tests::root().join("docs-gen/examples/asciidoc");
    let files = std::fs::read_dir(directory).unwrap().map(|entry| {
        let entry = entry.unwrap();
        (entry.file_name().into_string().unwrap(), std::fs::read_to_string(entry.path()).unwrap())
    });
    files.collect()
}

/// A writer's own format: the example's templates make AsciiDoc without a line of Rust.
#[test]
fn the_asciidoc_example_prints_every_table() {
    let system = compile_clean(PITCH).unwrap();
    let templates = [Templates::new(None, &asciidoc()).unwrap()];
    let printed = docs::artifacts(&system, "", "s", &docs::options(&system, &[], None), &templates).unwrap();
    assert_eq!(
        printed.iter().map(|file| file.path.as_str()).collect::<Vec<_>>(),
        ["s/manual.adoc", "s/tables.json"]
    );
    let text = String::from_utf8(printed[0].bytes.clone()).unwrap();
    let index: serde_json::Value = serde_json::from_slice(&printed[1].bytes).unwrap();
    for table in index["tables"].as_array().unwrap() {
        let anchor = format!("[[od-{}]]\n", table["anchor"].as_str().unwrap());
        assert_eq!(text.matches(&anchor).count(), 1, "{anchor}");
    }
    let grids = text.matches("[cols=").count();
    assert_eq!(text.matches("|===\n").count(), 2 * grids);
    assert!(text.contains("| 6041h\n") || text.contains("]]6041h\n"));
}

/// Texts command nothing in AsciiDoc: no format, attribute, link, index term, cell or file.
#[test]
fn the_asciidoc_example_escapes_texts() {
    let payload =
        "*b* _i_ `m` #k# {docname} <<x>> [[y]] |z| include::w[] ((v)) (C) a -- b ... https://example.org";
    let marks =
        ["*b", " _i", "`m", "#k", "{d", "<<x", "[[y", "|z", "::w", "w[", "((v", "(C)", " -- ", " ...", "://"];
    let sites = plant::sites(plant::TEXTS);
    let planted = plant::accepted(plant::TEXTS, &sites, payload, &mut |_, _| ()).unwrap();
    let (_, compiled) = plant::compiled(&plant::planted(plant::TEXTS, &sites, &planted.chosen, payload).0);
    let system = compiled.system.unwrap();
    let templates = [Templates::new(None, &asciidoc()).unwrap()];
    let printed = docs::artifacts(&system, "", "s", &docs::options(&system, &[], None), &templates).unwrap();
    let text = std::str::from_utf8(&printed[0].bytes).unwrap();
    for mark in marks {
        let found = text.lines().find(|line| line.contains(mark));
        assert_eq!(found, None, "{mark}");
    }
    assert!(text.matches("&#42;b&#42;").count() > 50, "{text}");
}

#[test]
fn a_template_changes_nothing_but_itself() {
    let system = compile_clean(TWO).unwrap();
    let options = docs::options(&system, &[], None);
    let print = |templates: &[(String, String)]| {
        let templates = [Templates::new(Some(Format::Html), templates).unwrap()];
        docs::artifacts(&system, "", "s", &options, &templates).unwrap()
    };
    let (before, after) = (print(&[]), print(&[("_style.css".to_owned(), "p { color: red }\n".to_owned())]));
    for (before, after) in before.iter().zip(&after).filter(|(before, _)| is(&before.path, "html")) {
        let text = |bytes: &[u8]| {
            let text = String::from_utf8(bytes.to_vec()).unwrap();
            let (head, rest) = text.split_once("<style>").unwrap();
            let (style, rest) = rest.split_once("</style>").unwrap();
            (style.trim().to_owned(), head.to_owned() + rest)
        };
        let (old, new) = (text(&before.bytes), text(&after.bytes));
        assert!(new.0.starts_with("p { color: red }"), "{}", new.0);
        assert_ne!(old.0, new.0);
        assert_eq!(old.1, new.1);
    }
}

/// Documents of one device show nothing of the others.
#[test]
fn one_device_alone() {
    let system = compile_clean(PITCH).unwrap();
    let options = docs::options(&system, &["pmc".to_owned()], None);
    let templates = [Templates::new(Some(Format::Markdown), &[]).unwrap()];
    let files = docs::artifacts(&system, "", "s", &options, &templates).unwrap();
    let names: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
    assert!(names.contains(&"s/pmc.md") && !names.contains(&"s/pmm.md"), "{names:?}");
    let pages: BTreeMap<&str, Page> = files
        .iter()
        .filter(|file| is(&file.path, "md"))
        .map(|file| {
            (file.path.strip_prefix("s/").unwrap(), markdown::read(std::str::from_utf8(&file.bytes).unwrap()))
        })
        .collect();
    // Of the PMM's chapter, only the thresholds remain that the PMC shares.
    let tables = &pages["4-the-pitch-management-module-pmm.md"].tables;
    assert_eq!(tables.len(), 1);
    assert!(tables[0].anchors.contains(&"table-19".to_owned()));
    for (name, page) in &pages {
        for link in &page.links {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target = &pages[if file.is_empty() { name } else { file }];
            assert!(anchor.is_empty() || target.anchors.contains(anchor), "{name} links to {link}");
        }
    }
}
