//! Names of objects and entries that the language takes: each of its own, and such that an EDS can hold it.

use std::collections::BTreeSet;

use od_spec::ascii::transliterate;
use od_spec::model::{DataType, Dictionary, EntryId, Fact, Index, ObjectKind, SubIndex};

use super::options::Place;
use super::remarks::Repair;

/// Longest name, as the rule about names has it.
const LONGEST: usize = 241;

/// Gives every object and entry a name that the language takes.
pub(super) fn settle(device: &mut Dictionary, repairs: &mut Vec<Repair>) {
    settle_entries(device, repairs);
    settle_objects(device, repairs);
}

fn settle_objects(device: &mut Dictionary, repairs: &mut Vec<Repair>) {
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let mut full: BTreeSet<String> = BTreeSet::new();
    for object in device.objects.values_mut() {
        let original = object.name.clone();
        let plain = fitting(&original, || format!("object {}", object.index));
        let entries = if object.is_structured() { object.entries.as_slice() } else { &[] };
        let with_entries = |name: &str| {
            let names = entries.iter().map(|entry| transliterate(&format!("{name}.{}", entry.name)));
            names.collect::<Vec<_>>()
        };
        let is_free = |name: &str| {
            let ascii = transliterate(name);
            !taken.contains(&ascii)
                && !full.contains(&ascii)
                && DataType::from_name(name).is_none()
                && !with_entries(name).iter().any(|full| taken.contains(full))
        };
        let index = object.index;
        let suffixed = std::iter::once(format!(" ({index})"))
            .chain((2u32..).map(|number| format!(" ({index}) {number}")));
        let name = first_free(&plain, suffixed, is_free);
        taken.insert(transliterate(&name));
        full.extend(with_entries(&name));
        if name != original {
            repairs.push(renamed(Place::Object(index), &original, &name));
            object.name.clone_from(&name);
        }
        if !object.is_structured() {
            object.entries.iter_mut().for_each(|entry| entry.name.clone_from(&name));
        }
    }
}

fn settle_entries(device: &mut Dictionary, repairs: &mut Vec<Repair>) {
    for object in device.objects.values_mut().filter(|object| object.is_structured()) {
        let (index, is_array) = (object.index, object.kind == ObjectKind::Array);
        let alike: BTreeSet<String> = object
            .entries
            .iter()
            .filter(|one| {
                is_array && object.entries.iter().filter(|entry| entry.name == one.name).count() > 1
            })
            .map(|entry| entry.name.clone())
            .collect();
        let mut taken: BTreeSet<String> = BTreeSet::new();
        for entry in &mut object.entries {
            let (original, sub) = (entry.name.clone(), entry.sub);
            let mut plain = fitting(&original, || format!("entry {sub}"));
            // In an array, `{n}` would stand for the sub-index.
            if is_array {
                plain = plain.replace("{n}", "(n)");
            }
            // Elements of one name are numbered.
            if alike.contains(&original) && sub.0 > 0 && !original.trim().is_empty() {
                plain = cut(&plain, &format!(" {sub}"));
            }
            let suffixed = std::iter::once(format!(" (sub {sub})"))
                .chain((2u32..).map(|number| format!(" (sub {sub}) {number}")));
            let name = first_free(&plain, suffixed, |name| !taken.contains(&transliterate(name)));
            taken.insert(transliterate(&name));
            if name != original {
                repairs.push(renamed(Place::Entry(EntryId { index, sub }), &original, &name));
                entry.name = name;
            }
        }
    }
}

fn renamed(place: Place, original: &str, now: &str) -> Repair {
    let because = if original.trim().is_empty() {
        "a name is wanted".to_owned()
    } else if fitting(original, String::new) == original {
        "each name stands for one thing".to_owned()
    } else {
        "no line of an EDS holds the name as it is".to_owned()
    };
    Repair {
        place,
        fact: Some(Fact::Name),
        original: format!("\"{original}\""),
        now: Some(now.to_owned()),
        because,
    }
}

/// The name itself, or with the first ending that makes it free.
fn first_free(name: &str, endings: impl Iterator<Item = String>, is_free: impl Fn(&str) -> bool) -> String {
    let with_endings = endings.map(|ending| cut(name, &ending));
    std::iter::once(name.to_owned())
        .chain(with_endings)
        .find(|name| is_free(name))
        .unwrap_or_else(|| name.to_owned())
}

/// A name with an ending, cut so that both fit.
fn cut(name: &str, ending: &str) -> String {
    let kept = shortened(name, LONGEST.saturating_sub(ending.len()));
    format!("{}{ending}", kept.trim_end())
}

/// The front of a text that has at most so many characters in an EDS.
pub(super) fn shortened(text: &str, longest: usize) -> &str {
    // Characters are transcribed one by one, each for itself.
    let mut length = 0;
    let too_long = |c: char| {
        length += transliterate(c.encode_utf8(&mut [0; 4])).len();
        length > longest
    };
    let end = text.char_indices().zip(text.chars().map(too_long)).find(|(_, is_over)| *is_over);
    end.map_or(text, |((end, _), _)| &text[..end])
}

/// The text of a name or of the header as a line can hold it; what another text gives where nothing is left.
fn fitting(text: &str, otherwise: impl Fn() -> String) -> String {
    let plain = readable(text);
    let ascii = transliterate(&plain);
    let has_form = ascii.chars().any(|c| c != '?') || plain.contains('?');
    if plain.is_empty() || !has_form { otherwise() } else { cut(&plain, "") }
}

/// A text on one line, without control characters.
pub(super) fn readable(text: &str) -> String {
    text.replace(char::is_control, " ").trim().to_owned()
}

/// A name that nothing else has: with the index, or with the sub-index.
pub(super) fn apart(name: &str, index: Index, sub: Option<SubIndex>) -> String {
    let ending = sub.map_or_else(|| format!(" ({index})"), |sub| format!(" (sub {sub})"));
    if name.ends_with(&ending) {
        return sub.map_or_else(|| format!("object {index}"), |sub| format!("entry {sub}"));
    }
    cut(&readable(name), &ending)
}
