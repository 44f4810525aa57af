//! What the model has no place for: keys of the standard such as `SRDOMapping`, keys and sections of a maker, modules.

use std::collections::{BTreeMap, BTreeSet};

use super::compact;
use crate::eds::check::keys::{self, Keys, RESERVED, UNREAD};
use crate::eds::coded;
use crate::eds::names::{ModuleTopic, Topic, canonical};
use crate::eds::view::{ObjectPart, Part, View};
use crate::model::{Further, FurtherSection, Index, KeyValue, Module};
use crate::order::Arrange as _;

/// Keys of sections, by their names.
pub(super) type KeysBySection = BTreeMap<String, Vec<KeyValue>>;

/// Reads all of a file. `objects` are those of the device, ascending, and `of_modules` are the keys of entries that modules bring.
pub(super) fn read(view: &View<'_>, objects: &[Index], of_modules: KeysBySection) -> Further {
    let has_subs = |_, object: &ObjectPart<'_>, own: &Part<'_>| has_subs(object, own);
    Further {
        comments: Some(view.section(Topic::Comments).map(comments).unwrap_or_default()),
        ..without_comments(view, objects, has_subs, of_modules)
    }
}

/// Reads what is there in addition to the comments. `has_subs` says whether an object has sub-indices.
pub(super) fn without_comments(
    view: &View<'_>,
    objects: &[Index],
    has_subs: impl Fn(Index, &ObjectPart<'_>, &Part<'_>) -> bool,
    of_modules: KeysBySection,
) -> Further {
    let mut further = Further {
        keys: of_modules,
        sections: unknown(view),
        connected: view.connected.clone(),
        ..Further::default()
    };
    for (topic, part) in view.topics() {
        match topic {
            Topic::Module(number, topic) => {
                let module = further.modules.entry(number).or_default();
                add_to_module(module, number, topic, part);
            }
            Topic::Tools | Topic::Tool(_) | Topic::SupportedModules => {
                further.sections.push(FurtherSection::new(name(topic, part), all_keys(topic, part)));
            }
            // What is there and has no meaning is reported where they are read.
            Topic::Elements(..) | Topic::DynamicChannels => {}
            Topic::Object(index) if compact::number(part) > 0 => {
                if objects.binary_search(&index).is_ok() {
                    add_for_elements(view, index, part, &mut further.keys);
                }
            }
            Topic::Object(index) => {
                let has_subs = view.objects.get(&index).is_some_and(|object| has_subs(index, object, part));
                add(&mut further.keys, name(topic, part), further_keys_of(index, part, has_subs));
            }
            Topic::FileInfo
            | Topic::DeviceInfo
            | Topic::DummyUsage
            | Topic::Comments
            | Topic::Objects(_)
            | Topic::Commissioning
            | Topic::Sub(..)
            | Topic::ObjectLinks(_)
            | Topic::ConnectedModules
            | Topic::Unknown => add(&mut further.keys, name(topic, part), further_keys(topic, part)),
        }
    }
    further
}

/// The keys of a section that the model has no place for.
pub(super) fn further_keys(topic: Topic, part: &Part<'_>) -> Vec<KeyValue> {
    last_of_each(part, |key| kept(topic, key, false))
}

/// Those of an object's own section.
pub(super) fn further_keys_of(index: Index, own: &Part<'_>, has_subs: bool) -> Vec<KeyValue> {
    last_of_each(own, |key| kept(Topic::Object(index), key, has_subs))
}

/// Whether the sections of an object say that it has sub-indices.
pub(super) fn has_subs(object: &ObjectPart<'_>, own: &Part<'_>) -> bool {
    let code = own.value("ObjectType").and_then(|text| coded::object_code(text.value));
    matches!(code, Some(8 | 9)) || object.subs.keys().any(|sub| *sub > 0)
}

/// A key that the standard does not have, or the model has no place for, under the name that it is kept by. Where an object
/// has sub-indices, its flags are read there only.
pub(super) fn kept(topic: Topic, key: &str, has_subs: bool) -> Option<String> {
    let more: &[&str] = if has_subs { &["ObjFlags"] } else { &[] };
    let unread = [&UNREAD[..], RESERVED, more];
    match keys::of(topic).map(|known| spelling(&known, key)) {
        None | Some(None) => Some(key.to_owned()),
        Some(Some(standard)) => unread.iter().any(|keys| keys.contains(&&*standard)).then_some(standard),
    }
}

/// Adds keys of a section, where there are any.
pub(super) fn add(keys: &mut KeysBySection, section: String, more: Vec<KeyValue>) {
    if !more.is_empty() {
        keys.insert(section, more);
    }
}

