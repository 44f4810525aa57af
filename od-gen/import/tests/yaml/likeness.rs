//! What is different between two models, fact by fact.

use std::fmt::Debug;

use od_spec::model::{Dictionary, Entry, Object, Pdo, System, Unit, Value};

/// The first fact in which two models of one device differ, and what each says.
pub(crate) fn difference(one: &System, other: &System) -> Option<String> {
    let (device, other_device) = (&one.devices[0], &other.devices[0]);
    let (vendor, other_vendor) = (&one.vendor, &other.vendor);
    first([
        fact("title", &one.title, &other.title),
        fact("languages", &one.languages, &other.languages),
        fact("vendor", &(&vendor.name, vendor.number), &(&other_vendor.name, other_vendor.number)),
        fact("key", &device.key, &other_device.key),
        fact("name", &device.name, &other_device.name),
        fact("about", &device.about, &other_device.about),
        fact("info", &device.info, &other_device.info),
        fact("file", &device.file, &other_device.file),
        objects(device, other_device),
        fact("PDOs", &pdos(device), &pdos(other_device)),
    ])
}

fn first(found: impl IntoIterator<Item = Option<String>>) -> Option<String> {
    found.into_iter().flatten().next()
}

fn fact<T: PartialEq + Debug + ?Sized>(name: &str, one: &T, other: &T) -> Option<String> {
    (one != other).then(|| format!("{name}: {one:?} and {other:?}"))
}

fn objects(one: &Dictionary, other: &Dictionary) -> Option<String> {
    let indices = |device: &Dictionary| device.objects.keys().map(ToString::to_string).collect::<Vec<_>>();
    fact("objects", &indices(one), &indices(other)).or_else(|| {
        first(one.objects.values().zip(other.objects.values()).map(|(one, other)| object(one, other)))
    })
}

fn object(one: &Object, other: &Object) -> Option<String> {
    let subs = |object: &Object| object.entries.iter().map(|entry| entry.sub.0).collect::<Vec<_>>();
    let found = first([
        fact("name", &one.name, &other.name),
        fact("kind", &one.kind, &other.kind),
        fact("identifier", &one.identifier, &other.identifier),
        fact("category", &one.category, &other.category).filter(|_| one.category.is_some()),
        fact("since", &one.since, &other.since),
        fact("about", &one.about, &other.about).filter(|_| !one.about.is_empty()),
        fact("links", &one.linked().collect::<Vec<_>>(), &other.linked().collect()),
        fact("sub-indices", &subs(one), &subs(other)),
    ]);
    let entries = || first(one.entries.iter().zip(&other.entries).map(|(one, other)| entry(one, other)));
    found.or_else(entries).map(|what| format!("{}: {what}", one.index))
}

fn entry(one: &Entry, other: &Entry) -> Option<String> {
    let condition = |entry: &Entry| entry.writable_when.as_ref().map(|condition| condition.text.clone());
    let errors = |entry: &Entry| {
        entry
            .bit_errors
            .iter()
            .map(|errors| (errors.bit, errors.error_codes().collect()))
            .collect::<Vec<(u8, Vec<u16>)>>()
    };
    let eds = |entry: &Entry| {
        // Without a value, nothing can be withheld.
        let default = entry.default.is_none() || entry.eds.default;
        (entry.eds.access, default, entry.eds.no_write, entry.eds.no_scan)
    };
    let named = |entry: &Entry| {
        let named = entry.named_type.as_ref()?;
        Some((named.name.clone(), named.base, named.about.clone(), named.kind.clone()))
    };
    let found = first([
        fact("name", &one.name, &other.name),
        fact("type", &one.data_type, &other.data_type),
        // Where a model is silent, a library may speak.
        fact("named type", &named(one), &named(other)).filter(|_| one.named_type.is_some()),
        fact("access", &(one.access, one.locked), &(other.access, other.locked)),
        fact("mapping", &one.pdo, &other.pdo),
        fact("default", &bits(one), &bits(other)),
        fact("limits", &(one.low, one.high), &(other.low, other.high)),
        fact("unit", &one.unit.as_deref().map(unit), &other.unit.as_deref().map(unit))
            .filter(|_| one.unit.is_some()),
        fact("special", &one.special, &other.special).filter(|_| !one.special.is_empty()),
        fact("stored", &one.stored, &other.stored),
        fact("category", &one.category, &other.category).filter(|_| one.category.is_some()),
        fact("since", &one.since, &other.since),
        fact("condition", &condition(one), &condition(other)),
        fact("capacity", &one.capacity, &other.capacity),
        fact("identifier", &one.identifier, &other.identifier),
        fact("bit errors", &errors(one), &errors(other)),
        fact("EDS", &eds(one), &eds(other)),
        fact("about", &one.about, &other.about).filter(|_| !one.about.is_empty()),
    ]);
    found.map(|what| format!("sub {}: {what}", one.sub))
}

/// The entries about which the second model says more than the first: a meaning, a unit, special values, a description.
pub(crate) fn enriched(one: &System, other: &System) -> Vec<String> {
    let mut ids = Vec::new();
    for ((id, object, one), (_, other_object, other)) in
        one.devices[0].entries().zip(other.devices[0].entries())
    {
        let facts = [
            (one.named_type.is_none() && other.named_type.is_some(), "meaning"),
            (one.unit.is_none() && other.unit.is_some(), "unit"),
            (one.special.is_empty() && !other.special.is_empty(), "special"),
            (one.category.is_none() && other.category.is_some(), "category"),
            (one.about.is_empty() && !other.about.is_empty(), "about"),
            (id.sub.0 == 0 && object.about.is_empty() && !other_object.about.is_empty(), "object's about"),
        ];
        let more: Vec<&str> = facts.into_iter().filter(|(more, _)| *more).map(|(_, fact)| fact).collect();
        if !more.is_empty() {
            ids.push(format!("{id}: {}", more.join(", ")));
        }
    }
    ids
}

/// A default to the last bit.
fn bits(entry: &Entry) -> Option<String> {
    entry.default.as_ref().map(|default| match default {
        Value::Real(real) => format!("{:X}", real.number().to_bits()),
        other => format!("{other:?}"),
    })
}

fn unit(unit: &Unit) -> impl PartialEq + Debug + use<> {
    let formula = unit.formula.as_ref().map(|formula| formula.text.clone());
    (unit.name.clone(), unit.symbol.clone(), unit.scale, unit.base.clone(), formula, unit.about.clone())
}

fn pdos(device: &Dictionary) -> Vec<String> {
    let said = |pdo: &Pdo| {
        let times = (pdo.inhibit_time, pdo.event_timer, pdo.sync_start);
        let map = (pdo.variable_mapping, pdo.capacity, &pdo.map);
        format!(
            "{:?} {} {:?} {} {:?} {times:?} {map:?} {:?}",
            pdo.direction, pdo.number, pdo.cob_id, pdo.valid, pdo.transmission, pdo.about
        )
    };
    device.pdos.iter().map(said).collect()
}
