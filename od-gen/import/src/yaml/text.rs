//! The whole specification.

use std::collections::BTreeSet;

use od_spec::model::{Dictionary, Index, Object, Pdo, System};

use super::context::{Context, Style, comment};
use super::emit::{self, Written};
use super::features::{self, Chosen};
use super::node::{Item, Node};
use super::options::Options;
use super::remarks::Remarks;
use super::{departures, device, errors, objects, pdo_obstacles, pdos, runs, types};

/// A device as a specification in a style. Libraries of the style from which nothing is taken are not used.
pub(super) fn write(
    system: &System,
    device: &Dictionary,
    options: &Options,
    remarks: &Remarks,
    style: &Style,
) -> Written {
    let (written, used) = attempt(&Context::new(system, device, options, remarks, style));
    if used.len() == style.libraries.len() {
        return written;
    }
    // What only an unused library defines has to be written.
    let mut fewer = style.clone();
    fewer.libraries.retain(|library| used.contains(&library.name));
    write(system, device, options, remarks, &fewer)
}

/// The text, and the libraries from which something is taken.
fn attempt(context: &Context<'_>) -> (Written, Vec<String>) {
    let short_pdos = pdos::short(context);
    let (object_items, features, used) = object_items(context, &short_pdos);
    let mut items = device::header(context, &used);
    if let (Some(first), false) = (items.first_mut(), context.options.head.is_empty()) {
        first.above = context.options.head.iter().flat_map(|line| head_line(line)).collect();
    }
    let mut section = |item: Item| {
        if let Node::Map(items) | Node::Block(items) = &item.value
            && items.is_empty()
        {
            return;
        }
        items.push(Item { above: vec![String::new()], ..item });
    };
    section(device::device(context, &features));
    let objects = Node::Block(object_items);
    // What a library says of an object needs no definition here.
    let named = |key: &str| {
        let mut found = BTreeSet::new();
        objects.texts_under(key, &mut found);
        found
    };
    section(Item::new("units", Node::Block(types::units(context, &named("unit")))));
    section(Item::new("types", Node::Block(types::types(context, &named("type")))));
    section(Item::new("objects", objects));
    section(Item::new("errors", Node::Block(errors::items(context))));
    section(Item::new("pdos", Node::Block(pdos::items(context, &short_pdos))));
    let mut written = emit::write(&items);
    let foot = context.options.foot.iter().flat_map(|line| head_line(line));
    let foot: Vec<String> = foot.collect();
    if !foot.is_empty() {
        written.text.push('\n');
    }
    for line in foot {
        let line = format!("# {line}");
        written.text.push_str(line.trim_end());
        written.text.push('\n');
    }
    (written, used)
}

/// A line of a comment that the caller gives: an empty one stays.
fn head_line(line: &str) -> Vec<String> {
    let lines = comment(line);
    if lines.is_empty() { vec![String::new()] } else { lines }
}

/// The items under `objects:`, the features that bring further objects, and the libraries that are used.
fn object_items(context: &Context<'_>, short_pdos: &[&Pdo]) -> (Vec<Item>, Vec<String>, Vec<String>) {
    let made: BTreeSet<Index> = short_pdos
        .iter()
        .flat_map(|pdo| [pdo.communication_index(), pdo.mapping_index()].map(Index))
        .collect();
    let written: Vec<&Object> =
        context.device.objects.values().filter(|object| !made.contains(&object.index)).collect();
    let taken: Vec<Option<Item>> =
        written.iter().map(|object| departures::from_library(context, object)).collect();
    let exact = written.iter().zip(&taken).filter(|(_, item)| item.as_ref().is_some_and(is_exact));
    let exact: BTreeSet<Index> = exact.map(|(object, _)| object.index).collect();
    let (mut chosen, mut used) = (Chosen::default(), BTreeSet::new());
    for library in &context.style.libraries {
        let before = chosen.objects.len();
        features::choose(library, &exact, &mut chosen);
        if chosen.objects.len() > before {
            used.insert(library.name.clone());
        }
    }
    let in_full_because = pdo_obstacles::remarks(context);
    let mut items = Vec::new();
    for (object, taken) in written.into_iter().zip(taken) {
        if chosen.objects.contains(&object.index) {
            continue;
        }
        let mut in_full = objects::in_full(context, object);
        in_full.above.extend(in_full_because.get(&object.index).into_iter().flat_map(|line| comment(line)));
        let taken = taken.filter(|taken| length(taken) <= length(&in_full));
        match taken {
            Some(taken) => {
                let library =
                    context.style.libraries.iter().find(|one| one.objects.contains_key(&object.index));
                used.extend(library.map(|library| library.name.clone()));
                items.push((None, taken));
            }
            None => items.push((Some(object.index).filter(|_| context.style.short), in_full)),
        }
    }
    let used =
        context.style.libraries.iter().map(|library| library.name.clone()).filter(|name| used.contains(name));
    (runs::fold(&items), chosen.features, used.collect())
}

/// Whether an object is just as the library has it, and nothing is above it.
fn is_exact(item: &Item) -> bool {
    match &item.value {
        Node::Map(items) => items.len() == 1 && item.above.is_empty(),
        Node::Text(_) | Node::Plain(_) | Node::List(_) | Node::Block(_) => false,
    }
}

fn length(item: &Item) -> usize {
    emit::write(std::slice::from_ref(item)).text.len()
}
