//! What the documentation of generated Rust says.

use std::collections::BTreeMap;

use od_spec::model::{Access, BitErrors, Entry, PdoMapping, Storage};

use super::Output;
use super::facts::{Facts, Limits, Reach, Reported};
use super::read::{self, Range};

/// Where the facts of an entry end and sentences begin.
const SENTENCES: [&str; 6] =
    [". In ", ". A view of ", ". 8-bit view: ", ". 16-bit view: ", ". Writable while ", ". Errors: "];

/// Reads the module of one device.
pub(crate) fn read(module: &str, output: &mut Output<'_>) {
    let mut lines: Vec<&str> = Vec::new();
    for line in module.lines().map(str::trim) {
        // A paragraph of its own, between heading and facts.
        if line.starts_with("/// **Warning:** ") {
            assert_eq!(lines.pop(), Some("///"), "{line}");
        } else {
            lines.push(line);
        }
    }
    for line in &lines {
        read_member(line, output);
    }
    for (at, window) in lines.windows(3).enumerate() {
        let [heading, "///", facts] = window else { continue };
        let Some(id) = heading.strip_prefix("/// `").and_then(|rest| rest.split_once('`')) else { continue };
        let (index, sub) = id.0.split_once("h.").unwrap_or((id.0.trim_end_matches('h'), "0"));
        let index = u16::from_str_radix(index, 16).unwrap();
        let facts = facts.strip_prefix("/// ").unwrap();
        // An object is not an entry; the facts of its members are there.
        let is_object = facts.starts_with("The group of ") || facts.starts_with("- `");
        if is_object {
            continue;
        }
        // An accessor by sub-index is about all elements; what only some have in common, is below.
        match heading.split_once("`sub` is the sub-index, 1 to ") {
            Some((_, rest)) => {
                let last: u8 = rest.split(';').next().unwrap().parse().unwrap();
                let own = of_elements(lines.get(at + 3..).unwrap_or_default());
                for sub in 1..=last {
                    let facts = match own.get(&sub).filter(|own| own.starts_with(char::is_lowercase)) {
                        Some(own) => format!("{}, {own}", facts.strip_suffix('.').unwrap()),
                        None => (*facts).to_owned(),
                    };
                    output.report(index, sub, |entry| read_facts(entry, &facts));
                }
            }
            None => output.report(index, sub.parse().unwrap(), |entry| read_facts(entry, facts)),
        }
    }
}

/// What is said of single elements: `- Sub-index 2 to 8: facts.`
fn of_elements<'a>(lines: &[&'a str]) -> BTreeMap<u8, &'a str> {
    let ["///", list @ ..] = lines else { return BTreeMap::new() };
    let mut own = BTreeMap::new();
    for (subs, facts) in list.iter().map_while(|line| line.strip_prefix("/// - Sub-index ")?.split_once(": "))
    {
        let (first, last) = subs.split_once(" to ").unwrap_or((subs, subs));
        let subs = first.parse::<u8>().unwrap()..=last.parse().unwrap();
        own.extend(subs.map(|sub| (sub, facts)));
    }
    own
}

/// A member of an object whose group of accessors others have as well: `` - `1400h.1` name: facts. ``
fn read_member(line: &str, output: &mut Output<'_>) {
    let Some((id, text)) = line.strip_prefix("/// - `").and_then(|rest| rest.split_once("` ")) else {
        return;
    };
    let Some((index, sub)) = id.split_once("h.") else { return };
    let index = u16::from_str_radix(index, 16).unwrap();
    output.report(index, sub.parse().unwrap(), |entry| {
        let facts = text.replace('\\', "");
        let facts = facts.strip_prefix(&format!("{}: ", entry.name));
        read_facts(entry, facts.unwrap_or_else(|| panic!("{text} is not about {}", entry.name)))
    });
}

fn read_facts(entry: &Entry, text: &str) -> Facts {
    let text = text.replace('\\', "");
    assert_eq!(read_errors(&text), entry.bit_errors.iter().map(by_bit).collect(), "{text}");
    let end = SENTENCES.iter().filter_map(|sentence| text.find(sentence)).min();
    let text = end.map_or_else(|| text.strip_suffix('.').unwrap(), |end| &text[..end]);
    let mut parts = text.split(", ");
    assert_eq!(parts.next(), Some(entry.data_type.to_string().as_str()), "{text}");
    let access = parts.next().unwrap();
    let (word, is_locked) = access.strip_suffix(" locked").map_or((access, false), |word| (word, true));
    let mut facts = Facts {
        // A view has no value of its own.
        default: if entry.alias.is_some() { Reported::Elsewhere } else { Reported::Said(None) },
        limits: Limits::Narrowing { low: None, high: None },
        step: None,
        special: BTreeMap::new(),
        reach: Reach::of(Access::from_word(word).unwrap(), is_locked),
        storage: Storage::No,
        mapping: PdoMapping::None,
    };
    for part in parts {
        if let Some(default) = part.strip_prefix("default ") {
            facts.default = Reported::Said(Some(read::value(entry, default)));
        } else if let Some(step) = part.strip_prefix("in ") {
            facts.step = Some(read::step(step));
        } else if let Some(mapping) = read::mapping(part) {
            facts.mapping = mapping;
        } else if let Some(storage) = read::storage(part) {
            facts.storage = storage;
        } else if let Some(listed) = read::listed(entry, part) {
            facts.special.insert(listed.raw, listed.name);
        } else {
            let range = read::range(entry, part);
            let Range { low, high } =
                range.unwrap_or_else(|| panic!("{part:?} of {text:?} says nothing known"));
            facts.limits = Limits::Narrowing { low, high };
        }
    }
    facts
}

/// Error codes by bit: `Errors: 4420h at bit 0, 4410h and 4411h at bit 4.`
fn read_errors(text: &str) -> BTreeMap<u8, Vec<u16>> {
    let Some((_, list)) = text.split_once(" Errors: ") else { return BTreeMap::new() };
    let list = list.split('.').next().unwrap().split(", ");
    let errors = list.map(|errors| {
        let (codes, bit) = errors.split_once(" at bit ").unwrap();
        let codes =
            codes.split(" and ").map(|code| u16::from_str_radix(code.trim_end_matches('h'), 16).unwrap());
        (bit.parse().unwrap(), codes.collect())
    });
    errors.collect()
}

fn by_bit(errors: &BitErrors) -> (u8, Vec<u16>) {
    (errors.bit, errors.error_codes().collect())
}
