//! What a specification keeps of objects for the stack CANopenNode.

use std::collections::BTreeMap;

use super::refs::Broken;
use crate::ast::{DeviceDecl, Name, NotesDecl};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::model::{EditorNotes, EntryId, Index, Object, PdoMapping, Storage, SubIndex};

/// Adds it to the objects.
pub(super) fn add(
    device: &DeviceDecl,
    objects: &mut BTreeMap<Index, Object>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) {
    for decl in &device.canopennode {
        let notes = notes(decl, diagnostics);
        let range = decl.range.value;
        for index in (range.first.0..=range.last.0).map(Index) {
            let Some(object) = objects.get_mut(&index) else {
                if broken.has(index) {
                    continue;
                }
                let id = EntryId { index, sub: SubIndex(0) };
                diagnostics.push(broken.missing(id, false, decl.range.span));
                break;
            };
            let missing = decl.srdo.iter().find(|(sub, _)| object.entry(SubIndex(**sub)).is_none());
            if let Some((sub, mapping)) = missing.filter(|_| !broken.has(index)) {
                let id = EntryId { index, sub: SubIndex(*sub) };
                diagnostics.push(broken.missing(id, true, mapping.span));
            }
            object.editor = (!notes.is_empty()).then(|| Box::new(notes.clone()));
            // A run of objects says it once.
            if let Some(conflict) = conflict(decl, object)
                && diagnostics.is_new(codes::CONFLICTING_KEYS, decl.range.span)
            {
                diagnostics.push(conflict);
            }
        }
    }
}

/// An entry that is stored by something else than its group: code for the stack would store it otherwise than all else says.
fn conflict(decl: &NotesDecl, object: &Object) -> Option<Diagnostic> {
    let (entry, group) = (object.stored_beside_group()?, decl.group.as_ref()?);
    let id = EntryId { index: object.index, sub: entry.sub };
    let message = format!(
        "group `{}` is `stored: {}`, and {id} is `stored: {}`",
        shorten(&group.value),
        Storage::of_group(&group.value).word(),
        entry.stored.word()
    );
    Some(
        Diagnostic::new(codes::CONFLICTING_KEYS, group.span, message)
            .help("correct `stored:` of the entry, or name another group"),
    )
}

fn notes(decl: &NotesDecl, diagnostics: &mut Diagnostics) -> EditorNotes {
    let mut notes = EditorNotes {
        count_label: name(decl.count.as_ref(), diagnostics),
        requests_tpdos: decl.requests_tpdos.is_some_and(|flag| flag.value),
        srdos: decl
            .srdo
            .iter()
            .filter(|(_, mapping)| mapping.value != PdoMapping::None)
            .map(|(sub, mapping)| (SubIndex(*sub), mapping.value))
            .collect(),
        ..EditorNotes::default()
    };
    notes.name_group(name(decl.group.as_ref(), diagnostics));
    notes
}

/// A name of which a name in C is made.
fn name(text: Option<&Name>, diagnostics: &mut Diagnostics) -> Option<String> {
    let text = text?;
    if !EditorNotes::is_name(&text.value) {
        let message = format!("`{}` cannot be a part of a name in C", shorten(&text.value));
        diagnostics.push(
            Diagnostic::new(codes::BAD_NOTATION, text.span, message)
                .help("write at most 64 letters, digits and `_`, such as `PERSIST_MFR`"),
        );
        return None;
    }
    Some(text.value.clone())
}
