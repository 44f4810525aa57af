//! The overview of all warnings: each once, with every place where it is written.

use std::collections::BTreeSet;

use od_spec::model::{Devices, Dictionary, EntryId, SubIndex, Text};

use crate::language::Word;
use crate::source::Source;
use crate::tables::Columns;
use crate::view::{Cell, Chapter, Row, Table};

/// Warnings, each with its places.
#[derive(Default)]
struct List(Vec<(Cell, Cell)>);

impl List {
    /// A warning of one more place. What reads the same is the same warning.
    fn add(&mut self, warning: Cell, place: Cell) {
        match self.0.iter_mut().find(|(known, _)| known.text == warning.text) {
            Some((_, places)) if places.text.lines().any(|line| line == place.text) => {}
            Some((_, places)) => *places = std::mem::take(places).line().and(place),
            None => self.0.push((warning, place)),
        }
    }
}

impl Source<'_> {
    /// Every warning of the chapters and of the objects; nothing where there are none.
    pub(crate) fn warnings(&self, chapters: &[Chapter]) -> Option<Table> {
        let (mut list, mut said) = (List::default(), BTreeSet::new());
        for chapter in chapters {
            for section in &chapter.sections {
                let title = format!("{} {}", section.number, section.title.text);
                for part in section.content.iter().filter(|part| !part.anchor.is_empty()) {
                    let lines = part.items.iter().cloned();
                    let warning = lines.fold(Cell::default(), |cell, line| cell.line().and(line));
                    let link = |text: &str| Cell::default().link(text, &*part.anchor, &*chapter.page);
                    if part.objects.is_empty() {
                        list.add(warning, link(title.trim()));
                        continue;
                    }
                    for object in &part.objects {
                        list.add(warning.clone(), link(&format!("{} {}", object.index, object.name)));
                        said.insert(object.index.clone());
                    }
                }
            }
        }
        for device in &self.devices {
            // What a chapter says in full is listed with it.
            for object in device.objects.values().filter(|object| !said.contains(&object.index.to_string())) {
                let whole = EntryId { index: object.index, sub: SubIndex(0) };
                let name = format!("{} {}", object.index, object.name);
                let place = self.link_on(
                    &Devices::one(&device.key),
                    object.index,
                    name,
                    crate::view::cell::object_anchor(object.index),
                );
                self.warn(&mut list, device, &object.warning, || place.clone());
                for entry in &object.entries {
                    let id = EntryId { sub: entry.sub, ..whole };
                    self.warn(&mut list, device, &entry.warning, || self.place_of(device, id));
                }
            }
        }
        if list.0.is_empty() {
            return None;
        }
        let rows = list.0.into_iter().map(|(warning, places)| Row::of(vec![places, warning]));
        let grid = Columns::new()
            .left(self, "places", Word::Place)
            .left(self, "warning", Word::Warning)
            .full(rows.collect());
        Some(Table::unnumbered("warnings", "warnings", Cell::default(), vec![grid]))
    }

    fn warn(&self, list: &mut List, device: &Dictionary, warning: &Text, place: impl Fn() -> Cell) {
        if !warning.is_empty() {
            list.add(self.text_on(&Devices::one(&device.key), warning), place());
        }
    }

    /// A link to an entry with its index and name.
    fn place_of(&self, device: &Dictionary, id: EntryId) -> Cell {
        let name = device.entry_name(id).unwrap_or_default();
        self.link_on(
            &Devices::one(&device.key),
            id.index,
            format!("{id} {name}"),
            crate::view::cell::entry_anchor(id),
        )
    }
}
