//! An EDS or DCF as a specification: the model as text, with what was wrong beside the object that it was wrong at, and what
//! has no place at the end.

use od_spec::Compiled;
use od_spec::diag::{Diagnostic, Diagnostics, Severity};
use od_spec::eds::{Document, Owner};
use od_spec::model::{Dictionary, ObjectKind};
use od_spec::source::{FileId, SourceMap};
use od_spec::wording::format_value;

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

/// Codes about facts that are kept nowhere but in the list at the end: left out objects, modules, values without a place.
const WITHOUT_PLACE: [&str; 3] = ["EDS401", "EDS415", "EDS512"];

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
    let document = Document::scan(root, file.text());
    let mut options =
        Options { head: vec![format!("Made from {}.", base_name(file.name()))], ..Options::default() };
    for remark in document.remarks() {
        match place(device, remark.owner) {
            Some(place) => options.comments.entry(place).or_default().push(remark.text.to_owned()),
            None => options.head.push(remark.text.to_owned()),
        }
    }
    options.head.extend(comment_lines(&document));
    let mut without_place = Vec::new();
    for finding in &compiled.diagnostics {
        let Some(label) = finding.labels.first() else { continue };
        let line = file.line_col(label.span.start).line;
        if WITHOUT_PLACE.contains(&finding.code.id) {
            without_place.push(format!("line {line}: {}", finding.message));
        } else if changes_what_is_read(finding) {
            let text = format!("line {line}: {} ({})", finding.message, finding.code.id);
            let place = place(device, document.owner(label.span)).unwrap_or(Place::Device);
            options.comments.entry(place).or_default().push(text);
        }
    }
    let values = node_values(compiled, device);
    let count = without_place.len() + values.len();
    options.foot = foot(without_place, values);
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

/// Whether a finding means that the specification says something else than the letters of the file.
fn changes_what_is_read(finding: &Diagnostic) -> bool {
    let about_facts =
        ["EDS40", "EDS41", "EDS5", "OD"].iter().any(|prefix| finding.code.id.starts_with(prefix));
    let is_about_name = ["OD0303", "OD0318"].contains(&finding.code.id);
    about_facts && !is_about_name && finding.code.severity == Severity::Error && finding.edits.is_empty()
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

/// The parameter values of a DCF, as settings of `odgen dcf`.
fn node_values(compiled: &Compiled, device: &Dictionary) -> Vec<String> {
    let Some(node) = &compiled.node else { return Vec::new() };
    let set = node.values.iter().filter_map(|(id, value)| {
        let entry = device.entry(*id)?;
        let sub = if id.sub.0 == 0 { String::new() } else { format!(".{}", id.sub) };
        Some(format!("--set \"{:04X}{sub}={}\"", id.index.0, format_value(entry, value)))
    });
    set.collect()
}

fn foot(without_place: Vec<String>, values: Vec<String>) -> Vec<String> {
    let mut foot = Vec::new();
    if !without_place.is_empty() {
        foot.push("What has no place in a specification:".to_owned());
        foot.extend(without_place.into_iter().map(|line| format!("- {line}")));
    }
    if !values.is_empty() {
        foot.push("The values of the node, for `odgen dcf`:".to_owned());
        foot.extend(values);
    }
    foot
}

fn base_name(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}
