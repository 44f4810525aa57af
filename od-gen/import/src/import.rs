//! An EDS or DCF as a specification: the model as text, with what was wrong next to the object that it was wrong at,
//! and what has no place at the end.

use std::borrow::Cow;
use std::collections::BTreeMap;

use od_spec::diag::codes::{XDD_DISABLED, XDD_LEFT_OUT};
use od_spec::diag::{Code, Diagnostic, Diagnostics, Severity};
use od_spec::eds::codes::{LINKS_OF_NOTHING, NO_INDEX, NO_PLACE, OBJECT_LEFT_OUT};
use od_spec::eds::{Document, Owner, cannot_hold, cannot_hold_section};
use od_spec::model::{Dictionary, EditorProperty, Further, KeyValue, Object, ObjectKind, System};
use od_spec::source::{FileId, SourceMap, Spanned};
use od_spec::visible::straight;
use od_spec::wording::{Notation, Wording};
use od_spec::xdd::is_xdd;
use od_spec::{Commissioning, Compiled, assign, rule_codes};

use crate::yaml::{self, Options, Place, Repair};

/// A specification that was made from an EDS or DCF.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Imported {
    /// The text; it compiles.
    pub text: String,
    /// What it says otherwise than the file; the text has a comment for each.
    pub repairs: Vec<Repair>,
    /// Rules that the device breaks; the text allows them, with what was found.
    pub allowed: Vec<&'static str>,
    /// How many facts of the file have no place in a specification; they are listed at the end of the text.
    pub without_place: usize,
}

/// Codes about facts that are kept nowhere but in the list at the end: left out objects, links of nothing, values without a
/// place.
const WITHOUT_PLACE: [&Code; 5] = [OBJECT_LEFT_OUT, LINKS_OF_NOTHING, NO_PLACE, XDD_DISABLED, XDD_LEFT_OUT];

/// Writes the specification of a compiled EDS or DCF. `None` where there is no model.
///
/// # Errors
/// What the language refuses of it where nothing more can be left out.
pub fn import(
    compiled: &Compiled,
    sources: &SourceMap,
    root: FileId,
) -> Option<Result<Imported, Diagnostics>> {
    let system = compiled.system.as_ref()?;
    let device = system.devices.first()?;
    let file = sources.file(root);
    // As it was compiled: a specification may not hold what turns text.
    let text = straight(file.text());
    // What an XDD says in addition to its objects is not a comment.
    let is_xdd = is_xdd(file.name(), &text);
    let document = if is_xdd { Document::default() } else { Document::scan(root, &text) };
    let mut options =
        Options { head: vec![format!("Made from {}.", base_name(file.name()))], ..Options::default() };
    let remarks = document.remarks().into_iter();
    // What is said by properties of CANopenEditor is in the model, or was reported.
    let remarks = remarks
        .map(|remark| (place(device, remark.owner), Cow::Borrowed(remark.text)))
        .filter(|(place, text)| place.is_none() || !is_property(text));
    let remarks: Vec<_> = remarks.collect();
    let mut without_place = device.further.as_deref().map(not_held).unwrap_or_default();
    without_place.extend(groups_left_out(device));
    let usual = usual(&remarks, device);
    for (place, text) in remarks {
        match place {
            Some(_) if usual.contains_key(&text) => {}
            Some(place) => options.comments.entry(place).or_default().push(text.into_owned()),
            None => options.head.push(text.into_owned()),
        }
    }
    let entries = device.entries().count();
    options
        .head
        .extend(usual.into_iter().map(|(text, count)| format!("{text}, at {count} of {entries} entries")));
    for finding in &compiled.diagnostics {
        let Some(label) = finding.labels.first() else { continue };
        let line = file.line_col(label.span.start).line;
        if WITHOUT_PLACE.contains(&finding.code) {
            without_place.push(format!("line {line}: {}", finding.message));
        } else if changes_what_is_read(finding) || loses_a_link(&document, finding) {
            let text = format!("line {line}: {} ({})", finding.message, finding.code.id);
            let place = place(device, document.owner(label.span)).unwrap_or(Place::Device);
            options.comments.entry(place).or_default().push(text);
        }
    }
    let values = node_values(compiled, sources, system, device);
    let count = without_place.len() + values.settings.len() + values.refused.len() + values.texts.len();
    options.foot = foot(without_place, values, base_name(file.name()));
    // What follows takes the most memory.
    drop(document);
    let written = yaml::specification(system, device, &options);
    Some(written.map(|written| Imported {
        text: written.text,
        repairs: written.repairs,
        allowed: written.allowed,
        without_place: count + written.left_out.len(),
    }))
}

