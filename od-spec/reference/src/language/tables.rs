//! A table of keys as Markdown.

use std::fmt::Write as _;

use crate::json_schema::{slug, title};
use od_spec::keys::{Choice, ENTRY, Key, KeyKind, Keys, Need, Shape, VERSION};

/// The section about one kind of map: its heading and its keys.
pub(super) fn section(keys: &Keys, level: &str) -> String {
    let mut out = format!("{level} {}\n\n", heading(keys));
    table(keys, &mut out);
    out.truncate(out.trim_end().len());
    out
}

/// `an EDS header` → `EDS header`, `a device` → `Device`.
fn heading(keys: &Keys) -> String {
    let mut letters = title(keys.name).chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn link(keys: &Keys) -> String {
    format!("[{}](#{})", keys.name, slug(keys.name))
}

/// A link without an article.
pub(super) fn short_link(keys: &Keys) -> String {
    format!("[{}](#{})", title(keys.name), slug(keys.name))
}

/// One row per key, then which keys depend on each other. Keys that a map shares with entries are named below only.
fn table(keys: &Keys, out: &mut String) {
    let TableKeys { explained, shared } = split(keys);
    let examples = explained.iter().any(|key| key.example.is_some());
    out.push_str(if examples {
        "| Key | Value | Required | Meaning | Example |\n| --- | --- | --- | --- | --- |\n"
    } else {
        "| Key | Value | Required | Meaning |\n| --- | --- | --- | --- |\n"
    });
    for key in explained {
        let (name, value, about) = (key.name, cell(&value(key.shape)), cell(key.about));
        let _ = write!(out, "| `{name}` | {value} | {}| {about} |", required(key, keys));
        if examples {
            let example = key.example.map(|example| format!(" `{}`", cell(example))).unwrap_or_default();
            let _ = write!(out, "{example} |");
        }
        out.push('\n');
    }
    for choice in keys.choices {
        let _ = write!(out, "\n{}\n", sentence(*choice));
    }
    if !shared.is_empty() {
        let names = shared.iter().map(|key| format!("`{}`", key.name)).collect::<Vec<_>>();
        let _ = write!(out, "\nAnd these keys of {}: {}.\n", link(&ENTRY), names.join(", "));
    }
}

/// The cell that says whether a key is required.
fn required(key: &Key, keys: &Keys) -> &'static str {
    let is_of =
        |choice: &&Choice| choice.keys().contains(&key.name) && !matches!(choice, Choice::Together(_));
    match (key.need, keys.choices.iter().find(is_of)) {
        (Need::Required, _) => "yes ",
        (Need::Inherited, _) => "unless inherited ",
        (Need::Optional, Some(_)) => "one of ",
        (Need::Optional, None) => "",
    }
}

/// How keys depend on each other. Of many, only their rows name them.
fn sentence(choice: Choice) -> String {
    const FEW: usize = 4;
    let keys = choice.keys();
    let names = if keys.len() <= FEW { joined(keys, "and") } else { "the keys marked \"one of\"".to_owned() };
    match choice {
        Choice::One(_) => format!("Exactly one of {names} is required."),
        Choice::Any(_) => format!("At least one of {names} is required."),
        Choice::AnyInherited(_) => format!("At least one of {names} is required, unless inherited."),
        Choice::Together(_) => format!("{names} are used together."),
    }
}

/// The keys that have a row of their own.
pub(super) fn explained(keys: &Keys) -> Vec<&Key> {
    split(keys).explained
}

/// The keys of a map in the reference.
struct TableKeys<'a> {
    /// Those that have a row.
    explained: Vec<&'a Key>,
    /// Those that the map shares with entries.
    shared: Vec<&'a Key>,
}

