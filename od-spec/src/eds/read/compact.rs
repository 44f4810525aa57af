//! Compact storage: arrays described by one section (CiA 306 4.6.3.4.2).

use super::Form;
use super::entry::{self, Context};
use super::node_texts;
use super::shape::{declaration, members, sub, with_shape};
use super::{made, value, words};
use crate::ast::{EntryDecl, ObjectDecl};
use crate::commissioning::Denoted;
use crate::diag::{Diagnostic, shorten};
use crate::eds::codes;
use crate::eds::names::ElementList;
use crate::eds::number::{self, lenient_integer};
use crate::eds::view::{Entry, ObjectPart, Part};
use crate::model::{Access, DataType, EntryId, Index, ObjectKind, Role, SubIndex};
use crate::source::Spanned;
use std::collections::BTreeMap;

/// How many elements a section may represent, as far as it can be read without a word.
pub(super) fn number(main: &Part<'_>) -> usize {
    let number = main.value("CompactSubObj").and_then(|text| lenient_integer(text.value));
    usize::try_from(number.unwrap_or(0).clamp(0, 254)).unwrap_or(0)
}

/// The number of elements of a compact array; `None` for an object that is not one.
pub(super) fn count(main: &Part<'_>, context: &mut Context<'_>) -> Option<u8> {
    let text = main.value("CompactSubObj")?;
    let read = number::integer(text.value);
    if let Some(number) = &read {
        words::report(text, number, context.diagnostics);
    }
    match read.map(|number| number.value) {
        Some(0) => None,
        Some(count @ 1..=254) => u8::try_from(count).ok(),
        other => {
            let taken = other.filter(|count| *count > 254).map(|_| 254);
            let message = format!("found `CompactSubObj={}`, expected 1 to 254", shorten(text.value));
            let help = "write the number of elements without sub-index 0";
            context.push(
                Diagnostic::new(codes::BAD_COUNT, text.span, message).help(number::help(text.value, help)),
            );
            taken
        }
    }
}

/// An object whose elements are alike. Sections of single sub-indices say more about these.
pub(super) fn object(
    index: Index,
    kind: ObjectKind,
    main: &Part<'_>,
    part: &ObjectPart<'_>,
    count: u8,
    context: &mut Context<'_>,
) -> ObjectDecl {
    let place = main.place();
    let id = EntryId { index, sub: SubIndex(0) };
    // What the section says holds for every element; its own value is not one of the object's.
    let node = context.node.take();
    let common = entry::entry(main, id, Form::Elements, context);
    context.node = node;
    node_texts::read(main, Denoted::object(index), None, context);
    let data_type = entry::type_of(&common);
    let name = common.name.clone().map_or(String::new(), |name| name.value);
    let names = listed(part, ElementList::Name, count, context);
    let values = listed(part, ElementList::Value, count, context);
    for (sub, name) in listed(part, ElementList::Denotation, count, context) {
        let of = Denoted::entry(EntryId { index, sub: SubIndex(sub) });
        node_texts::element_name(name.value, of, context);
    }
    let mut explicit: BTreeMap<u8, (Spanned<SubIndex>, EntryDecl)> =
        members(index, part, context).into_iter().map(|member| (member.0.value.0, member)).collect();
    let mut elements = Vec::with_capacity(usize::from(count));
    for sub in 1..=count {
        if let Some(value) = values.get(&sub) {
            let read = data_type.and_then(|known| value::value(value.value, known, context.diagnostics));
            if let (Some(node), Some(read)) = (context.node.as_deref_mut(), read) {
                node.values.push((EntryId { index, sub: SubIndex(sub) }, read));
            }
        }
        let made_name = made(format!("{name}{sub}"), place);
        let listed_name = names.get(&sub).map(|entry| super::owned(entry.value));
        let element = EntryDecl { name: Some(listed_name.unwrap_or(made_name)), ..common.clone() };
        let described = explicit.remove(&sub);
        elements.push(described.unwrap_or((Spanned::new(SubIndex(sub), place), element)));
    }
    elements.extend(explicit.into_values());
    // How many entries a PDO maps, and how many errors there were, is written: it is not a constant of the compact
    // form. A node whose mapping is listed maps the whole list.
    if let (Role::PdoMapping, Some(node), true) =
        (Role::of(index), context.node.as_deref_mut(), !values.is_empty() && !part.subs.contains_key(&0))
    {
        node.values.push((id, made(count.to_string(), place)));
    }
    let sub0 = if matches!(Role::of(index), Role::PdoMapping | Role::ErrorHistory) {
        let access = common.access.map_or(Access::Rw, |access| access.value.access);
        entry::made_up("NrOfObjects", DataType::Unsigned8, access, place)
    } else {
        entry::count_of("NrOfObjects", count, Access::Ro, place)
    };
    let sub0 = match part.subs.get(&0) {
        Some(section) => sub(id, section, context),
        None => sub0,
    };
    let head = EntryDecl { name: common.name, eds: common.eds, ..EntryDecl::empty(place) };
    with_shape(ObjectDecl { sub0: Some(Box::new(sub0)), ..declaration(index, place, head) }, kind, elements)
}

/// The lines of a list by element; what no element has is reported.
fn listed<'d>(
    part: &ObjectPart<'d>,
    list: ElementList,
    count: u8,
    context: &mut Context<'_>,
) -> BTreeMap<u8, Entry<'d>> {
    let mut found = BTreeMap::new();
    let Some(section) = part.elements.get(&list) else { return found };
    for entry in section.entries() {
        if entry.key.eq_ignore_ascii_case("NrOfEntries") || entry.value.is_empty() {
            continue;
        }
        let sub = lenient_integer(entry.key.value).and_then(|sub| u8::try_from(sub).ok());
        if let Some(sub) = sub.filter(|sub| (1..=count).contains(sub)) {
            found.insert(sub, entry);
        } else {
            let message =
                format!("found `{}`, expected an element from 1 to {count}", shorten(entry.key.value));
            context.push(Diagnostic::new(codes::COMPACT_ELEMENT, entry.key.span, message).help(
                number::help(entry.key.value, "write the sub-index in decimal, or raise `CompactSubObj`"),
            ));
        }
    }
    found
}
