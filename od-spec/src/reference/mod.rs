//! The language reference: the key tables as Markdown, with the rules that no table can hold between them.
//!
//! What a single key means stands in [`crate::keys`] and nowhere else; the paragraphs here are about what several
//! keys have to do with each other.

mod prose;

use std::fmt::Write as _;

use crate::compile::LIBRARIES;
use crate::diag::Diagnostics;
use crate::json_schema::{slug, title};
use crate::keys::{self, ENTRY, Key, KeyKind, Keys, Shape};
use crate::model::DataType;
use crate::source::SourceMap;
use crate::yaml::{self, Node};
use prose::{
    ALIASES, AXES, BITS, CONSTRAINTS, DEVICES, EDS, ENTRIES, ERRATA, ERRATUM_RULES, ERRORS, FEATURES, FILES,
    INHERITANCE, INTRODUCTION, MACHINES, MANUAL, NAMING, OBJECTS, OUTSIDE, PDOS, READING, ROUNDING, SPECIAL,
    STORAGE, SUB0, TABLES, TOP, TYPES, UNITS, USES,
};

/// Prints the language reference in Markdown.
pub fn reference() -> String {
    let mut out = String::from(INTRODUCTION);
    for chapter in CHAPTERS {
        let _ = write!(out, "\n## {}\n", chapter.title);
        paragraph(chapter.text, &mut out);
        for section in chapter.sections {
            let _ = write!(out, "\n### {}\n\n", heading(section.keys));
            table(section.keys, &mut out);
            paragraph(section.rules, &mut out);
        }
    }
    for (mark, words) in WORDS {
        out = out.replace(mark, &word_table(words));
    }
    let types = DataType::ALL.map(|data_type| format!("`{}`", data_type.name())).join(", ");
    out.replace("{TYPES}", &types).replace("{FEATURES}", &features())
}

/// The features of the built-in libraries, in the words of the libraries.
fn features() -> String {
    let mut out = String::new();
    for (name, text) in LIBRARIES {
        out.push_str(if out.is_empty() { "" } else { "\n" });
        let _ =
            write!(out, "Of the library `{name}`:\n\n| Feature | Objects | Meaning |\n| --- | --- | --- |\n");
        let mut sources = SourceMap::new();
        let id = sources.add(*name, *text);
        let library = yaml::parse(id, sources.file(id), &mut Diagnostics::new());
        let features = library.as_ref().and_then(|library| library.get("features"));
        for (feature, facts) in features.map(Node::entries).unwrap_or_default() {
            let text = |key: &str| facts.get(key).and_then(Node::text).map_or("", |text| text.value);
            let objects: Vec<&str> = facts
                .get("objects")
                .map(Node::items)
                .unwrap_or_default()
                .iter()
                .filter_map(|index| index.text()?.value.strip_prefix("0x"))
                .collect();
            let objects = objects.iter().map(|index| format!("{index}h")).collect::<Vec<_>>().join(", ");
            let implied = if text("implied") == "yes" { ", implied" } else { "" };
            let _ = writeln!(out, "| `{}`{implied} | {objects} | {} |", feature.value, cell(text("about")));
        }
    }
    out.truncate(out.trim_end().len());
    out
}

fn paragraph(text: &str, out: &mut String) {
    if !text.is_empty() {
        let _ = write!(out, "\n{}\n", text.trim());
    }
}

