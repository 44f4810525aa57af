//! References to entries, by index or by name.

use std::cell::OnceCell;
use std::collections::btree_map;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::ast::{EntryDecl, Name};
use crate::check::codes as rule_codes;
use crate::decode::lexical;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::model::{Devices, Dictionary, EntryId, Index, Object, SubIndex};
use crate::order::Arrange as _;
use crate::source::{Span, Spanned};

/// What is defined, but not well enough to be there: a reference to it says nothing new.
#[derive(Debug, Default)]
pub(super) struct Broken {
    indices: BTreeSet<Index>,
    names: BTreeSet<String>,
    /// What is broken for every device.
    everywhere: Option<Arc<Broken>>,
    /// Objects that only some devices have.
    owners: BTreeMap<Index, Owners>,
    /// The same by name.
    owned: BTreeMap<String, Owners>,
}

/// The devices that have an object.
#[derive(Debug, Clone)]
struct Owners {
    /// How the specification calls the object.
    object: String,
    /// Keys of the devices.
    devices: Vec<String>,
    /// Where it is written.
    place: Span,
}

impl Owners {
    /// Adds the devices of another object.
    fn join(&mut self, other: &Owners) {
        let new = other.devices.iter().filter(|device| !self.devices.contains(device)).cloned();
        let new: Vec<String> = new.collect();
        self.devices.extend(new);
    }

    /// What to do when another device is to have the object.
    fn help(&self) -> String {
        let devices: Vec<String> = self.devices.iter().map(|key| format!("`{key}`")).collect();
        let object = shorten(&self.object);
        format!(
            "`{object}` is an object of {} only; name the other device under its `devices:`, too",
            devices.join(", ")
        )
    }
}

impl Broken {
    /// Nothing but what is broken for every device.
    pub(super) fn over(everywhere: &Arc<Broken>) -> Self {
        Self { everywhere: Some(Arc::clone(everywhere)), ..Self::default() }
    }

    pub(super) fn add<'n>(&mut self, index: Index, names: impl IntoIterator<Item = &'n Name>) {
        self.indices.insert(index);
        self.names.extend(names.into_iter().map(|name| name.value.clone()));
    }

    /// Notes an object that only some devices have.
    pub(super) fn own(&mut self, index: Spanned<Index>, entry: &EntryDecl, devices: &[Name]) {
        let object = entry.name.as_ref().map_or_else(|| index.value.to_string(), |name| name.value.clone());
        let devices = devices.iter().map(|key| key.value.clone()).collect();
        let owners = Owners { object, devices, place: index.span };
        for name in entry.names() {
            self.owned
                .entry(name.value.clone())
                .and_modify(|known| known.join(&owners))
                .or_insert_with(|| owners.clone());
        }
        match self.owners.entry(index.value) {
            btree_map::Entry::Vacant(vacant) => drop(vacant.insert(owners)),
            btree_map::Entry::Occupied(mut known) => {
                known.get_mut().join(&owners);
                known.get_mut().object = index.value.to_string();
            }
        }
    }

    /// An entry that is named at `place`, and is not there; `is_there` says whether its object is.
    pub(super) fn missing(&self, id: EntryId, is_there: bool, place: Span) -> Diagnostic {
        let help = match self.owners_of(id.index).filter(|_| !is_there) {
            Some(owners) => owners.help(),
            None => "correct the index or sub-index, or define the object on this device".to_owned(),
        };
        Diagnostic::new(codes::UNKNOWN_ENTRY, place, format!("there is no entry {id}")).help(help)
    }

    /// Where an object is that only some devices have, and what to do when another is to have it.
    pub(super) fn elsewhere(&self, index: Index) -> Option<(Span, String)> {
        self.owners_of(index).map(|owners| (owners.place, owners.help()))
    }

    fn owners_of(&self, index: Index) -> Option<&Owners> {
        let everywhere = || self.everywhere.as_ref()?.owners_of(index);
        self.owners.get(&index).or_else(everywhere)
    }

    fn owners_of_name(&self, name: &str) -> Option<&Owners> {
        let everywhere = || self.everywhere.as_ref()?.owners_of_name(name);
        objects_in(name).find_map(|object| self.owned.get(object)).or_else(everywhere)
    }

    pub(super) fn append(&mut self, more: Broken) {
        self.indices.extend(more.indices);
        self.names.extend(more.names);
    }

    pub(super) fn has(&self, index: Index) -> bool {
        self.indices.contains(&index) || self.everywhere.as_ref().is_some_and(|broken| broken.has(index))
    }

    /// Whether a name is that of a broken object, or of an entry in one.
    fn has_name(&self, name: &str) -> bool {
        let mut objects = objects_in(name);
        objects.any(|object| self.names.contains(object))
            || self.everywhere.as_ref().is_some_and(|broken| broken.has_name(name))
    }
}

