//! Specifications: a model as the text that a person would write for it.
//!
//! What comes out compiles, and gives the model that went in. Objects that a library defines are taken from it, PDOs
//! are under `pdos:`, and what entries have in common is said once – each time only if the text then says the same.
//! What the language refuses is left out or changed, as little as possible, and a comment states what the model says.

mod compare;
mod context;
mod departures;
mod device;
mod eds;
mod emit;
mod entry;
mod errors;
mod features;
mod fold;
mod further;
mod mend;
mod names;
mod node;
mod objects;
mod options;
mod pdo_names;
mod pdo_obstacles;
mod pdo_parameters;
mod pdos;
mod remarks;
mod runs;
mod scalar;
mod text;
mod texts;
mod trial;
mod types;
mod value;

use std::sync::{Arc, LazyLock};

use od_gen::plan::decided;
use od_gen::rust::Rust;
use od_spec::diag::Diagnostics;
use od_spec::model::{Dictionary, EntryId, Index, System, Value};
use od_spec::{LIBRARIES, Library, library, library_in};

use context::Style;
pub use eds::follow as forget_eds_policy;
use mend::Draft;
pub(crate) use node::{Item, Node};
pub use options::{Options, Place};
use remarks::Remarks;
pub use remarks::Repair;
pub use scalar::spelled;
pub(crate) use value::value;
pub use value::value_text;

/// A document of these keys.
pub(crate) fn written(items: &[Item]) -> String {
    emit::write(items).text
}

/// A specification that was written for a model.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Specification {
    /// The text; it compiles.
    pub text: String,
    /// What it says otherwise than the model; the text has a comment for each.
    pub repairs: Vec<Repair>,
    /// The rules that the model breaks, by code: the text allows them, each with what was found.
    pub allowed: Vec<&'static str>,
    /// What the model has and the text does not: parts of a specification that no EDS can hold.
    pub left_out: Vec<String>,
}

/// The built-in libraries in English, each read once.
static BUILT_IN: LazyLock<Vec<Arc<Library>>> =
    LazyLock::new(|| LIBRARIES.iter().filter_map(|(name, _)| library(name)).map(Arc::new).collect());

/// The built-in libraries with their texts in the languages of a system.
fn built_in(languages: &[String]) -> Vec<Arc<Library>> {
    if languages == ["en"] {
        return BUILT_IN.clone();
    }
    LIBRARIES.iter().filter_map(|(name, _)| library_in(name, languages)).map(Arc::new).collect()
}

/// Writes a device of a system as a specification of its own.
///
/// ```
/// use od_import::yaml::{Options, specification};
/// use od_spec::source::SourceMap;
/// use od_spec::{NoFiles, compile};
///
/// let mut sources = SourceMap::new();
/// let root = sources.add("lamp.od.yaml", "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices: {lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}}
/// objects:
///   0x2000: {name: brightness, type: unsigned8, access: rw, default: 80, max: 100}
/// ");
/// let system = compile(&mut sources, root, &mut NoFiles).system.expect("no errors");
/// let written = specification(&system, &system.devices[0], &Options::default()).expect("it can be written");
/// assert!(written.text.ends_with("
/// objects:
///   0x2000: {name: brightness, type: unsigned8, access: rw, default: 80, max: 100}
/// "));
/// assert!(written.repairs.is_empty());
/// ```
///
/// # Errors
/// What the language still refuses where nothing more can be left out: a device without a valid key, for example.
pub fn specification(
    system: &System,
    device: &Dictionary,
    options: &Options,
) -> Result<Specification, Diagnostics> {
    let mut draft = Draft { system: system.clone(), device: device.clone() };
    // The only device of a draft is its own.
    draft.system.devices.clear();
    let mut left_out = leave_out(&mut draft);
    name_device(&mut draft);
    withhold(&mut draft);
    let mut remarks = Remarks::default();
    names::settle(&mut draft.device, &mut remarks.repairs);
    // What code needs of it, as it is decided for code made from the EDS itself.
    draft.device = decided(&draft.system, &draft.device, &Rust).into_owned();
    draft.settle_counts(&mut remarks.repairs);
    let (text, found) = trial::proven(&mut draft, options, &mut remarks)?;
    let not_said = compare::differing(&draft.device, &found);
    left_out.extend(not_said.iter().map(|index| format!("facts about {index} for which there are no keys")));
    let allowed = remarks.allowed.into_keys().collect();
    Ok(Specification { text, repairs: remarks.repairs, allowed, left_out })
}

