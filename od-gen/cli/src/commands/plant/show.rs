//! `odgen plant show`: what nodes are set to, and which level says so.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use od_plant::{PlantValue, default_of, values};
use od_spec::diag::{Diagnostic, codes, nearest};
use od_spec::file_name;
use od_spec::model::EntryId;
use od_spec::plant::{Plant, PlantLayer, PlantNode};
use od_spec::source::{SourceMap, Span};
use serde_json::{Value, json};

use super::args::{PlantShowArgs, ShowFormat};
use crate::plant_file::{Read, read};
use crate::report::{Report, print, print_json};

pub(super) fn run(args: &PlantShowArgs, report: &Report) -> Result<u8, u8> {
    let read = read(&args.plant, report)?;
    let nodes = chosen(args, &read.plant).map_err(|diagnostic| report.refuse(*diagnostic))?;
    let groups = groups(&nodes);
    let mut shown = Vec::new();
    for (class, nodes) in groups {
        let Some(settled) = read.settled.get(class) else { continue };
        let values = values(&read.plant, class, settled);
        let device = read.plant.classes.get(class).and_then(|class| read.plant.devices.get(class.own.device));
        let wanted = match (&args.entry, device) {
            (Some(entry), Some(device)) => match od_spec::SettingNames::of(&device.dictionary).entry(entry) {
                Some(id) => Some(id),
                // Not every device has it.
                None => continue,
            },
            _ => None,
        };
        shown.push(Group { class, nodes, wanted, values });
    }
    if let (true, Some(entry)) = (shown.is_empty(), &args.entry) {
        let message = format!("no device of these nodes has an entry `{entry}`");
        return Err(report.refuse(
            Diagnostic::without_place(codes::UNKNOWN_ENTRY, message)
                .help("write an index in hexadecimal (`607D.2`), an object's name, or `object.entry`"),
        ));
    }
    Ok(match args.format {
        ShowFormat::Human => print(&human(&read, &shown)),
        ShowFormat::Json => {
            let text = serde_json::to_string_pretty(&document(&read, &shown)).unwrap_or_default() + "\n";
            print_json(text.as_bytes())
        }
    })
}

/// Nodes that are set to the same.
struct Group<'a> {
    class: usize,
    nodes: Vec<&'a PlantNode>,
    /// The only entry that is asked for.
    wanted: Option<EntryId>,
    values: Vec<PlantValue<'a>>,
}

impl<'a> Group<'a> {
    fn values(&self) -> impl Iterator<Item = &PlantValue<'a>> {
        self.values.iter().filter(|value| self.wanted.is_none_or(|id| id == value.id))
    }
}

/// The nodes that are asked for. A name that there is not is said.
fn chosen<'a>(args: &PlantShowArgs, plant: &'a Plant) -> Result<Vec<&'a PlantNode>, Box<Diagnostic>> {
    let named = |node: &&PlantNode| {
        let machine = plant.machines.get(node.machine);
        let is = |wanted: &Option<String>, name: Option<&str>| {
            wanted.as_deref().is_none_or(|wanted| Some(wanted) == name)
        };
        is(&args.site, machine.map(|machine| plant.site_of(machine)))
            && is(&args.machine, machine.map(|machine| machine.name.as_str()))
            && is(&args.position, Some(&node.position))
            && is(&args.device, plant.devices.get(node.device).map(|device| device.key.as_str()))
    };
    let nodes: Vec<&PlantNode> = plant.nodes.iter().filter(named).collect();
    if !nodes.is_empty() {
        return Ok(nodes);
    }
    let sites = plant.sites.iter().map(|site| site.name.as_str()).collect();
    let of_site = |name: &str| args.site.as_deref().is_none_or(|site| site == name);
    let machines = plant.machines.iter().filter(|machine| of_site(plant.site_of(machine)));
    let machines = machines.map(|machine| machine.name.as_str()).collect();
    let positions = plant.nodes.iter().map(|node| node.position.as_str()).collect();
    let devices = plant.devices.iter().map(|device| device.key.as_str()).collect();
    let names: [(&str, &Option<String>, Vec<&str>); 4] = [
        ("site", &args.site, sites),
        ("machine", &args.machine, machines),
        ("position", &args.position, positions),
        ("device", &args.device, devices),
    ];
    for (what, wanted, known) in names {
        let Some(wanted) = wanted.as_deref().filter(|wanted| !known.contains(wanted)) else { continue };
        let message = format!("there is no {what} `{wanted}`");
        let help = match nearest(wanted, known.iter().copied()) {
            Some(word) => format!("did you mean `{word}`?"),
            None => format!("look for it with `odgen plant show {}`", file_name::shown(&args.plant)),
        };
        return Err(Box::new(Diagnostic::without_place(codes::UNKNOWN_WORD, message).help(help)));
    }
    let message = "no node is at all of these places";
    Err(Box::new(Diagnostic::without_place(codes::UNKNOWN_WORD, message).help("ask for less at once")))
}