/// The names of objects that a reference may hold: the whole, or what is before a dot.
fn objects_in(reference: &str) -> impl Iterator<Item = &str> {
    reference.match_indices('.').map(|(dot, _)| &reference[..dot]).chain([reference])
}

/// Entries of one device by name or identifier: `controlword`, `drive data.error mask`.
pub(crate) struct Names<'a> {
    /// By name and by identifier; of one text, in the order in which they were given.
    objects: Vec<(&'a str, &'a Object)>,
    /// What can be written, for suggestions.
    all: OnceCell<Vec<String>>,
    /// For help.
    indices: OnceCell<BTreeSet<Index>>,
}

/// What a name means.
pub(crate) enum Meant<'a> {
    /// Nothing has it.
    Nothing,
    /// One entry.
    One(EntryId),
    /// Several: the objects and sub-indices of the first ones, as many as [`ambiguous`] wants.
    Several(Vec<(&'a Object, SubIndex)>),
}

impl Meant<'_> {
    /// The first entry, where there is any.
    pub(crate) fn first(&self) -> Option<EntryId> {
        match self {
            Meant::One(id) => Some(*id),
            Meant::Several(found) => {
                found.first().map(|(object, sub)| EntryId { index: object.index, sub: *sub })
            }
            Meant::Nothing => None,
        }
    }

    /// The entry, where it is one.
    pub(crate) fn one(&self) -> Option<EntryId> {
        match self {
            Meant::One(id) => Some(*id),
            Meant::Nothing | Meant::Several(_) => None,
        }
    }
}

impl<'a> Names<'a> {
    pub(crate) fn new(objects: impl IntoIterator<Item = &'a Object>) -> Self {
        let texts = |object: &'a Object| {
            let identifier = object.identifier.as_deref().filter(|identifier| *identifier != object.name);
            std::iter::once(object.name.as_str()).chain(identifier).map(move |text| (text, object))
        };
        let mut objects: Vec<(&str, &Object)> = objects.into_iter().flat_map(texts).collect();
        objects.arrange_by_key(|(text, _)| *text);
        Self { objects, all: OnceCell::new(), indices: OnceCell::new() }
    }

    /// Whether there is an object of this index.
    fn has(&self, index: Index) -> bool {
        let indices =
            self.indices.get_or_init(|| self.objects.iter().map(|(_, object)| object.index).collect());
        indices.contains(&index)
    }

    /// The objects of a name or identifier.
    pub(super) fn named(&self, name: &str) -> impl Iterator<Item = &'a Object> {
        let first = self.objects.partition_point(|(text, _)| *text < name);
        let named = self.objects[first..].iter().take_while(move |(text, _)| *text == name);
        named.map(|(_, object)| *object)
    }

    /// What a name means.
    pub(crate) fn get(&self, name: &str) -> Meant<'a> {
        let whole = self.named(name).map(|object| (object, SubIndex(0)));
        let members = name.match_indices('.').flat_map(|(dot, _)| {
            let (object, entry) = (&name[..dot], &name[dot + 1..]);
            self.named(object).filter(|object| object.is_structured()).flat_map(move |object| {
                object
                    .entries
                    .iter()
                    .filter(move |one| one.is_called(entry))
                    .map(move |one| (object, one.sub))
            })
        });
        let found: Vec<(&Object, SubIndex)> = whole.chain(members).take(Namesake::LISTED + 1).collect();
        match found.as_slice() {
            [] => Meant::Nothing,
            [(object, sub)] => Meant::One(EntryId { index: object.index, sub: *sub }),
            _ => Meant::Several(found),
        }
    }

    /// All names, ascending.
    pub(super) fn all(&self) -> impl Iterator<Item = &str> {
        let all = self.all.get_or_init(|| {
            let mut all: Vec<String> = Vec::new();
            for (text, object) in &self.objects {
                all.push((*text).to_owned());
                if object.is_structured() {
                    all.extend(object.entries.iter().map(|entry| format!("{text}.{}", entry.name)));
                }
            }
            all
        });
        all.iter().map(String::as_str)
    }

    /// The entry that a reference names; what is broken is not reported as missing.
    pub(super) fn find(
        &self,
        reference: &Name,
        exists: impl Fn(EntryId) -> bool,
        broken: &Broken,
        diagnostics: &mut Diagnostics,
    ) -> Option<EntryId> {
        find(&[self], reference, exists, broken, diagnostics)
    }
}

