//! Compares a file with copies of itself in which one key has another value: the difference is reported, of its weight,
//! and no other.

use od_diff::{Change, Class, Question, Scope, compare};
use od_spec::model::{Fact, Index, System};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

/// Most sections of a file in which a key is changed.
const MOST_SECTIONS: usize = 8;

/// A line with the key of an entry that is by itself: a VAR, or what is under a sub-index other than 0.
struct KeyLine<'t> {
    index: Index,
    key: &'t str,
    value: &'t str,
    /// Where the value is in the text.
    at: usize,
}

/// Another value for a key, and what has to be reported about it.
struct Edit {
    value: String,
    fact: Fact,
    /// The least weight of the change.
    class: Class,
}

/// What is reported wrongly, a line each.
pub(super) fn run(name: &str, text: &str) -> Result<Vec<String>, String> {
    let original = system(name, text)?;
    let mut problems = Vec::new();
    for change in changes(&original, &system(name, text)?)? {
        problems.push(format!("differs from itself: {}", reported(&change)));
    }
    for (line, edit) in edits(text) {
        let copy = format!("{}{}{}", &text[..line.at], edit.value, &text[line.at + line.value.len()..]);
        let found = changes(&original, &system(name, &copy)?)?;
        let what = format!("{} {}={} -> {}", line.index, line.key, line.value, edit.value);
        let is_told = |change: &Change| {
            change.place.index() == Some(line.index)
                && change.fact == edit.fact
                && change.class() >= edit.class
        };
        if !found.iter().any(is_told) {
            let others: Vec<String> = found.iter().map(reported).collect();
            problems.push(format!("{what} is not reported, but: {}", others.join("; ")));
        }
        // A PDO that maps the entry changes with it.
        let is_elsewhere = |change: &&Change| {
            let index = change.place.index();
            index.is_some_and(|index| index != line.index && !(0x1400..0x1C00).contains(&index.0))
        };
        if let Some(change) = found.iter().find(is_elsewhere) {
            problems.push(format!("{what} reports another object: {}", reported(change)));
        }
    }
    Ok(problems)
}

fn system(name: &str, text: &str) -> Result<System, String> {
    let mut sources = SourceMap::new();
    let root = sources.add(name, text);
    compile(&mut sources, root, &mut NoFiles).system.ok_or_else(|| "no model".to_owned())
}

fn changes(old: &System, new: &System) -> Result<Vec<Change>, String> {
    let question = Question { old, new, scope: Scope::WhatAnEdsStates, device: None, nodes: None };
    let found = compare(&question).map_err(|unpaired| unpaired.to_string())?;
    Ok(found.changes().cloned().collect())
}

fn reported(change: &Change) -> String {
    let none = "none".to_owned();
    let (before, after) = (change.before.as_ref().unwrap_or(&none), change.after.as_ref().unwrap_or(&none));
    format!("{:?} {}: {before} -> {after} ({})", change.place, change.fact.word(), change.class().word())
}

/// Some changes from the whole text, each of another key than the one before.
fn edits(text: &str) -> Vec<(KeyLine<'_>, Edit)> {
    let sections: Vec<_> = sections(text).into_iter().map(|(index, lines)| key_lines(index, lines)).collect();
    let sections: Vec<_> = sections.into_iter().filter(|lines| !lines.is_empty()).collect();
    let step = sections.len().div_ceil(MOST_SECTIONS).max(1);
    let mut edits = Vec::new();
    for (number, lines) in sections.into_iter().step_by(step).enumerate() {
        let mut of_section: Vec<_> =
            lines.into_iter().filter_map(|line| Some((edit(&line)?, line))).collect();
        let at = number % of_section.len().max(1);
        if at < of_section.len() {
            let (edit, line) = of_section.swap_remove(at);
            edits.push((line, edit));
        }
    }
    edits
}

