//! What differs where, for people: Markdown.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use od_spec::eds::GENERATED;
use od_spec::markdown::paragraph;
use od_spec::model::EntryId;
use od_spec::plant::{Level, Plant, Settled};

use super::cell::plain;
use super::messages::pdos;
use super::values::{PlantValue, values};

/// A value as one level gives it to some nodes.
struct Said<'a> {
    value: PlantValue<'a>,
    nodes: usize,
}

/// The overview: types with their nodes, sites with their machines, each value that a level gives, and who sends which PDO to whom.
/// `tables` are the files with all values.
pub(super) fn write(plant: &Plant, settled: &[Settled], tables: &[&str]) -> String {
    let mut text = format!("<!-- {GENERATED} -->\n\n# {}\n", plain(&plant.title));
    if let Some(about) = &plant.about {
        let _ = write!(text, "\n{}\n", paragraph(plain(about)));
    }
    let _ = write!(
        text,
        "\n{} at {}, {} of {}. {} {} a row for each value of each node.\n",
        counted(plant.machines.len(), "machine"),
        counted(plant.sites.len(), "site"),
        counted(plant.nodes.len(), "node"),
        counted(plant.classes.len(), "kind"),
        tables.iter().map(|table| format!("`{table}`")).collect::<Vec<_>>().join(" and "),
        if tables.len() == 1 { "has" } else { "have" },
    );
    types(&mut text, plant);
    sites(&mut text, plant);
    levels(&mut text, plant, settled);
    pdos(&mut text, plant, settled);
    remarks(&mut text, plant);
    text
}

fn types(text: &mut String, plant: &Plant) {
    text.push_str("\n## Types\n\n| type | machines | nodes |\n|---|---|---|\n");
    for (at, of_type) in plant.types.iter().enumerate() {
        let count = plant.machines.iter().filter(|machine| machine.of_type == at).count();
        let first = plant.machines.iter().find(|machine| machine.of_type == at);
        let nodes = first.and_then(|machine| plant.nodes.get(machine.nodes.clone())).unwrap_or_default();
        let nodes: Vec<String> = nodes
            .iter()
            .map(|node| {
                let key = plant.devices.get(node.device).map_or("", |device| &device.key);
                format!("{} {key} {}", plain(&node.position), node.node.value)
            })
            .collect();
        let _ = writeln!(text, "| {} | {count} | {} |", plain(&of_type.name), nodes.join(", "));
    }
}

fn sites(text: &mut String, plant: &Plant) {
    text.push_str("\n## Sites\n\n| site | machines | type | remarks |\n|---|---|---|---|\n");
    for (at, site) in plant.sites.iter().enumerate() {
        let mut by_type: BTreeMap<usize, Vec<&str>> = BTreeMap::new();
        for machine in plant.machines.iter().filter(|machine| machine.site == at) {
            by_type.entry(machine.of_type).or_default().push(&machine.name);
        }
        let name = match &site.title {
            Some(title) => format!("{} ({})", plain(&site.name), plain(title)),
            None => plain(&site.name),
        };
        for (of_type, machines) in by_type {
            let of_type = plant.types.get(of_type).map_or_else(String::new, |one| plain(&one.name));
            let remark = site.comment.as_deref().map(plain).unwrap_or_default();
            let _ = writeln!(text, "| {name} | {} | {of_type} | {remark} |", runs(&machines));
        }
    }
}

/// Names of machines, numbers that follow one another as runs.
fn runs(names: &[&str]) -> String {
    let mut parts: Vec<String> = Vec::new();
    let mut open: Option<(u32, u32)> = None;
    let shown = |(first, last): (u32, u32)| {
        if first == last { first.to_string() } else { format!("{first}..{last}") }
    };
    for name in names {
        match (name.parse::<u32>(), open) {
            (Ok(number), Some((first, last))) if number == last + 1 => open = Some((first, number)),
            (Ok(number), before) => {
                parts.extend(before.map(shown));
                open = Some((number, number));
            }
            (Err(_), before) => {
                parts.extend(before.map(shown));
                open = None;
                parts.push(plain(name));
            }
        }
    }
    parts.extend(open.map(shown));
    parts.join(", ")
}

/// What each level gives, level by level in the order of the file.
fn levels(text: &mut String, plant: &Plant, settled: &[Settled]) {
    let mut said: BTreeMap<(usize, EntryId), Said<'_>> = BTreeMap::new();
    for (class, one) in plant.classes.iter().zip(settled) {
        let at = plant.nodes.get(class.first).map_or(0, |node| node.class);
        for value in values(plant, at, one) {
            let layer =
                class.own.layers.iter().copied().find(|layer| {
                    plant.layers.get(*layer).is_some_and(|layer| std::ptr::eq(layer, value.from))
                });
            let Some(layer) = layer else { continue };
            said.entry((layer, value.id))
                .and_modify(|said| said.nodes += class.count)
                .or_insert(Said { value, nodes: class.count });
        }
    }
    text.push_str("\n## Values\n\nEach value with the level that gives it, and how many nodes have it in force; a later level overrides an earlier one.\n");
    let mut level: Option<(&Level, Option<&str>)> = None;
    for ((layer, id), Said { value, nodes }) in &said {
        let Some(layer) = plant.layers.get(*layer) else { continue };
        let here = (&layer.level, layer.position.as_deref());
        if level != Some(here) {
            let _ = write!(
                text,
                "\n### {}\n\n| device | entry | name | value | nodes | instead of |\n|---|---|---|---|---|---|\n",
                plain(&layer.words())
            );
            level = Some(here);
        }
        let device = plant.devices.get(layer.device).map_or("", |device| &device.key);
        let lock = if value.is_unlocked { " **LOCKED**" } else { "" };
        let instead = match value.over.last() {
            Some((before, _)) => format!("what {} says", plain(&before.words())),
            None => value
                .default
                .as_deref()
                .map_or_else(|| "no default".to_owned(), |default| format!("the default {}", plain(default))),
        };
        let _ = writeln!(
            text,
            "| {device} | {id} | {} | {}{lock} | {nodes} | {instead} |",
            plain(&value.name),
            plain(&value.value)
        );
    }
}

/// Machines and nodes of which something is said in addition to values.
fn remarks(text: &mut String, plant: &Plant) {
    let mut rows = Vec::new();
    for machine in &plant.machines {
        let name = plain(&format!("{} {}", plant.site_of(machine), machine.name));
        if machine.serial.is_some() || machine.comment.is_some() {
            let serial = machine.serial.as_ref().map_or("", |serial| &serial.value);
            rows.push([
                name.clone(),
                String::new(),
                plain(serial),
                machine.comment.as_deref().map(plain).unwrap_or_default(),
            ]);
        }
        for node in plant.nodes.get(machine.nodes.clone()).unwrap_or_default() {
            if node.serial.is_some() || node.comment.is_some() {
                let key = plant.devices.get(node.device).map_or("", |device| &device.key);
                let serial = node.serial.map(|serial| serial.value.to_string()).unwrap_or_default();
                rows.push([
                    name.clone(),
                    format!("{} {key} (node {})", plain(&node.position), node.node.value),
                    serial,
                    node.comment.as_deref().map(plain).unwrap_or_default(),
                ]);
            }
        }
    }
    if rows.is_empty() {
        return;
    }
    text.push_str(
        "\n## Serial numbers and remarks\n\n| machine | node | serial number | remark |\n|---|---|---|---|\n",
    );
    for [machine, node, serial, remark] in rows {
        let _ = writeln!(text, "| {machine} | {node} | {serial} | {remark} |");
    }
}

/// `1 site`, `2 sites`.
fn counted(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}
