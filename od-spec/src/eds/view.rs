//! A document by what its sections describe: sections found by topic, keys found by name, every text with its place.

use std::collections::BTreeMap;

use super::document::{Document, SectionRef};
use super::line::{Line, LineKind};
use super::names::{ElementList, List, ModuleTopic, Topic, topic};
use super::number::lenient_integer;
use crate::encoding::Encoding;
use crate::model::Index;
use crate::source::{FileId, Span, Spanned};
use crate::wording::FileFormat;

/// What is known about a file in addition to its text.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FileFacts<'d> {
    /// The name on the disk, without directories; empty where the text is from no file.
    pub name: &'d str,
    /// How its characters are stored.
    pub encoding: Encoding,
    /// How it is written.
    pub format: FileFormat,
}

/// What a document holds.
#[derive(Debug)]
pub(crate) struct View<'d> {
    pub document: &'d Document<'d>,
    pub file: FileId,
    pub facts: FileFacts<'d>,
    /// Whether the file is that of a configured node.
    pub is_dcf: bool,
    /// Sections that are there once or several times, by topic; objects are among `objects`.
    pub sections: BTreeMap<Topic, Part<'d>>,
    /// Sections of an unknown name, in the order of the text.
    pub unknown: Vec<SectionRef<'d, 'd>>,
    /// Objects by index: every index that has a section of its own or for one of its sub-indices.
    pub objects: BTreeMap<Index, ObjectPart<'d>>,
    /// Modules by number.
    pub modules: BTreeMap<u32, BTreeMap<ModuleTopic, Part<'d>>>,
    /// The numbers of the modules that are plugged in, in order.
    pub connected: Vec<u32>,
}

/// The sections about an object.
#[derive(Debug, Default)]
pub(crate) struct ObjectPart<'d> {
    /// `[1018]`.
    pub object: Option<Part<'d>>,
    /// `[1018sub1]`, by sub-index, which may be larger than any.
    pub subs: BTreeMap<u32, Part<'d>>,
    /// Lists for the elements of a compact array.
    pub elements: BTreeMap<ElementList, Part<'d>>,
    /// `[1018ObjectLinks]`.
    pub links: Option<Part<'d>>,
}

/// All sections of one topic: one, or the several that a faulty file has.
#[derive(Debug, Clone)]
pub(crate) struct Part<'d> {
    pub sections: Vec<SectionRef<'d, 'd>>,
    file: FileId,
}

/// A line with a key.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Entry<'d> {
    /// The key, as it is spelled.
    pub key: Spanned<&'d str>,
    /// The text of the value, without spaces around it.
    pub value: Spanned<&'d str>,
    /// The whole line.
    pub line: &'d Line<'d>,
}

impl<'d> View<'d> {
    pub(crate) fn new(
        document: &'d Document<'d>,
        file: FileId,
        has_dcf_name: bool,
        facts: FileFacts<'d>,
    ) -> Self {
        let mut view = Self {
            document,
            file,
            facts,
            is_dcf: has_dcf_name,
            sections: BTreeMap::new(),
            unknown: Vec::new(),
            objects: BTreeMap::new(),
            modules: BTreeMap::new(),
            connected: Vec::new(),
        };
        for section in document.sections() {
            view.add(section);
        }
        view.is_dcf |= view.sections.contains_key(&Topic::Commissioning);
        view.connected = view.section(Topic::ConnectedModules).map(Part::modules).unwrap_or_default();
        view
    }

    fn add(&mut self, section: SectionRef<'d, 'd>) {
        let file = self.file;
        let whole = topic(section.name());
        let slot = match whole {
            Topic::Unknown => return self.unknown.push(section),
            Topic::Object(index) => &mut self.objects.entry(index).or_default().object,
            Topic::ObjectLinks(index) => &mut self.objects.entry(index).or_default().links,
            Topic::Sub(index, sub) => {
                return add_to(&mut self.objects.entry(index).or_default().subs, sub, section, file);
            }
            Topic::Elements(index, list) => {
                return add_to(&mut self.objects.entry(index).or_default().elements, list, section, file);
            }
            Topic::Module(number, topic) => {
                return add_to(self.modules.entry(number).or_default(), topic, section, file);
            }
            Topic::FileInfo
            | Topic::DeviceInfo
            | Topic::DummyUsage
            | Topic::Comments
            | Topic::Objects(_)
            | Topic::Commissioning
            | Topic::DynamicChannels
            | Topic::Tools
            | Topic::Tool(_)
            | Topic::SupportedModules
            | Topic::ConnectedModules => return add_to(&mut self.sections, whole, section, file),
        };
        match slot {
            Some(part) => part.sections.push(section),
            None => *slot = Some(Part::of(section, file)),
        }
    }

    /// The sections of a topic that is not an object's.
    pub(crate) fn section(&self, topic: Topic) -> Option<&Part<'d>> {
        self.sections.get(&topic)
    }

    /// A list of objects.
    pub(crate) fn list(&self, list: List) -> Option<&Part<'d>> {
        self.section(Topic::Objects(list))
    }

    /// The place of a header, or of the first line of the file.
    pub(crate) fn start(&self) -> Span {
        let first = self.document.lines().iter().find(|line| line.kind() != LineKind::Blank);
        let place = first.and_then(|line| self.document.place(line));
        place.unwrap_or(Span { file: self.file, start: 0, end: 0 })
    }

    /// Every part there is, with its topic: those of the file, of objects and of modules.
    pub(crate) fn topics(&self) -> impl Iterator<Item = (Topic, &Part<'d>)> {
        let of_objects = self.objects.iter().flat_map(|(index, object)| {
            let index = *index;
            let object_itself = object.object.iter().map(move |part| (Topic::Object(index), part));
            let subs = object.subs.iter().map(move |(sub, part)| (Topic::Sub(index, *sub), part));
            let lists = object.elements.iter().map(move |(list, part)| (Topic::Elements(index, *list), part));
            let links = object.links.iter().map(move |part| (Topic::ObjectLinks(index), part));
            object_itself.chain(subs).chain(lists).chain(links)
        });
        let of_modules = self.modules.iter().flat_map(|(number, module)| {
            module.iter().map(move |(topic, part)| (Topic::Module(*number, *topic), part))
        });
        let of_the_file = self.sections.iter().map(|(topic, part)| (*topic, part));
        of_the_file.chain(of_objects).chain(of_modules)
    }

    /// Every part there is.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &Part<'d>> {
        self.topics().map(|(_, part)| part)
    }
}

