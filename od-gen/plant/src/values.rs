//! The values of a node, with where each is said.

use od_spec::model::{EntryId, Value};
use od_spec::plant::{Class, Plant, PlantLayer, Settled};
use od_spec::source::Span;
use od_spec::wording::format_value;

/// A value that a level of the plant gives.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct PlantValue<'a> {
    /// The entry.
    pub id: EntryId,
    /// Its name.
    pub name: String,
    /// Its value in its unit, or by its name.
    pub value: String,
    /// The raw number, where it is one.
    pub raw: Option<i128>,
    /// The symbol of its unit.
    pub unit: Option<String>,
    /// The default of the device, written likewise.
    pub default: Option<String>,
    /// Whether it is one that the device takes only while it is unlocked.
    pub is_unlocked: bool,
    /// The level that gives it.
    pub from: &'a PlantLayer,
    /// Where that is written.
    pub place: Span,
    /// The levels that said something else before, the first one first, with the places.
    pub over: Vec<(&'a PlantLayer, Span)>,
}

/// The values that the levels of a plant give to the nodes of a class, by entry.
pub fn values<'a>(plant: &'a Plant, class: usize, settled: &'a Settled) -> Vec<PlantValue<'a>> {
    let Some(class) = plant.classes.get(class) else { return Vec::new() };
    let Some(device) = plant.devices.get(class.own.device) else { return Vec::new() };
    let layers: Vec<&PlantLayer> = plant.layers_of(&class.own).collect();
    let values = settled.assigned.values.iter().filter_map(|(id, value)| {
        let origin = settled.assigned.origins.get(id)?;
        let entry = device.dictionary.entry(*id)?;
        let shown = |value: &Value| format_value(entry, value);
        let before = settled.assigned.overridden.get(id).into_iter().flatten();
        Some(PlantValue {
            id: *id,
            name: device.dictionary.entry_name(*id).unwrap_or_default(),
            value: shown(value),
            raw: value.integer_for(class.own.node),
            unit: entry.unit.as_ref().map(|unit| unit.symbol.clone()),
            default: entry.default.as_ref().map(shown),
            is_unlocked: settled.assigned.unlocked.contains(id),
            from: layers.get(origin.layer)?,
            place: origin.span,
            over: before.filter_map(|one| Some((*layers.get(one.layer)?, one.span))).collect(),
        })
    });
    values.collect()
}

/// The name of an entry of the nodes of a class, and what it is where no level sets it.
pub fn default_of(plant: &Plant, class: &Class, id: EntryId) -> (String, Option<String>) {
    let Some(device) = plant.devices.get(class.own.device) else { return (id.to_string(), None) };
    let entry = device.dictionary.entry(id);
    let default = entry.and_then(|entry| Some(format_value(entry, entry.default.as_ref()?)));
    (device.dictionary.entry_name(id).unwrap_or_default(), default)
}