/// What the section of a compact array says of SRDOs holds for every element that has no section of its own.
fn add_for_elements(view: &View<'_>, index: Index, main: &Part<'_>, keys: &mut KeysBySection) {
    let topic = Topic::Object(index);
    let is_standard = |key: &KeyValue| UNREAD.contains(&key.key.as_str());
    let (of_elements, own): (Vec<_>, Vec<_>) = further_keys(topic, main).into_iter().partition(is_standard);
    add(keys, name(topic, main), own);
    let described = view.objects.get(&index).map(|object| &object.subs);
    let elements = (1..).take(compact::number(main));
    for sub in elements.filter(|sub| described.is_none_or(|subs| !subs.contains_key(sub))) {
        add(keys, name(Topic::Sub(index, sub), main), of_elements.clone());
    }
}

fn add_to_module(module: &mut Module, number: u32, topic: ModuleTopic, part: &Part<'_>) {
    let text = |key: &str| part.value(key).map_or(String::new(), |text| text.value.to_owned());
    match topic {
        ModuleTopic::ModuleInfo => {
            (module.product_name, module.order_code) = (text("ProductName"), text("OrderCode"));
        }
        ModuleTopic::Fixed(index, _) => drop(module.brings.insert(index)),
        ModuleTopic::SubExtension(index) => drop(module.extends.insert(index)),
        ModuleTopic::Comments | ModuleTopic::FixedObjects | ModuleTopic::SubExtends => {}
    }
    let topic = Topic::Module(number, topic);
    module.sections.push(FurtherSection::new(name(topic, part), all_keys(topic, part)));
}

/// Sections that the standard does not know, those of one name as one, in the order of the text.
fn unknown(view: &View<'_>) -> Vec<FurtherSection> {
    let mut parts: Vec<Part<'_>> = Vec::new();
    let mut positions: BTreeMap<String, usize> = BTreeMap::new();
    for section in &view.unknown {
        let position = *positions.entry(section.name().to_ascii_lowercase()).or_insert(parts.len());
        match parts.get_mut(position) {
            Some(part) => part.sections.push(*section),
            None => parts.push(Part::of(*section, view.file)),
        }
    }
    let section =
        |part: &Part<'_>| FurtherSection::new(part.name().value.to_owned(), all_keys(Topic::Unknown, part));
    parts.iter().map(section).collect()
}

/// The name of a section, in the spelling of the standard where that has one.
pub(super) fn name(topic: Topic, part: &Part<'_>) -> String {
    canonical(topic).unwrap_or_else(|| part.name().value.to_owned())
}

/// All keys of a section.
fn all_keys(topic: Topic, part: &Part<'_>) -> Vec<KeyValue> {
    let known = keys::of(topic);
    last_of_each(part, |key| {
        let standard = known.as_ref().and_then(|known| spelling(known, key));
        Some(standard.unwrap_or_else(|| key.to_owned()))
    })
}

/// A key in the spelling of the standard; `None` for one that the section does not have.
fn spelling(known: &Keys, key: &str) -> Option<String> {
    known.spelling(key).or_else(|| {
        let is_spaced = key.contains(char::is_whitespace);
        is_spaced.then(|| known.spelling(&key.split_whitespace().collect::<String>()))?
    })
}

/// The keys with a value that are wanted, under the names that they get; of several with one name the last, as most readers
/// take it.
fn last_of_each(part: &Part<'_>, wanted: impl Fn(&str) -> Option<String>) -> Vec<KeyValue> {
    let entries = part.entries().filter(|entry| !entry.key.value.is_empty() && !entry.value.value.is_empty());
    let named = entries.filter_map(|entry| Some((wanted(entry.key.value)?, entry.value.value)));
    let named: Vec<(String, &str)> = named.collect();
    let mut seen = BTreeSet::new();
    let mut keys: Vec<KeyValue> = Vec::new();
    for (key, value) in named.into_iter().rev() {
        if seen.insert(key.to_ascii_lowercase()) {
            keys.push(KeyValue::new(key, value.to_owned()));
        }
    }
    keys.reverse();
    keys
}

/// The lines of `[Comments]` in the order of their numbers.
fn comments(part: &Part<'_>) -> Vec<String> {
    let lines = part.entries().filter_map(|entry| {
        let (front, digits) = entry.key.value.split_at_checked(4)?;
        let number: u32 = digits.parse().ok()?;
        let is_line = front.eq_ignore_ascii_case("Line") && !entry.value.value.is_empty();
        is_line.then_some((number, entry.value.value))
    });
    let mut lines: Vec<(u32, &str)> = lines.collect();
    lines.arrange_by_key(|(number, _)| *number);
    lines.into_iter().map(|(_, text)| text.to_owned()).collect()
}
