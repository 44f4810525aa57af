//! What an editor shows between the characters: the raw value of a physical one, the place of an entry in a PDO, the CAN-ID of a PDO, the
//! name of an entry in an EDS.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use lsp_types::{InlayHint, InlayHintLabel, InlayHintTooltip, Position, Range};
use od_spec::model::{Direction, Pdo, System, Value};
use od_spec::order::Arrange as _;
use od_spec::scalar;
use od_spec::source::{Span, Spanned};
use od_spec::yaml::Node;
use serde_json::Value as Json;

use super::analysis::{Analysis, Kind};
use super::eds::{Referring, referring};
use super::hover::{Words, fact_of, value_of};
use super::snapshot::Snapshot;

/// A kind of hint, which a client can do without.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Hint {
    /// The raw value of a physical one.
    RawValue,
    /// Byte and bit of an entry in a PDO.
    PdoPlace,
    /// The identifier of a PDO.
    CobId,
    /// The name of the entry that a number means in an EDS.
    EntryName,
}

impl Hint {
    const ALL: [Hint; 4] = [Hint::RawValue, Hint::PdoPlace, Hint::CobId, Hint::EntryName];

    /// Its name in the options.
    const fn name(self) -> &'static str {
        match self {
            Hint::RawValue => "raw-values",
            Hint::PdoPlace => "pdo-places",
            Hint::CobId => "cob-ids",
            Hint::EntryName => "entry-names",
        }
    }

    /// The hints that a client wants: those that its `initializationOptions` list under `inlayHints`, or all.
    pub(super) fn wanted(options: Option<&Json>) -> BTreeSet<Hint> {
        let listed = options.and_then(|options| options.get("inlayHints")).and_then(Json::as_array);
        let is_wanted = |hint: &Hint| {
            listed.is_none_or(|listed| listed.iter().any(|name| name.as_str() == Some(hint.name())))
        };
        Self::ALL.into_iter().filter(is_wanted).collect()
    }
}

/// The hints in a range of a document.
pub(super) fn hints(snapshot: &Snapshot, range: Range, wanted: &BTreeSet<Hint>) -> Vec<InlayHint> {
    let Some((good, system)) = snapshot.good.as_ref().zip(snapshot.system()) else { return Vec::new() };
    let mut hints = Vec::new();
    match snapshot.now.kind {
        Kind::Specification => {}
        Kind::Eds if wanted.contains(&Hint::EntryName) => hints.extend(entry_names(snapshot, system)),
        Kind::Eds | Kind::Xdd | Kind::Plant | Kind::Parameters | Kind::Foreign | Kind::TooLarge => {}
    }
    if snapshot.now.kind == Kind::Specification && wanted.contains(&Hint::RawValue) {
        hints.extend(raw_values(snapshot, good, system));
    }
    if snapshot.now.kind == Kind::Specification {
        hints.extend(of_pdos(snapshot, system, wanted));
    }
    hints.retain(|hint| range.start <= hint.position && hint.position <= range.end);
    hints.arrange_by_key(|hint| hint.position);
    hints
}

fn hint(position: Position, label: String, about: &str) -> InlayHint {
    InlayHint {
        position,
        label: InlayHintLabel::String(label),
        kind: None,
        text_edits: None,
        tooltip: Some(InlayHintTooltip::String(about.to_owned())),
        padding_left: Some(true),
        padding_right: None,
        data: None,
    }
}

/// The names of the entries that values of an EDS mean.
fn entry_names(snapshot: &Snapshot, system: &System) -> Vec<InlayHint> {
    let Some(device) = system.devices.first() else { return Vec::new() };
    let named = |referring: Referring| {
        let object = device.objects.get(&referring.id.index)?;
        let entry = device.entry_name(referring.id);
        // A list names whole objects.
        let name = if referring.id.sub.0 == 0 { object.name.clone() } else { entry? };
        Some(hint(snapshot.range(referring.value).end, name, "name of the entry"))
    };
    referring(snapshot.file, snapshot.text()).into_iter().filter_map(named).collect()
}

