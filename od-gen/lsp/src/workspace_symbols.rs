//! Objects, entries, types and units of everything that is open, by index or name.

use std::collections::BTreeSet;

use lsp_types::{Location, OneOf};
use lsp_types::{SymbolKind, WorkspaceSymbol};
use od_spec::model::{Dictionary, EntryId, Object, ObjectKind};
use od_spec::source::Span;

use super::snapshot::Snapshot;

/// What is looked for.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Query {
    /// What has a number that begins so: four digits of the index, and the sub-index where one is given.
    Number { index: String, sub: Option<u8> },
    /// What has these characters in its name; everything for an empty text.
    Name(String),
}

impl Query {
    /// `6041`, `0x6041`, `6041h`, `6041.1`, `6041sub1`; anything else is a name.
    fn of(text: &str) -> Self {
        let text = text.trim().to_lowercase();
        let (index, sub) = match text.split_once('.').or_else(|| text.split_once("sub")) {
            Some((index, sub)) => (index, Some(sub)),
            None => (text.as_str(), None),
        };
        let digits = index.strip_prefix("0x").unwrap_or_else(|| index.strip_suffix('h').unwrap_or(index));
        let is_number = (1..=4).contains(&digits.len()) && digits.bytes().all(|c| c.is_ascii_hexdigit());
        // `fee` is a number, too, but who means it writes `0xfee`.
        let is_meant =
            digits.len() < index.len() || digits.bytes().next().is_some_and(|c| c.is_ascii_digit());
        let sub = sub.map(str::parse::<u8>);
        match sub.transpose() {
            Ok(sub) if is_number && is_meant => Query::Number { index: digits.to_uppercase(), sub },
            _ => Query::Name(text),
        }
    }

    fn finds_object(&self, object: &Object) -> bool {
        match self {
            Query::Number { index, sub } => sub.is_none() && number_of(object).starts_with(index.as_str()),
            Query::Name(name) => object.name.to_lowercase().contains(name.as_str()),
        }
    }

    fn finds_entry(&self, object: &Object, id: EntryId, name: &str) -> bool {
        match self {
            Query::Number { index, sub } => *sub == Some(id.sub.0) && number_of(object) == *index,
            Query::Name(part) => !part.is_empty() && name.to_lowercase().contains(part.as_str()),
        }
    }

    fn finds_definition(&self, defined: &str) -> bool {
        match self {
            Query::Number { .. } => false,
            Query::Name(name) => !name.is_empty() && defined.to_lowercase().contains(name.as_str()),
        }
    }
}

/// The four digits of an index.
fn number_of(object: &Object) -> String {
    format!("{:04X}", object.index.0)
}

/// What is found in some specifications, each place once.
pub(super) fn find(query: &str, snapshots: &[Snapshot]) -> Vec<WorkspaceSymbol> {
    let query = Query::of(query);
    let mut found = Vec::new();
    for snapshot in snapshots {
        let Some((good, system)) = snapshot.good.as_ref().and_then(|good| Some((good, good.system()?)))
        else {
            continue;
        };
        let mut add = |name: String, kind: SymbolKind, container: Option<String>, span: Span| {
            if let Some(location) = snapshot.location(good, span) {
                found.push(symbol(name, kind, container, location));
            }
        };
        for device in &system.devices {
            for object in device.objects.values() {
                of_object(&query, device, object, &mut add);
            }
        }
        for (name, named) in system.types.iter().filter(|(name, _)| query.finds_definition(name)) {
            add(name.clone(), SymbolKind::ENUM, None, named.stated.span);
        }
        for (name, unit) in system.units.iter().filter(|(name, _)| query.finds_definition(name)) {
            add(name.clone(), SymbolKind::CONSTANT, None, unit.stated.span);
        }
    }
    let mut seen = BTreeSet::new();
    found.retain(|symbol| seen.insert(identity(symbol)));
    found
}

/// An object that several devices have is one place.
fn identity(symbol: &WorkspaceSymbol) -> (String, String) {
    let place = match &symbol.location {
        OneOf::Left(location) => {
            let start = location.range.start;
            format!("{}:{}:{}", location.uri.as_str(), start.line, start.character)
        }
        OneOf::Right(document) => document.uri.as_str().to_owned(),
    };
    (symbol.name.clone(), place)
}

fn of_object(
    query: &Query,
    device: &Dictionary,
    object: &Object,
    add: &mut impl FnMut(String, SymbolKind, Option<String>, Span),
) {
    let kind = match object.kind {
        ObjectKind::Var | ObjectKind::Domain => SymbolKind::VARIABLE,
        ObjectKind::Array => SymbolKind::ARRAY,
        ObjectKind::Record => SymbolKind::STRUCT,
    };
    if query.finds_object(object) {
        add(format!("0x{} {}", number_of(object), object.name), kind, Some(device.key.clone()), object.span);
    }
    for entry in object.entries.iter().filter(|_| object.is_structured()) {
        let id = EntryId { index: object.index, sub: entry.sub };
        if query.finds_entry(object, id, &entry.name) {
            let name = format!("0x{}.{} {}", number_of(object), entry.sub.0, entry.name);
            add(name, SymbolKind::FIELD, Some(object.name.clone()), entry.span);
        }
    }
}

fn symbol(name: String, kind: SymbolKind, container: Option<String>, location: Location) -> WorkspaceSymbol {
    WorkspaceSymbol {
        name,
        kind,
        tags: None,
        container_name: container,
        location: OneOf::Left(location),
        data: None,
    }
}

#[cfg(test)]
mod tests {
    use super::Query;

    #[test]
    fn numbers_are_written_in_many_ways() {
        let number = |index: &str, sub| Query::Number { index: index.to_owned(), sub };
        for text in ["6041", "0x6041", "6041h", " 0X6041 "] {
            assert_eq!(Query::of(text), number("6041", None), "{text}");
        }
        assert_eq!(Query::of("60f"), number("60F", None));
        assert_eq!(Query::of("0xfee"), number("FEE", None));
        assert_eq!(Query::of("1018.4"), number("1018", Some(4)));
        assert_eq!(Query::of("1018sub4"), number("1018", Some(4)));
        for text in ["fee", "speed", "60411", "6041.x", "", "subindex"] {
            assert_eq!(Query::of(text), Query::Name(text.to_owned()), "{text}");
        }
    }
}