/// One of several things that have one name.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Namesake {
    /// Its number, as messages write it.
    pub number: String,
    /// How a reference names it and nothing else.
    pub way: String,
}

impl Namesake {
    /// So many are listed in a message.
    pub(super) const LISTED: usize = 4;

    /// What distinguishes an entry from all others that a name means.
    pub(super) fn of(name: &str, object: &Object, sub: SubIndex) -> Self {
        let member = object.entry(sub).filter(|_| !object.is_called(name) && object.is_structured());
        let id = EntryId { index: object.index, sub };
        let (label, number, index) = match member {
            Some(entry) => (format!("{}.{}", object.label(), entry.label()), id.to_string(), id.notation()),
            None => (object.label().to_owned(), id.index.to_string(), id.index.notation()),
        };
        Self { number, way: if label == name { index } else { label } }
    }
}

/// Reports a reference by a name that several things have.
pub(crate) fn ambiguous(name: &str, of: &[Namesake], place: Span) -> Diagnostic {
    let list = |word: fn(&Namesake) -> String, between: &str, more: &str| {
        let words: Vec<String> = of.iter().take(Namesake::LISTED).map(word).collect();
        match words.split_last() {
            _ if of.len() > words.len() => format!("{}{more}", words.join(", ")),
            Some((last, rest)) if !rest.is_empty() => format!("{} {between} {last}", rest.join(", ")),
            _ => words.concat(),
        }
    };
    let numbers = list(|one| one.number.clone(), "and", " and others");
    let ways = list(|one| format!("`{}`", shorten(&one.way)), "or", " or another");
    Diagnostic::new(
        rule_codes::DUPLICATE_NAME,
        place,
        format!("`{}` is the name of {numbers}", shorten(name)),
    )
    .label("not clear which")
    .help(format!("write {ways}"))
}

/// The entry that a reference names in the first of some devices that has it.
fn find(
    devices: &[&Names<'_>],
    reference: &Name,
    exists: impl Fn(EntryId) -> bool,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<EntryId> {
    let text = reference.value.as_str();
    if lexical::looks_like_index(text) {
        let id = lexical::entry_by_index(text)?.id();
        if exists(id) {
            return Some(id);
        }
        if !broken.has(id.index) {
            let is_there = devices.iter().any(|names| names.has(id.index));
            diagnostics.push(broken.missing(id, is_there, reference.span));
        }
        return None;
    }
    let meant = devices.iter().map(|names| names.get(text)).find(|meant| meant.first().is_some());
    if let Some(Meant::Several(several)) = &meant {
        let namesakes: Vec<Namesake> =
            several.iter().map(|(object, sub)| Namesake::of(text, object, *sub)).collect();
        let ways: BTreeSet<&str> = namesakes.iter().map(|one| one.way.as_str()).collect();
        // Where nothing distinguishes them, that is reported at their names.
        if namesakes.iter().any(|one| !lexical::looks_like_index(&one.way)) && ways.len() == namesakes.len() {
            diagnostics.push(ambiguous(text, &namesakes, reference.span));
            return None;
        }
    }
    let found = meant.and_then(|meant| meant.first());
    if found.is_none() && !broken.has_name(text) && diagnostics.is_new(codes::UNKNOWN_ENTRY, reference.span) {
        let message = format!("there is no entry named `{}`", shorten(text));
        let diagnostic = Diagnostic::new(codes::UNKNOWN_ENTRY, reference.span, message);
        let known = devices.iter().flat_map(|names| names.all());
        let member = member_called(text, devices.iter().flat_map(|names| names.all()));
        let meant = member.or_else(|| diagnostics.suggestions.nearest(text, known));
        diagnostics.push(match (broken.owners_of_name(text), lexical::with_0x(text), meant) {
            (Some(owners), ..) => diagnostic.help(owners.help()),
            (None, Some(index), _) => diagnostic.did_you_mean(&index),
            (None, None, Some(name)) => diagnostic.did_you_mean(name),
            (None, None, None) => {
                diagnostic.help("write an object's name, `object.entry` for a member, or an index")
            }
        });
    }
    found
}

/// The member of an object that has this name: `record.member`.
pub(crate) fn member_called<'a>(text: &str, mut known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    known.find(|name| name.rsplit_once('.').is_some_and(|(_, member)| member.eq_ignore_ascii_case(text)))
}

/// The names of devices, each worked out when it is asked for.
pub(super) struct NamesOf<'a> {
    devices: &'a [Dictionary],
    single: BTreeMap<&'a str, OfDevice<'a>>,
    by_index: OnceCell<BTreeMap<Index, Vec<&'a Object>>>,
}

