//! Detail tables: one row per entry.

use od_spec::model::{
    Alias, Dictionary, Entry, EntryId, Index, Object, Origin, Outside, Ratio, Rounding, Storage, Value,
};

use super::overview::{access, mapping};
use super::{Columns, pdos};
use crate::cell::{entry_anchor, object_anchor};
use crate::language::Word;
use crate::source::Source;
use crate::view::{Cell, Grid, ObjectHead, Row};

impl Source<'_> {
    /// The details of objects: those of one value that follow each other share a grid, an array or record has its own.
    /// `first` tells whether links to an object lead here.
    pub(crate) fn details(&self, indices: &[Index], first: impl Fn(Index) -> bool) -> Vec<Grid> {
        let mut grids: Vec<Grid> = Vec::new();
        let mut simple: Vec<Row> = Vec::new();
        for index in indices {
            let mut shown: Vec<Vec<Vec<Cell>>> = Vec::new();
            let owners: Vec<&Dictionary> =
                self.devices.iter().copied().filter(|device| device.objects.contains_key(index)).collect();
            for device in &owners {
                let Some(object) = device.objects.get(index) else { continue };
                let rows = self.entry_rows(device, object, first(*index) && shown.is_empty());
                let cells: Vec<Vec<Cell>> = rows.iter().map(|row| row.cells.clone()).collect();
                // Devices share most of their common objects; what is equal stands once.
                if shown.contains(&cells) {
                    continue;
                }
                let several = owners.len() > 1
                    && owners.iter().any(|other| {
                        let other =
                            other.objects.get(index).map(|object| self.entry_rows(device, object, false));
                        other.is_some_and(|rows| rows.iter().map(|row| &row.cells).ne(cells.iter()))
                    });
                shown.push(cells);
                if object.is_structured() {
                    grids.extend(self.simple_grid(std::mem::take(&mut simple)));
                    let head = ObjectHead {
                        index: object.index.to_string(),
                        anchor: if first(*index) && shown.len() == 1 {
                            object_anchor(*index)
                        } else {
                            String::new()
                        },
                        name: object.name.clone(),
                        kind: object.kind.name(),
                        about: self.text(&object.about),
                        device: if several { device.key.clone() } else { String::new() },
                    };
                    grids.push(Grid { object: Some(head), ..self.entry_columns(object).grid(rows, ALWAYS) });
                } else {
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
            .left(self, "description", Word::Description)
    }

    /// The rows of an object's entries; the first cell is the index of a VAR, or the sub-index.
    pub(crate) fn entry_rows(&self, device: &Dictionary, object: &Object, anchors: bool) -> Vec<Row> {
        object
            .entries
            .iter()
            .map(|entry| {
                let id = EntryId { index: object.index, sub: entry.sub };
                let place =
                    if object.is_structured() { entry.sub.to_string() } else { object.index.to_string() };
                let anchored = anchors && (entry.sub.0 > 0 || !object.is_structured());
                Row {
                    anchor: if anchored { entry_anchor(id) } else { String::new() },
                    cells: vec![
                        Cell::plain(place),
                        Cell::plain(&entry.name),
                        Cell::plain(entry.data_type.name()),
                        Cell::plain(access(entry)),
                        Cell::plain(mapping(entry.pdo)),
                        Cell::plain(self.default(object, entry)),
                        Cell::plain(entry.unit.as_ref().map_or_else(String::new, |unit| self.step(unit))),
                        Cell::plain(self.range(entry)),
                        self.description(device, object, entry),
                    ],
                    stored: entry.stored != Storage::No,
                    errata: self.errata_of_entry(object, entry).iter().map(|at| at + 1).collect(),
                }
            })
            .collect()
    }

    /// The default; that of a mapping parameter in its parts: index, sub-index, bits.
    pub(crate) fn default(&self, object: &Object, entry: &Entry) -> String {
        match &entry.default {
            Some(Value::Integer(raw))
                if object.origin == Origin::Pdo && is_mapping(object.index) && entry.sub.0 > 0 =>
            {
                pdos::parameter(u32::try_from(*raw).unwrap_or_default())
            }
            Some(value) => self.value(entry, value),
            None => String::new(),
        }
    }

    /// Meaning of an entry and what else is to be known about it.
    fn description(&self, device: &Dictionary, object: &Object, entry: &Entry) -> Cell {
        let mut cell = self.text(&entry.about);
        for special in &entry.special {
            let mut line = cell.line().text(format!("{}: {}", special.value, special.name));
            if !special.about.is_empty() {
                line = line.text("; ").and_words(&special.about, self.language);
            }
            cell = line;
        }
        if let Some(alias) = &entry.alias {
            cell =
                cell.line().text(format!("{} ", self.word(Word::AliasOf))).and(self.entry_link(alias.target));
            cell = cell.text(format!("; {}.", self.conversion(alias)));
        }
        if let Some(condition) = &entry.writable_when {
            let devices = std::slice::from_ref(&device.key);
            cell = cell.line().text(format!("{}: ", self.word(Word::WritableWhen)));
            cell = cell.and(self.condition(condition, devices)).text(".");
        }
        if let Some(since) = entry.since.as_ref().filter(|since| object.since.as_ref() != Some(*since)) {
            cell = cell.line().text(format!("{} {since}.", self.word(Word::Since)));
        }
        cell
    }

    /// How an alias converts.
    pub(crate) fn conversion(&self, alias: &Alias) -> String {
        let outside = self.word(match alias.outside {
            Outside::Saturate => Word::OutsideSaturate,
            Outside::Wrap => Word::OutsideWrap,
            Outside::Abort => Word::OutsideAbort,
        });
        if alias.factor == Ratio::ONE {
            return outside.to_owned();
        }
        let rounding = self.word(match alias.rounding {
            Rounding::Down => Word::RoundedDown,
            Rounding::Up => Word::RoundedUp,
            Rounding::Nearest => Word::RoundedNearest,
            Rounding::Zero => Word::RoundedZero,
        });
        format!("× {}, {rounding}; {outside}", self.language.number(&alias.factor.to_string()))
    }
}

/// Whether an object holds mapping parameters.
fn is_mapping(index: Index) -> bool {
    matches!(index.0, 0x1600..=0x17FF | 0x1A00..=0x1BFF)
}

/// Columns that stand even when nothing fills them.
pub(crate) const ALWAYS: &[&str] =
    &["index", "sub", "name", "type", "access", "map", "default", "description"];
