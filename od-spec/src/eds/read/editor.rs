//! What CANopenEditor keeps of objects: in which group of CANopenNode values lie, and what else its code is made from.

use std::collections::BTreeMap;

use super::entry::{Context, type_of};
use super::without_place;
use crate::ast::{EntryDecl, ObjectDecl};
use crate::diag::shorten;
use crate::eds::number::lenient_integer;
use crate::eds::view::{ObjectPart, Part};
use crate::eds::{codes, editor};
use crate::model::{Access, DataType, EditorNotes, EditorProperty, PdoMapping, Storage, SubIndex};
use crate::notation::words::yes_no;
use crate::source::{Span, Spanned};
use crate::wording::FileFormat;

/// Adds what the sections of an object say in properties.
pub(super) fn add_to(mut object: ObjectDecl, part: &ObjectPart<'_>, context: &mut Context<'_>) -> ObjectDecl {
    let mut read = Properties::default();
    if let Some(main) = &part.object {
        read.section(None, main, context);
    }
    for (sub, part) in &part.subs {
        if let Ok(sub) = u8::try_from(*sub) {
            read.section(Some(SubIndex(sub)), part, context);
        }
    }
    if object.array.is_some() || object.record.is_some() {
        for (sub, entry) in object.entries_mut() {
            read.add_to_entry(sub, entry, sub == SubIndex(0));
        }
    } else {
        read.add_to_entry(SubIndex(0), &mut object.entry, false);
    }
    let Properties { group, mut notes, .. } = read;
    notes.name_group(group.map(|group| group.value));
    object.editor = Some(Box::new(notes)).filter(|notes| !notes.is_empty());
    object
}

/// What the sections of an object say.
#[derive(Default)]
struct Properties {
    notes: EditorNotes,
    group: Option<Spanned<String>>,
    /// The fewest characters of texts; a longer default needs more.
    lengths: BTreeMap<SubIndex, Spanned<i128>>,
}

impl Properties {
    /// Adds the length and what stores the value to an entry.
    fn add_to_entry(&self, sub: SubIndex, entry: &mut EntryDecl, is_count: bool) {
        if let Some(length) = self.lengths.get(&sub) {
            capacity(entry, *length);
        }
        if let Some(group) = &self.group {
            stored(entry, Storage::of_group(&group.value), is_count, group.span);
        }
    }

    /// Reads the section of the object, or that of an entry.
    fn section(&mut self, sub: Option<SubIndex>, part: &Part<'_>, context: &mut Context<'_>) {
        let sections = part.sections.iter().map(|section| (section.document(), section.body()));
        let lines = sections.flat_map(|(document, body)| {
            editor::own_lines(body).iter().map(move |line| (document.place(line), line))
        });
        for (place, line) in lines {
            let Some((property, text)) = editor::property(line) else { continue };
            let value = Spanned::new(text, place.unwrap_or_else(|| part.place()));
            if !text.is_empty() && !self.property(sub, property, value) {
                let found = match context.format {
                    FileFormat::Xdd => format!("{}={text}", property.name()),
                    FileFormat::Eds => line.text().trim().to_owned(),
                };
                let message = format!("`{}` cannot be understood; it is left out", shorten(&found));
                context.push(without_place(codes::NO_PLACE, value.span, message));
            }
        }
    }

    /// Whether a property can be understood. A group and a label are those of the object: what CANopenEditor writes of its
    /// entries counts for nothing.
    fn property(&mut self, sub: Option<SubIndex>, property: EditorProperty, value: Spanned<&str>) -> bool {
        let entry = sub.unwrap_or(SubIndex(0));
        match property {
            EditorProperty::StorageGroup | EditorProperty::CountLabel if sub.is_some() => true,
            EditorProperty::StorageGroup => {
                self.group =
                    Some(value.map(str::to_owned)).filter(|group| EditorNotes::is_name(&group.value));
                self.group.is_some()
            }
            EditorProperty::CountLabel => {
                self.notes.count_label =
                    Some(value.value.to_owned()).filter(|label| EditorNotes::is_name(label));
                self.notes.count_label.is_some()
            }
            EditorProperty::TpdoRequests => {
                let is_set = flag(value.value);
                self.notes.requests_tpdos |= is_set == Some(true);
                is_set.is_some()
            }
            EditorProperty::SrdoAccess => {
                let mapping = match value.value {
                    "no" => return true,
                    "rx" => PdoMapping::Receive,
                    "tx" => PdoMapping::Transmit,
                    "trx" => PdoMapping::Both,
                    _ => return false,
                };
                self.notes.srdos.insert(entry, mapping);
                true
            }
            EditorProperty::StringLength => {
                let Some(length) = lenient_integer(value.value).filter(|length| *length >= 0) else {
                    return false;
                };
                self.lengths.insert(entry, value.map(|_| length));
                true
            }
        }
    }
}

/// `1`, `true` or the opposite.
fn flag(text: &str) -> Option<bool> {
    match text {
        "1" => Some(true),
        "0" => Some(false),
        word => yes_no(word),
    }
}

/// Says what keeps an entry of a group. What has no default has no place in it. What can only be read is not a setting: it is
/// kept where the device itself changes it, which it does with no communication parameter and no count.
fn stored(entry: &mut EntryDecl, storage: Storage, is_count: bool, place: Span) {
    let is_kept = match entry.access.map(|access| access.value.access) {
        Some(Access::Const) | None => false,
        Some(Access::Ro) => !is_count && storage != Storage::Communication,
        Some(Access::Wo | Access::Rw | Access::Rwr | Access::Rww) => true,
    };
    let has_place = entry.default.is_some() || entry.capacity.is_some();
    if is_kept && has_place && storage != Storage::No && entry.stored.is_none() {
        entry.stored = Some(Spanned::new(storage, place));
    }
}

/// Says how long a text may be, or bytes: at least as long as the default.
fn capacity(entry: &mut EntryDecl, characters: Spanned<i128>) {
    let default = entry.default.as_ref().and_then(|default| default.value.text()).unwrap_or_default();
    let (width, default) = match type_of(entry) {
        Some(DataType::VisibleString) => (1, default.len()),
        Some(DataType::UnicodeString) => (2, default.encode_utf16().count()),
        // Two digits are a byte.
        Some(DataType::OctetString) => (1, default.bytes().filter(u8::is_ascii_hexdigit).count() / 2),
        Some(_) | None => return,
    };
    let length = characters.value.max(i128::try_from(default).unwrap_or(i128::MAX));
    let bytes = length.saturating_mul(width);
    entry.capacity = (1..=i128::from(u16::MAX)).contains(&bytes).then(|| characters.map(|_| bytes));
}
