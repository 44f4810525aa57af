//! The values of a node as a parameter file: what differs from the defaults, by name and in units, as a person would write it.
//!
//! What comes out is read again before it is given: an entry whose name or value does not come back is written by index and as a
//! number, and what cannot be set at all is left out, with the reason.

mod transfer;
mod write;

use std::collections::BTreeMap;

use od_spec::diag::{Code, Diagnostic, Diagnostics, Severity};
use od_spec::model::{Dictionary, EntryId, System};
use od_spec::source::{FileId, SourceMap};
use od_spec::{Commissioning, assign_layers, bit_rate, parameter_file, rule_codes};

pub use transfer::{Transferred, transfer};

/// A parameter file that was written for a node.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ParameterText {
    /// The text.
    pub text: String,
    /// How many values it sets.
    pub count: usize,
    /// What it does not say, with the reason.
    pub left_out: Vec<String>,
    /// What is wrong with the values that it sets.
    pub findings: Vec<String>,
}

/// What a parameter file is about.
#[derive(Debug, Clone, Copy)]
pub struct About<'a> {
    /// Everything that the specification describes.
    pub system: &'a System,
    /// The texts that it was read from: places in a parameter file are not places in them.
    pub sources: &'a SourceMap,
    /// The device.
    pub device: &'a Dictionary,
    /// Whether the file names its device, which only a specification gives a key.
    pub names_device: bool,
    /// The node-ID, where one is stated.
    pub node_id: Option<u8>,
}

/// The parameter file of a node; `left_out` is what is already known not to be in it.
pub fn write(about: About<'_>, node: &Commissioning, left_out: Vec<String>) -> ParameterText {
    let mut node = node.clone();
    let mut left_out = left_out;
    left_out.extend(views(about.device, &mut node));
    if about.node_id.is_some() {
        node.keep_differences(about.device);
    } else {
        // Without a node-ID, it is not known which number a formula gives.
        let default = |id: EntryId| about.device.entry(id).and_then(|entry| entry.default.as_ref());
        node.values.retain(|id, value| default(*id) != Some(value));
    }
    written(about, node, left_out, &[])
}

/// The same with all values, also those that are the defaults: what a node has is written down whole. In which state it accepted them is not
/// asked, as who gives them back finds most of them there, nor whether a line of a DCF could hold them. A bit rate of 0 is not known, and not said.
pub fn write_all(about: About<'_>, node: Commissioning, left_out: Vec<String>) -> ParameterText {
    written(about, node, left_out, &[rule_codes::NOT_NOW, rule_codes::NOT_FOR_EDS])
}

/// The parameter file of all values of a node; what is found about them by the rules with these codes is not said.
fn written(about: About<'_>, node: Commissioning, left_out: Vec<String>, unsaid: &[&Code]) -> ParameterText {
    let device = about.device;
    let (mut node, mut left_out) = (node, left_out);
    node.unlocked = node.values.keys().copied().filter(|id| is_locked(device, *id)).collect();
    let mut findings = Vec::new();
    for (id, found) in found(about, &node) {
        let is_refused = [rule_codes::NOT_WRITABLE, rule_codes::IS_COMMAND].contains(&found.code);
        match id.filter(|_| is_refused) {
            Some(id) => {
                node.values.remove(&id);
                node.unlocked.remove(&id);
                left_out.push(found.message.clone());
            }
            None if unsaid.contains(&found.code) => {}
            None => findings.push(found.message.clone()),
        }
    }
    if node.bit_rate != 0
        && let Err(refused) = bit_rate(device, &node.bit_rate.to_string())
    {
        left_out.push(refused.message);
    }
    left_out.extend(texts(&node));
    let text = write::text(about, &node, &left_out, &findings);
    ParameterText { text, count: node.values.len(), left_out, findings }
}

fn is_locked(device: &Dictionary, id: EntryId) -> bool {
    device.entry(id).is_some_and(|entry| entry.locked)
}

/// Leaves out views of entries that have a value of their own, and says so where the two differ.
fn views(device: &Dictionary, node: &mut Commissioning) -> Vec<String> {
    let held: Vec<(EntryId, EntryId)> = node
        .values
        .keys()
        .filter_map(|id| Some((*id, device.entry(*id)?.alias.as_ref()?.target)))
        .filter(|(_, target)| node.values.contains_key(target))
        .collect();
    let mut said = Vec::new();
    for (view, target) in held {
        node.values.remove(&view);
        let name = device.entry_name(view).unwrap_or_default();
        said.push(format!("{view} ({name}): it is a view of {target}, whose value is written"));
    }
    said
}

/// What is said about the values of a node, with the entry that each is about.
fn found(about: About<'_>, node: &Commissioning) -> Vec<(Option<EntryId>, Diagnostic)> {
    let mut sources = about.sources.clone();
    let text = write::text(about, node, &[], &[]);
    let mut diagnostics = Diagnostics::new();
    let file: FileId = sources.add("parameters", text.as_str());
    let Some(read) = parameter_file(&sources, file, &mut diagnostics) else { return Vec::new() };
    let assigned = assign_layers(about.system, about.device, node.node, &[read.layer], &mut diagnostics);
    diagnostics.sort();
    let mut lines: BTreeMap<usize, EntryId> = BTreeMap::new();
    for (id, origin) in &assigned.origins {
        lines.insert(sources.file(file).line_col(origin.span.start).line, *id);
    }
    let of_file = |one: &Diagnostic| {
        let label = one.labels.first().filter(|label| label.span.file == file)?;
        lines.get(&sources.file(file).line_col(label.span.start).line).copied()
    };
    let serious = diagnostics.iter().filter(|one| one.severity() != Severity::Note);
    serious.map(|one| (of_file(one), one.clone())).collect()
}

/// Names in the application, reference designations and files of DOMAINs, for which a parameter file has no place.
fn texts(node: &Commissioning) -> Vec<String> {
    let names =
        node.denotations.iter().map(|(of, name)| format!("{of}: its name `{name}` in the application"));
    let files = node.files.iter().flat_map(|(id, files)| {
        let kinds = [("receives", &files.upload), ("holds", &files.download)];
        kinds.into_iter().filter_map(move |(what, path)| {
            Some(format!("{id}: the file `{}`, which {what} its content", path.as_ref()?))
        })
    });
    let references =
        node.references.iter().map(|(of, text)| format!("{of}: its reference designation `{text}`"));
    let of_node = [("node", &node.reference), ("network", &node.net_reference)];
    let of_node = of_node.into_iter().filter(|(_, text)| !text.is_empty());
    let of_node = of_node.map(|(of, text)| format!("the reference designation `{text}` of the {of}"));
    let manager = node.manager.then(|| "the node is the CANopen manager".to_owned());
    names.chain(references).chain(files).chain(of_node).chain(manager).collect()
}
