//! The model in front of the printer: chosen devices, language, what refers to what, and links.

pub(crate) mod conditions;
mod numbers;
pub(crate) mod outline;
pub(crate) mod series;
mod stated;
pub(crate) mod uses;

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;

use od_spec::Library;
use od_spec::model::{
    BitErrors, BitField, Departure, Devices, Dictionary, Document, Entry, EntryId, Erratum, ErratumPlace,
    Fact, Index, Object, Part, Storage, System, SystemSource, TableContent, TableId, Text, TypeKind, Unit,
};
use od_spec::order::Arrange as _;
use od_spec::running_text::{Written, indices};
use od_spec::wording::{self, Wording, filled};

use crate::language::{Language, Word};
use crate::options::{CodeNames, Gaps, Options, Since};
use crate::source::numbers::Numbers;
use crate::source::outline::Outline;
use crate::source::series::title;
use crate::view::cell::{entry_anchor, object_anchor, slug};
use crate::view::{Cell, Table, Target};

/// The tables of each section of the manual; filled when they are first asked for.
type Tables = OnceCell<Vec<Vec<Option<Table>>>>;

/// What would otherwise be searched for again and again.
#[derive(Default)]
struct Lookup {
    /// Positions of the errata about each object, ascending.
    errata: BTreeMap<Index, Vec<usize>>,
    /// Positions of the errata that leave open what the values or bits of a type mean, by the type's name.
    unprinted_types: BTreeMap<String, Vec<usize>>,
    /// Entries with error codes of their own for the bits of their type, by the type's name.
    bit_errors: BTreeMap<String, Vec<EntryId>>,
    /// Entries with bits that show an error code.
    showing: BTreeMap<u16, Vec<EntryId>>,
    /// Positions of the errata about each table of the manual, ascending.
    errata_of_table: BTreeMap<TableId, Vec<usize>>,
    /// The first table of the manual that shows an object in detail.
    detailed: BTreeMap<Index, TableId>,
    /// Positions of the sections that show an object.
    places: BTreeMap<Index, Vec<usize>>,
    /// The names that libraries give objects of another name.
    standard_names: BTreeMap<Index, String>,
    /// Objects with an entry in a unit, by the unit's name.
    in_unit: BTreeMap<String, BTreeSet<Index>>,
    /// Parts of anchors, by the names of what they lead to.
    units: BTreeMap<String, String>,
    machines: BTreeMap<String, String>,
    constraints: BTreeMap<String, String>,
}

/// Each name as part of an anchor, with a number where an earlier name gives the same.
fn anchors<'a>(names: impl Iterator<Item = &'a String>) -> BTreeMap<String, String> {
    let (mut anchors, mut counts) = (BTreeMap::new(), BTreeMap::new());
    for name in names {
        if anchors.contains_key(name) {
            continue;
        }
        let part = slug(name);
        let before: &mut usize = counts.entry(part.clone()).or_default();
        *before += 1;
        let anchor = if *before == 1 && !part.is_empty() { part } else { format!("{part}-no-{before}") };
        anchors.insert(name.clone(), anchor);
    }
    anchors
}

fn names_it_otherwise(object: &Object) -> bool {
    object.departures.contains(&Departure { part: Part::Object, fact: Fact::Name })
}

/// What the libraries of devices call those of their objects that these name otherwise.
fn standard_names(devices: &[&Dictionary]) -> BTreeMap<Index, String> {
    let objects = devices.iter().flat_map(|device| device.objects.values());
    let renamed: Vec<&Object> = objects.filter(|object| names_it_otherwise(object)).collect();
    let profiles: BTreeSet<&String> = renamed.iter().filter_map(|object| object.profile.as_ref()).collect();
    let libraries: Vec<Library> = profiles.into_iter().filter_map(|name| od_spec::library(name)).collect();
    let names = renamed.into_iter().filter_map(|object| {
        let of_object = |library: &&Library| object.profile.as_ref() == Some(&library.name);
        let standard = libraries.iter().find(of_object)?.objects.get(&object.index)?;
        Some((object.index, standard.object.name.clone()))
    });
    names.collect()
}

/// A text with links in place of the parts that they represent. In another language where one is named.
fn with_links(text: &str, language: &str, mut links: Vec<(Range<usize>, Cell)>) -> Cell {
    links.arrange_by_key(|(range, _)| range.start);
    let (mut cell, mut start) = (Cell::default(), 0);
    for (range, link) in links {
        cell = cell.in_language(&text[start..range.start], language).and(link.all_in_language(language));
        start = range.end;
    }
    cell.in_language(&text[start..], language)
}

