//! Numbers of tables, figures and sections in the texts of a specification are links to these.

use std::collections::{BTreeMap, BTreeSet};

use od_documents::{self as docs, Format, Templates};
use od_tests::documents;
use serde_json::Value;

use super::links::{assert_has, page};
use super::{FULLMO, PITCH, compile_clean};

const NUMBERS: &str = "tests/docs/numbers.od.yaml";

/// The pages of a format, of these devices or of all.
fn files(spec: &str, devices: &[&str], templates: &Templates) -> BTreeMap<String, String> {
    let system = compile_clean(spec).unwrap();
    let devices: Vec<String> = devices.iter().map(|key| (*key).to_owned()).collect();
    let options = docs::options(&system, &devices, None);
    let files = docs::artifacts(&system, "", "s", &options, std::slice::from_ref(templates)).unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    files
        .into_iter()
        .map(|file| (file.path.strip_prefix("s/").unwrap().to_owned(), text(file.bytes)))
        .collect()
}

#[test]
fn a_number_in_a_text_is_a_link() {
    let text = page(NUMBERS, Format::Html, "en", "index.html");
    assert_has(
        text,
        "<a href=\"#section-1.1\">Sections 1.1</a> and <a href=\"#section-1.2\">1.2</a> describe them, \
         <a href=\"#section-2\">chapter 2</a> of the speed. <a href=\"#table-12\">Tables 12</a> to \
         <a href=\"#table-14\">14</a>; Table 15.",
    );
    assert_has(text, "the colours are in <a href=\"#table-13\">Table 13</a>.");
    assert_has(text, "See <a href=\"#figure-7\">Figure 7</a>.");
    assert_has(
        text,
        "Not Table 130, nor table 48 of CiA 301; as <a href=\"#section-1.2\">section 1.2</a> says.",
    );
    // A heading is not a link.
    assert_has(text, "1.1 Lamp in Table 12</h3>");
}

#[test]
fn a_number_in_a_german_text_is_a_link() {
    let text = page(NUMBERS, Format::Html, "de", "index.html");
    assert_has(
        text,
        "Die <a href=\"#section-1.1\">Abschnitte 1.1</a> und <a href=\"#section-1.2\">1.2</a> beschreiben sie, \
         <a href=\"#section-2\">Kapitel 2</a> die Drehzahl. <a href=\"#table-12\">Tabellen 12</a> bis \
         <a href=\"#table-14\">14</a>; Tabelle 15.",
    );
    assert_has(text, "Siehe <a href=\"#figure-7\">Bild 7</a>.");
    assert_has(
        text,
        "Nicht Tabelle 130, noch Tabelle 48 aus CiA 301; wie <a href=\"#section-1.2\">Abschnitt 1.2</a> sagt.",
    );
}

#[test]
fn a_number_is_a_link_from_page_to_page() {
    let html = Templates::new(Some(Format::Html), &[]).unwrap();
    assert_has(
        &files(NUMBERS, &[], &html)["fan.html"],
        "as <a href=\"index.html#section-1.2\">section 1.2</a> says.",
    );
    let markdown = files(NUMBERS, &[], &Templates::new(Some(Format::Markdown), &[]).unwrap());
    assert_has(&markdown["2-speed.md"], "as [section 1.2](1-two-devices.md#section-1.2) says.");
    assert_has(&markdown["1-two-devices.md"], "<a id=\"section-1.2\"></a>");
    let print = files(NUMBERS, &[], &Templates::new(Some(Format::Print), &[]).unwrap());
    assert_has(&print["manual.html"], "as <a href=\"#section-1.2\">section 1.2</a> says.");
    let example = Templates::new(None, &crate::asciidoc()).unwrap();
    assert_has(&files(NUMBERS, &[], &example)["manual.adoc"], "as <<od-section-1.2,section 1.2>> says.");
}

/// What the printed manual says is not corrected on the way.
#[test]
fn what_an_erratum_prints_is_no_link() {
    let text = page(NUMBERS, Format::Markdown, "en", "errata.md");
    assert_has(
        text,
        "| 1.1, [Table 13](1-two-devices.md#table-13) | see Table 12      | see [Table 13](1-two-devices.md#table-13) |",
    );
    assert_has(text, "[Table 12](1-two-devices.md#table-12) has no bits");
}

/// The document of one device has neither the tables of the other nor the sections that only these make.
#[test]
fn what_is_not_in_a_document_is_no_link() {
    let html = Templates::new(Some(Format::Html), &[]).unwrap();
    let lamp = files(NUMBERS, &["lamp"], &html);
    assert_has(
        &lamp["index.html"],
        "<a href=\"#section-1.1\">Sections 1.1</a> and 1.2 describe them, chapter 2 of the speed. \
         <a href=\"#table-12\">Tables 12</a> to 14; Table 15.",
    );
    for devices in [&["lamp"][..], &["fan"]] {
        assert_leads_somewhere(&files(NUMBERS, devices, &html));
    }
    assert_leads_somewhere(&files(PITCH, &["pmm"], &html));
}