/// Parts off the keys that a map shares with entries, if it has all that an entry can say about its value.
fn split(keys: &Keys) -> TableKeys<'_> {
    let is_shared =
        |key: &&Key| ENTRY.keys.iter().any(|entry| entry.name == key.name && entry.about == key.about);
    let count = keys.keys.iter().filter(is_shared).count();
    if keys.name == ENTRY.name || count + 1 < ENTRY.keys.len() {
        return TableKeys { explained: keys.keys.iter().collect(), shared: Vec::new() };
    }
    // An object's name is explained even where the words are the same.
    let (explained, shared) = keys.keys.iter().partition(|key| key.name == "name" || !is_shared(key));
    TableKeys { explained, shared }
}

pub(super) fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// What a value looks like, in a few words.
fn value(shape: Shape) -> String {
    match shape {
        Shape::Text | Shape::NameOf(_) => "text".to_owned(),
        Shape::HeaderText => "text, or `\"\"`".to_owned(),
        Shape::Words => "text, or text by language".to_owned(),
        Shape::Choice(words) => one_of(words),
        Shape::YesNo => one_of(&["yes", "no"]),
        Shape::Version => format!("`{VERSION}`"),
        Shape::Integer(low, high) => format!("integer, {low} to {}", limit(high)),
        Shape::Date => "date".to_owned(),
        Shape::DateTime => "date and time".to_owned(),
        Shape::Index => "index".to_owned(),
        Shape::ErrorCode => "error code".to_owned(),
        Shape::Default => "value, list: value or bit, or map: device → value or list".to_owned(),
        Shape::Setting => "value, list of bits, or map: entry → value or list".to_owned(),
        Shape::Entry => "entry".to_owned(),
        Shape::Entries => "entry or entries".to_owned(),
        Shape::Access => "access".to_owned(),
        Shape::Type => "type".to_owned(),
        Shape::Value => "value".to_owned(),
        Shape::Ratio => "fraction".to_owned(),
        Shape::SignedRatio => "fraction, which may be negative".to_owned(),
        Shape::Base => "fraction and symbol".to_owned(),
        Shape::Time => "time".to_owned(),
        Shape::Numbers => "number or numbers".to_owned(),
        Shape::Condition => "condition".to_owned(),
        Shape::Formula => "formula".to_owned(),
        Shape::Pattern => "bit pattern".to_owned(),
        Shape::NumberedName(_) => "name with placeholders".to_owned(),
        Shape::Map(keys) => link(keys),
        Shape::MapOf(kind, inner) => format!("map: {} → {}", key_kind(kind), value(*inner)),
        Shape::List(Shape::List(inner)) => format!("list of lists: {}", value(**inner)),
        Shape::List(inner) => format!("list: {}", value(*inner)),
        Shape::OneOrMore(inner) => format!("{}, or a list of such", value(*inner)),
        Shape::ShortOr(short, keys) => format!("{} or {}", value(*short), link(keys)),
        Shape::Feature => "text, or text, a colon and a number".to_owned(),
    }
}

fn limit(high: i128) -> String {
    if high >= 0xFFFF { format!("0x{high:X}") } else { high.to_string() }
}

fn one_of(words: &[&str]) -> String {
    joined(words, "or")
}

/// Words as code, with another word before the last one.
fn joined(words: &[&str], before_last: &str) -> String {
    let mut words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    let last = words.pop().unwrap_or_default();
    if words.is_empty() { last } else { format!("{} {before_last} {last}", words.join(", ")) }
}

const fn key_kind(kind: KeyKind) -> &'static str {
    match kind {
        KeyKind::Name | KeyKind::Device => "name",
        KeyKind::DeviceKey => "short key of lower-case letters, digits and `-`",
        KeyKind::Language => "language code",
        KeyKind::Indices => "index or indices",
        KeyKind::SubIndex => "sub-index, 1 to 254",
        KeyKind::SubIndices => "sub-index or sub-indices, 1 to 254",
        KeyKind::Bits => "bit or bits",
        KeyKind::Integer => "integer",
        KeyKind::ErrorCodes => "error code or codes",
        KeyKind::Place => "name",
        KeyKind::Machines => "name, number or run",
        KeyKind::PdoNumber => "number, 1 to 512",
        KeyKind::Number => "number, 0 to 255",
    }
}
