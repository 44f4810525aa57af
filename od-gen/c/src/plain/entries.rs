//! What the header says of each entry: its numbers, its default and its limits, and what reads and writes it.

use od_gen::facts;
use od_gen::plan::{PlannedEntry, PlannedObject, Shape};
use od_spec::model::{Text, Value};

use super::super::page::{Page, WORDING};
use super::super::relations::relations;
use super::accessors;
use super::raw::Raw;

pub(super) fn entries(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    page.text.gap();
    page.text.comment(
        "Entries: ENTRY is the row in the table, by which the application is asked; DEFAULT, LOW and HIGH are raw values. \
         What the device itself sets is not checked against the limits.",
    );
    for object in &plan.objects {
        object_of(page, object);
    }
}

fn object_of(page: &mut Page<'_, '_>, planned: &PlannedObject<'_>) {
    let plan = page.plan;
    let object = planned.object;
    page.text.gap();
    if object.is_structured() {
        let about = page.about(&format!("{} {}", object.index, object.name), &object.about);
        page.text.comment(&warned(page, &about, &object.warning));
        page.text.gap();
    }
    for entry in plan.entries_of(planned) {
        numbers(page, entry);
        let is_element = matches!(planned.shape, Shape::Indexed { .. }) && entry.id.sub.0 > 0;
        if !is_element {
            accessors::of_entry(page, entry);
        }
        page.text.gap();
    }
    if matches!(planned.shape, Shape::Indexed { .. }) {
        accessors::of_elements(page, planned);
    }
}

/// Documentation and constants of an entry.
fn numbers(page: &mut Page<'_, '_>, entry: &PlannedEntry<'_>) {
    let plan = page.plan;
    let what = entry.id.to_string();
    let about = page.about(&format!("{} {}", entry.id, entry.entry.name), &entry.entry.about);
    let about = warned(page, &about, &entry.entry.warning);
    let facts = facts::facts(entry, WORDING, str::to_owned).join(", ");
    page.text.doc(&[format!("{about}\n{facts}."), relations(plan, entry)].concat());
    let row = plan.row(entry.id).unwrap_or(od_gen::plan::NONE);
    page.define(&["ENTRY", &entry.name], &format!("({row}U)"), &what);
    page.define(&index_name(entry), &format!("(0x{:04X}U)", entry.id.index.0), &what);
    page.define(&["SUB", &entry.name], &format!("({}U)", entry.id.sub.0), &what);
    let raw = Raw::of(plan, &entry.kind);
    if !plan.is_stated(entry) {
        return;
    }
    if let Some(default) = entry.entry.default.as_ref().filter(|_| entry.entry.alias.is_none())
        && let Some(default) = raw.literal(default)
    {
        page.define(&["DEFAULT", &entry.name], &default, &what);
    }
    if entry.entry.is_limited() {
        let (low, high) = entry.entry.limits();
        let end = |limit: Option<Value>| limit.and_then(|limit| raw.literal(&limit));
        for (kind, limit) in [("LOW", end(low)), ("HIGH", end(high))] {
            if let Some(limit) = limit {
                page.define(&[kind, &entry.name], &limit, &what);
            }
        }
    }
}

/// The parts of the macro that has the index of an entry.
pub(crate) fn index_name<'e>(entry: &'e PlannedEntry<'_>) -> [&'e str; 2] {
    ["INDEX", &entry.name]
}

fn warned(page: &Page<'_, '_>, about: &str, warning: &Text) -> String {
    match page.words(warning) {
        "" => about.to_owned(),
        warning => format!("{about}\nWarning: {warning}"),
    }
}