/// Takes out what a specification made of an EDS does not have; returns what that was.
fn leave_out(draft: &mut Draft) -> Vec<String> {
    let mut left_out = Vec::new();
    let mut say = |what: String, is_there: bool| left_out.extend(is_there.then_some(what));
    let system = &draft.system;
    let document = &system.document;
    say(
        "the printed manual and its revisions".to_owned(),
        document.source.is_some() || document.revision.is_some(),
    );
    say("state machines".to_owned(), !system.machines.is_empty());
    say("constraints".to_owned(), !system.constraints.is_empty());
    say("errata".to_owned(), !system.errata.is_empty());
    for object in draft.device.objects.values_mut() {
        for entry in &mut object.entries {
            if let Some(alias) = entry.alias.take() {
                left_out.push(format!("{} is a view of {}", object.index, alias.target));
            }
        }
    }
    left_out
}

/// A device fills in its type, name and identity where no value is stated; of values that the model leaves open, the EDS shall
/// show none.
fn withhold(draft: &mut Draft) {
    let Draft { system, device } = draft;
    let open: Vec<(EntryId, Value)> = device
        .entries()
        .filter(|(.., entry)| entry.default.is_none())
        .filter_map(|(id, ..)| Some((id, entry::device_value(system, device, id.index, id.sub)?)))
        .collect();
    for (id, value) in open {
        let object = device.objects.get_mut(&id.index);
        let entry = object.and_then(|object| object.entries.iter_mut().find(|entry| entry.sub == id.sub));
        if let Some(entry) = entry {
            entry.default = Some(value);
            entry.eds.default = false;
        }
    }
}

/// A specification has a title and its device a name, which no EDS shows; where the model has none, the product's is
/// used.
fn name_device(draft: &mut Draft) {
    let (title, device) = (&mut draft.system.title, &mut draft.device);
    let named = |text: &str| !text.trim().is_empty();
    if !named(&device.name) {
        let product = Some(&device.info.product_name).filter(|name| named(name));
        device.name = product.unwrap_or(&device.key).clone();
    }
    if !named(title) {
        title.clone_from(&device.name);
    }
}

/// Takes the PDOs as they follow from the parameter objects that are left; they keep their descriptions.
fn follow(device: &mut Dictionary, found: &Dictionary) {
    let before = std::mem::replace(&mut device.pdos, found.pdos.clone());
    for pdo in &mut device.pdos {
        let same = before.iter().find(|one| (one.direction, one.number) == (pdo.direction, pdo.number));
        pdo.about = same.map(|one| one.about.clone()).unwrap_or_default();
    }
}

/// Whether a library describes a device profile, and the device type names another one that has a library: profiles
/// give the same indices to different objects.
fn is_of_another_profile(device: &Dictionary, library: &Library) -> bool {
    let device_type =
        device.objects.get(&Index(0x1000)).and_then(|object| object.entries.first()?.default.as_ref());
    let Some(device_type) = device_type.and_then(Value::integer) else { return false };
    let named = format!("cia{}", device_type & 0xFFFF);
    let is_profile = |name: &str| name.strip_prefix("cia").is_some_and(|number| number >= "401");
    is_profile(&library.name) && library.name != named && BUILT_IN.iter().any(|one| one.name == named)
}

/// The shortest style in which the text gives what the plain one gives.
fn shortest(draft: &Draft, remarks: &Remarks) -> Style {
    let has = |index: &Index| draft.device.objects.contains_key(index);
    let usable = |library: &&Arc<Library>| {
        // What every device has that uses it cannot be left out.
        let implied = library.features.iter().filter(|feature| feature.implied);
        implied.flat_map(|feature| &feature.objects).all(has)
            && library.objects.keys().any(has)
            && !is_of_another_profile(&draft.device, library)
    };
    let libraries = built_in(&draft.system.languages).iter().filter(usable).cloned().collect();
    Style { libraries, short: true, pdos_in_full: pdo_obstacles::not_said(&draft.device, remarks) }
}