/// The raw values of values that are written with a unit.
fn raw_values(snapshot: &Snapshot, good: &Arc<Analysis>, system: &System) -> Vec<InlayHint> {
    // If one text means several raw values, none of them is shown.
    let mut seen: BTreeMap<Span, Option<i128>> = BTreeMap::new();
    let file = snapshot.now.place(snapshot.file);
    for device in &system.devices {
        for (_, _, entry) in device.entries().filter(|(_, _, entry)| entry.unit.is_some()) {
            for fact in ["default", "min", "max"].into_iter().filter_map(fact_of) {
                let Some(stated) = entry.facts.get(fact) else { continue };
                if good.place(stated.span.file) != file {
                    continue;
                }
                let Some(Value::Integer(raw)) = value_of(entry, fact) else { continue };
                let written = good.sources.text(stated.span).trim_matches(['"', '\'']);
                // A plain number is the raw value itself, and lists have several.
                let is_one = !written.starts_with(['[', '{', '*']) && !written.contains('\n');
                // A step of 1 gives the number that is written.
                let number = written.split(' ').next().and_then(|number| scalar::integer(number).ok());
                let is_new = number != Some(raw);
                if is_one && is_new && written.contains(' ') && scalar::integer(written).is_err() {
                    let raw = Some(raw);
                    let known = seen.entry(stated.span).or_insert(raw);
                    *known = raw.filter(|_| *known == raw);
                }
            }
        }
    }
    seen.into_iter()
        .filter_map(|(span, raw)| {
            let location = snapshot.location(good, span)?;
            Some(hint(location.range.end, raw?.to_string(), "raw value"))
        })
        .collect()
}

/// What is known about the PDOs of the document as it is now, as far as it is that of the model.
fn of_pdos(snapshot: &Snapshot, system: &System, wanted: &BTreeSet<Hint>) -> Vec<InlayHint> {
    let words = Words::of(Some(system)).wording;
    let mut hints = Vec::new();
    let sections = snapshot.now.outline(snapshot.file).and_then(|tree| tree.get("pdos"));
    for (device, node) in sections.map(Node::entries).unwrap_or_default() {
        let Some(device) = system.device(&device.value) else { continue };
        for direction in [Direction::Receive, Direction::Transmit] {
            for (key, node) in node.get(direction.word()).map(Node::entries).unwrap_or_default() {
                let Some(pdo) = pdo_of(device.pdos_of(direction), key) else { continue };
                let is_written = node.get("cob-id").is_some();
                let is_shown = wanted.contains(&Hint::CobId) && !is_written;
                if let Some(cob_id) = pdo.cob_id.as_ref().filter(|_| is_shown) {
                    let end = snapshot.range(key.span).end;
                    hints.push(hint(end, words.can_id(cob_id), "CAN-ID"));
                }
                if wanted.contains(&Hint::PdoPlace) {
                    hints.extend(places(snapshot, pdo, node));
                }
            }
        }
    }
    hints
}

fn pdo_of<'a>(mut pdos: impl Iterator<Item = &'a Pdo>, key: &Spanned<String>) -> Option<&'a Pdo> {
    let number = scalar::integer(&key.value).ok()?;
    pdos.find(|pdo| i128::from(pdo.number) == number)
}

/// Where each item of a map begins in the PDO.
fn places(snapshot: &Snapshot, pdo: &Pdo, node: &Node) -> Vec<InlayHint> {
    let items = node.get("map").map(Node::items).unwrap_or_default();
    let lengths: Vec<usize> = items.iter().map(fields_of).collect();
    // The text says something else than the model at the moment.
    if lengths.iter().sum::<usize>() != pdo.map.len() {
        return Vec::new();
    }
    let fields: Vec<_> = pdo.fields().collect();
    let mut at = 0;
    let mut hints = Vec::new();
    for (item, length) in items.iter().zip(lengths) {
        if let Some(field) = fields.get(at) {
            let bit = if field.bit() == 0 { String::new() } else { format!(".{}", field.bit()) };
            let end = snapshot.range(item.span).end;
            hints.push(hint(
                end,
                format!("byte {}{bit}", field.byte()),
                "first byte, and its bit where that is not 0",
            ));
        }
        at += length;
    }
    hints
}

/// How many entries an item of a map is: `0x2021.1..4` is four.
fn fields_of(item: &Node) -> usize {
    let run = item.text().and_then(|text| {
        let (_, subs) = text.value.split_once('.').filter(|(object, _)| object.starts_with("0x"))?;
        let (first, last) = subs.split_once("..")?;
        let (first, last) = (scalar::integer(first).ok()?, scalar::integer(last).ok()?);
        usize::try_from(last - first + 1).ok()
    });
    run.unwrap_or(1)
}
