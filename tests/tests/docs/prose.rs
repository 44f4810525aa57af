//! Texts of a manual are between its tables, in the language of the document, and with the devices that they are about.

use std::collections::BTreeSet;

use od_documents::{self as docs, Format, Templates};
use od_gen::rust::{self, Provenance};
use od_spec::diag::Diagnostics;
use od_spec::model::{EntryId, Index, ProseKind, SubIndex};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};
use od_tests::documents;

use super::compile_clean;

const PROSE: &str = "tests/docs/prose.od.yaml";

/// A page in a language.
fn page(name: &str, language: &str, format: Format) -> &'static str {
    &documents::pages(PROSE, format, language).unwrap()[name]
}

/// The pages of the chapters for some devices, in a language.
fn chapters(devices: &[&str], language: &str, format: Format) -> String {
    let system = compile_clean(PROSE).unwrap();
    let devices: Vec<String> = devices.iter().map(ToString::to_string).collect();
    let templates = [Templates::new(Some(format), &[]).unwrap()];
    let options = docs::options(&system, &devices, Some(language));
    let files = docs::artifacts(&system, "", "s", &options, &templates).unwrap();
    let is_chapter =
        |path: &str| path.starts_with("s/1-") || path.starts_with("s/2-") || path == "s/index.html";
    let chapters = files.iter().filter(|file| is_chapter(&file.path));
    chapters.map(|file| String::from_utf8_lossy(&file.bytes).into_owned()).collect()
}

/// Whether all of these are in a text, in this order.
fn assert_in_order(text: &str, parts: &[&str]) {
    let mut rest = text;
    for part in parts {
        let at = rest.find(part).unwrap_or_else(|| panic!("`{part}` is not after the others in\n{text}"));
        rest = &rest[at + part.len()..];
    }
}

#[test]
fn texts_are_between_tables() {
    let text = chapters(&[], "en", Format::Markdown);
    assert_in_order(
        &text,
        &[
            "One paragraph.\n\nAnother one.\n",
            "About both.\n",
            "Before the table of ",
            "**Table 1**",
            "**Table 2**",
            "> **Warning**\n>\n> After the table.\n",
            "1. First.\n2. \\- Second.\n",
            "- a\n- b\n",
            "> **Note**\n>\n> Line of a note.\n>\n> Second line.\n",
            "> a = b · c\n>\n> d = e\n",
        ],
    );
    let text = chapters(&[], "en", Format::Html);
    assert_in_order(
        &text,
        &[
            "<p class=\"prose\">One paragraph.</p>",
            "<p class=\"prose\">Another one.</p>",
            "Before the table of ",
            "id=\"table-1\"",
            "<div class=\"prose warning\" id=\"section-2.1-warning-1\" role=\"note\">\n<p><b>Warning</b></p>\n<p>After the table.</p>",
            "<ol class=\"prose\">\n<li>First.</li>\n<li>- Second.</li>\n</ol>",
            "<p class=\"prose formula\">d = e</p>",
        ],
    );
}

#[test]
fn texts_are_in_the_language_of_the_document() {
    let text = chapters(&[], "de", Format::Markdown);
    assert_in_order(
        &text,
        &["Ein Absatz.\n\nNoch einer.\n", "> **Warnung**\n>\n> Nach der Tabelle.\n", "> **Hinweis**"],
    );
    assert!(!text.contains("One paragraph"), "{text}");
    // A chapter with texts in another language says so first.
    assert_in_order(
        &text,
        &["Was in diesem Teil nicht übersetzt ist, gibt es nur auf Englisch.", "About both.\n"],
    );
}

#[test]
fn texts_go_with_the_devices_around_them() {
    let one = chapters(&["one"], "en", Format::Markdown);
    assert_in_order(
        &one,
        &["One paragraph.", "About both.", "Before the table", "**Table 1**", "After the table.", "First."],
    );
    for absent in ["Table 2", "Line of a note", "Only about two"] {
        assert!(!one.contains(absent), "`{absent}` is in\n{one}");
    }
    let two = chapters(&["two"], "en", Format::Markdown);
    assert_in_order(
        &two,
        &["One paragraph.", "About both.", "**Table 2**", "Line of a note.", "Only about two."],
    );
    assert!(!two.contains("**Table 1**"), "{two}");
}

#[test]
fn warnings_are_where_the_object_does() {
    let text = page("two.md", "en", Format::Markdown);
    assert_in_order(
        text,
        &[
            "2002h speed",
            "| **Warning:** The axis moves at once.",
            // The view does the same when it is made, and not when it is read.
            "2003h speed in 16 bits",
            "**Warning:** The axis moves at once.<br>View of",
            "2004h speed to be read",
            "| View of",
            "2005h heater",
            "**Warning:** The plate is hot.\n",
            "**Warning:** Full power burns.",
        ],
    );
    assert_in_order(page("two.md", "de", Format::Markdown), &["**Warnung:** Die Achse fährt sofort los."]);
    let text = page("two.html", "en", Format::Html);
    assert_in_order(
        text,
        &[
            "<strong>Warning:</strong> The axis moves at once.",
            "<p class=\"warning\"><b>Warning:</b> The plate is hot.</p>",
            "<strong>Warning:</strong> Full power burns.",
        ],
    );
    let text = chapters(&[], "en", Format::Markdown);
    assert_in_order(
        &text,
        &[
            "**Warning:** The axis moves at once.",
            "<br>**Warning:** The plate is hot.\n",
            "Full power burns.",
        ],
    );
}

