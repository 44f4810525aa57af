//! What tables hold of a device, and what they do not.

use std::collections::BTreeMap;
use std::sync::Arc;

use od_import::yaml::forget_eds_policy;
use od_spec::model::{
    AnyError, Author, BitField, BitUsage, Date, DateTime, Devices, Dictionary, Entry, EnumValue, Fact,
    NamedType, Object, Phrases, System, Text, TypeKind, Unit,
};

/// A device without what tables do not hold.
pub(super) struct Held {
    pub system: System,
    pub device: Dictionary,
    pub lost: Vec<String>,
}

/// How often each kind of fact is left out.
#[derive(Default)]
struct Lost(BTreeMap<&'static str, usize>);

impl Lost {
    fn add(&mut self, what: &'static str, count: usize) {
        if count > 0 {
            *self.0.entry(what).or_default() += count;
        }
    }

    /// Words to look for; those of a library come back with it.
    fn phrases(&mut self, phrases: &mut Phrases, author: Author) {
        self.add("words to look for", usize::from(!phrases.is_empty() && author == Author::Maker));
        *phrases = Phrases::default();
    }

    /// What the printed manual leaves open.
    fn gap(&mut self, text: &mut Text) {
        if text.gap().is_some() {
            self.add("what the printed manual leaves open", 1);
            *text = Text::new(text.iter());
        }
    }
}

/// Takes out what tables do not hold.
pub(super) fn held(system: &System, device: &Dictionary) -> Held {
    let (mut system, mut device) = (system.clone(), device.clone());
    let mut lost = Lost::default();
    of_system(&mut system, &mut device, &mut lost);
    for object in device.objects.values_mut() {
        of_object(object, &mut lost);
    }
    of_types(&mut device, &mut lost);
    let lost = lost.0.into_iter().map(|(what, count)| format!("{what}: {count}")).collect();
    Held { system, device, lost }
}

fn of_system(system: &mut System, device: &mut Dictionary, lost: &mut Lost) {
    lost.add("state machines", system.machines.len());
    lost.add("constraints", system.constraints.len());
    lost.add("errata", system.errata.len());
    let has_manual = system.document.source.is_some() || system.document.revision.is_some();
    lost.add("the printed manual", usize::from(has_manual));
    (system.document.source, system.document.revision) = (None, None);
    system.machines.clear();
    system.constraints.clear();
    system.errata.clear();
    system.errors.retain(|error| error.devices.includes(&device.key));
    for error in &mut system.errors {
        if !error.treated_by.includes(&device.key) {
            error.priority = None;
            error.reaction = Text::default();
            error.option_code = None;
        }
        (error.devices, error.treated_by) = (Devices::All, Devices::All);
        lost.add(
            "entries that choose the reaction to an error",
            usize::from(error.option_code.take().is_some()),
        );
        lost.phrases(&mut error.search, Author::Maker);
        for text in [&mut error.reaction, &mut error.reset, &mut error.about] {
            lost.gap(text);
        }
    }
    let any_error = std::mem::take(&mut device.any_error);
    lost.add("what holds for every error", usize::from(any_error != AnyError::default()));
    lost.gap(&mut device.about);
    lost.add("dynamic channels", device.info.dynamic_channels.len());
    device.info.dynamic_channels.clear();
    let further = device.further.take().is_some_and(|further| !further.is_empty());
    lost.add("what the EDS says in addition", usize::from(further));
    of_file(system, device, lost);
}

/// What the EDS says about itself follows from the device where nothing else is said.
fn of_file(system: &System, device: &mut Dictionary, lost: &mut Lost) {
    let before = device.file.clone();
    let file = &mut device.file;
    file.created = DateTime { date: Date { year: 2000, month: 1, day: 1 }, hour: 0, minute: 0 };
    file.modified = file.created;
    file.description.clone_from(&device.name);
    file.created_by.clone_from(&system.vendor.name);
    file.modified_by.clone_from(&system.vendor.name);
    (file.version, file.revision) = (1, 0);
    lost.add("what the EDS says about itself", usize::from(*file != before));
}

fn of_object(object: &mut Object, lost: &mut Lost) {
    lost.add("links between objects", object.links.len());
    object.links.clear();
    lost.add("notes of CANopenEditor", usize::from(object.editor.take().is_some()));
    let author = if object.profile.is_some() { Author::Library } else { Author::Maker };
    lost.phrases(&mut object.search, author);
    lost.gap(&mut object.about);
    lost.gap(&mut object.warning);
    for entry in &mut object.entries {
        of_entry(entry, lost);
    }
}

fn of_entry(entry: &mut Entry, lost: &mut Lost) {
    lost.add("views of other entries", usize::from(entry.alias.take().is_some()));
    lost.add("what the EDS shows otherwise", usize::from(forget_eds_policy(entry)));
    lost.add("error codes of the bits of one entry", entry.bit_errors.len());
    entry.bit_errors.clear();
    let author = if entry.is_only_standard(Fact::Search) { Author::Library } else { Author::Maker };
    lost.phrases(&mut entry.search, author);
    lost.gap(&mut entry.about);
    lost.gap(&mut entry.warning);
    for special in &mut entry.special {
        lost.add("descriptions of special values", usize::from(!special.about.is_empty()));
        special.about = Text::default();
    }
}

/// Types and units, each once.
fn of_types(device: &mut Dictionary, lost: &mut Lost) {
    let mut types: BTreeMap<String, Arc<NamedType>> = BTreeMap::new();
    let mut units: BTreeMap<String, Arc<Unit>> = BTreeMap::new();
    let entries = device.objects.values_mut().flat_map(|object| &mut object.entries);
    for entry in entries {
        if let Some(named) = &mut entry.named_type {
            let name = named.name.clone();
            *named = types.entry(name).or_insert_with(|| Arc::new(of_type(named, lost))).clone();
        }
        if let Some(unit) = &mut entry.unit {
            let name = unit.name.clone();
            *unit = units.entry(name).or_insert_with(|| Arc::new(of_unit(unit, lost))).clone();
        }
    }
}

fn of_type(named: &NamedType, lost: &mut Lost) -> NamedType {
    let mut named = named.clone();
    let author = named.stated.author;
    lost.gap(&mut named.about);
    match &mut named.kind {
        TypeKind::Enum(values) => {
            let mut held = values.to_vec();
            for value in &mut held {
                of_value(value, author, lost);
            }
            *values = held.into();
        }
        TypeKind::Bits(fields) => fields.iter_mut().for_each(|field| of_field(field, author, lost)),
    }
    named
}

fn of_value(value: &mut EnumValue, author: Author, lost: &mut Lost) {
    lost.phrases(&mut value.search, author);
    lost.gap(&mut value.about);
}

fn of_field(field: &mut BitField, author: Author, lost: &mut Lost) {
    lost.phrases(&mut field.search, author);
    lost.gap(&mut field.about);
    lost.add("meanings of bits in single modes", field.modes.len());
    field.modes.clear();
    // Bits that mean something in single modes only.
    if field.name.is_empty() && field.usage == BitUsage::Used {
        field.usage = BitUsage::Reserved;
    }
    let further = [
        ("short names of bits", field.mnemonic.take().is_some()),
        ("terminals of bits", field.clamp.take().is_some()),
        ("edges of bits", field.edge.take().is_some()),
        ("priorities of bits", field.priority.take().is_some()),
        ("bits that are active at 0", std::mem::replace(&mut field.active, 1) != 1),
    ];
    for (what, is_there) in further {
        lost.add(what, usize::from(is_there));
    }
    field.values.iter_mut().for_each(|value| of_value(value, author, lost));
}

fn of_unit(unit: &Unit, lost: &mut Lost) -> Unit {
    let mut unit = unit.clone();
    lost.add("formulas of units", usize::from(unit.formula.take().is_some()));
    lost.gap(&mut unit.about);
    unit
}
