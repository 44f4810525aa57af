//! Keys of the sections of an EDS or DCF, and the values that have words or numbers of their own.

use lsp_types::{CompletionItem, CompletionItemKind, Position};
use od_spec::eds::{Document, keys_of_section};
use od_spec::model::{DataType, ObjectKind};
use od_spec::source::Span;

use super::Insertion;
use super::items::{Insert, Offer, Written, access_types};
use crate::snapshot::Snapshot;

/// What could be written at a position of an EDS or DCF.
pub(super) fn completion(
    snapshot: &Snapshot,
    position: Position,
    insertion: &Insertion,
) -> Vec<CompletionItem> {
    let (text, offset) = (snapshot.text(), snapshot.offset(position));
    let start = text[..offset].rfind(['\n', '\r']).map_or(0, |at| at + 1);
    let end = text[offset..].find(['\n', '\r']).map_or(text.len(), |at| offset + at);
    let line = &text[start..end];
    if line.starts_with([';', '#', '[']) {
        return Vec::new();
    }
    let written = |from: usize, to: usize, follows: char| Written {
        start: from,
        end: to.max(offset),
        before: text[from..offset].to_owned(),
        after: text[offset..to.max(offset)].to_owned(),
        quote: None,
        follows,
    };
    let (offers, written) = match line.find('=').filter(|at| start + at < offset) {
        Some(equals) => (of_value(line[..equals].trim()), written(start + equals + 1, end, '\n')),
        None => {
            let length = line.find('=').unwrap_or(line.len());
            let written = written(start, start + length, line[length..].chars().next().unwrap_or('\n'));
            (keys(snapshot, start, &written), written)
        }
    };
    let position = |byte: usize| snapshot.lines().position(text, byte, snapshot.encoding);
    offers.into_iter().map(|offer| offer.into_item(&written, insertion, position)).collect()
}

/// The keys that the section of a line does not have yet.
fn keys(snapshot: &Snapshot, line: usize, written: &Written) -> Vec<Offer> {
    let document = Document::scan(snapshot.file, snapshot.text());
    let Ok(start) = u32::try_from(line) else { return Vec::new() };
    let begins_before = |place: Option<Span>| place.is_some_and(|place| place.start <= start);
    let sections = document.sections().take_while(|section| begins_before(document.place(section.header())));
    let Some(section) = sections.last() else { return Vec::new() };
    let has =
        |name: &str| section.keys().any(|line| line.key().is_some_and(|key| key.eq_ignore_ascii_case(name)));
    let equals = if written.follows == '=' { "" } else { "=" };
    let offer = |(order, name): (usize, &str)| Offer {
        insert: Insert::Raw(format!("{name}{equals}")),
        order,
        goes_on: true,
        ..Offer::word(name, CompletionItemKind::PROPERTY)
    };
    keys_of_section(section.name()).filter(|name| !has(name)).enumerate().map(offer).collect()
}

/// The values of a key.
fn of_value(key: &str) -> Vec<Offer> {
    let is = |name: &str| key.eq_ignore_ascii_case(name);
    let number = |(order, (number, word)): (usize, (String, String))| {
        let offer = Offer::word(&number, CompletionItemKind::ENUM_MEMBER).detail(word.clone()).also(word);
        Offer { order, ..offer }
    };
    let numbers = |pairs: Vec<(String, String)>| pairs.into_iter().enumerate().map(number).collect();
    let begins = |front: &str| key.get(..front.len()).is_some_and(|start| start.eq_ignore_ascii_case(front));
    if is("DataType") {
        let types = DataType::ALL.into_iter();
        numbers(types.map(|one| (format!("0x{:04X}", one.code()), one.to_string())).collect())
    } else if is("ObjectType") {
        let kinds = [ObjectKind::Var, ObjectKind::Array, ObjectKind::Record, ObjectKind::Domain];
        numbers(
            kinds.into_iter().map(|kind| (format!("0x{:X}", kind.code()), kind.name().to_owned())).collect(),
        )
    } else if is("AccessType") {
        access_types()
    } else if is("PDOMapping")
        || ["BaudRate_", "Dummy", "SimpleBootUp"].into_iter().any(begins)
        || ["GroupMessaging", "LSS_Supported", "CANopenManager"].into_iter().any(is)
    {
        numbers(vec![("0".to_owned(), "no".to_owned()), ("1".to_owned(), "yes".to_owned())])
    } else {
        Vec::new()
    }
}