fn add_to<'d, K: Ord>(parts: &mut BTreeMap<K, Part<'d>>, key: K, section: SectionRef<'d, 'd>, file: FileId) {
    parts.entry(key).or_insert_with(|| Part { sections: Vec::new(), file }).sections.push(section);
}

impl<'d> Part<'d> {
    /// A single section.
    pub(crate) fn of(section: SectionRef<'d, 'd>, file: FileId) -> Self {
        Self { sections: vec![section], file }
    }

    /// The numbers of the modules that `[ConnectedModules]` names, in order. Two in one place are two modules, unless a line
    /// only repeats another.
    fn modules(&self) -> Vec<u32> {
        let slots = self.entries().filter_map(|entry| {
            let slot = lenient_integer(entry.key.value)?;
            let module = lenient_integer(entry.value.value)?;
            Some((slot, u32::try_from(module).ok()?))
        });
        let mut by_slot: BTreeMap<i128, Vec<u32>> = BTreeMap::new();
        for (slot, module) in slots {
            let modules = by_slot.entry(slot).or_default();
            if modules.as_slice() != [module] {
                modules.push(module);
            }
        }
        by_slot.into_values().flatten().collect()
    }

    /// The name of the first section, as it is spelled.
    pub(crate) fn name(&self) -> Spanned<&'d str> {
        let header = self.sections[0].header();
        Spanned::new(self.sections[0].name(), self.sections[0].document().name_place(header, self.file))
    }

    /// Where the first header's name is.
    pub(crate) fn place(&self) -> Span {
        self.name().span
    }

    /// The length of its values and of the comments above it.
    pub(crate) fn size(&self) -> usize {
        let values = self.entries().map(|entry| entry.value.value.len());
        values.sum::<usize>() + self.comments_at_header().map(str::len).sum::<usize>()
    }

    /// All keys in order, also those that are written twice.
    pub(crate) fn entries(&self) -> impl Iterator<Item = Entry<'d>> + use<'d> {
        let file = self.file;
        let sections = self.sections.clone();
        let keys = sections.into_iter().flat_map(|section| section.keys().map(move |line| (section, line)));
        keys.filter_map(move |(section, line)| entry_in(section, line, file))
    }

    /// A key in upper or lower case, the last of several, as most readers take it; where it is not there, one with
    /// spaces in it.
    pub(crate) fn key(&self, name: &str) -> Option<Entry<'d>> {
        let sections = self.sections.iter().rev();
        let keys = sections.flat_map(|section| section.body().iter().rev().map(move |line| (*section, line)));
        let mut named =
            keys.clone().filter(|(_, line)| line.key().is_some_and(|key| key.eq_ignore_ascii_case(name)));
        let mut spaced = keys.filter(|(_, line)| line.key().is_some_and(|key| is_spaced(key, name)));
        let (section, line) = named.next().or_else(|| spaced.next())?;
        entry_in(section, line, self.file)
    }

    /// The value of a key, unless it is missing or, which means the same (CiA 306 4.3), empty.
    pub(crate) fn value(&self, name: &str) -> Option<Spanned<&'d str>> {
        self.key(name).map(|entry| entry.value).filter(|value| !value.value.is_empty())
    }

    /// The comments directly above the first section.
    pub(crate) fn comments_at_header(&self) -> impl Iterator<Item = &'d str> + use<'d> {
        self.sections[0].comments_at_header()
    }
}

/// Whether a key is a name with spaces in it: `Product Name`.
pub(crate) fn is_spaced(key: &str, name: &str) -> bool {
    key.len() > name.len()
        && key.contains(char::is_whitespace)
        && key
            .split_whitespace()
            .flat_map(str::bytes)
            .map(|byte| byte.to_ascii_lowercase())
            .eq(name.bytes().map(|byte| byte.to_ascii_lowercase()))
}

/// The place of the name in a header.
pub(crate) fn name_place(header: &Line<'_>, file: FileId) -> Span {
    header.name_part().map_or(Span { file, start: 0, end: 0 }, |name| header.part(file, name))
}

/// A line's key and value with their places, in whatever notation the file has; `None` for a line without.
fn entry_in<'d>(section: SectionRef<'d, 'd>, line: &'d Line<'d>, file: FileId) -> Option<Entry<'d>> {
    let (key, value) = section.document().key_places(line, file)?;
    Some(Entry { key: Spanned::new(line.key()?, key), value: Spanned::new(line.value()?, value), line })
}

/// A line's key and value with their places in an EDS; `None` for a line without.
pub(crate) fn entry<'d>(line: &'d Line<'d>, file: FileId) -> Option<Entry<'d>> {
    let (key, value) = (line.key_part()?, line.value_part()?);
    Some(Entry {
        key: Spanned::new(line.key()?, line.part(file, key)),
        value: Spanned::new(line.value()?, line.part(file, value)),
        line,
    })
}