/// The model, seen by the printer.
#[derive(Clone)]
pub(crate) struct Source<'a> {
    pub system: &'a System,
    /// The devices to show.
    pub devices: Vec<&'a Dictionary>,
    /// The devices that have a page: those shown, and where only one is shown, the others that links lead to.
    pub with_page: Vec<&'a Dictionary>,
    pub language: Language<'a>,
    /// How facts are worded in that language.
    pub wording: Wording,
    /// What changed since an earlier specification.
    pub since: Option<&'a Since>,
    /// What generated code calls entries, by key of the device, then by entry.
    code_names: &'a BTreeMap<String, BTreeMap<EntryId, CodeNames>>,
    /// Where to say what the printed manual leaves open.
    pub gaps: Gaps,
    /// The page, where pages are small, that shows an object in detail.
    homes: BTreeMap<Index, String>,
    /// The document's sections by chapter.
    pub outline: Rc<Outline>,
    /// Where the numbers of its tables, figures and sections are.
    pub numbers: Rc<Numbers>,
    /// The tables of the manual.
    pub tables: Rc<Tables>,
    lookup: Rc<Lookup>,
}

impl<'a> Source<'a> {
    pub(crate) fn new(system: &'a System, options: &'a Options) -> Self {
        let is_chosen = |device: &&Dictionary| options.devices.includes(&device.key);
        let devices: Vec<&Dictionary> = system.devices.iter().filter(is_chosen).collect();
        let code = options.language.as_deref().unwrap_or_else(|| system.language());
        let words = options.words.unwrap_or_else(|| wording::Language::of(code));
        let language = Language { code, words };
        let outline = Outline::of(system);
        let mut source = Self {
            system,
            language,
            wording: language.wording(),
            since: options.since.as_ref(),
            code_names: &options.code_names,
            gaps: options.gaps,
            homes: outline.homes(&system.document, &devices),
            outline: Rc::new(outline),
            with_page: devices.clone(),
            devices,
            numbers: Rc::default(),
            tables: Rc::default(),
            lookup: Rc::default(),
        };
        source.lookup = Rc::new(source.look_up());
        source
    }

    /// The same for the page of one device, which shows every object of the device itself.
    pub(crate) fn only(&self, device: &'a Dictionary) -> Self {
        let homes = device.objects.keys().map(|index| (*index, device.key.clone())).collect();
        Self {
            devices: vec![device],
            with_page: self.with_page.clone(),
            homes,
            outline: Rc::clone(&self.outline),
            numbers: Rc::clone(&self.numbers),
            tables: Rc::default(),
            lookup: Rc::clone(&self.lookup),
            ..*self
        }
    }

    /// The same, with what the printed manual leaves open said elsewhere.
    pub(crate) fn with_gaps(&self, gaps: Gaps) -> Self {
        Self { gaps, tables: Rc::default(), ..self.clone() }
    }

    /// What generated code calls an entry of a device.
    pub(crate) fn code_names(&self, device: &str, id: EntryId) -> CodeNames {
        self.code_names.get(device).and_then(|names| names.get(&id)).cloned().unwrap_or_default()
    }