/// Keys that no line of an EDS can hold as they are.
fn not_held(further: &Further) -> Vec<String> {
    let sections =
        further.keys.iter().chain(further.all_sections().map(|section| (&section.name, &section.keys)));
    let comments = further.comments.iter().flatten().enumerate();
    let comments = comments.filter(|(_, line)| cannot_hold("Line99999", line).is_some());
    let mut lines: Vec<String> =
        comments.map(|(at, line)| format!("[Comments] Line{}={line}", at + 1)).collect();
    for (section, keys) in sections {
        let is_held = cannot_hold_section(section).is_none();
        let lost = keys.iter().filter(|one| !is_held || cannot_hold(&one.key, &one.value).is_some());
        lines.extend(lost.map(|KeyValue { key, value, .. }| format!("[{section}] {key}={value}")));
    }
    lines
}

/// The groups that no specification can name, as entries of the object are stored by something else.
fn groups_left_out(device: &Dictionary) -> Vec<String> {
    let objects = device.objects.values().filter(|object| object.stored_beside_group().is_some());
    let group = |object: &Object| {
        let group = object.editor.as_ref()?.storage_group.as_deref()?;
        Some(format!("the group {group} of {}, whose entries are stored otherwise", object.index))
    };
    objects.filter_map(group).collect()
}

/// Whether a comment is a property of CANopenEditor.
fn is_property(text: &str) -> bool {
    text.split_once('=').is_some_and(|(key, _)| EditorProperty::of_name(key.trim()).is_some())
}

/// What is at most of the entries, such as a maker's key that always has the same value, and at how many: it is said
/// once.
fn usual<'t>(
    remarks: &[(Option<Place>, Cow<'t, str>)],
    device: &Dictionary,
) -> BTreeMap<Cow<'t, str>, usize> {
    let mut counts: BTreeMap<Cow<'t, str>, usize> = BTreeMap::new();
    for (_, text) in remarks.iter().filter(|(place, _)| place.is_some()) {
        *counts.entry(text.clone()).or_default() += 1;
    }
    let most = (device.entries().count() / 2).max(3);
    counts.retain(|_, count| *count > most);
    counts
}

/// Whether a finding means that the specification says something else than the letters of the file.
fn changes_what_is_read(finding: &Diagnostic) -> bool {
    let is_about_name = [rule_codes::DUPLICATE_NAME, rule_codes::NAME_NOT_FOR_EDS].contains(&finding.code);
    finding.code.is_about_facts()
        && !is_about_name
        && finding.code.severity == Severity::Error
        && finding.edits.is_empty()
}

/// Whether a finding is about an entry of object links that is not an index. In a list of objects it says nothing that
/// the objects do not.
fn loses_a_link(document: &Document<'_>, finding: &Diagnostic) -> bool {
    let place = finding.labels.first().map(|label| label.span);
    finding.code == NO_INDEX && place.is_some_and(|place| document.owner(place) != Owner::File)
}

/// Where a specification speaks of what a section is about; `None` for the file as a whole, and for what is left out.
fn place(device: &Dictionary, owner: Owner) -> Option<Place> {
    match owner {
        Owner::File => None,
        Owner::Object(index) => device.objects.contains_key(&index).then_some(Place::Object(index)),
        Owner::Entry(id) => {
            let object = device.objects.get(&id.index)?;
            let is_entry = object.kind != ObjectKind::Var && object.entry(id.sub).is_some();
            Some(if is_entry { Place::Entry(id) } else { Place::Object(id.index) })
        }
    }
}

