//! What there is to know about what is at a position.

mod definition;
mod entry;
mod key;
mod section;
mod value;

use lsp_types::{Hover, HoverContents, MarkupContent, MarkupKind, Position};
use od_spec::model::{EntryId, System, Text};
use od_spec::names::{By, Found, Kind, Place, Spot};
use od_spec::source::Span;
use od_spec::wording::{Language, Wording};

pub(super) use value::{fact_of, value_of};

use super::analysis;
use super::cursor::{Cursor, entries_of};
use super::snapshot::Snapshot;

/// What there is to know, if there is something.
pub(super) fn hover(snapshot: &Snapshot, position: Position) -> Option<Hover> {
    let (text, span) = match snapshot.now.kind {
        analysis::Kind::Specification | analysis::Kind::Plant | analysis::Kind::Parameters => {
            at_cursor(&Cursor::of(snapshot, position)?)?
        }
        analysis::Kind::Eds => section::of_section(snapshot, position)?,
        analysis::Kind::Xdd => section::of_element(snapshot, position)?,
        analysis::Kind::Foreign | analysis::Kind::TooLarge => return None,
    };
    let contents = HoverContents::Markup(MarkupContent { kind: MarkupKind::Markdown, value: text });
    Some(Hover { contents, range: Some(snapshot.range(span)) })
}

/// The text, and what it is about.
fn at_cursor(cursor: &Cursor<'_>) -> Option<(String, Span)> {
    let words = Words::of(cursor.snapshot.system());
    if let Some((text, span)) = cursor.found().and_then(|found| of_name(cursor, found, words)) {
        return Some((text, span));
    }
    let place = cursor.place()?;
    match place.spot {
        Spot::Key { keys, name, .. } => Some((key::of_key(keys, name.value)?, name.span)),
        Spot::Value { node, .. } => {
            let of_value = value::of_value(cursor, &place, words).or_else(|| of_setting(cursor, &place));
            Some((of_value.or_else(|| around(&place))?, node.span))
        }
        Spot::Data { name, .. } => Some((around(&place)?, name.span)),
    }
}

/// The entry that is set at a place of a parameter file or plant.
fn of_setting(cursor: &Cursor<'_>, place: &Place<'_>) -> Option<String> {
    let setting = place.setting()?;
    let (system, device) = cursor.snapshot.device_of(&setting)?;
    entry::of_entry(system, setting.entry(device)?, &[&device.key], Words::of(Some(system)))
}

/// The key that leads to a place.
fn around(place: &Place<'_>) -> Option<String> {
    place.path.iter().rev().find_map(|step| match step {
        od_spec::names::Step::Key { keys, key, .. } => key::of_key(keys, key.name),
        od_spec::names::Step::Data { .. } | od_spec::names::Step::Item { .. } => None,
    })
}

fn of_name(cursor: &Cursor<'_>, found: Found<'_>, words: Words<'_>) -> Option<(String, Span)> {
    let system = cursor.snapshot.system();
    let names = cursor.names;
    let is_here =
        |span: &Span| span.file == cursor.snapshot.file && (span.start..=span.end).contains(&cursor.offset);
    match found {
        Found::Reference(one) => {
            let of_entry = || {
                let id = one.entry?;
                let devices = one.targets.iter().flat_map(|target| {
                    system
                        .map(|system| entries_of(system, names, names.definition(*target)))
                        .unwrap_or_default()
                });
                let mut keys: Vec<&str> = devices.map(|(device, _)| device.key.as_str()).collect();
                keys.sort_unstable();
                keys.dedup();
                entry::of_entry(system?, id, &keys, words)
            };
            let text = match (one.kind, one.by) {
                (Kind::Object | Kind::Entry | Kind::Pdo, _) => of_entry(),
                (Kind::Type, By::Word) => {
                    definition::of_data_type(cursor.snapshot.now.sources.text(one.span))
                }
                _ => {
                    let of_targets = one.targets.iter();
                    let texts = of_targets.map(|id| definition::of(cursor, names.definition(*id), words));
                    joined(texts)
                }
            };
            Some((text?, one.span))
        }
        Found::Definition(_, one) => {
            let span = if is_here(&one.span) { one.span } else { one.key };
            let text = match one.kind {
                Kind::Object | Kind::Entry => {
                    let entries = entries_of(system?, names, one);
                    let id: EntryId = entries.first()?.1;
                    let keys: Vec<&str> = entries.iter().map(|(device, _)| device.key.as_str()).collect();
                    entry::of_entry(system?, id, &keys, words)?
                }
                _ => definition::of(cursor, one, words),
            };
            Some((text, span))
        }
    }
}

/// Texts, one below the other, each once.
fn joined(texts: impl Iterator<Item = String>) -> Option<String> {
    let mut all: Vec<String> = Vec::new();
    for text in texts {
        if !all.contains(&text) {
            all.push(text);
        }
    }
    (!all.is_empty()).then(|| all.join("\n\n---\n\n"))
}

/// How facts are worded: as in the documents, in the language of the specification.
#[derive(Clone, Copy)]
pub(super) struct Words<'a> {
    pub wording: Wording,
    code: &'a str,
}

impl<'a> Words<'a> {
    pub(super) fn of(system: Option<&'a System>) -> Self {
        let code = system.map_or("en", System::language);
        Self { wording: Wording::manual(Language::of(code)), code }
    }

    /// A text in the language.
    fn text(self, text: &Text) -> Option<String> {
        let in_language = text.get(self.code).or_else(|| text.iter().next().map(|(_, text)| text));
        in_language.filter(|text| !text.is_empty()).map(escaped)
    }
}

/// A text in which nothing is markup.
pub(super) fn escaped(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut out, c| {
        if matches!(c, '[' | ']' | '<' | '>' | '*' | '_' | '`' | '\\' | '#' | '|') {
            out.push('\\');
        }
        out.push(c);
        out
    })
}

/// A text as code.
pub(super) fn code(text: &str) -> String {
    if text.contains('`') { format!("`` {text} ``") } else { format!("`{text}`") }
}