    /// Where an entry is stored, as the specification's word; nothing where an EDS does not say that it is, because it has no
    /// key for that.
    pub(crate) const fn storage_word(&self, storage: Storage) -> &'static str {
        match (self.system.source, storage) {
            (SystemSource::Eds, Storage::No) => "",
            (SystemSource::Eds | SystemSource::Specification, storage) => storage.word(),
        }
    }

    /// The objects that may have an entry in a unit, ascending.
    pub(crate) fn objects_in(&self, unit: &str) -> impl Iterator<Item = Index> {
        self.lookup.in_unit.get(unit).into_iter().flatten().copied()
    }

    /// The part of an anchor that a unit has.
    pub(crate) fn unit_anchor<'n>(&'n self, name: &'n str) -> &'n str {
        self.lookup.units.get(name).map_or(name, String::as_str)
    }

    /// The part of an anchor that a state machine has.
    pub(crate) fn machine_anchor<'n>(&'n self, name: &'n str) -> &'n str {
        self.lookup.machines.get(name).map_or(name, String::as_str)
    }

    /// The part of an anchor that a constraint has.
    pub(crate) fn constraint_part<'n>(&'n self, name: &'n str) -> &'n str {
        self.lookup.constraints.get(name).map_or(name, String::as_str)
    }

    fn look_up(&self) -> Lookup {
        let mut lookup = Lookup {
            units: anchors(self.system.units.keys()),
            machines: anchors(self.system.machines.keys()),
            constraints: anchors(self.system.constraints.iter().map(title).collect::<Vec<_>>().iter()),
            ..Lookup::default()
        };
        lookup.standard_names = standard_names(&self.devices);
        for (id, _, entry) in self.devices.iter().flat_map(|device| device.entries()) {
            if let Some(unit) = &entry.unit {
                lookup.in_unit.entry(unit.name.clone()).or_default().insert(id.index);
            }
        }
        for (position, erratum) in self.system.errata.iter().enumerate() {
            if !self.is_about(erratum) {
                continue;
            }
            let indices: BTreeSet<Index> = erratum.at.iter().map(|place| place.index()).collect();
            for index in indices {
                lookup.errata.entry(index).or_default().push(position);
            }
            for table in erratum.tables.iter().collect::<BTreeSet<_>>() {
                lookup.errata_of_table.entry(*table).or_default().push(position);
            }
        }
        for (id, _, entry) in self.devices.iter().flat_map(|device| device.entries()) {
            let Some(named) = &entry.named_type else { continue };
            for at in lookup.errata.get(&id.index).into_iter().flatten() {
                let erratum = &self.system.errata[*at];
                let places = [ErratumPlace::Object(id.index), ErratumPlace::Entry(id)];
                let leaves_it_open = erratum.unprinted.as_ref().is_some_and(stated::leaves_meaning_open);
                if !leaves_it_open || !places.iter().any(|place| erratum.at.contains(place)) {
                    continue;
                }
                let of_type: &mut Vec<usize> = lookup.unprinted_types.entry(named.name.clone()).or_default();
                if !of_type.contains(at) {
                    of_type.push(*at);
                }
            }
        }
        let mut seen: BTreeSet<EntryId> = BTreeSet::new();
        for (id, _, entry) in self.devices.iter().flat_map(|device| device.entries()) {
            let Some(named) = &entry.named_type else { continue };
            let TypeKind::Bits(fields) = &named.kind else { continue };
            let of_the_entry = entry.bit_errors.iter().flat_map(BitErrors::error_codes);
            let codes: BTreeSet<u16> =
                fields.iter().flat_map(BitField::error_codes).chain(of_the_entry).collect();
            for code in codes {
                let entries = lookup.showing.entry(code).or_default();
                if !entries.contains(&id) {
                    entries.push(id);
                }
            }
            if !entry.bit_errors.is_empty() && seen.insert(id) {
                lookup.bit_errors.entry(named.name.clone()).or_default().push(id);
            }
        }
        for (position, section) in self.document().sections.iter().enumerate() {
            for (at, table) in section.tables.iter().enumerate() {
                if let TableContent::Objects(list) = &table.content {
                    for index in list {
                        lookup.detailed.entry(*index).or_insert(TableId { section: position, table: at });
                    }
                }
                for index in table.content.objects() {
                    let places = lookup.places.entry(*index).or_default();
                    if places.last() != Some(&position) {
                        places.push(position);
                    }
                }
            }
        }
        lookup
    }

    /// The name that a standard gives an object, where the maker names it otherwise.
    pub(crate) fn standard_name(&self, object: &Object) -> Option<&str> {
        names_it_otherwise(object)
            .then(|| self.lookup.standard_names.get(&object.index).map(String::as_str))?
    }

    /// Entries with error codes of their own for the bits of a type.
    pub(crate) fn with_bit_errors(&self, named: &str) -> &[EntryId] {
        self.lookup.bit_errors.get(named).map_or(&[], Vec::as_slice)
    }

    /// Entries with bits that show an error code.
    pub(crate) fn showing(&self, code: u16) -> &[EntryId] {
        self.lookup.showing.get(&code).map_or(&[], Vec::as_slice)
    }

    /// Positions of the errata whose place names a table of the manual.
    pub(crate) fn errata_naming(&self, table: TableId) -> &[usize] {
        self.lookup.errata_of_table.get(&table).map_or(&[], Vec::as_slice)
    }

    /// Whether this table of the manual is the first to show an object in detail.
    pub(crate) fn details_first(&self, table: TableId, index: Index) -> bool {
        self.lookup.detailed.get(&index) == Some(&table)
    }

    /// Positions of the sections whose tables show an object.
    pub(crate) fn sections_of(&self, index: Index) -> &[usize] {
        self.lookup.places.get(&index).map_or(&[], Vec::as_slice)
    }

    /// Number and title of a section of the manual.
    pub(crate) fn heading(&self, section: usize) -> String {
        let section = &self.document().sections[section];
        format!("{} {}", section.number, self.text(&section.title).text).trim().to_owned()
    }

    /// The printed manual.
    pub(crate) const fn document(&self) -> &'a Document {
        &self.system.document
    }

    /// A fixed word.
    pub(crate) fn word(&self, word: Word) -> &'static str {
        self.language.word(word)
    }

    /// A fixed sentence with what differs.
    pub(crate) fn sentence(&self, word: Word, part: &str) -> String {
        filled(self.word(word), &[part])
    }

    /// What a chapter says first whose texts are in another language.
    pub(crate) fn untranslated(&self, language: Option<&str>) -> String {
        language
            .map_or_else(String::new, |code| self.sentence(Word::Untranslated, self.language.name_of(code)))
    }

    /// What one step of a unit is worth, as a link to the unit.
    pub(crate) fn unit_link(&self, unit: &Unit) -> Cell {
        let step = self.wording.step(unit);
        match self.lookup.units.get(&unit.name) {
            Some(anchor) => Cell::default().link(step, format!("unit-{anchor}"), "units"),
            None => Cell::plain(step),
        }
    }

    /// A text of the specification, in which each index of an object shown is a link, and each number of a table, figure or section.
    pub(crate) fn text(&self, text: &Text) -> Cell {
        self.text_on(&Devices::All, text)
    }

    /// A text of the specification about these devices.
    pub(crate) fn text_on(&self, devices: &Devices, text: &Text) -> Cell {
        let words = Cell::words(text, self.language);
        let linked = words.parts().map(|part| self.linked(devices, part.text, part.language));
        let cell = linked.fold(Cell::default(), Cell::and);
        match text.gap().filter(|_| self.gaps == Gaps::InPlace) {
            Some(gap) => {
                let label = format!("{}:", self.word(Word::Gap));
                cell.line().strong(label).text(" ").and(self.text_on(devices, gap))
            }
            None => cell,
        }
    }

    /// A text as something else than this document words it, be it another issue of the manual: only an index is a link, as a number
    /// may mean another table there, or be wrong.
    pub(crate) fn quoted(&self, text: &Text) -> Cell {
        let words = Cell::quoted(text, self.language);
        let quoted = words.parts().map(|part| {
            let links = self.links_to_objects(&Devices::All, part.text).collect();
            with_links(part.text, part.language, links)
        });
        quoted.fold(Cell::default(), Cell::and)
    }

    /// A text in which each index is a link: to the object of these devices, or else to that of others; and each number of a table,
    /// figure or section of the document. In another language where one is named.
    pub(crate) fn linked(&self, devices: &Devices, text: &str, language: &str) -> Cell {
        let links = self.links_to_objects(devices, text).chain(self.links_to_numbers(text)).collect();
        with_links(text, language, links)
    }

    /// The indices of objects shown in a text, each as a link.
    fn links_to_objects(&self, devices: &Devices, text: &str) -> impl Iterator<Item = (Range<usize>, Cell)> {
        indices(text).filter_map(move |one| {
            let has_it = self.led_to(devices, one.id.index).next().is_some();
            let devices = if has_it { devices } else { &Devices::All };
            let (end, anchor) = self.named_in_text(devices, one)?;
            let link = self.link_on(devices, one.id.index, text[one.start..end].to_owned(), anchor);
            Some((one.start..end, link))
        })
    }

    /// What is named in a running text: where its name ends, and the anchor that it leads to. Of an object without the sub-index
    /// only the index counts. Nothing where that is an error code, too: no text says which of them it means.
    fn named_in_text(&self, devices: &Devices, one: Written) -> Option<(usize, String)> {
        let EntryId { index, sub } = one.id;
        let mut objects =
            self.led_to(devices, index).filter_map(|device| device.objects.get(&index)).peekable();
        objects.peek()?;
        let has_entry = |object: &Object| object.is_structured() && object.entry(sub).is_some();
        if one.end > one.index_end && objects.any(has_entry) {
            return Some((one.end, format!("{}.{sub}", object_anchor(index))));
        }
        let is_error_code = self.system.errors.binary_search_by_key(&index.0, |error| error.code).is_ok();
        (!is_error_code).then(|| (one.index_end, object_anchor(index)))
    }

    /// The page that shows an object in detail.
    pub(crate) fn home(&self, index: Index) -> &str {
        self.homes.get(&index).map_or("", String::as_str)
    }

    /// Those of these devices that a link to an object can lead to: shown ones, or else others with a page.
    fn led_to(&self, devices: &Devices, index: Index) -> impl Iterator<Item = &'a Dictionary> + use<'a> {
        let of = |some: &[&'a Dictionary]| {
            let having = some.iter().copied();
            having
                .filter(|device| devices.includes(&device.key) && device.objects.contains_key(&index))
                .collect::<Vec<_>>()
        };
        let shown = of(&self.devices);
        if shown.is_empty() { of(&self.with_page) } else { shown }.into_iter()
    }

    /// A link to an entry, as `6040h` or `3020h.5`; of a device without a page, the id alone.
    pub(crate) fn entry_link(&self, id: EntryId) -> Cell {
        self.link(id.index, id.to_string(), entry_anchor(id))
    }

    /// A link to something of an object, if a device with a page has the object.
    pub(crate) fn link(&self, index: Index, text: String, anchor: String) -> Cell {
        self.link_on(&Devices::All, index, text, anchor)
    }

    /// A link to something of an object of these devices.
    pub(crate) fn link_on(&self, devices: &Devices, index: Index, text: String, anchor: String) -> Cell {
        let Some(target) = self.target(devices, index, anchor) else { return Cell::plain(text) };
        Cell::default().link(text, target.anchor, target.page)
    }

    /// Where something of an object of these devices is described, if one of them has a page and the object.
    pub(crate) fn target(&self, devices: &Devices, index: Index, anchor: String) -> Option<Target> {
        let device = self.led_to(devices, index).next()?;
        // What no chapter details is on the page of its device: each device has one. So does what another device has.
        let home = self.home(index);
        let is_shown = self.devices.iter().any(|one| one.key == device.key);
        let is_on_page_of_device = !is_shown || self.devices.iter().any(|device| device.key == home);
        let page = if is_on_page_of_device { &device.key } else { home };
        Some(Target { anchor, page: page.to_owned() })
    }

    /// Where an entry of a device is described.
    pub(crate) fn entry_target(&self, device: &Dictionary, id: EntryId) -> Option<Target> {
        self.target(&Devices::one(&device.key), id.index, entry_anchor(id))
    }

    /// A link to an entry of a device.
    pub(crate) fn entry_link_on(&self, device: &Dictionary, id: EntryId) -> Cell {
        self.link_on(&Devices::one(&device.key), id.index, id.to_string(), entry_anchor(id))
    }

    /// A link to an entry with its name.
    pub(crate) fn named_entry(&self, device: &Dictionary, id: EntryId) -> Cell {
        self.entry_link_on(device, id).text(format!(" {}", device.entry_name(id).unwrap_or_default()))
    }

    /// Whether one of these devices is shown; where none is, what is about all devices is still shown.
    pub(crate) fn shows_any(&self, devices: &Devices) -> bool {
        *devices == Devices::All || self.devices.iter().any(|device| devices.includes(&device.key))
    }

    /// Whether an erratum is about one of the devices shown.
    pub(crate) fn is_about(&self, erratum: &Erratum) -> bool {
        self.shows_any(&erratum.devices)
    }

    /// Numbers of the errata about an object, as a whole or any of its entries.
    pub(crate) fn errata_of_object(&self, index: Index) -> &[usize] {
        self.lookup.errata.get(&index).map_or(&[], Vec::as_slice)
    }

    /// Numbers of the errata that name one entry; those of an object of one value name its only entry.
    pub(crate) fn errata_of_entry(&self, object: &Object, entry: &Entry) -> Vec<usize> {
        let id = EntryId { index: object.index, sub: entry.sub };
        let names = |at: &&usize| {
            self.system.errata[**at].at.iter().any(|place| match place {
                ErratumPlace::Object(index) => *index == object.index && !object.is_structured(),
                ErratumPlace::Entry(named) => *named == id,
            })
        };
        self.errata_of_object(object.index).iter().filter(names).copied().collect()
    }
}
