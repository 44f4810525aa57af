//! Detail tables: one row per entry.

use od_spec::model::{
    Alias, DataType, Dictionary, Entry, EntryId, Fact, Index, Object, Origin, Outside, Ratio, Rounding,
    Storage, Value,
};

use super::overview::{access, mapping};
use super::{Columns, pdos};
use crate::cell::{entry_anchor, object_anchor};
use crate::language::Word;
use crate::source::{Source, bit_pattern};
use crate::view::{Cell, Grid, ObjectHead, Row};

impl Source<'_> {
    /// The details of objects: those of one value that follow each other share a grid, an array or record has its own.
    /// `first` tells whether links to an object lead here.
    pub(crate) fn details(&self, indices: &[Index], first: impl Fn(Index) -> bool) -> Vec<Grid> {
        let mut grids: Vec<Grid> = Vec::new();
        let mut simple: Vec<Row> = Vec::new();
        for index in indices {
            let variants = self.variants(*index, |device, object| {
                let head =
                    object.is_structured().then(|| (object.name.clone(), object.kind, object.about.clone()));
                let rows = self.entry_rows(device, object, false);
                let texts =
                    rows.iter().map(|row| row.cells.iter().map(|cell| cell.text.clone()).collect::<Vec<_>>());
                (head, texts.collect::<Vec<_>>())
            });
            let several = variants.len() > 1;
            for (number, devices) in variants.iter().enumerate() {
                let Some((device, object)) =
                    devices.first().and_then(|one| Some((*one, one.objects.get(index)?)))
                else {
                    continue;
                };
                let anchors = first(*index) && number == 0;
                let mut rows = self.entry_rows(device, object, anchors);
                let label = if several { keys(devices) } else { String::new() };
                if object.is_structured() {
                    grids.extend(self.simple_grid(std::mem::take(&mut simple)));
                    let head = ObjectHead {
                        index: object.index.to_string(),
                        anchor: if anchors { object_anchor(*index) } else { String::new() },
                        name: object.name.clone(),
                        kind: object.kind.name(),
                        about: self.text(&object.about),
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

    /// The devices shown that have an object, in groups for which it is the same.
    pub(crate) fn variants<T: PartialEq>(
        &self,
        index: Index,
        of: impl Fn(&Dictionary, &Object) -> T,
    ) -> Vec<Vec<&Dictionary>> {
        let mut variants: Vec<(T, Vec<&Dictionary>)> = Vec::new();
        for device in self.devices.iter().copied() {
            let Some(object) = device.objects.get(&index) else { continue };
            let own = of(device, object);
            match variants.iter_mut().find(|(other, _)| *other == own) {
                Some((_, devices)) => devices.push(device),
                None => variants.push((own, vec![device])),
            }
        }
        variants.into_iter().map(|(_, devices)| devices).collect()
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
                // Of an object that a feature brings as a whole, nothing is the maker's word.
                let taken = object.origin == Origin::Manual;
                let cell = |text: String, facts: &[Fact]| {
                    let standard = taken && facts.iter().any(|fact| entry.is_only_standard(*fact));
                    Cell::plain(text).standard(standard)
                };
                let unit = entry.unit.as_ref().map_or_else(String::new, |unit| self.step(unit));
                let about = taken && entry.is_only_standard(Fact::About);
                Row {
                    anchor: if anchored { entry_anchor(id) } else { String::new() },
                    cells: vec![
                        Cell::plain(place),
                        cell(entry.name.clone(), &[Fact::Name]),
                        cell(entry.data_type.name().to_owned(), &[Fact::Type]),
                        cell(access(entry), &[Fact::Access]),
                        cell(mapping(entry.pdo).to_owned(), &[Fact::Mapping]),
                        cell(self.default(object, entry), &[Fact::Default]),
                        cell(unit, &[Fact::Unit]),
                        cell(self.range(entry), &[Fact::LowLimit, Fact::HighLimit]),
                        cell(self.stored(entry), &[Fact::Storage]),
                        self.description(device, object, entry).standard(about),
                        Cell::default(),
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
            // Identities, COB-IDs and the like: people know them in hexadecimal.
            Some(Value::Integer(raw))
                if (0x1000..0x2000).contains(&object.index.0)
                    && entry.data_type == DataType::Unsigned32
                    && entry.named_type.is_none()
                    && entry.unit.is_none() =>
            {
                bit_pattern(entry.data_type, *raw)
            }
            Some(value) => self.value(entry, value),
            None => String::new(),
        }
    }

    /// What keeps an entry over power-off, in a word.
    fn stored(&self, entry: &Entry) -> String {
        let word = match entry.stored {
            Storage::No => return String::new(),
            Storage::Communication => Word::Communication,
            Storage::Application => Word::Application,
            Storage::Manufacturer => Word::Manufacturer,
            Storage::Remanent => Word::Remanent,
        };
        self.word(word).to_owned()
    }

    /// Meaning of an entry and what else is to be known about it.
    fn description(&self, device: &Dictionary, object: &Object, entry: &Entry) -> Cell {
        let mut cell = self.text(&entry.about);
        for special in &entry.special {
            let number = special_number(entry.data_type, special.value);
            let mut line = cell.line().text(format!("{number}: {}", special.name));
            if !special.about.is_empty() {
                line = line.text("; ").and_words(&special.about, self.language);
            }
            cell = line;
        }
        if let Some(alias) = &entry.alias {
            cell = cell
                .line()
                .text(format!("{} ", self.word(Word::AliasOf)))
                .and(self.entry_link_on(device, alias.target));
            cell = cell.text(format!("; {}.", self.conversion(alias)));
        }
        if let Some(capacity) = entry.capacity {
            cell = cell.line().text(self.word(Word::Capacity).replace("{n}", &capacity.to_string()));
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

/// Keys of devices, as they stand in tables.
pub(crate) fn keys(devices: &[&Dictionary]) -> String {
    devices.iter().map(|device| device.key.to_uppercase()).collect::<Vec<_>>().join(", ")
}

/// A special value; a large one also as its bits, by which people know it.
fn special_number(data_type: DataType, raw: i128) -> String {
    if raw < 0x1_0000 { raw.to_string() } else { format!("{raw} ({})", bit_pattern(data_type, raw)) }
}

/// Whether an object holds mapping parameters.
fn is_mapping(index: Index) -> bool {
    matches!(index.0, 0x1600..=0x17FF | 0x1A00..=0x1BFF)
}

/// Columns that stand even when nothing fills them.
pub(crate) const ALWAYS: &[&str] =
    &["index", "sub", "name", "type", "access", "map", "default", "description"];
