//! Detail tables: one row per entry.

use od_spec::model::{
    Devices, Dictionary, Entry, EntryId, ErratumKind, Fact, Index, Object, Storage, TypeKind, Value,
};

use super::Columns;
use super::variants::device_keys;
use crate::language::Word;
use crate::source::Source;
use crate::view::cell::{entry_anchor, object_anchor};
use crate::view::{Cell, Grid, ObjectHead, Row};

/// Where the warnings of an object are said.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Warnings {
    /// In its table.
    Here,
    /// In a text next to the table.
    InText,
}

impl Source<'_> {
    /// The details of objects: those of one value that follow each other share a grid, an array or record has its own.
    /// `first` says whether links to an object lead here, `warned` those whose warnings are said next to the table.
    pub(crate) fn details(
        &self,
        indices: &[Index],
        first: impl Fn(Index) -> bool,
        warned: &[Index],
    ) -> Vec<Grid> {
        let mut grids: Vec<Grid> = Vec::new();
        let mut simple: Vec<Row> = Vec::new();
        for index in indices {
            let warnings = if warned.contains(index) { Warnings::InText } else { Warnings::Here };
            let variants = self.variants(*index, |device, object| {
                let head = object.is_structured().then(|| {
                    (object.name.clone(), object.kind, object.about.clone(), object.warning.clone())
                });
                let rows = self.entry_rows(device, object, false, warnings);
                let texts =
                    rows.iter().map(|row| row.cells.iter().map(|cell| cell.text.clone()).collect::<Vec<_>>());
                (head, texts.collect::<Vec<_>>())
            });
            let several = variants.len() > 1;
            for (number, devices) in variants.iter().enumerate() {
                let Some((device, object)) =
                    devices.first().and_then(|device| Some((*device, device.objects.get(index)?)))
                else {
                    continue;
                };
                let anchors = first(*index) && number == 0;
                let mut rows = self.entry_rows(device, object, anchors, warnings);
                let label = if several { device_keys(devices) } else { String::new() };
                if object.is_structured() {
                    grids.extend(self.simple_grid(std::mem::take(&mut simple)));
                    let head = ObjectHead {
                        index: object.index.to_string(),
                        anchor: if anchors { object_anchor(*index) } else { String::new() },
                        name: object.name.clone(),
                        kind: object.kind.name(),
                        about: self.text_on(&Devices::one(&device.key), &object.about),
                        warning: match warnings {
                            Warnings::Here => self.warning(device, object),
                            Warnings::InText => Cell::default(),
                        },
                        device: label,
                    };
                    grids.push(Grid { object: Some(head), ..self.entry_columns(object).grid(rows, ALWAYS) });
                } else {
                    for cell in rows.iter_mut().filter_map(|row| row.cells.last_mut()) {
                        *cell = Cell::plain(&label);
                    }
                    simple.extend(rows);
                }
            }
        }
        grids.extend(self.simple_grid(simple));
        grids
    }

    fn simple_grid(&self, rows: Vec<Row>) -> Option<Grid> {
        if rows.is_empty() {
            return None;
        }
        Some(self.columns(Columns::new().left(self, "index", Word::Index)).grid(rows, ALWAYS))
    }

    /// The columns of an object's own table.
    pub(crate) fn entry_columns(&self, object: &Object) -> Columns {
        self.columns(if object.is_structured() {
            Columns::new().right(self, "sub", Word::SubIndex)
        } else {
            Columns::new().left(self, "index", Word::Index)
        })
    }

    fn columns(&self, first: Columns) -> Columns {
        first
            .left(self, "name", Word::Name)
            .left(self, "type", Word::Type)
            .left(self, "access", Word::Access)
            .left(self, "map", Word::Map)
            .left(self, "default", Word::Default)
            .left(self, "unit", Word::Unit)
            .left(self, "range", Word::Range)
            .left(self, "stored", Word::Stored)
            .left(self, "description", Word::Description)
            .left(self, "device", Word::Device)
    }

    /// The rows of an object's entries, with their warnings or without; the first cell is the index of a VAR, or the sub-index.
    pub(crate) fn entry_rows(
        &self,
        device: &Dictionary,
        object: &Object,
        anchors: bool,
        warnings: Warnings,
    ) -> Vec<Row> {
        object
            .entries
            .iter()
            .map(|entry| {
                let id = EntryId { index: object.index, sub: entry.sub };
                let place =
                    if object.is_structured() { entry.sub.to_string() } else { object.index.to_string() };
                let anchor = match (anchors, entry.sub.0) {
                    (false, _) => String::new(),
                    // The count of entries; links to the object lead to its heading.
                    (true, 0) if object.is_structured() => format!("{}.0", object_anchor(object.index)),
                    (true, _) => entry_anchor(id),
                };
                let stated = |facts: &[Fact]| self.stated(device, object, entry, facts);
                let cell = |text: String, facts: &[Fact]| Cell::plain(text).stated(stated(facts));
                let unit = entry.unit.as_ref().map_or_else(Cell::default, |unit| self.unit_link(unit));
                let range = self.wording.range(object.index, entry).unwrap_or_default();
                let mark = |at: usize| {
                    let column = column_of_entry(self.system.errata[at].kind);
                    self.mark(at, column.unwrap_or_default())
                };
                Row {
                    anchor,
                    also: Vec::new(),
                    cells: vec![
                        Cell::plain(place),
                        cell(entry.name.clone(), &[Fact::Name]),
                        cell(entry.data_type.name().to_owned(), &[Fact::Type]),
                        cell(self.wording.access(entry), &[Fact::Access]),
                        cell(self.wording.mapping(entry.pdo).to_owned(), &[Fact::Mapping]),
                        cell(self.default(object, entry), &[Fact::Default]),
                        unit.stated(stated(&[Fact::Unit])),
                        cell(range, &[Fact::LowLimit, Fact::HighLimit]),
                        cell(self.wording.storage(entry.stored).to_owned(), &[Fact::Storage]),
                        self.description(device, object, entry, warnings).stated(stated(&[Fact::About])),
                        Cell::default(),
                    ],
                    stored: entry.stored != Storage::No,
                    errata: self.errata_of_entry(object, entry).into_iter().map(mark).collect(),
                }
            })
            .collect()
    }

    /// The default; empty where there is none.
    pub(crate) fn default(&self, object: &Object, entry: &Entry) -> String {
        let value = |value| self.wording.value(Some(object.index), entry, value);
        entry.default.as_ref().map_or_else(String::new, value)
    }

    /// Meaning of an entry and what else is to be known about it.
    fn description(&self, device: &Dictionary, object: &Object, entry: &Entry, warnings: Warnings) -> Cell {
        let of_device = Devices::one(&device.key);
        let mut cell = self.text_on(&of_device, &entry.about);
        if warnings == Warnings::Here && !entry.warning.is_empty() {
            let label = format!("{}:", self.word(Word::Warning));
            cell = cell.line().strong(label).text(" ").and(self.text_on(&of_device, &entry.warning));
        }
        if let (Some(TypeKind::Bits(fields)), Some(Value::Integer(raw))) =
            (entry.named_type.as_ref().map(|named| &named.kind), &entry.default)
            && let Some(bits) = self.set_bits(fields, *raw)
        {
            cell = cell.line().text(self.sentence(Word::SetByDefault, &bits));
        }
        for special in &entry.special {
            cell = cell.line().text(self.wording.special(entry, special));
            if !special.about.is_empty() {
                cell = cell.text("; ").and(self.text_on(&of_device, &special.about));
            }
        }
        if let Some(alias) = &entry.alias {
            cell = cell
                .line()
                .text(format!("{} ", self.word(Word::AliasOf)))
                .and(self.entry_link_on(device, alias.target));
            cell = cell.text(format!("; {}.", self.wording.conversion(alias)));
        }
        if let Some(capacity) = entry.capacity {
            cell = cell.line().text(self.sentence(Word::Capacity, &capacity.to_string()));
        }
        if let Some(condition) = &entry.writable_when {
            cell = cell.line().text(format!("{}: ", self.word(Word::WritableWhen)));
            cell = cell.and(self.condition(condition, &of_device)).text(".");
        }
        if let Some(since) = entry.since.as_ref().filter(|since| object.since.as_ref() != Some(*since)) {
            cell = cell.line().text(format!("{} {since}.", self.word(Word::Since)));
        }
        cell
    }
}

/// The column that has a fact of an entry.
pub(crate) const fn column_of_entry(kind: ErratumKind) -> Option<&'static str> {
    match kind {
        ErratumKind::Index => Some("index"),
        ErratumKind::Name => Some("name"),
        ErratumKind::Type | ErratumKind::Sign => Some("type"),
        ErratumKind::Access => Some("access"),
        ErratumKind::SubIndex => Some("sub"),
        ErratumKind::Default => Some("default"),
        ErratumKind::Limit => Some("range"),
        ErratumKind::Unit => Some("unit"),
        ErratumKind::Pdo => Some("map"),
        ErratumKind::Stored => Some("stored"),
        ErratumKind::ObjectType
        | ErratumKind::Count
        | ErratumKind::Bits
        | ErratumKind::Values
        | ErratumKind::Table
        | ErratumKind::Text
        | ErratumKind::Gap
        | ErratumKind::Profile => None,
    }
}

/// Columns that are there even when nothing fills them.
pub(crate) const ALWAYS: &[&str] =
    &["index", "sub", "name", "type", "access", "map", "default", "description"];
