//! Overview tables: one row per object.

use std::collections::BTreeSet;

use od_spec::model::{Entry, Index, Object, SystemSource};

use super::Columns;
use super::variants::device_keys;
use crate::language::Word;
use crate::source::Source;
use crate::view::cell::object_anchor;
use crate::view::{Cell, Grid, Row};

/// What differs among the entries of an object, each once and in order; the count at sub-index 0 does not matter.
pub(crate) fn among<T: Ord>(object: &Object, fact: impl Fn(&Entry) -> T) -> Vec<T> {
    let entries = if object.is_structured() { &object.entries[1..] } else { &object.entries[..] };
    let mut seen = BTreeSet::new();
    let mut facts = Vec::new();
    for entry in entries {
        if seen.insert(fact(entry)) {
            facts.push(fact(entry));
        }
    }
    facts
}

impl Source<'_> {
    /// The objects of these indices on the devices shown. An object that devices share is there once, unless it
    /// differs.
    pub(crate) fn overview(&self, indices: &[Index]) -> Grid {
        let mut rows: Vec<Row> = Vec::new();
        for index in indices {
            let variants = self.variants(*index, |_, object| {
                let row = self.overview_row(object);
                row.cells.iter().map(|cell| cell.text.clone()).collect::<Vec<_>>()
            });
            for devices in &variants {
                let Some(object) = devices.first().and_then(|device| device.objects.get(index)) else {
                    continue;
                };
                let mut row = self.overview_row(object);
                if let Some(cell) = row.cells.last_mut().filter(|_| variants.len() > 1) {
                    *cell = Cell::plain(device_keys(devices));
                }
                rows.push(row);
            }
        }
        self.overview_grid(rows)
    }

    pub(crate) fn overview_grid(&self, rows: Vec<Row>) -> Grid {
        Columns::new()
            .left(self, "index", Word::Index)
            .left(self, "object", Word::Object)
            .left(self, "name", Word::Name)
            .left(self, "type", Word::Type)
            .left(self, "access", Word::Access)
            .center(self, "mem", Word::Mem)
            .left(self, "device", Word::Device)
            .grid(
                rows,
                match self.system.source {
                    SystemSource::Specification => &["index", "object", "name", "type", "access", "mem"],
                    SystemSource::Eds => &["index", "object", "name", "type", "access"],
                },
            )
    }

    pub(crate) fn overview_row(&self, object: &Object) -> Row {
        let index = Cell::default().link(
            object.index.to_string(),
            object_anchor(object.index),
            self.home(object.index),
        );
        let stored = object.is_stored();
        let mem = match (stored, self.system.source) {
            (true, _) => "Y",
            (false, SystemSource::Specification) => "N",
            // An EDS has no key for it: it is unknown.
            (false, SystemSource::Eds) => "",
        };
        Row {
            cells: vec![
                index,
                Cell::plain(object.kind.name()),
                Cell::plain(&object.name),
                Cell::plain(among(object, |entry| entry.data_type.name()).join(", ")),
                Cell::plain(among(object, |entry| self.wording.access(entry)).join(", ")),
                Cell::plain(mem),
                Cell::default(),
            ],
            stored,
            ..Row::default()
        }
    }
}
