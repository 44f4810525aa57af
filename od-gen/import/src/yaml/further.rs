//! What a device's EDS has in addition to the facts of the model, and what CANopenNode keeps of its objects.

use od_spec::eds::{Owner, cannot_hold, cannot_hold_section, owner};
use od_spec::model::{Dictionary, EditorNotes, Index, KeyValue, Object};

use super::context::Context;
use super::node::{Item, Node};
use super::objects::key;
use super::scalar::spelled;

/// `comments:` and `sections:` of the device's `eds:`.
pub(super) fn of_eds(device: &Dictionary) -> Vec<Item> {
    let Some(further) = &device.further else { return Vec::new() };
    let comments = further.comments.as_ref().map(|lines| {
        let lines = lines.iter().filter(|line| cannot_hold("Line99999", line).is_none());
        Item::new("comments", Node::List(lines.map(|line| Node::text(line.clone())).collect()))
    });
    let of_what_is_there = further.keys.iter().filter(|(section, _)| is_there(device, section));
    let others = further.all_sections().map(|section| (&section.name, &section.keys));
    let sections = of_what_is_there.chain(others);
    let sections = sections.filter(|(section, _)| cannot_hold_section(section).is_none());
    let mut sections: Vec<Item> = sections
        .map(|(section, keys)| Item::new(name(section), Node::Map(items(keys))))
        .filter(|section| !matches!(&section.value, Node::Map(items) if items.is_empty()))
        .collect();
    if !further.connected.is_empty() {
        let modules = (1..).zip(&further.connected);
        let modules =
            modules.map(|(slot, module): (u32, _)| Item::new(slot.to_string(), Node::plain(module)));
        sections.push(Item::new("ConnectedModules", Node::Map(modules.collect())));
    }
    let sections = (!sections.is_empty()).then(|| Item::new("sections", Node::Block(sections)));
    comments.into_iter().chain(sections).collect()
}

/// Whether a device has what a section is about.
fn is_there(device: &Dictionary, section: &str) -> bool {
    match owner(section) {
        Owner::File => true,
        Owner::Object(index) => device.objects.get(&index).is_some_and(|object| {
            let is_of_links = section.ends_with("ObjectLinks");
            !is_of_links || !object.links.is_empty()
        }),
        Owner::Entry(id) => {
            device.objects.get(&id.index).is_some_and(Object::is_structured) && device.entry(id).is_some()
        }
    }
}

fn items(keys: &[KeyValue]) -> Vec<Item> {
    let kept = keys.iter().filter(|one| cannot_hold(&one.key, &one.value).is_none());
    kept.map(|one| Item::new(name(&one.key), value(&one.value))).collect()
}

/// A name as it is written, without quotes where it is a number.
fn name(text: &str) -> String {
    if is_number(text) { text.to_owned() } else { spelled(text) }
}

/// A number without quotes, any other text as YAML needs it.
fn value(text: &str) -> Node {
    if is_number(text) { Node::plain(text) } else { Node::text(text) }
}

fn is_number(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit()) && text.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

/// `canopennode:`: objects one after the other that say the same are one run.
pub(super) fn canopennode(context: &Context<'_>) -> Option<Node> {
    let objects = context.device.objects.values();
    let noted = objects.filter_map(|object| {
        let notes = object.editor.as_deref()?;
        let mut notes = notes.clone();
        notes.srdos.retain(|sub, _| object.entry(*sub).is_some());
        if object.stored_beside_group().is_some() {
            notes.storage_group = None;
        }
        (!notes.is_empty()).then_some((object.index, notes))
    });
    let mut runs: Vec<(Index, Index, EditorNotes)> = Vec::new();
    for (index, notes) in noted {
        match runs.last_mut() {
            Some((_, last, same)) if last.0.checked_add(1) == Some(index.0) && *same == notes => {
                *last = index;
            }
            _ => runs.push((index, index, notes)),
        }
    }
    let item = |(first, last, notes): &(Index, Index, EditorNotes)| {
        let (first, last) = (key(*first), key(*last));
        let run = if first == last { first } else { format!("{first}..{last}") };
        Item::new(run, Node::Map(of_object(notes)))
    };
    (!runs.is_empty()).then(|| Node::Block(runs.iter().map(item).collect()))
}

fn of_object(notes: &EditorNotes) -> Vec<Item> {
    let name =
        |key: &str, name: &Option<String>| name.as_ref().map(|name| Item::new(key, Node::text(name.clone())));
    let srdos =
        notes.srdos.iter().map(|(sub, mapping)| Item::new(sub.to_string(), Node::plain(mapping.word())));
    let srdos: Vec<Item> = srdos.collect();
    let items = [
        name("group", &notes.storage_group),
        name("count", &notes.count_label),
        (!srdos.is_empty()).then(|| Item::new("srdo", Node::Map(srdos))),
        notes.requests_tpdos.then(|| Item::new("requests-tpdos", Node::yes_no(true))),
    ];
    items.into_iter().flatten().collect()
}