/// The names of one device.
struct OfDevice<'a> {
    position: usize,
    names: OnceCell<Names<'a>>,
}

impl<'a> NamesOf<'a> {
    pub(super) fn new(devices: &'a [Dictionary]) -> Self {
        let single = devices
            .iter()
            .enumerate()
            .map(|(position, device)| (device.key.as_str(), OfDevice { position, names: OnceCell::new() }));
        Self { devices, single: single.collect(), by_index: OnceCell::new() }
    }

    /// Each of some devices with its names, in the order of the devices.
    pub(super) fn each(&self, on: &Devices) -> impl Iterator<Item = (&'a Dictionary, &Names<'a>)> {
        self.positions(on).into_iter().filter_map(|position| {
            let device = self.devices.get(position)?;
            let names = &self.single.get(device.key.as_str())?.names;
            Some((device, names.get_or_init(|| Names::new(device.objects.values()))))
        })
    }

    fn positions(&self, on: &Devices) -> BTreeSet<usize> {
        match on {
            Devices::All => (0..self.devices.len()).collect(),
            Devices::Only(keys) => {
                keys.iter().filter_map(|key| Some(self.single.get(key.as_str())?.position)).collect()
            }
        }
    }

    /// The objects of an index on some devices.
    pub(super) fn objects(&self, on: &Devices, index: Index) -> Vec<&'a Object> {
        match on {
            Devices::All => {
                let by_index = self.by_index.get_or_init(|| {
                    let mut by_index: BTreeMap<Index, Vec<&'a Object>> = BTreeMap::new();
                    for object in self.devices.iter().flat_map(|device| device.objects.values()) {
                        by_index.entry(object.index).or_default().push(object);
                    }
                    by_index
                });
                by_index.get(&index).cloned().unwrap_or_default()
            }
            Devices::Only(_) => {
                let devices =
                    self.positions(on).into_iter().filter_map(|position| self.devices.get(position));
                devices.filter_map(|device| device.objects.get(&index)).collect()
            }
        }
    }

    /// The entry that an index or a name means on the first of some devices that has it.
    pub(super) fn entry(
        &self,
        on: &Devices,
        reference: &Name,
        broken: &Broken,
        diagnostics: &mut Diagnostics,
    ) -> Option<EntryId> {
        let by_index = lexical::entry_by_index(&reference.value).map(lexical::NumberedEntry::id);
        let exists = |id: &EntryId| {
            let objects = self.objects(on, id.index);
            objects.iter().any(|object| object.entry(id.sub).is_some())
        };
        by_index.filter(exists).or_else(|| self.find(on, reference, broken, diagnostics))
    }

    /// The entry that a name means on the first of some devices that has it.
    pub(super) fn find(
        &self,
        on: &Devices,
        reference: &Name,
        broken: &Broken,
        diagnostics: &mut Diagnostics,
    ) -> Option<EntryId> {
        let names: Vec<&Names<'_>> = self.each(on).map(|(_, names)| names).collect();
        find(&names, reference, |_| false, broken, diagnostics)
    }
}
