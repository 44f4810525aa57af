//! What the parts of a specification are written against.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use od_spec::Library;
use od_spec::model::{DataType, Dictionary, Direction, EntryId, Index, NamedType, System, Unit};

use super::eds::{EdsDefaults, fewest_exceptions};
use super::options::{Options, Place};
use super::remarks::{Remarks, Repair};

/// How a device is written.
#[derive(Debug, Clone, Default)]
pub(super) struct Style {
    /// Libraries that it uses.
    pub libraries: Vec<Arc<Library>>,
    /// Whether common keys are written once, features bring objects, and PDOs are under `pdos:`.
    pub short: bool,
    /// PDOs whose parameter objects are written, as no key under `pdos:` says what they have.
    pub pdos_in_full: BTreeSet<(Direction, u16)>,
}

/// What the parts of a specification are written against.
pub(super) struct Context<'a> {
    pub system: &'a System,
    pub device: &'a Dictionary,
    pub options: &'a Options,
    pub remarks: &'a Remarks,
    pub style: &'a Style,
    pub eds: EdsDefaults,
    /// What was changed, by place.
    repairs: BTreeMap<Place, Vec<&'a Repair>>,
    /// Types of the file's own: by the name in the model, the name in the text.
    types: BTreeMap<String, String>,
    /// Units of the file's own, likewise.
    units: BTreeMap<String, String>,
}

impl<'a> Context<'a> {
    pub(super) fn new(
        system: &'a System,
        device: &'a Dictionary,
        options: &'a Options,
        remarks: &'a Remarks,
        style: &'a Style,
    ) -> Self {
        let eds = if style.short { fewest_exceptions(device) } else { EdsDefaults::All };
        let mut context = Self {
            system,
            device,
            options,
            remarks,
            style,
            eds,
            repairs: remarks.by_place(),
            types: BTreeMap::new(),
            units: BTreeMap::new(),
        };
        context.types = context.own_types();
        context.units = context.own_units();
        context
    }

    /// The language of texts that do not say theirs.
    pub(super) fn language(&self) -> &str {
        self.system.language()
    }

    /// The name of a type in the text.
    pub(super) fn type_name(&self, named: &NamedType) -> String {
        self.types.get(&named.name).unwrap_or(&named.name).clone()
    }

    /// The name of a unit in the text.
    pub(super) fn unit_name(&self, unit: &Unit) -> String {
        self.units.get(&unit.name).unwrap_or(&unit.name).clone()
    }

    /// The types that the file defines: those that its entries have and no library defines just so.
    pub(super) fn types(&self) -> Vec<Arc<NamedType>> {
        let all = self.device.entries().filter_map(|(.., entry)| entry.named_type.clone());
        let by_name: BTreeMap<String, Arc<NamedType>> =
            all.map(|named| (named.name.clone(), named)).collect();
        by_name.into_values().filter(|named| self.types.contains_key(&named.name)).collect()
    }

    /// The units that the file defines.
    pub(super) fn units(&self) -> Vec<Arc<Unit>> {
        let all = self.device.entries().filter_map(|(.., entry)| entry.unit.clone());
        let by_name: BTreeMap<String, Arc<Unit>> = all.map(|unit| (unit.name.clone(), unit)).collect();
        by_name.into_values().filter(|unit| self.units.contains_key(&unit.name)).collect()
    }

    fn own_types(&self) -> BTreeMap<String, String> {
        let mut taken: BTreeSet<String> =
            self.style.libraries.iter().flat_map(|library| library.types.keys().cloned()).collect();
        let mut names = BTreeMap::new();
        for named in self.device.entries().filter_map(|(.., entry)| entry.named_type.as_ref()) {
            let is_library = |library: &Arc<Library>| {
                library.types.get(&named.name).is_some_and(|one| same_type(one, named))
            };
            if names.contains_key(&named.name) || self.style.libraries.iter().any(is_library) {
                continue;
            }
            let is_free = |name: &str| !taken.contains(name) && DataType::from_name(name).is_none();
            let name = free_name(&named.name, is_free);
            taken.insert(name.clone());
            names.insert(named.name.clone(), name);
        }
        names
    }

    fn own_units(&self) -> BTreeMap<String, String> {
        let mut taken: BTreeSet<String> =
            self.style.libraries.iter().flat_map(|library| library.units.keys().cloned()).collect();
        let mut names = BTreeMap::new();
        for unit in self.device.entries().filter_map(|(.., entry)| entry.unit.as_ref()) {
            let is_library = |library: &Arc<Library>| {
                library.units.get(&unit.name).is_some_and(|one| same_unit(one, unit))
            };
            if names.contains_key(&unit.name) || self.style.libraries.iter().any(is_library) {
                continue;
            }
            let name = free_name(&unit.name, |name| !taken.contains(name));
            taken.insert(name.clone());
            names.insert(unit.name.clone(), name);
        }
        names
    }

    /// Comments about the device.
    pub(super) fn above_device(&self) -> Vec<String> {
        self.above(Place::Device)
    }

    /// Comments about an object.
    pub(super) fn above_object(&self, index: Index) -> Vec<String> {
        self.above(Place::Object(index))
    }

    /// Comments about an entry.
    pub(super) fn above_entry(&self, id: EntryId) -> Vec<String> {
        self.above(Place::Entry(id))
    }

    fn above(&self, place: Place) -> Vec<String> {
        let given = self.options.comments.get(&place).into_iter().flatten().cloned();
        let repairs = self.repairs.get(&place).into_iter().flatten().map(|repair| repair.comment());
        given.chain(repairs).flat_map(|line| comment(&line)).collect()
    }
}

/// A comment in lines that fit; without characters that end a line for some reader.
pub(super) fn comment(text: &str) -> Vec<String> {
    let plain: String = text.chars().map(|c| if is_line_safe(c) { c } else { ' ' }).collect();
    let plain = plain.trim();
    if plain.is_empty() { Vec::new() } else { super::emit::wrapped(plain, 130) }
}

const fn is_line_safe(c: char) -> bool {
    !matches!(c, '\0'..='\u{1F}' | '\u{7F}'..='\u{9F}' | '\u{2028}' | '\u{2029}' | '\u{FEFF}' | '\u{FFFE}' | '\u{FFFF}')
}

/// A name, or with the first number after it that makes it free.
fn free_name(name: &str, is_free: impl Fn(&str) -> bool) -> String {
    let numbered = (2u32..).map(|number| format!("{name} {number}"));
    std::iter::once(name.to_owned()).chain(numbered).find(|name| is_free(name)).unwrap_or_default()
}

/// Whether two types say the same.
pub(super) fn same_type(one: &NamedType, other: &NamedType) -> bool {
    one.base == other.base && one.kind == other.kind && (one.about == other.about || other.about.is_empty())
}

/// Whether a unit says what another does; one that is called like its symbol has no name of its own.
pub(super) fn same_unit(one: &Unit, other: &Unit) -> bool {
    let text = |unit: &Unit| unit.formula.as_ref().map(|formula| formula.text.clone());
    (one.name == other.name || other.name == other.symbol)
        && one.symbol == other.symbol
        && one.scale == other.scale
        && one.offset == other.offset
        && one.base == other.base
        && text(one) == text(other)
        && (one.about == other.about || other.about.is_empty())
}