/// `an EDS header` → `EDS header`, `a device` → `Device`.
fn heading(keys: &Keys) -> String {
    let mut letters = title(keys.name).chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn link(keys: &Keys) -> String {
    format!("[{}](#{})", keys.name, slug(keys.name))
}

/// One row per key. Keys that a map shares with entries are named below the table only.
fn table(keys: &Keys, out: &mut String) {
    let (own, shared) = split(keys);
    let examples = own.iter().any(|key| key.example.is_some());
    out.push_str(if examples {
        "| Key | Value | Required | Meaning | Example |\n| --- | --- | --- | --- | --- |\n"
    } else {
        "| Key | Value | Required | Meaning |\n| --- | --- | --- | --- |\n"
    });
    for key in own {
        let required = if key.required { "yes " } else { "" };
        let _ =
            write!(out, "| `{}` | {} | {required}| {} |", key.name, cell(&value(key.shape)), cell(key.about));
        if examples {
            let example = key.example.map(|example| format!(" `{}`", cell(example))).unwrap_or_default();
            let _ = write!(out, "{example} |");
        }
        out.push('\n');
    }
    if !shared.is_empty() {
        let names = shared.iter().map(|key| format!("`{}`", key.name)).collect::<Vec<_>>().join(", ");
        let _ = write!(out, "\nAnd these keys of {}: {names}.\n", link(&ENTRY));
    }
}

/// A map's own keys, and those that it shares with entries if it has all that an entry can say about its value.
fn split(keys: &Keys) -> (Vec<&Key>, Vec<&Key>) {
    let is_shared =
        |key: &&Key| ENTRY.keys.iter().any(|entry| entry.name == key.name && entry.about == key.about);
    let shared = keys.keys.iter().filter(is_shared).count();
    if keys.name == ENTRY.name || shared + 1 < ENTRY.keys.len() {
        return (keys.keys.iter().collect(), Vec::new());
    }
    // An object's name is its own even where the words are the same.
    keys.keys.iter().partition(|key| key.name == "name" || !is_shared(key))
}

fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// What a value looks like, in a few words.
fn value(shape: Shape) -> String {
    match shape {
        Shape::Text => "text".to_owned(),
        Shape::Words => "text, or text by language".to_owned(),
        Shape::Choice(words) => one_of(words),
        Shape::YesNo => one_of(&["yes", "no"]),
        Shape::Integer(low, high) if low == high => format!("`{low}`"),
        Shape::Integer(low, high) => format!("integer, {low} to {}", limit(high)),
        Shape::Date => "date".to_owned(),
        Shape::DateTime => "date and time".to_owned(),
        Shape::Index => "index".to_owned(),
        Shape::Entry => "entry".to_owned(),
        Shape::Access => "access".to_owned(),
        Shape::Type => "type".to_owned(),
        Shape::Value => "value".to_owned(),
        Shape::Ratio => "fraction".to_owned(),
        Shape::Base => "fraction and symbol".to_owned(),
        Shape::Condition => "condition".to_owned(),
        Shape::Formula => "formula".to_owned(),
        Shape::Pattern => "bit pattern".to_owned(),
        Shape::Map(keys) => link(keys),
        Shape::MapOf(kind, inner) => format!("map: {} → {}", key_kind(kind), value(*inner)),
        Shape::List(Shape::List(inner)) => format!("list of lists: {}", value(**inner)),
        Shape::List(inner) => format!("list: {}", value(*inner)),
        Shape::OneOrMore(inner) => format!("{}, or a list of such", value(*inner)),
        Shape::ShortOr(short, keys) => format!("{} or {}", value(*short), link(keys)),
    }
}

fn limit(high: i128) -> String {
    if high >= 0xFFFF { format!("0x{high:X}") } else { high.to_string() }
}

fn one_of(words: &[&str]) -> String {
    let mut words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    let last = words.pop().unwrap_or_default();
    if words.is_empty() { last } else { format!("{} or {last}", words.join(", ")) }
}

const fn key_kind(kind: KeyKind) -> &'static str {
    match kind {
        KeyKind::Name => "name",
        KeyKind::DeviceKey => "short key of lower-case letters, digits and `-`",
        KeyKind::Language => "language code",
        KeyKind::Indices => "index or indices",
        KeyKind::SubIndex => "sub-index, 1 to 254",
        KeyKind::Bits => "bit or bits",
        KeyKind::Integer => "integer",
        KeyKind::ErrorCodes => "error code or codes",
        KeyKind::PdoNumber => "number, 1 to 512",
        KeyKind::Number => "number, 0 to 255",
    }
}

fn word_table(words: &[(&str, &str)]) -> String {
    let mut out = String::from("| Word | Meaning |\n| --- | --- |");
    for (word, about) in words {
        let _ = write!(out, "\n| `{word}` | {about} |");
    }
    out
}

/// Words of the language that are explained one by one, and where.
const WORDS: [(&str, &[(&str, &str)]); 4] =
    [("{STORAGE}", STORAGE), ("{ERRATA}", ERRATA), ("{ROUNDING}", ROUNDING), ("{OUTSIDE}", OUTSIDE)];

struct Chapter {
    title: &'static str,
    text: &'static str,
    sections: &'static [Section],
}

struct Section {
    keys: &'static Keys,
    rules: &'static str,
}

const fn plain(keys: &'static Keys) -> Section {
    Section { keys, rules: "" }
}

