//! A device: its objects with everything that refers to them, and its PDOs.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::model::{
    Devices, Dictionary, Direction, Entry, EntryId, Fact, Index, NamedType, Object, ObjectKind, PdoMapping,
    Phrases, Storage, SubIndex, SystemSource, TypeKind, Value,
};

use crate::language::Word;
use crate::source::Source;
use crate::source::uses::Uses;
use crate::tables::Columns;
use crate::tables::bits::types_of;
use crate::tables::errors;
use crate::tables::objects::Warnings;
use crate::tables::overview::among;
use crate::view::cell::{entry_anchor, object_anchor, slug};
use crate::view::long_list::LongList;
use crate::view::{
    Cell, DeviceView, EntryView, Filters, Grid, ObjectHead, ObjectView, PdoView, Place, Row, SearchWords,
    Stated, Table,
};

/// The entry that has the device type.
const DEVICE_TYPE: EntryId = EntryId { index: Index(0x1000), sub: SubIndex(0) };

impl Source<'_> {
    /// The page of a device: all links stay on it. The source is that of the device alone.
    pub(crate) fn device(&self, device: &Dictionary) -> DeviceView {
        let uses = Uses::new(self, device);
        let objects: LongList<ObjectView> =
            device.objects.values().map(|object| self.object(device, object, &uses)).collect();
        let rows = device.objects.values().map(|object| self.overview_row(object)).collect();
        let overview =
            Table::unnumbered("overview", "overview", Cell::default(), vec![self.overview_grid(rows)]);
        let filters = self.filters(device, &objects);
        let pdos: Vec<PdoView> = device.pdos.iter().map(|pdo| self.pdo(device, pdo)).collect();
        let mut view = DeviceView {
            key: device.key.clone(),
            name: device.name.clone(),
            eds: match self.system.source {
                SystemSource::Specification => format!("{}.eds", device.key),
                SystemSource::Eds => String::new(),
            },
            about: self.text(&device.about),
            facts: self.facts(device),
            dynamic_channels: self.dynamic_channels(device),
            modules: self.modules(device),
            overview,
            details: self.not_in_chapters(device, &pdos),
            objects,
            groups: self.groups(device),
            pdos,
            appendices: self.device_appendices(),
            filters,
            untranslated: String::new(),
            workbench: self.workbench(device),
            search: self.search_words(device),
        };
        view.untranslated = self.untranslated(view.foreign());
        view
    }

    /// The words that readers look for, of all that has some.
    fn search_words(&self, device: &Dictionary) -> Vec<SearchWords> {
        let objects = device.objects.values().flat_map(|object| {
            let entries = object.entries.iter().filter(move |_| object.is_structured());
            let entries = entries.map(move |entry| (entry_anchor(id(object, entry)), &entry.search));
            let types = types_of(object).into_iter().flat_map(move |named| searched(object, named));
            std::iter::once((object_anchor(object.index), &object.search)).chain(entries).chain(types)
        });
        let errors = self.system.errors.iter().filter(|error| error.devices.includes(&device.key));
        let errors = errors.map(|error| (errors::anchor(error.code), &error.search));
        let searched = objects.chain(errors).filter(|(_, phrases)| !phrases.is_empty());
        searched
            .map(|(anchor, phrases)| SearchWords { anchor, phrases: phrases.all().cloned().collect() })
            .collect()
    }

    /// The objects that no chapter shows in detail, and the PDOs: their names by anchor.
    fn not_in_chapters(&self, device: &Dictionary, pdos: &[PdoView]) -> BTreeMap<String, String> {
        let in_chapters: BTreeSet<Index> =
            self.outline.detailed(self.document()).map(|(index, _)| index).collect();
        let outside = device.objects.values().filter(|object| !in_chapters.contains(&object.index));
        let objects = outside.map(|object| (object_anchor(object.index), object.name.clone()));
        objects.chain(pdos.iter().map(|pdo| (pdo.anchor.clone(), pdo.name.clone()))).collect()
    }

    /// What a filter can offer: whatever occurs.
    fn filters(&self, device: &Dictionary, objects: &[ObjectView]) -> Filters {
        let all = |facts: fn(&ObjectView) -> &[String]| -> Vec<String> {
            let all: BTreeSet<&String> = objects.iter().flat_map(facts).collect();
            all.into_iter().cloned().collect()
        };
        let occurs = |facts: fn(&ObjectView) -> &[String], word: &str| {
            objects.iter().flat_map(facts).any(|fact| fact == word)
        };
        Filters {
            types: all(|object| &object.data_types),
            access: all(|object| &object.access),
            units: all(|object| &object.units),
            stored: [
                Storage::Communication,
                Storage::Application,
                Storage::Manufacturer,
                Storage::Remanent,
                Storage::No,
            ]
            .into_iter()
            .filter(|group| {
                let word = self.storage_word(*group);
                !word.is_empty() && occurs(|object| &object.stored, word)
            })
            .map(|group| (group.word(), self.wording.storage_group_of(group, device).to_owned()))
            .collect(),
            mappable: [Direction::Receive, Direction::Transmit]
                .into_iter()
                .filter(|direction| occurs(|object| &object.mappable, direction.word()))
                .map(|direction| (direction.word(), direction.pdo()))
                .collect(),
        }
    }

    fn facts(&self, device: &Dictionary) -> Table {
        let info = &device.info;
        let number = |number: u32| self.wording.hexadecimal(number.into(), 8);
        let rates: Vec<String> = info.bit_rates.iter().map(u16::to_string).collect();
        // What an EDS leaves out is not 0: it is unknown.
        let is_known = |fact: Fact| match self.system.source {
            SystemSource::Specification => true,
            SystemSource::Eds => device.facts.get(fact).is_some(),
        };
        let if_known = |fact: Fact, text: String| is_known(fact).then_some(text);
        let of_device = |fact: Fact| self.stated_of_device(device, fact);
        let rows = [
            (Word::Vendor, Stated::Manual, Some(self.system.vendor.name.clone())),
            (Word::Name, of_device(Fact::Name), Some(info.product_name.clone())),
            (Word::OrderCode, of_device(Fact::Name), Some(info.order_code.clone())),
            (Word::Product, of_device(Fact::Product), if_known(Fact::Product, number(info.product))),
            (
                Word::ProductRevision,
                of_device(Fact::ProductRevision),
                if_known(Fact::ProductRevision, number(info.product_revision)),
            ),
            (
                Word::DeviceType,
                self.stated_default(device, DEVICE_TYPE),
                if_known(Fact::DeviceType, number(info.device_type)),
            ),
            (
                Word::BitRates,
                of_device(Fact::BitRates),
                if_known(Fact::BitRates, format!("{} kbit/s", rates.join(", "))),
            ),
        ];
        let rows = rows.into_iter().filter_map(|(word, stated, text)| {
            Some(Row::of(vec![Cell::plain(self.word(word)), Cell::plain(text?).stated(stated)]))
        });
        let grid = Columns::new()
            .left(self, "name", Word::Parameter)
            .left(self, "value", Word::Value)
            .full(rows.collect());
        Table::unnumbered(
            format!("device-{}", device.key),
            "facts",
            Cell::plain(self.word(Word::Facts)),
            vec![grid],
        )
    }

    fn dynamic_channels(&self, device: &Dictionary) -> Option<Table> {
        let channels = &device.info.dynamic_channels;
        if channels.is_empty() {
            return None;
        }
        let rows = channels.iter().map(|channel| {
            let range = if channel.first == channel.last {
                channel.first.to_string()
            } else {
                format!("{}–{}", channel.first, channel.last)
            };
            let difference = channel.difference.map_or(String::new(), |difference| difference.to_string());
            let cells = [
                range,
                channel.data_type.name().to_owned(),
                channel.access.word().to_owned(),
                channel.offset.to_string(),
                difference,
            ];
            Row::of(cells.map(Cell::plain).into())
        });
        let grid = Columns::new()
            .left(self, "index", Word::Index)
            .left(self, "type", Word::Type)
            .left(self, "access", Word::Access)
            .right(self, "offset", Word::Offset)
            .right(self, "difference", Word::AddressDifference)
            .grid(rows.collect(), &["index", "type", "access", "offset"]);
        Some(Table::unnumbered(
            format!("dynamic-channels-{}", device.key),
            "dynamic-channels",
            Cell::plain(self.word(Word::DynamicChannels)),
            vec![grid],
        ))
    }

    fn modules(&self, device: &Dictionary) -> Option<Table> {
        let modules = &device.further.as_ref()?.modules;
        if modules.is_empty() {
            return None;
        }
        let list = |indices: &BTreeSet<Index>| {
            Cell::plain(indices.iter().map(Index::to_string).collect::<Vec<_>>().join(", "))
        };
        let rows = modules.iter().map(|(number, module)| {
            let [number, name, code] =
                [number.to_string(), module.product_name.clone(), module.order_code.clone()].map(Cell::plain);
            Row::of(vec![number, name, code, list(&module.brings), list(&module.extends)])
        });
        let grid = Columns::new()
            .right(self, "number", Word::Number)
            .left(self, "name", Word::Name)
            .left(self, "order_code", Word::OrderCode)
            .left(self, "brings", Word::Brings)
            .left(self, "extends", Word::Extends)
            .grid(rows.collect(), &["number", "name", "order_code"]);
        Some(Table::unnumbered(
            format!("modules-{}", device.key),
            "modules",
            Cell::plain(self.word(Word::Modules)),
            vec![grid],
        ))
    }

    fn object(&self, device: &Dictionary, object: &Object, uses: &Uses) -> ObjectView {
        let types = types_of(object).into_iter().map(|named| {
            let (kind, word, grid) = match &named.kind {
                TypeKind::Bits(fields) => ("bits", Word::Bits, self.bits(named, fields, None)),
                TypeKind::Enum(values) => ("values", Word::Values, self.values(named, values)),
            };
            let grid = anchored(grid, object, named);
            let anchor = format!("{}-type-{}", object_anchor(object.index), slug(&named.name));
            let title = Cell::plain(format!("{}: {}", self.word(word), named.name));
            Table { about: self.text(&named.about), ..Table::unnumbered(anchor, kind, title, vec![grid]) }
        });
        let types: Vec<Table> = types.collect();
        let entries = object.entries.iter().map(|entry| self.entry(device, object, entry)).collect();
        let table = Table::unnumbered(
            format!("{}-entries", object_anchor(object.index)),
            "objects",
            Cell::default(),
            vec![self.detail(device, object)],
        );
        let (data_types, units) = (among(object, |entry| entry.data_type.name()), units(object));
        ObjectView {
            index: object.index.to_string(),
            anchor: object_anchor(object.index),
            name: object.name.clone(),
            kind: object.kind.name(),
            origin: object.origin.word(),
            about: self.about(object),
            warning: self.warning(device, object),
            notes: self.notes(device, object),
            changed: self.changed(device, object).unwrap_or_default(),
            table,
            names: names(object, &types),
            types,
            used: uses.of(object.index),
            places: self.places(object),
            errata: self
                .errata_of_object(object.index)
                .iter()
                .filter(|at| self.system.errata[**at].devices.includes(&device.key))
                .map(|at| self.erratum(*at))
                .collect(),
            entries,
            access: self.accesses(object),
            data_types: data_types.into_iter().map(str::to_owned).collect(),
            units,
            stored: among(object, |entry| self.storage_word(entry.stored).to_owned()),
            mappable: mappable(object),
        }
    }

    /// An entry as plain facts.
    fn entry(&self, device: &Dictionary, object: &Object, entry: &Entry) -> EntryView {
        let id = EntryId { index: object.index, sub: entry.sub };
        let limit = |limit: Option<Value>| match limit {
            Some(Value::Integer(raw)) => raw.to_string(),
            Some(limit) => self.wording.value(Some(object.index), entry, &limit),
            None => String::new(),
        };
        let (low, high) = entry.limits();
        let names = self.code_names(&device.key, id);
        EntryView {
            index: object.index.to_string(),
            sub: entry.sub.0,
            name: entry.name.clone(),
            anchor: entry_anchor(id),
            data_type: entry.data_type.name(),
            access: self.wording.access(entry),
            pdo: entry.pdo.word(),
            default: match &entry.default {
                Some(Value::Integer(raw)) => raw.to_string(),
                Some(Value::NodeId(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_)) => {
                    self.default(object, entry)
                }
                None => String::new(),
            },
            low: limit(low),
            high: limit(high),
            unit: entry.unit.as_ref().map_or_else(String::new, |unit| self.wording.step(unit)),
            symbol: entry.unit.as_ref().map_or_else(String::new, |unit| unit.symbol.clone()),
            stored: self.storage_word(entry.stored),
            path: format!("0x{:04X}:{:02X}", object.index.0, entry.sub.0),
            rust: names.rust,
            c: names.c,
            structured_text: names.structured_text,
        }
    }

    /// The entries of one object.
    fn detail(&self, device: &Dictionary, object: &Object) -> Grid {
        // The card itself is what links to an object lead to.
        let rows = self.entry_rows(device, object, object.is_structured(), Warnings::Here);
        let grid = self.entry_columns(object).grid(rows, crate::tables::objects::ALWAYS);
        if !object.is_structured() {
            return grid;
        }
        let head = ObjectHead {
            index: object.index.to_string(),
            anchor: String::new(),
            name: object.name.clone(),
            kind: object.kind.name(),
            about: Cell::default(),
            warning: Cell::default(),
            device: String::new(),
        };
        Grid { object: Some(head), ..grid }
    }

    /// What an object is for; the only entry of a VAR has it in its row.
    fn about(&self, object: &Object) -> Cell {
        match object.kind {
            ObjectKind::Array | ObjectKind::Record => self.text(&object.about),
            ObjectKind::Var | ObjectKind::Domain => Cell::default(),
        }
    }

    /// The danger that comes from an object as a whole; the only entry of a VAR has it in its row.
    pub(crate) fn warning(&self, device: &Dictionary, object: &Object) -> Cell {
        match object.kind {
            ObjectKind::Array | ObjectKind::Record => {
                self.text_on(&Devices::one(&device.key), &object.warning)
            }
            ObjectKind::Var | ObjectKind::Domain => Cell::default(),
        }
    }

    fn notes(&self, device: &Dictionary, object: &Object) -> Vec<Cell> {
        let mut notes = Vec::new();
        if let Some(profile) = &object.profile {
            let mut note = Cell::plain(format!("{} {profile}", self.word(Word::FromStandard)));
            if let Some(name) = self.standard_name(object) {
                note = note.text(": ").code(name);
            }
            if !object.departures.is_empty() {
                let differs: Vec<String> =
                    object.departures.iter().map(|departure| self.wording.departure(*departure)).collect();
                note = note.text(format!(". {}: {}", self.word(Word::Differs), differs.join(", ")));
            }
            notes.push(note.text("."));
        }
        if let Some(category) = object.category {
            let word = self.wording.category(category);
            notes.push(Cell::plain(format!("{}: {word}.", self.word(Word::Category))));
        }
        if let Some(since) = &object.since {
            notes.push(Cell::plain(format!("{} {since}.", self.word(Word::Since))));
        }
        notes.extend(self.links(device, object));
        let writable = || object.entries.iter().filter(|entry| entry.access.is_writable());
        if writable().next().is_some() && writable().all(|entry| entry.locked) {
            notes.push(Cell::plain(self.word(Word::LockedNote)));
        }
        notes
    }

    /// The objects that belong together with an object.
    fn links(&self, device: &Dictionary, object: &Object) -> Option<Cell> {
        let here = Devices::one(&device.key);
        let links = object.linked().map(|index| {
            let link = self.link_on(&here, index, index.to_string(), object_anchor(index));
            match device.objects.get(&index) {
                Some(linked) => link.text(format!(" {}", linked.name)),
                None => link,
            }
        });
        let list = links.reduce(|list, link| list.text(", ").and(link))?;
        Some(Cell::plain(format!("{}: ", self.word(Word::Links))).and(list).text("."))
    }

    /// Accesses of an object's entries, each once; that of sub-index 0 where it can be written.
    fn accesses(&self, object: &Object) -> Vec<String> {
        let mut all = among(object, |entry| self.wording.access(entry));
        for entry in object.entries.iter().filter(|entry| entry.access.is_writable()) {
            let access = self.wording.access(entry);
            if !all.contains(&access) {
                all.push(access);
            }
        }
        all
    }

    /// The sections of the manual whose tables show the object in detail.
    fn places(&self, object: &Object) -> Vec<Place> {
        let sections = self.sections_of(object.index).iter();
        sections
            .map(|at| {
                let text = self.heading(*at);
                let anchor = self.outline.section_anchor(*at).to_owned();
                Place { text, anchor, page: self.outline.page_of(*at).to_owned() }
            })
            .collect()
    }
}