fn groups<'a>(nodes: &[&'a PlantNode]) -> Vec<(usize, Vec<&'a PlantNode>)> {
    let mut at: BTreeMap<usize, usize> = BTreeMap::new();
    let mut groups: Vec<(usize, Vec<&PlantNode>)> = Vec::new();
    for node in nodes {
        let next = groups.len();
        let group = *at.entry(node.class).or_insert(next);
        match groups.get_mut(group) {
            Some((_, nodes)) => nodes.push(node),
            None => groups.push((node.class, vec![node])),
        }
    }
    groups
}

/// `plant.yaml:17:5`.
fn place(sources: &SourceMap, span: Span) -> String {
    let file = sources.file(span.file);
    format!("{}:{}", file.name(), file.line_col(span.start))
}

fn human(read: &Read, groups: &[Group<'_>]) -> String {
    let Read { plant, sources, .. } = read;
    let mut text = String::new();
    for group in groups {
        let Some(first) = group.nodes.first() else { continue };
        let rate = plant.classes.get(group.class).map_or(0, |class| class.own.bit_rate);
        let _ = write!(text, "{}, {rate} kbit/s", plant.name_of(first));
        match group.nodes.len() - 1 {
            0 => {}
            1 => text.push_str("; one more node is alike"),
            more => drop(write!(text, "; {more} more nodes are alike")),
        }
        if let (1, Some(serial)) = (group.nodes.len(), first.serial) {
            let _ = write!(text, "; serial number {}", serial.value);
        }
        text.push('\n');
        let mut none = true;
        for value in group.values() {
            none = false;
            let lock = if value.is_unlocked { "  LOCKED" } else { "" };
            let _ = writeln!(
                text,
                "  {}  {} = {}{lock}\n      {}, {}",
                value.id,
                value.name,
                value.value,
                value.from.words(),
                place(sources, value.place)
            );
            for (layer, span) in value.over.iter().rev() {
                let _ = writeln!(text, "      over {}, {}", layer.words(), place(sources, *span));
            }
            if let Some(default) = &value.default {
                let _ = writeln!(text, "      over the default {default}");
            }
        }
        match (none, group.wanted, plant.classes.get(group.class)) {
            (true, Some(id), Some(class)) => {
                let (name, default) = default_of(plant, class, id);
                let default =
                    default.map_or("no default".to_owned(), |default| format!("the default {default}"));
                let _ = writeln!(text, "  {id}  {name}: no level sets it; {default}");
            }
            (true, ..) => text.push_str("  no level sets anything\n"),
            (false, ..) => {}
        }
    }
    text
}

fn document(read: &Read, groups: &[Group<'_>]) -> Value {
    let Read { plant, sources, .. } = read;
    let position = |span: Span| {
        let file = sources.file(span.file);
        let at = file.line_col(span.start);
        json!({"file": file.name(), "line": at.line, "column": at.column})
    };
    let level = |layer: &PlantLayer, span: Span| json!({"level": layer.words(), "position": layer.position, "place": position(span)});
    let kinds = groups.iter().map(|group| {
        let class = plant.classes.get(group.class);
        let nodes = group.nodes.iter().map(|node| {
            let machine = plant.machines.get(node.machine);
            json!({
                "site": machine.map(|machine| plant.site_of(machine)),
                "machine": machine.map(|machine| &machine.name),
                "position": node.position,
                "name": node.node_name,
                "serial": node.serial.map(|serial| serial.value),
                "comment": node.comment,
            })
        });
        let mut values: Vec<Value> = group
            .values()
            .map(|value| {
                json!({
                    "entry": value.id.to_string(),
                    "name": value.name,
                    "value": value.value,
                    "raw": value.raw.and_then(|raw| i64::try_from(raw).ok()),
                    "unit": value.unit,
                    "default": value.default,
                    "locked": value.is_unlocked,
                    "from": level(value.from, value.place),
                    "over": value.over.iter().map(|(layer, span)| level(layer, *span)).collect::<Vec<_>>(),
                })
            })
            .collect();
        if let (true, Some(id), Some(class)) = (values.is_empty(), group.wanted, class) {
            let (name, default) = default_of(plant, class, id);
            values.push(json!({"entry": id.to_string(), "name": name, "value": default, "from": null}));
        }
        json!({
            "device": class.and_then(|class| plant.devices.get(class.own.device)).map(|device| &device.key),
            "node-id": class.map(|class| class.own.node),
            "bit-rate": class.map(|class| class.own.bit_rate),
            "nodes": nodes.collect::<Vec<_>>(),
            "values": values,
        })
    });
    json!({"od-plant-values": 1, "title": plant.title, "kinds": kinds.collect::<Vec<_>>()})
}