#[test]
fn warnings_are_in_the_firmware() {
    let system = compile_clean(PROSE).unwrap();
    let device = system.devices.iter().find(|device| device.key == "two").unwrap();
    let made_of = Provenance::of(&SourceMap::new());
    let module = rust::file(&system, device, &made_of, &mut Diagnostics::new()).unwrap();
    for warning in ["The axis moves at once.", "The plate is hot.", "Full power burns."] {
        assert!(module.contains(&format!("/// **Warning:** {warning}\n")), "`{warning}` is not in\n{module}");
    }
}

#[test]
fn warnings_are_in_the_eds() {
    let system = compile_clean(PROSE).unwrap();
    let device = system.devices.iter().find(|device| device.key == "two").unwrap();
    let eds = String::from_utf8(od_formats::eds::write_eds(&system, device)).unwrap();
    assert_in_order(
        &eds,
        &["; Warning: The axis moves at once.\r\n[2002]", "; Warning: The plate is hot.\r\n[2005]"],
    );
    assert_in_order(&eds, &["; Warning: Full power burns.\r\n[2005sub1]"]);
    let mut sources = SourceMap::new();
    let id = sources.add("two.eds", eds);
    let read = compile(&mut sources, id, &mut NoFiles).system.unwrap();
    let warning = |index: u16, sub: u8| {
        let id = EntryId { index: Index(index), sub: SubIndex(sub) };
        read.devices[0].entry(id).unwrap().warning.get("en").map(str::to_owned)
    };
    assert_eq!(warning(0x2002, 0).as_deref(), Some("The axis moves at once."));
    assert_eq!(warning(0x2005, 1).as_deref(), Some("Full power burns."));
    assert_eq!(warning(0x2005, 2), None);
}

/// The overview has every warning of the model once, with all of its places, and its links lead there.
#[test]
fn the_overview_has_every_warning() {
    for (path, language) in [(super::PITCH, "en"), (super::FULLMO, "de")] {
        let system = compile_clean(path).unwrap();
        let context = documents::context(path, language).unwrap();
        let rows = context["warnings"]["grids"][0]["rows"].as_array().unwrap();
        let warnings: Vec<(&str, &str)> = rows
            .iter()
            .map(|row| (row["cells"][0]["text"].as_str().unwrap(), row["cells"][1]["text"].as_str().unwrap()))
            .collect();
        let mut texts: Vec<&str> = warnings.iter().map(|(_, warning)| *warning).collect();
        let count = texts.len();
        texts.sort_unstable();
        texts.dedup();
        assert_eq!(texts.len(), count, "{path}: a warning is there twice");
        let mut expected: BTreeSet<(String, String)> = BTreeSet::new();
        let contents = system.document.sections.iter().flat_map(|section| &section.content);
        let in_text: BTreeSet<Index> = contents
            .filter_map(|part| match part {
                od_spec::model::Content::Prose(prose) => Some(prose),
                od_spec::model::Content::Table(_) => None,
            })
            .flat_map(|prose| prose.warns_for.iter().copied())
            .collect();
        for device in &system.devices {
            for (id, object, entry) in device.entries().filter(|(id, ..)| !in_text.contains(&id.index)) {
                let name = device.entry_name(id).unwrap();
                for (place, text) in [
                    (format!("{} {}", object.index, object.name), &object.warning),
                    (format!("{id} {name}"), &entry.warning),
                ] {
                    expected.extend(text.get(language).map(|text| (place, text.to_owned())));
                }
            }
        }
        for section in &system.document.sections {
            let title = format!("{} {}", section.number, section.title.get(language).unwrap());
            for part in &section.content {
                let od_spec::model::Content::Prose(prose) = part else { continue };
                if prose.kind == ProseKind::Warning {
                    let items = prose.items.iter().filter_map(|item| item.get(language));
                    let warning = items.collect::<Vec<_>>().join("\n");
                    // What it says of objects is listed with them.
                    for index in &prose.warns_for {
                        let object =
                            system.devices.iter().find_map(|device| device.objects.get(index)).unwrap();
                        expected.insert((format!("{index} {}", object.name), warning.clone()));
                    }
                    if prose.warns_for.is_empty() {
                        expected.insert((title.trim().to_owned(), warning));
                    }
                }
            }
        }
        let found: BTreeSet<(String, String)> = warnings
            .iter()
            .flat_map(|(places, warning)| {
                places.lines().map(|place| (place.to_owned(), (*warning).to_owned()))
            })
            .collect();
        assert_eq!(found, expected, "{path}");
        assert!(found.len() > 30, "{path}");
    }
}

/// A letter is that of the same appendix on every page.
#[test]
fn appendices_have_the_same_letter_everywhere() {
    let context = documents::context(super::PITCH, "en").unwrap();
    let letters = |list: &serde_json::Value| -> Vec<(String, String, String)> {
        let list = list.as_array().unwrap().iter();
        let text = |one: &serde_json::Value, key: &str| one[key].as_str().unwrap().to_owned();
        list.map(|one| (text(one, "page"), text(one, "letter"), text(one, "title"))).collect()
    };
    let all = letters(&context["appendices"]);
    let numbered: Vec<&str> = all.iter().map(|(_, letter, _)| letter.as_str()).collect();
    assert_eq!(numbered, ["A", "B", "C", "D", "E", "F", "G", "H"]);
    for (_, letter, title) in &all {
        assert!(title.starts_with(&format!("Appendix {letter}: ")), "{title}");
    }
    for device in context["devices"].as_array().unwrap() {
        for one in letters(&device["appendices"]) {
            assert!(all.contains(&one), "{one:?}");
        }
    }
}