/// The rows of a type with anchors below each entry that has it: `6041.b3` is a bit, `6060.v8` a value.
fn anchored(mut grid: Grid, object: &Object, named: &NamedType) -> Grid {
    let anchors: Vec<String> = having(object, named).collect();
    let Some((first, others)) = anchors.split_first() else { return grid };
    for (row, part) in grid.rows.items_mut().iter_mut().zip(parts_of(named)) {
        row.anchor = format!("{first}.{part}");
        row.also = others.iter().map(|entry| format!("{entry}.{part}")).collect();
    }
    grid
}

/// Where links to the entries of a type lead.
fn having<'a>(object: &'a Object, named: &'a NamedType) -> impl Iterator<Item = String> + 'a {
    let has_it =
        move |entry: &&Entry| entry.named_type.as_deref().is_some_and(|its_type| its_type.name == named.name);
    object.entries.iter().filter(has_it).map(move |entry| entry_anchor(id(object, entry)))
}

/// What the bits or values of a type are called in links.
fn parts_of(named: &NamedType) -> Vec<String> {
    match &named.kind {
        TypeKind::Bits(fields) => fields.iter().map(|field| format!("b{}", field.first)).collect(),
        TypeKind::Enum(values) => values.iter().map(|value| format!("v{}", value.value)).collect(),
    }
}