/// What a DCF says of its node.
#[derive(Default)]
struct NodeValues {
    /// As settings of `odgen dcf`.
    settings: Vec<String>,
    /// What cannot be set, each with the reason.
    refused: Vec<String>,
    /// Names and files.
    texts: Vec<String>,
}

fn node_values(compiled: &Compiled, sources: &SourceMap, system: &System, device: &Dictionary) -> NodeValues {
    let mut values = NodeValues::default();
    let Some(node) = compiled.node.as_ref().map(|node| node.at(None)) else { return values };
    let words = Wording::english(Notation::Diagnostic);
    // Places in the settings are not places in the file.
    let mut sources = sources.clone();
    let mut settings = Vec::new();
    for (id, value) in &node.values {
        let Some(entry) = device.entry(*id) else { continue };
        let sub = if id.sub.0 == 0 { String::new() } else { format!(".{}", id.sub) };
        let text = format!("{:04X}{sub}={}", id.index.0, words.value(Some(id.index), entry, value));
        let file = sources.add("--set", text.as_str());
        settings.push(Spanned::new(text, sources.whole(file)));
    }
    let mut diagnostics = Diagnostics::new();
    assign(system, device, node.node, &settings, &mut diagnostics);
    for Spanned { value: text, span } in settings {
        let is_about_it = |one: &&Diagnostic| one.labels.iter().any(|label| label.span.file == span.file);
        let mut errors = diagnostics.iter().filter(|one| one.severity() == Severity::Error);
        match errors.find(is_about_it) {
            Some(error) => values.refused.push(format!("- {text}: {}", error.message)),
            None => values.settings.push(format!("--set \"{text}\"")),
        }
    }
    values.texts = node_texts(&node);
    values
}

/// What else belongs to the node of a DCF, in the keys of one.
fn node_texts(node: &Commissioning) -> Vec<String> {
    let names = node.denotations.iter().map(|(of, name)| format!("{of}: Denotation={name}"));
    let references = node.references.iter().map(|(of, text)| format!("{of}: ParamRefd={text}"));
    let mut texts: Vec<String> = names.chain(references).collect();
    let of_node = [("NodeRefd", &node.reference), ("NetRefd", &node.net_reference)];
    let said = of_node.into_iter().filter(|(_, text)| !text.is_empty());
    texts.extend(said.map(|(key, text)| format!("{key}={text}")));
    if node.manager {
        texts.push("CANopenManager=1".to_owned());
    }
    for (id, files) in &node.files {
        let keys = [("UploadFile", &files.upload), ("DownloadFile", &files.download)];
        let paths =
            keys.into_iter().filter_map(|(key, path)| Some(format!("{id}: {key}={}", path.as_ref()?)));
        texts.extend(paths);
    }
    texts
}

fn foot(without_place: Vec<String>, values: NodeValues, file: &str) -> Vec<String> {
    let NodeValues { settings, refused, texts } = values;
    let mut foot = Vec::new();
    if !without_place.is_empty() {
        foot.push("What has no place in a specification:".to_owned());
        foot.extend(without_place.into_iter().map(|line| format!("- {line}")));
    }
    if !settings.is_empty() {
        foot.push(format!(
            "The values of the node; `odgen dcf {file}` keeps them, with a specification they are:"
        ));
        foot.extend(settings);
    }
    if !refused.is_empty() {
        foot.push("Values of the node that cannot be set:".to_owned());
        foot.extend(refused);
    }
    if !texts.is_empty() {
        foot.push("Names in the application and files of the node, which a DCF keeps:".to_owned());
        foot.extend(texts.into_iter().map(|line| format!("- {line}")));
    }
    foot
}

fn base_name(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}
