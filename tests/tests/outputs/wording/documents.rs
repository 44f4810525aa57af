//! What the Markdown documents say, in each language.

use std::collections::BTreeMap;

use od_spec::model::{Access, Entry};

use super::Output;
use super::facts::{Facts, Limits, Reach, Reported};
use super::markdown::{Page, Table};
use super::read::{self, Range};

/// The column titles of a language.
pub(crate) struct Titles {
    pub language: &'static str,
    access: &'static str,
    default: &'static str,
    unit: &'static str,
    range: &'static str,
    stored: &'static str,
    description: &'static str,
}

pub(crate) const ENGLISH: Titles = Titles {
    language: "en",
    access: "Attr",
    default: "Default",
    unit: "Unit",
    range: "Range",
    stored: "Stored",
    description: "Description",
};

pub(crate) const GERMAN: Titles = Titles {
    language: "de",
    access: "Zugriff",
    default: "Vorgabe",
    unit: "Einheit",
    range: "Bereich",
    stored: "Gespeichert",
    description: "Beschreibung",
};

/// Reads the page of one device.
pub(crate) fn read(page: &Page, titles: &Titles, output: &mut Output<'_>) {
    for object in output.device.objects.values() {
        let anchor = format!("{:04X}", object.index.0);
        let table = page.tables.iter().find(|table| table.anchors.contains(&anchor)).unwrap();
        for row in &table.rows {
            let sub = if object.is_structured() { row[0].parse().unwrap() } else { 0 };
            output.report(object.index.0, sub, |entry| facts(entry, table, row, titles));
        }
    }
}

fn reach(words: &str) -> Reach {
    match words {
        "r(w)" => Reach::ReadAndServiceWrites,
        "(w)" => Reach::ServiceWrites,
        word => Reach::of(Access::from_word(word).unwrap(), false),
    }
}

fn facts(entry: &Entry, table: &Table, row: &[String], titles: &Titles) -> Facts {
    // A column that nothing fills is left out.
    let cell = |title: &str| {
        table.columns.iter().position(|column| column == title).map_or("", |at| row[at].as_str())
    };
    let reported = |title: &'static str| Some(cell(title)).filter(|text| !text.is_empty());
    let Range { low, high } =
        reported(titles.range).map(|text| read::range(entry, text).unwrap()).unwrap_or_default();
    Facts {
        default: Reported::Said(reported(titles.default).map(|text| read::value(entry, text))),
        limits: Limits::Narrowing { low, high },
        step: reported(titles.unit).map(read::step),
        special: special(entry, cell(titles.description), titles.language),
        reach: reach(cell(titles.access)),
        storage: read::storage(cell(titles.stored)).unwrap(),
        mapping: read::mapping(cell("Map")).unwrap(),
    }
}

/// The special values among the lines after the meaning; more about one follows after its name.
fn special(entry: &Entry, description: &str, language: &str) -> BTreeMap<i128, String> {
    let meaning = entry.about.get(language).unwrap_or_default().replace('\n', " ");
    let rest = description.strip_prefix(&meaning).unwrap_or(description);
    let lines = rest.lines().filter_map(|line| read::listed(entry, line));
    lines.map(|listed| (listed.raw, listed.name.split("; ").next().unwrap().to_owned())).collect()
}
