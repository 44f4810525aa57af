//! Objects: VAR, ARRAY, RECORD and DOMAIN, from the sections that describe them.

use super::comments::Meanings;
use super::compact;
use super::entry::{self, Context};
use super::modules;
use super::node::NodeDecl;
use super::without_place;
use crate::ast::{ArrayDecl, EntryDecl, ObjectDecl, RecordDecl};
use crate::diag::{Diagnostic, Diagnostics, shorten};
use crate::eds::codes;
use crate::eds::number;
use crate::eds::view::{ObjectPart, Part, View};
use crate::model::{EntryId, Index, ObjectKind, SubIndex};
use crate::source::{Span, Spanned};

/// All objects of a file, by index.
pub(super) fn read(
    view: &View<'_>,
    node: Option<&mut NodeDecl>,
    meanings: &mut Meanings,
    diagnostics: &mut Diagnostics,
) -> Vec<ObjectDecl> {
    let mut context = Context { node, meanings, diagnostics };
    let described = view.objects.iter().filter(|(_, part)| part.object.is_some() || !part.subs.is_empty());
    let mut objects: Vec<ObjectDecl> =
        described.filter_map(|(index, part)| object(*index, part, &mut context)).collect();
    compact::implicit_pdos(view, &mut objects);
    modules::add(view, &mut objects, &mut context);
    objects.sort_by_key(|object| object.index.value);
    objects
}

/// One object; `None` for one that is left out.
pub(super) fn object(index: Index, part: &ObjectPart<'_>, context: &mut Context<'_>) -> Option<ObjectDecl> {
    let id = EntryId { index, sub: SubIndex(0) };
    let first = part.object.as_ref().or_else(|| part.subs.values().next())?;
    let place = first.place();
    if index.0 < 0x1000 {
        let message = format!("{index} is no entry of the dictionary; it is left out");
        context.push(without_place(codes::OBJECT_LEFT_OUT, place, message));
        return None;
    }
    if let Some(links) = &part.links {
        let message = format!("the object links of {index} are left out");
        context.push(without_place(codes::NO_PLACE, links.place(), message));
    }
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
            let entry = entry::entry(main, id, kind, context);
            Some(declaration(index, place, entry))
        }
        ObjectKind::Array | ObjectKind::Record => {
            let name = entry::name(main, id, context);
            let common = EntryDecl { name: Some(name.clone()), ..EntryDecl::empty(place) };
            let common = context.meanings.add_to(common, main, &name.value);
            Some(structured(index, kind, part, common, place, context))
        }
    }
}

/// An object about which nothing but its entry is known.
pub(super) fn declaration(index: Index, place: Span, entry: EntryDecl) -> ObjectDecl {
    ObjectDecl {
        index: Spanned::new(index, place),
        on: None,
        from: None,
        alias: None,
        outside: None,
        rounding: None,
        array: None,
        record: None,
        sub0: None,
        omit: Vec::new(),
        entry,
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
    let read = text.and_then(|text| number::integer(text.value));
    if let Some(text) = text {
        entry::report(text, read.as_ref(), context);
    }
    let stated = match (text, read.map(|number| number.value)) {
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
            Some(text) => (text.span, format!("`ObjectType={}`", shorten(text.value))),
            None => (main.place(), "no `ObjectType`".to_owned()),
        };
        let why = if has_subs { "has sub-indices" } else { "has none" };
        let message = format!("{index}: found {found}, but it {why}; it is taken as {}", taken.name());
        let help = "write 0x7 for VAR, 0x8 for ARRAY, 0x9 for RECORD, 0x2 for DOMAIN";
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
        Some(count) => Some(sub(EntryId { index, sub: SubIndex(0) }, kind, count, context)),
        None => {
            let message = format!("{index} has no sub-index 0");
            let help = "add the section, with `DataType=0x0005` and the highest sub-index as its default";
            context.push(Diagnostic::new(codes::NO_SUB_0, place, message).help(help));
            None
        }
    };
    with_shape(ObjectDecl { sub0, ..declaration(index, place, common) }, kind, members)
}

/// The object with its elements or members.
pub(super) fn with_shape(
    object: ObjectDecl,
    kind: ObjectKind,
    members: Vec<(Spanned<SubIndex>, EntryDecl)>,
) -> ObjectDecl {
    let span = object.index.span;
    if kind != ObjectKind::Array {
        return ObjectDecl { record: Some(RecordDecl { span, members }), ..object };
    }
    let has = |sub: &u8| members.iter().any(|(member, _)| member.value.0 == *sub);
    let highest = members.last().map_or(0, |(sub, _)| sub.value.0);
    let omit = (1..=highest).filter(|sub| !has(sub)).map(|sub| Spanned::new(i128::from(sub), span));
    let array = ArrayDecl {
        span,
        count: Some(Spanned::new(i128::from(highest), span)),
        entry: EntryDecl::empty(span),
        elements: members.clone(),
    };
    ObjectDecl { omit: omit.collect(), array: Some(array), ..object }
}

/// The sub-indices from 1 on.
pub(super) fn members(
    index: Index,
    part: &ObjectPart<'_>,
    context: &mut Context<'_>,
) -> Vec<(Spanned<SubIndex>, EntryDecl)> {
    let mut members = Vec::new();
    for (number, section) in part.subs.range(1..) {
        let Some(number) = u8::try_from(*number).ok().filter(|number| *number < 0xFF) else {
            let message = format!("{index} has no sub-index {number:X}h; it is left out");
            context.push(
                Diagnostic::new(codes::BAD_SUB_INDEX, section.place(), message)
                    .help("sub-indices of entries are 1 to FE"),
            );
            continue;
        };
        let id = EntryId { index, sub: SubIndex(number) };
        let member = sub(id, ObjectKind::Var, section, context);
        members.push((Spanned::new(id.sub, section.place()), member));
    }
    members
}

/// One sub-index, in an object of a kind; from sub-index 1 on it stands for itself.
fn sub(id: EntryId, object: ObjectKind, section: &Part<'_>, context: &mut Context<'_>) -> EntryDecl {
    let text = section.value("ObjectType");
    let code = text.map(|text| number::lenient_integer(text.value));
    let kind = match code {
        None | Some(Some(7)) => object,
        Some(Some(2)) => ObjectKind::Domain,
        Some(_) => {
            let shown = text.map(|text| shorten(text.value)).unwrap_or_default();
            let message = format!("{id}: a sub-index is a VAR, found `ObjectType={shown}`");
            let place = text.map_or(section.place(), |text| text.span);
            context.push(
                Diagnostic::new(codes::BAD_OBJECT_TYPE, place, message)
                    .help("write `0x7`")
                    .edit(place, "0x7"),
            );
            object
        }
    };
    entry::entry(section, id, kind, context)
}
