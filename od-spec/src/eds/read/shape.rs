//! Declarations of objects, and of their elements or members.

use super::Form;
use super::entry::{self, Context};
use super::{node_texts, words};
use crate::ast::{ArrayDecl, EntryDecl, ObjectDecl, RecordDecl};
use crate::commissioning::Denoted;
use crate::diag::{Diagnostic, shorten};
use crate::eds::view::{ObjectPart, Part};
use crate::eds::{coded, codes};
use crate::model::{EntryId, Index, ObjectKind, SubIndex};
use crate::source::{Span, Spanned};
use crate::wording::Key;

/// An object about which nothing but its entry is known.
pub(super) fn declaration(index: Index, place: Span, entry: EntryDecl) -> ObjectDecl {
    ObjectDecl {
        index: Spanned::new(index, place),
        weight: 0,
        devices: None,
        from: None,
        like: None,
        alias: None,
        outside: None,
        rounding: None,
        array: None,
        record: None,
        sub0: None,
        omit: Vec::new(),
        links: None,
        editor: None,
        entry,
    }
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
    ObjectDecl { omit: omit.collect(), array: Some(Box::new(array)), ..object }
}

/// The sub-indices from 1 on.
pub(super) fn members(
    index: Index,
    part: &ObjectPart<'_>,
    context: &mut Context<'_>,
) -> Vec<(Spanned<SubIndex>, EntryDecl)> {
    let mut members = Vec::with_capacity(part.subs.len());
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
        let member = sub(id, section, context);
        members.push((Spanned::new(id.sub, section.place()), member));
    }
    members
}

/// One sub-index of an ARRAY or RECORD.
pub(super) fn sub(id: EntryId, section: &Part<'_>, context: &mut Context<'_>) -> EntryDecl {
    context.about(id);
    let usual = Form::of_sub(id);
    let form = section.value("ObjectType").map_or(usual, |text| match coded::object_code(text.value) {
        Some(code @ (2 | 7)) => {
            words::object_type(text, code, context.diagnostics);
            if code == 2 { Form::Domain } else { usual }
        }
        _ => {
            let found = context.format.set(Key::ObjectType, &shorten(text.value));
            let message = format!("{id}: a sub-index is a VAR, found {found}");
            context.push(
                Diagnostic::new(codes::BAD_OBJECT_TYPE, text.span, message)
                    .help("write `0x7`")
                    .edit(text.span, "0x7"),
            );
            usual
        }
    });
    let entry = entry::entry(section, id, form, context);
    node_texts::read(section, Denoted::entry(id), entry::type_of(&entry), context);
    context.about(id.index);
    entry
}
