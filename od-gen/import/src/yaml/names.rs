//! Names of objects and entries: kept as they are, with identifiers that distinguish equal ones. Only what a
//! specification cannot hold is changed.

use std::collections::BTreeMap;

use od_gen::plan::{Words, tell_apart};
use od_gen::rust::Rust;
use od_spec::ascii::transliterate;
use od_spec::model::{DataType, Dictionary, EntryId, Fact, Index, ObjectKind, usual_pdo_names};
use od_spec::name_pattern::{NamePattern, Numbers};

use super::options::Place;
use super::remarks::Repair;

/// Longest name, as the rule about names has it.
const LONGEST: usize = 241;

/// Gives every object and entry a name that a specification can hold, and an identifier where others have the name, too.
pub(super) fn settle(device: &mut Dictionary, repairs: &mut Vec<Repair>) {
    fit(device, repairs);
    spell_identifiers(device);
    identify_pdos(device);
    for object in device.objects.values_mut() {
        if DataType::from_name(object.label()).is_some() {
            object.identifier = Some(format!("{} {:04X}", object.name, object.index.0));
        }
    }
    tell_apart(device, &Rust);
    spell_identifiers(device);
}

/// An identifier of a specification is spelled as one.
fn spell_identifiers(device: &mut Dictionary) {
    for object in device.objects.values_mut() {
        let of_entries = object.entries.iter_mut().map(|entry| &mut entry.identifier);
        for identifier in of_entries.chain([&mut object.identifier]) {
            let spelled = identifier.take().map(|name| Words::of(&name).snake());
            *identifier = spelled.filter(|name| !name.is_empty());
        }
        // A VAR is its entry.
        if let (ObjectKind::Var | ObjectKind::Domain, [only]) = (object.kind, object.entries.as_mut_slice()) {
            only.identifier.clone_from(&object.identifier);
        }
    }
}

/// Parameter objects of PDOs that have one name are identified by the numbers of their PDOs.
fn identify_pdos(device: &mut Dictionary) {
    let mut count: BTreeMap<String, usize> = BTreeMap::new();
    for object in device.objects.values() {
        *count.entry(transliterate(object.label())).or_default() += 1;
    }
    let mut identify = |index: u16, pdo: u16, usual: &str| {
        let Some(object) = device.objects.get_mut(&Index(index)).filter(|object| object.is_structured())
        else {
            return;
        };
        let numbers = Numbers { pdo, index: object.index, entry: None };
        let is_shared = count.get(&transliterate(object.label())).is_some_and(|count| *count > 1);
        if let Some(usual) = NamePattern::parse(usual).ok().filter(|_| is_shared) {
            object.identifier = Some(Words::of(&usual.fill(numbers)).snake());
        }
    };
    for pdo in &device.pdos {
        identify(pdo.communication_index(), pdo.number, usual_pdo_names::communication(pdo.direction));
        identify(pdo.mapping_index(), pdo.number, usual_pdo_names::mapping(pdo.direction));
    }
}

/// Takes out of names what a specification cannot hold.
fn fit(device: &mut Dictionary, repairs: &mut Vec<Repair>) {
    for object in device.objects.values_mut() {
        let (index, is_array) = (object.index, object.kind == ObjectKind::Array);
        let name = fitting(&object.name, || format!("object {index}"));
        rename(&mut object.name, name, Place::Object(index), repairs);
        if !object.is_structured() {
            object.entries.iter_mut().for_each(|entry| entry.name.clone_from(&object.name));
            continue;
        }
        for entry in &mut object.entries {
            let sub = entry.sub;
            let mut name = fitting(&entry.name, || format!("entry {sub}"));
            // In an array, `{n}` would mean the sub-index.
            if is_array {
                name = name.replace("{n}", "(n)");
            }
            rename(&mut entry.name, name, Place::Entry(EntryId { index, sub }), repairs);
        }
    }
}

fn rename(name: &mut String, now: String, place: Place, repairs: &mut Vec<Repair>) {
    if *name == now {
        return;
    }
    let because = if name.trim().is_empty() {
        "a name is wanted"
    } else if fitting(name, String::new) == *name {
        "`{n}` means the sub-index"
    } else {
        "no line of an EDS holds the name as it is"
    };
    let original = format!("\"{}\"", std::mem::replace(name, now.clone()));
    repairs.push(Repair {
        place,
        fact: Some(Fact::Name),
        original,
        now: Some(now),
        because: because.to_owned(),
    });
}

/// The front of a text that has at most so many characters in an EDS.
fn shortened(text: &str, longest: usize) -> &str {
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
    if plain.is_empty() || !has_form { otherwise() } else { shortened(&plain, LONGEST).trim_end().to_owned() }
}

/// A text on one line, without control characters.
fn readable(text: &str) -> String {
    text.replace(char::is_control, " ").trim().to_owned()
}