/// The bits and values of a type with the words by which readers look for them, at the first entry that has the type.
fn searched<'a>(object: &'a Object, named: &'a NamedType) -> impl Iterator<Item = (String, &'a Phrases)> {
    let phrases: Vec<&Phrases> = match &named.kind {
        TypeKind::Bits(fields) => fields.iter().map(|field| &field.search).collect(),
        TypeKind::Enum(values) => values.iter().map(|value| &value.search).collect(),
    };
    let first = having(object, named).next();
    parts_of(named)
        .into_iter()
        .zip(phrases)
        .filter_map(move |(part, phrases)| Some((format!("{}.{part}", first.as_ref()?), phrases)))
}

const fn id(object: &Object, entry: &Entry) -> EntryId {
    EntryId { index: object.index, sub: entry.sub }
}

/// Unit symbols of an object's entries, each once.
fn units(object: &Object) -> Vec<String> {
    let symbols = among(object, |entry| entry.unit.as_ref().map(|unit| unit.symbol.clone()));
    let symbols: BTreeSet<String> = symbols.into_iter().flatten().collect();
    symbols.into_iter().collect()
}

fn mappable(object: &Object) -> Vec<String> {
    let any = |wanted: PdoMapping| {
        object.entries.iter().any(|entry| entry.pdo == wanted || entry.pdo == PdoMapping::Both)
    };
    [PdoMapping::Receive, PdoMapping::Transmit]
        .into_iter()
        .filter(|pdo| any(*pdo))
        .map(|pdo| pdo.word().to_owned())
        .collect()
}

/// The names of an object's entries, bits and values, each once.
fn names(object: &Object, types: &[Table]) -> String {
    let entries = object.entries.iter().skip(1).map(|entry| entry.name.as_str());
    let rows = types.iter().filter_map(|table| table.grids.first()).flat_map(|grid| grid.rows.iter());
    let of_types = rows.filter_map(|row| row.cells.get(1)).map(|cell| cell.text.as_str());
    let mut seen = BTreeSet::new();
    entries.chain(of_types).filter(|name| seen.insert(*name)).collect::<Vec<_>>().join(" ")
}
