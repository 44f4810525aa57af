//! What two DCF files, or parameter files, say of their nodes: where they are, and the values that they set.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::Commissioning;
use od_spec::model::{Dictionary, EntryId, Fact, Role};

use super::change::{Change, Class, Place};
use super::rules;
use super::words::{self, yes_no};

/// What differs in a node: its place in a network, and the values that are set for it.
pub(super) fn changes(
    (old_device, old): (&Dictionary, &Commissioning),
    (new_device, new): (&Dictionary, &Commissioning),
) -> Vec<Change> {
    let fact = |part: &str, before: String, after: String, class, because| {
        Some(Change::text(Place::Device, Fact::Node, &before, &after)?.part(part).so(class, because))
    };
    let number = |number: u32| number.to_string();
    let connected = |device: &Dictionary| {
        let modules = device.further.as_ref().map(|further| further.connected.iter().copied().map(number));
        modules.into_iter().flatten().collect::<Vec<_>>().join(", ")
    };
    let rate = |rate: u16| format!("{rate} kbit/s");
    let facts = [
        fact(
            "node-ID",
            number(old.node.into()),
            number(new.node.into()),
            Class::Plc,
            "its messages have other identifiers",
        ),
        fact(
            "bit rate",
            rate(old.bit_rate),
            rate(new.bit_rate),
            Class::Plc,
            "nodes of different bit rates disturb each other",
        ),
        fact(
            "network",
            number(old.net_number),
            number(new.net_number),
            Class::Documents,
            "a number for programs",
        ),
        fact("name", old.node_name.clone(), new.node_name.clone(), Class::Documents, "a name for people"),
        fact(
            "serial number",
            old.serial_number.map(number).unwrap_or_default(),
            new.serial_number.map(number).unwrap_or_default(),
            Class::Plc,
            "LSS finds another node",
        ),
        fact(
            "manager",
            yes_no(old.manager).to_owned(),
            yes_no(new.manager).to_owned(),
            Class::Behaviour,
            "the network has one manager",
        ),
        fact(
            "modules plugged in",
            connected(old_device),
            connected(new_device),
            Class::Plc,
            "the sub-indices of the modules are others",
        ),
        fact(
            "name of the network",
            old.net_name.clone(),
            new.net_name.clone(),
            Class::Documents,
            "a name for people",
        ),
    ];
    let ids: BTreeSet<EntryId> = old.values.keys().chain(new.values.keys()).copied().collect();
    let value = |device: &Dictionary, node: &Commissioning, id: EntryId| {
        let (entry, value) = (device.entry(id)?, node.values.get(&id)?);
        Some(words::value(id.index, entry, value))
    };
    let values = ids.into_iter().filter_map(|id| {
        let object = new_device.objects.get(&id.index).or_else(|| old_device.objects.get(&id.index))?;
        let entry = new_device.entry(id).or_else(|| old_device.entry(id))?;
        let (place, name) = if object.is_structured() {
            (Place::entry(id), format!("{}.{}", object.name, entry.name))
        } else {
            (Place::Object(id.index), object.name.clone())
        };
        let (before, after) = (value(old_device, old, id), value(new_device, new, id));
        let change = Change::of(place, Fact::Default, before, after)?.named(name).part("set for the node");
        Some(match Role::of(id.index) {
            Role::PdoMapping => change.so(Class::Plc, "the bytes of the PDO mean something else"),
            _ => change.with(rules::default(id, entry)),
        })
    });
    facts.into_iter().flatten().chain(values).chain(texts(old, new)).collect()
}

/// What a DCF calls its objects, and the files that go into and out of the node.
fn texts(old: &Commissioning, new: &Commissioning) -> Vec<Change> {
    let all = |node: &Commissioning| -> BTreeMap<String, String> {
        let names = node.denotations.iter().map(|(of, name)| (format!("name of {of}"), name.clone()));
        let files = node.files.iter().flat_map(|(id, files)| {
            let kinds = [("upload", &files.upload), ("download", &files.download)];
            kinds
                .into_iter()
                .filter_map(move |(kind, path)| Some((format!("{kind} file of {id}"), path.clone()?)))
        });
        let references = node.references.iter();
        let references =
            references.map(|(of, text)| (format!("reference designation of {of}"), text.clone()));
        let of_node = [("the node", &node.reference), ("the network", &node.net_reference)];
        let of_node = of_node.into_iter().filter(|(_, text)| !text.is_empty());
        let of_node = of_node.map(|(of, text)| (format!("reference designation of {of}"), text.clone()));
        names.chain(files).chain(references).chain(of_node).collect()
    };
    let (before, after) = (all(old), all(new));
    let parts: BTreeSet<&String> = before.keys().chain(after.keys()).collect();
    let change = |part: &String| {
        let value = |texts: &BTreeMap<String, String>| texts.get(part).cloned();
        let change = Change::of(Place::Device, Fact::Node, value(&before), value(&after))?;
        Some(change.part(part).so(Class::Documents, "a text for people and tools"))
    };
    parts.into_iter().filter_map(change).collect()
}
