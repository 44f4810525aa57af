//! An EDS or DCF as a specification: the model as text, with what was wrong beside the object that it was wrong at, and what
//! has no place at the end.

use std::collections::BTreeMap;

use od_spec::diag::codes::{XDD_DISABLED, XDD_LEFT_OUT};
use od_spec::diag::{Code, Diagnostic, Diagnostics, Severity};
use od_spec::eds::codes::{LINKS_OF_NOTHING, MODULES, NO_INDEX, NO_PLACE, OBJECT_LEFT_OUT, UNREAD};
use od_spec::eds::{Document, Owner};
use od_spec::model::{Dictionary, EditorProperty, EntryId, ObjectKind, Storage, System};
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

/// Codes about facts that are kept nowhere but in the list at the end: left out objects, modules, links of nothing, values without a
/// place.
const WITHOUT_PLACE: [&Code; 7] =
    [OBJECT_LEFT_OUT, MODULES, LINKS_OF_NOTHING, NO_PLACE, UNREAD, XDD_DISABLED, XDD_LEFT_OUT];

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
    // What an XDD says beside its objects is no comment.
    let is_xdd = is_xdd(file.name(), &text);
    let document = if is_xdd { Document::default() } else { Document::scan(root, &text) };
    let mut options =
        Options { head: vec![format!("Made from {}.", base_name(file.name()))], ..Options::default() };
    let properties = if is_xdd { properties(device) } else { Vec::new() };
    let remarks = document.remarks().into_iter().map(|remark| (place(device, remark.owner), remark.text));
    let remarks = remarks.chain(properties.iter().map(|(place, text)| (Some(*place), text.as_str())));
    let mut without_place = Vec::new();
    let mut remarks: Vec<_> = remarks.collect();
    for extra in document.extras() {
        match (place(device, extra.owner), extra.section) {
            (Some(place), _) => remarks.push((Some(place), extra.text)),
            (None, Some(section)) => without_place.push(format!("[{section}] {}", extra.text)),
            // Of an object that is left out, which is said.
            (None, None) => {}
        }
    }
    remarks.retain(|(place, text)| !place.is_some_and(|place| is_said_by_stored(device, place, text)));
    let usual = usual(&remarks, device);
    for (place, text) in remarks {
        match place {
            Some(_) if usual.contains_key(text) => {}
            Some(place) => options.comments.entry(place).or_default().push(text.to_owned()),
            None => options.head.push(text.to_owned()),
        }
    }
    let entries = device.entries().count();
    options
        .head
        .extend(usual.into_iter().map(|(text, count)| format!("{text}, at {count} of {entries} entries")));
    options.head.extend(comment_lines(&document));
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

/// What CANopenEditor keeps in the properties of an XDD, where a specification has no key for it.
fn properties(device: &Dictionary) -> Vec<(Place, String)> {
    let mut texts = Vec::new();
    for object in device.objects.values() {
        let Some(notes) = &object.editor else { continue };
        let of_object = notes.of_object().map(|one| (Owner::Object(object.index), one));
        let of_entries = object.entries.iter().filter_map(|entry| {
            let id = EntryId { index: object.index, sub: entry.sub };
            Some((Owner::Entry(id), notes.of_entry(entry.sub)?))
        });
        for (owner, (property, value)) in of_object.chain(of_entries) {
            texts.extend(place(device, owner).map(|place| (place, format!("{}={value}", property.name()))));
        }
    }
    texts
}

/// Whether a text says the group of an object, and `stored:` of its entries says the same.
fn is_said_by_stored(device: &Dictionary, place: Place, text: &str) -> bool {
    let Place::Object(index) = place else { return false };
    let Some(object) = device.objects.get(&index).filter(|object| object.is_stored()) else { return false };
    let group = object.editor.as_ref().and_then(|notes| notes.storage_group.as_deref());
    let is_of_standard =
        |group: &&str| matches!(Storage::of_group(group), Storage::Communication | Storage::Application);
    let names = [EditorProperty::StorageGroup.key(), EditorProperty::StorageGroup.name()];
    group
        .filter(is_of_standard)
        .is_some_and(|group| names.into_iter().any(|name| text == format!("{name}={group}")))
}

/// What stands at most of the entries, such as a maker's key that always has the same value, and at how many: it is said once.
fn usual<'t>(remarks: &[(Option<Place>, &'t str)], device: &Dictionary) -> BTreeMap<&'t str, usize> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for (_, text) in remarks.iter().filter(|(place, _)| place.is_some()) {
        *counts.entry(text).or_default() += 1;
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

/// Whether a finding is about an entry of object links that is no index. In a list of objects it says nothing that the
/// objects do not.
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

/// The lines of `[Comments]`.
fn comment_lines<'d>(document: &'d Document<'_>) -> impl Iterator<Item = String> + 'd {
    let sections = document.sections().filter(|section| section.name().eq_ignore_ascii_case("Comments"));
    let lines = sections.flat_map(|section| section.keys());
    let is_text =
        |key: &str| key.get(..4).is_some_and(|front| front.eq_ignore_ascii_case("Line")) && key.len() > 4;
    let texts = lines
        .filter(move |line| line.key().is_some_and(|key| is_text(key) && !key.eq_ignore_ascii_case("Lines")));
    texts.filter_map(|line| line.value()).filter(|text| !text.is_empty()).map(ToOwned::to_owned)
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
    // Places in the settings are none in the file.
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
    let mut texts: Vec<String> = names.collect();
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