/// The sections of entries that other rules do not know by their index, each with its lines and where they are.
fn sections(text: &str) -> Vec<(Index, Vec<(usize, &str)>)> {
    let mut sections: Vec<(&str, Vec<(usize, &str)>)> = Vec::new();
    let mut at = 0;
    for line in text.split_inclusive(['\n', '\r']) {
        let trimmed = line.trim();
        match trimmed.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            Some(name) => sections.push((name.trim(), Vec::new())),
            None => {
                if let Some((_, lines)) = sections.last_mut() {
                    lines.push((at, line));
                }
            }
        }
        at += line.len();
    }
    let names: Vec<String> = sections.iter().map(|(name, _)| name.to_ascii_lowercase()).collect();
    // Some files have a section twice, once as `[0x2000]`.
    let is_single = |name: &str| {
        names.iter().filter(|one| one.trim_start_matches("0x").eq_ignore_ascii_case(name)).count() == 1
    };
    // What is at an object with sub-indices, its sub-indices say.
    let has_subs =
        |name: &str| names.iter().any(|one| one.starts_with(&format!("{}sub", name.to_ascii_lowercase())));
    let of_entry = |(name, lines): (&str, _)| {
        Some((entry_of(name).filter(|_| is_single(name) && !has_subs(name))?, lines))
    };
    sections.into_iter().filter_map(of_entry).collect()
}

/// The index in `2000` and `2000sub1`.
fn entry_of(name: &str) -> Option<Index> {
    let (index, rest) = name.split_at_checked(4)?;
    let index = Index(u16::from_str_radix(index, 16).ok()?);
    let lower = rest.to_ascii_lowercase();
    let sub = lower.strip_prefix("sub").and_then(|sub| u8::from_str_radix(sub, 16).ok());
    let is_element = sub.is_some_and(|sub| (1..=0xFE).contains(&sub));
    let has_rules = index.0 < 0x2000 || index.0 >= 0xA000;
    ((rest.is_empty() || is_element) && !has_rules).then_some(index)
}

/// The keys of a section, as far as each is there once, and the section is not an array or record.
fn key_lines<'t>(index: Index, lines: Vec<(usize, &'t str)>) -> Vec<KeyLine<'t>> {
    let keys: Vec<KeyLine<'t>> = lines
        .into_iter()
        .filter_map(|(start, line)| {
            let (key, value) = line.split_once('=')?;
            let at = start + key.len() + 1 + (value.len() - value.trim_start().len());
            Some(KeyLine { index, key: key.trim(), value: value.trim(), at })
        })
        .collect();
    let value =
        |key: &str| keys.iter().find(|one| one.key.eq_ignore_ascii_case(key)).map(|one| number(one.value));
    let is_var = matches!(value("ObjectType"), None | Some(Some(7)));
    let is_plain =
        value("SubNumber").is_none() && value("CompactSubObj").is_none() && value("DataType").is_some();
    if !is_var || !is_plain {
        return Vec::new();
    }
    let is_number = matches!(value("DataType"), Some(Some(2..=7)));
    // A key that is written twice, once with a character too many, is one key.
    let count = |key: &str| keys.iter().filter(|one| letters(one.key) == letters(key)).count();
    let single: Vec<bool> = keys.iter().map(|one| count(one.key) == 1).collect();
    let lines = keys.into_iter().zip(single).filter_map(|(line, is_single)| is_single.then_some(line));
    lines.filter(|line| is_number || !line.key.eq_ignore_ascii_case("DefaultValue")).collect()
}

/// The letters and digits of a key, in lower case.
fn letters(key: &str) -> String {
    key.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect()
}

fn number(text: &str) -> Option<i64> {
    match text.get(..2) {
        Some("0x" | "0X") => i64::from_str_radix(&text[2..], 16).ok(),
        _ => text.parse().ok(),
    }
}

/// Another value for a key.
fn edit(line: &KeyLine<'_>) -> Option<Edit> {
    let to = |value: &str, fact, class| Some(Edit { value: value.to_owned(), fact, class });
    let value = line.value.to_ascii_lowercase();
    match line.key.to_ascii_lowercase().as_str() {
        "parametername" if value.len() > 2 && value.len() < 200 => {
            to(&format!("{}X", line.value), Fact::Name, Class::Documents)
        }
        "datatype" => match number(&value)? {
            5 => to("0x0006", Fact::Type, Class::Plc),
            2 | 3 | 4 | 6 | 7 => to("0x0005", Fact::Type, Class::Plc),
            _ => None,
        },
        "accesstype" => match value.as_str() {
            "ro" => to("rw", Fact::Access, Class::Addition),
            "rw" => to("ro", Fact::Access, Class::Plc),
            _ => None,
        },
        "pdomapping" => match number(&value)? {
            0 => to("1", Fact::Mapping, Class::Addition),
            1 => to("0", Fact::Mapping, Class::Plc),
            _ => None,
        },
        "defaultvalue" => match number(&value)? {
            0 => to("1", Fact::Default, Class::Behaviour),
            1..100 => to("0", Fact::Default, Class::Behaviour),
            _ => None,
        },
        _ => None,
    }
}
