//! Objects: VAR, ARRAY, RECORD and DOMAIN, from the sections that describe them.

use super::Form;
use super::compact;
use super::editor;
use super::entry::{self, Context};
use super::links;
use super::node_texts;
use super::shape::{declaration, members, sub, with_shape};
use super::{without_place, words};
use crate::ast::{EntryDecl, ObjectDecl};
use crate::commissioning::Denoted;
use crate::diag::{Diagnostic, shorten};
use crate::eds::view::{ObjectPart, Part};
use crate::eds::{coded, codes, number};
use crate::model::{EntryId, Index, ObjectKind, SubIndex};
use crate::source::Span;
use crate::wording::Key;

/// One object; `None` for one that is left out.
pub(super) fn object(index: Index, part: &ObjectPart<'_>, context: &mut Context<'_>) -> Option<ObjectDecl> {
    let id = EntryId { index, sub: SubIndex(0) };
    let first = part.object.as_ref().or_else(|| part.subs.values().next())?;
    let place = first.place();
    context.about(index);
    if index.0 < 0x1000 {
        let message = format!("{index} is not an entry of the dictionary; it is left out");
        context.push(without_place(codes::OBJECT_LEFT_OUT, place, message));
        return None;
    }
    let compact = part.object.as_ref().map_or(0, compact::number);
    // Each element of a compact array has the texts of its section.
    let text = if compact > 0 { first.size() } else { 0 };
    if !context.fits(index, 1 + compact.max(part.subs.len()), text, place) {
        return None;
    }
    let links = part.links.as_ref().map(links::links);
    let object = ObjectDecl { links, ..described(id, part, place, context)? };
    context.about(index);
    Some(editor::add_to(object, part, context))
}

/// An object as its own section and those of its sub-indices describe it.
fn described(
    id: EntryId,
    part: &ObjectPart<'_>,
    place: Span,
    context: &mut Context<'_>,
) -> Option<ObjectDecl> {
    let index = id.index;
    let Some(main) = &part.object else {
        let message = format!("there is no section `[{:X}]` for this sub-index", index.0);
        context.push(
            Diagnostic::new(codes::NO_PARENT, place, message)
                .help("add the section of the object, with its name, object type and number of sub-indices"),
        );
        let name = super::made(index.to_string(), place);
        let common = EntryDecl { name: Some(name), ..EntryDecl::empty(place) };
        return Some(structured(index, ObjectKind::Record, part, common, place, context));
    };
    let kind = kind(index, main, part, context)?;
    if let (ObjectKind::Array | ObjectKind::Record, Some(count)) = (kind, compact::count(main, context)) {
        return Some(compact::object(index, kind, main, part, count, context));
    }
    match kind {
        ObjectKind::Var | ObjectKind::Domain => {
            let form = if kind == ObjectKind::Domain { Form::Domain } else { Form::Value };
            let entry = entry::entry(main, id, form, context);
            node_texts::read(main, Denoted::object(index), entry::type_of(&entry), context);
            Some(declaration(index, place, entry))
        }
        ObjectKind::Array | ObjectKind::Record => {
            let name = entry::name(main, id, context);
            let common = EntryDecl { name: Some(name.clone()), ..EntryDecl::empty(place) };
            context.about(index);
            let common = context.meanings.add_to(common, main, &name.value);
            node_texts::read(main, Denoted::object(index), None, context);
            Some(structured(index, kind, part, common, place, context))
        }
    }
}

/// What the object is: what its key says, unless its sections say otherwise.
fn kind(
    index: Index,
    main: &Part<'_>,
    part: &ObjectPart<'_>,
    context: &mut Context<'_>,
) -> Option<ObjectKind> {
    let has_subs = part.subs.keys().any(|sub| *sub > 0);
    let text = main.value("ObjectType");
    let code = text.and_then(|text| coded::object_code(text.value));
    if let (Some(text), Some(code)) = (text, code) {
        match number::integer(text.value) {
            Some(number) => words::report(text, &number, context.diagnostics),
            None => words::object_type(text, code, context.diagnostics),
        }
    }
    let stated = match (text, code) {
        (None, _) => Some(ObjectKind::Var),
        (Some(_), Some(2)) => Some(ObjectKind::Domain),
        (Some(_), Some(7)) => Some(ObjectKind::Var),
        (Some(_), Some(8)) => Some(ObjectKind::Array),
        (Some(_), Some(9)) => Some(ObjectKind::Record),
        (Some(text), Some(0 | 5 | 6)) => {
            let message = format!("{index} describes a data type, or nothing; it is left out");
            context.push(without_place(codes::OBJECT_LEFT_OUT, text.span, message));
            return None;
        }
        (Some(_), _) => None,
    };
    let taken = match stated {
        Some(ObjectKind::Var | ObjectKind::Domain) | None if has_subs => ObjectKind::Record,
        None => ObjectKind::Var,
        Some(stated) => stated,
    };
    if stated != Some(taken) || (text.is_none() && has_subs) {
        let (place, found) = match text {
            Some(text) => (text.span, context.format.set(Key::ObjectType, &shorten(text.value))),
            None => (main.place(), format!("no {}", context.format.key(Key::ObjectType))),
        };
        let why = if has_subs { "has sub-indices" } else { "has none" };
        let message = format!("{index}: found {found}, but it {why}; it is taken as {}", taken.name());
        let help = "write 0x7 for VAR, 0x8 for ARRAY, 0x9 for RECORD, 0x2 for DOMAIN";
        let help = number::help(text.map_or("", |text| text.value), help);
        context.push(Diagnostic::new(codes::BAD_OBJECT_TYPE, place, message).help(help));
    }
    Some(taken)
}

fn structured(
    index: Index,
    kind: ObjectKind,
    part: &ObjectPart<'_>,
    common: EntryDecl,
    place: Span,
    context: &mut Context<'_>,
) -> ObjectDecl {
    let members = members(index, part, context);
    let sub0 = match part.subs.get(&0) {
        Some(count) => Some(Box::new(sub(EntryId { index, sub: SubIndex(0) }, count, context))),
        None => {
            let message = format!("{index} has no sub-index 0");
            let data_type = context.format.set(Key::DataType, "0x0005");
            let help = format!("add the section, with {data_type} and the highest sub-index as its default");
            context.push(Diagnostic::new(codes::NO_SUB_0, place, message).help(help));
            None
        }
    };
    with_shape(ObjectDecl { sub0, ..declaration(index, place, common) }, kind, members)
}
