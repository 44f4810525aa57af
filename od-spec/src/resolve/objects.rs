//! One object: VAR, ARRAY, RECORD, DOMAIN.

use std::borrow::Cow;

use super::declared::Declared;
use super::defaults;
use super::entries;
use super::keys_have_effect;
use super::surroundings::Surroundings;
use super::types::{phrases, with_gap, words};
use crate::ast::{ArrayDecl, EntryDecl, ObjectDecl, RecordDecl};
use crate::check::codes as rule_codes;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{
    Access, AccessRight, DataType, Entry, Index, Object, ObjectKind, Role, Statement, SubIndex, Value,
};
use crate::source::Spanned;

/// Resolves a declaration; `None` when nothing usable is left of it.
pub(super) fn resolve(
    declared: &Declared<'_>,
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Object> {
    let decl = &declared.decl;
    let around = Surroundings { index: Some(decl.index.value), ..around };
    let Some(name) = &decl.entry.name else {
        // A run of objects lacks it once.
        if decl.entry.unsure || !diagnostics.is_new(codes::MISSING_KEY, decl.index.span) {
            return None;
        }
        diagnostics.push(
            Diagnostic::new(
                codes::MISSING_KEY,
                decl.index.span,
                format!("object {} needs the key `name`", decl.index.value),
            )
            .help("add `name:`, as the manual's heading spells it"),
        );
        return None;
    };
    let shapes = [
        decl.array.as_ref().map(|array| ("array", array.span)),
        decl.record.as_ref().map(|record| ("record", record.span)),
    ];
    let (kind, entries) = match (&decl.array, &decl.record) {
        (Some(_), Some(_)) => {
            let [Some((_, array)), Some((_, record))] = shapes else { return None };
            diagnostics.push(
                Diagnostic::new(codes::CONFLICTING_KEYS, record, "an object is either an array or a record")
                    .with(array, "the array")
                    .help("keep one of `array:` and `record:`"),
            );
            return None;
        }
        (Some(array), None) => (ObjectKind::Array, elements(decl, array, around, diagnostics)?),
        (None, Some(record)) => (ObjectKind::Record, members(decl, record, around, diagnostics)?),
        (None, None) => {
            let entry = entries::resolve(&decl.entry, SubIndex(0), name.value.clone(), around, diagnostics)?;
            let kind = if entry.data_type == DataType::Domain { ObjectKind::Domain } else { ObjectKind::Var };
            (kind, vec![entry])
        }
    };
    diagnostics.now_about(Some(decl.index.value.into()));
    keys_have_effect::check_written(decl, &entries, around.file, diagnostics);
    Some(Object {
        index: decl.index.value,
        name: name.value.clone(),
        identifier: entries::identifier(&decl.entry, diagnostics),
        kind,
        origin: declared.origin,
        profile: declared.profile.clone(),
        departures: declared.departures.clone(),
        category: decl.entry.category.map(|category| category.value),
        since: decl.entry.since.as_ref().map(|since| since.value.clone()),
        links: decl.links.clone().unwrap_or_default(),
        editor: decl.editor.clone(),
        warning: words(&decl.entry.warning),
        about: with_gap(&decl.entry.about, &decl.entry.gap),
        search: phrases(decl.entry.search.as_ref()),
        entries,
        span: decl.index.span,
    })
}

fn elements(
    decl: &ObjectDecl,
    array: &ArrayDecl,
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<Entry>> {
    let highest = array.elements.last().map(|(sub, _)| sub.value.0);
    let count = match (&array.count, highest) {
        (Some(count), Some(highest)) if i128::from(highest) > count.value => {
            let (sub, _) = array.elements.last()?;
            diagnostics.push(
                Diagnostic::new(
                    rule_codes::COUNT_MISMATCH,
                    sub.span,
                    format!("element {highest} of an array of {}", count.value),
                )
                .with(count.span, "the count")
                .help("raise the count, or correct the sub-index"),
            );
            return None;
        }
        (Some(count), _) => super::numbers::to_u8(count.value),
        (None, Some(highest)) => highest,
        (None, None) => {
            if !array.entry.unsure {
                diagnostics.push(
                    Diagnostic::new(
                        codes::MISSING_KEY,
                        array.span,
                        "an array needs the key `count` or `elements`",
                    )
                    .help("add `count:`, the number of elements"),
                );
            }
            return None;
        }
    };
    let before = diagnostics.errors_found();
    let omitted = |sub: u8| decl.omit.iter().any(|omit| omit.value == i128::from(sub));
    let mut common = EntryDecl { name: None, ..array.entry.over(&decl.entry.inherited()) };
    let subs: Vec<u8> = (1..=count).filter(|sub| !omitted(*sub)).collect();
    if let Cow::Owned(of_device) = defaults::of_device(&common, around, diagnostics) {
        common = of_device;
    }
    let mut defaults = defaults::of_elements(&mut common, array, subs.len(), diagnostics).into_iter();
    // One more for sub-index 0.
    let (mut list, mut broken) = (Vec::with_capacity(usize::from(count) + 1), false);
    for sub in subs {
        let element = array.elements.iter().find(|(at, _)| at.value.0 == sub).map(|(_, element)| element);
        let mut merged = element.map_or_else(|| common.clone(), |element| element.over(&common));
        merged.default = merged.default.or(defaults.next());
        if let Some(identifier) = &mut merged.identifier {
            identifier.value = identifier.value.replace("{n}", &sub.to_string());
        }
        let pattern = array.entry.name.as_ref().map(|pattern| pattern.value.replace("{n}", &sub.to_string()));
        let own_name = merged.name.as_ref().map(|name| name.value.replace("{n}", &sub.to_string()));
        let Some(name) = own_name.or(pattern) else {
            if !merged.unsure {
                diagnostics.push(
                    Diagnostic::new(
                        codes::MISSING_KEY,
                        array.span,
                        format!("element {sub} of this array has no name"),
                    )
                    .help("add `name: \"… {n}\"` to the array, or name the element under `elements:`"),
                );
            }
            return None;
        };
        match entries::resolve(&merged, SubIndex(sub), name, around, diagnostics) {
            Some(element) => list.push(element),
            None => broken = true,
        }
    }
    if list.is_empty() && broken {
        return None;
    }
    // What a library says for all is also for those who have more, and what is wrong was said.
    if around.device.is_some() && !list.is_empty() && diagnostics.errors_found() == before {
        keys_have_effect::check_taken(decl, &list, around, diagnostics);
    }
    finish(decl, list, around, diagnostics)
}

fn members(
    decl: &ObjectDecl,
    record: &RecordDecl,
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<Entry>> {
    let (common, before) = (decl.entry.inherited(), diagnostics.errors_found());
    // One more for sub-index 0.
    let (mut list, mut broken) = (Vec::with_capacity(record.members.len() + 1), false);
    for (sub, member) in &record.members {
        if decl.omit.iter().any(|omit| omit.value == i128::from(sub.value.0)) {
            continue;
        }
        let Some(name) = &member.name else {
            // A run of members lacks it once.
            if !member.unsure && diagnostics.is_new(codes::MISSING_KEY, sub.span) {
                diagnostics.push(
                    Diagnostic::new(
                        codes::MISSING_KEY,
                        sub.span,
                        format!("member {} needs the key `name`", sub.value),
                    )
                    .help("add `name:`, as the manual's table spells it"),
                );
            }
            broken = true;
            continue;
        };
        let merged = with_fitting_condition(member.over(&common), member);
        match entries::resolve(&merged, sub.value, name.value.clone(), around, diagnostics) {
            Some(entry) => list.push(entry),
            None => broken = true,
        }
    }
    if list.is_empty() && broken {
        return None;
    }
    // What a library says for all is also for those who have more, and what is wrong was said.
    if around.device.is_some() && !list.is_empty() && diagnostics.errors_found() == before {
        keys_have_effect::check_taken(decl, &list, around, diagnostics);
    }
    finish(decl, list, around, diagnostics)
}

/// A condition that the object states for all its members concerns those that can be written.
fn with_fitting_condition(merged: EntryDecl, member: &EntryDecl) -> EntryDecl {
    let writable = merged.access.is_some_and(|access| access.value.access.is_writable());
    let writable_when = if writable { merged.writable_when } else { member.writable_when.clone() };
    EntryDecl { writable_when, ..merged }
}

/// Whether sub-index 0 says something else than which sub-index is the highest.
fn is_counted_at_run_time(index: Index) -> bool {
    matches!(Role::of(index), Role::PdoMapping | Role::ErrorHistory)
}

/// Puts sub-index 0 in front.
fn finish(
    decl: &ObjectDecl,
    mut list: Vec<Entry>,
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<Entry>> {
    let counted = list.iter().map(|entry| entry.sub).filter(|sub| *sub != SubIndex::STRUCTURE);
    let highest = counted.max().unwrap_or(SubIndex(0));
    let count = decl.sub0.as_ref();
    let span = count.map_or(decl.index.span, |count| count.span);
    let unsigned8 = DataType::Unsigned8;
    let mut sub0 = Entry::new(SubIndex(0), "number of elements".to_owned(), unsigned8, Access::Ro, span);
    if let Some(count) = count {
        let usual = EntryDecl {
            type_name: Some(Spanned::new("unsigned8".to_owned(), span)),
            access: Some(Spanned::new(AccessRight { access: Access::Ro, locked: false }, span)),
            ..EntryDecl::empty(span)
        };
        let name = count.name.as_ref().map_or(sub0.name.clone(), |name| name.value.clone());
        sub0 = entries::resolve(&count.over(&usual), SubIndex(0), name, around, diagnostics)?;
    }
    // How many of its entries a PDO maps, and how many errors there were, does not follow from how many it has.
    let varies = sub0.access.is_writable() || is_counted_at_run_time(decl.index.value);
    if sub0.default.is_none() && !varies {
        sub0.set_default(Some(Value::Integer(i128::from(highest.0))), Statement::derived(span));
    }
    list.insert(0, sub0);
    Some(list)
}