static CHAPTERS: &[Chapter] = &[
    Chapter { title: "How a file is read", text: READING, sections: &[] },
    Chapter { title: "How entries are named", text: NAMING, sections: &[] },
    Chapter {
        title: "The file",
        text: "",
        sections: &[
            Section { keys: &keys::SPEC, rules: TOP },
            plain(&keys::SOURCE),
            plain(&keys::REVISION),
            plain(&keys::VENDOR),
        ],
    },
    Chapter {
        title: "Devices",
        text: "",
        sections: &[
            Section { keys: &keys::DEVICE, rules: DEVICES },
            Section { keys: &keys::FILE, rules: FILES },
        ],
    },
    Chapter {
        title: "Units and types",
        text: "",
        sections: &[
            Section { keys: &keys::UNIT, rules: UNITS },
            Section { keys: &keys::TYPE, rules: TYPES },
            plain(&keys::ENUM_VALUE),
            Section { keys: &keys::BIT, rules: BITS },
            plain(&keys::MODE_BIT),
        ],
    },
    Chapter {
        title: "Objects and entries",
        text: OBJECTS,
        sections: &[
            Section { keys: &keys::OBJECT, rules: INHERITANCE },
            plain(&keys::ARRAY),
            Section { keys: &keys::SUB0, rules: SUB0 },
            Section { keys: &ENTRY, rules: ENTRIES },
            Section { keys: &keys::SPECIAL, rules: SPECIAL },
            Section { keys: &keys::ENTRY_EDS_KEYS, rules: EDS },
        ],
    },
    Chapter { title: "Aliases", text: ALIASES, sections: &[] },
    Chapter {
        title: "Libraries",
        text: USES,
        sections: &[
            Section { keys: &keys::FEATURE, rules: FEATURES },
            Section { keys: &keys::AXES, rules: AXES },
        ],
    },
    Chapter {
        title: "PDOs",
        text: "",
        sections: &[plain(&keys::PDOS), Section { keys: &keys::PDO, rules: PDOS }],
    },
    Chapter { title: "Error codes", text: "", sections: &[Section { keys: &keys::ERROR, rules: ERRORS }] },
    Chapter {
        title: "State machines",
        text: MACHINES,
        sections: &[
            plain(&keys::MACHINE),
            plain(&keys::STATE),
            plain(&keys::TRANSITION),
            plain(&keys::COMMAND),
        ],
    },
    Chapter {
        title: "Constraints",
        text: "",
        sections: &[Section { keys: &keys::CONSTRAINT, rules: CONSTRAINTS }],
    },
    Chapter {
        title: "The printed manual",
        text: MANUAL,
        sections: &[
            Section { keys: &keys::ERRATUM, rules: ERRATUM_RULES },
            plain(&keys::SECTION),
            Section { keys: &keys::TABLE, rules: TABLES },
            plain(&keys::TABLE_PDOS),
            Section { keys: &keys::TABLE_ROWS, rules: "A row has one cell per column." },
        ],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::json_schema::reachable;
    use crate::model::{ErratumKind, Outside, Rounding, Storage};

    #[test]
    fn every_key_table_has_a_section() {
        let sections: Vec<&str> =
            CHAPTERS.iter().flat_map(|chapter| chapter.sections).map(|section| section.keys.name).collect();
        for keys in reachable() {
            assert_eq!(sections.iter().filter(|name| **name == keys.name).count(), 1, "{}", keys.name);
        }
    }

    #[test]
    fn every_word_is_explained() {
        assert!(STORAGE.iter().map(|(word, _)| word).eq(Storage::WORDS));
        assert!(ERRATA.iter().map(|(word, _)| word).eq(ErratumKind::WORDS));
        assert!(ROUNDING.iter().map(|(word, _)| word).eq(Rounding::WORDS));
        assert!(OUTSIDE.iter().map(|(word, _)| word).eq(Outside::WORDS));
    }

    #[test]
    fn every_link_leads_somewhere() {
        let text = reference();
        let anchor = |line: &str| {
            line.trim_start_matches('#').trim().to_lowercase().replace(' ', "-").replace('\'', "")
        };
        let anchors: Vec<String> = text.lines().filter(|line| line.starts_with('#')).map(anchor).collect();
        for link in text.split("](#").skip(1).filter_map(|rest| rest.split(')').next()) {
            assert!(anchors.iter().any(|anchor| anchor == link), "#{link}");
        }
        let marks = WORDS.iter().map(|(mark, _)| *mark).chain(["{TYPES}", "{FEATURES}"]);
        assert!(marks.into_iter().all(|mark| !text.contains(mark)));
    }
}