/// The links to tables, figures and sections of HTML pages all have their places.
fn assert_leads_somewhere(pages: &BTreeMap<String, String>) {
    let mut links = 0;
    for (name, text) in pages {
        for link in text.split("href=\"").skip(1).filter_map(|rest| rest.split('"').next()) {
            let Some((page, anchor)) = link.split_once('#') else { continue };
            if !["table-", "figure-", "section-"].iter().any(|kind| anchor.starts_with(kind)) {
                continue;
            }
            let page = if page.is_empty() { name } else { page };
            assert!(pages[page].contains(&format!(" id=\"{anchor}\"")), "{name}: {link} leads nowhere");
            links += 1;
        }
    }
    assert!(links > 0);
}

/// Words before a number, in small letters, and how an anchor begins.
const NOUNS: [(&str, &[&str]); 3] = [
    ("table-", &["table", "tables", "tabelle", "tabellen"]),
    ("figure-", &["figure", "figures", "abbildung", "abbildungen", "bild", "bilder", "bildern"]),
    (
        "section-",
        &[
            "section",
            "sections",
            "chapter",
            "chapters",
            "abschnitt",
            "abschnitts",
            "abschnitte",
            "abschnitten",
            "kapitel",
        ],
    ),
];

/// The anchors that the words of a text name: every number after a noun.
fn named(text: &str) -> Vec<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let bare = |word: &str| word.trim_matches(|sign: char| !sign.is_alphanumeric()).to_lowercase();
    let pairs = words.windows(2).filter_map(|pair| {
        let number = bare(pair[1]);
        let (anchor, _) = NOUNS.iter().find(|(_, nouns)| nouns.contains(&bare(pair[0]).as_str()))?;
        number.starts_with(|sign: char| sign.is_ascii_digit()).then(|| format!("{anchor}{number}"))
    });
    pairs.collect()
}

/// What a document says about numbers.
#[derive(Default)]
struct Said {
    /// Places of tables, figures and sections: page and anchor.
    places: BTreeSet<(String, String)>,
    /// Links to such, with their texts.
    links: Vec<(String, String, String)>,
    /// Texts that are not links; quotations of the printed manual are not the document's.
    texts: Vec<String>,
}

impl Said {
    fn read_cell(&mut self, cell: &Value) {
        for part in cell["parts"].as_array().unwrap() {
            let word = |key: &str| part[key].as_str().unwrap().to_owned();
            let anchor = word("anchor");
            if NOUNS.iter().any(|(kind, _)| anchor.starts_with(kind)) && !anchor.contains("-warning-") {
                self.links.push((word("page"), anchor, word("text")));
            } else if word("kind") == "text" {
                self.texts.push(word("text"));
            }
        }
    }

    fn read(&mut self, value: &Value) {
        match value {
            Value::Object(map) if map.contains_key("parts") => self.read_cell(value),
            Value::Object(map) if map.contains_key("columns") && map.contains_key("rows") => {
                for row in value["rows"].as_array().unwrap() {
                    let columns = value["columns"].as_array().unwrap().iter();
                    for (column, cell) in columns.zip(row["cells"].as_array().unwrap()) {
                        if column["key"] != "prints" {
                            self.read(cell);
                        }
                    }
                }
            }
            Value::Object(map) => {
                let is_ours = |key: &str| !matches!(key, "title" | "prints");
                map.iter().filter(|(key, _)| is_ours(key)).for_each(|(_, one)| self.read(one));
            }
            Value::Array(list) => list.iter().for_each(|one| self.read(one)),
            _ => {}
        }
    }

    fn of(spec: &str, language: &str) -> Self {
        let context = documents::context(spec, language).unwrap();
        let mut said = Self::default();
        for chapter in context["chapters"].as_array().unwrap() {
            let mut add = |one: &Value| {
                let word = |value: &Value| value.as_str().unwrap().to_owned();
                said.places.insert((word(&chapter["page"]), word(&one["anchor"])));
            };
            for section in chapter["sections"].as_array().unwrap() {
                add(section);
                for table in section["tables"].as_array().unwrap() {
                    add(table);
                    if !table["figure"].is_null() {
                        add(&table["figure"]);
                    }
                }
            }
        }
        said.read(context);
        said
    }
}

#[test]
fn every_number_that_the_shipped_documents_have_is_a_link() {
    for (spec, language, least) in
        [(PITCH, "en", 700), (PITCH, "de", 700), (FULLMO, "de", 150), (FULLMO, "en", 100)]
    {
        let Said { places, links, texts } = Said::of(spec, language);
        let mut to_numbers = 0;
        for (page, anchor, text) in links {
            assert!(places.contains(&(page, anchor.clone())), "{spec}: `{text}` leads nowhere");
            // A link that is not a number in a text is one of the lists.
            let number = anchor.rsplit_once('-').unwrap().1;
            let is_number = text.trim_end_matches(number).len() < text.len();
            to_numbers += usize::from(is_number);
        }
        assert!(to_numbers >= least, "{spec}, {language}: only {to_numbers} links");
        let plain = texts.iter().flat_map(|text| named(text).into_iter().map(move |anchor| (anchor, text)));
        // The only other document that a text names with a table's number.
        let plain = plain.filter(|(_, text)| !text.contains("CiA 301 v4.02, 9.6.3"));
        for (anchor, text) in plain {
            assert!(!places.iter().any(|(_, place)| *place == anchor), "{spec}: no link in `{text}`");
        }
    }
}
