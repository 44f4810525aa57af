//! Why a PDO cannot be under `pdos:`, and has its parameter objects written in full.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::model::{
    Access, CommunicationParameter, DataType, Dictionary, Direction, Entry, Fact, Index, Mapped, Object,
    ObjectKind, Pdo, PdoTarget, Role, SubIndex,
};

use super::context::Context;
use super::eds::{self, EdsDefaults};
use super::node::Spot;
use super::pdo_parameters;
use super::remarks::Remarks;

/// What `pdos:` has no word for.
pub(super) fn obstacle(device: &Dictionary, pdo: &Pdo) -> Option<String> {
    let object = |index: u16| device.objects.get(&Index(index));
    let Some(communication) = object(pdo.communication_index()) else {
        return Some("without communication parameters".to_owned());
    };
    let Some(mapping) = object(pdo.mapping_index()) else {
        return Some("without mapping parameters".to_owned());
    };
    let of_communication = |problem: String| format!("of the communication parameters, {problem}");
    let of_mapping = |problem: String| format!("of the mapping parameters, {problem}");
    of_object(communication)
        .or_else(|| of_communication_entries(communication))
        .map(of_communication)
        .or_else(|| of_object(mapping).or_else(|| of_mapped_entries(pdo, mapping)).map(of_mapping))
        .or_else(|| of_map(device, pdo))
}

fn of_object(object: &Object) -> Option<String> {
    match object.kind {
        ObjectKind::Record => None,
        ObjectKind::Var | ObjectKind::Array | ObjectKind::Domain => {
            Some("the object is no RECORD".to_owned())
        }
    }
}

fn of_communication_entries(object: &Object) -> Option<String> {
    let known = |entry: &Entry| CommunicationParameter::ALL.into_iter().find(|one| one.sub() == entry.sub.0);
    for kind in
        [CommunicationParameter::Count, CommunicationParameter::CobId, CommunicationParameter::Transmission]
    {
        if object.entry(SubIndex(kind.sub())).is_none() {
            return Some(format!("sub-index {} is missing", kind.sub()));
        }
    }
    let count = object.entries.first().and_then(|count| count.default.as_ref()?.integer());
    if count.is_some_and(|count| count != i128::from(object.highest().0)) {
        return Some("sub-index 0 is not the highest".to_owned());
    }
    object.entries.iter().find_map(|entry| match known(entry) {
        None => Some(format!("there is a sub-index {}", entry.sub)),
        Some(kind) => {
            let has_value = entry.default.is_some() || kind == CommunicationParameter::Reserved;
            of_entry(entry, kind.data_type(), has_value)
        }
    })
}

fn of_mapped_entries(pdo: &Pdo, object: &Object) -> Option<String> {
    let expected = |sub: u8| if sub == 0 { DataType::Unsigned8 } else { DataType::Unsigned32 };
    let subs = object.entries.iter().map(|entry| entry.sub.0);
    if !subs.eq(0..=pdo.capacity) {
        return Some("a sub-index is left out".to_owned());
    }
    if !pdo.variable_mapping && usize::from(pdo.capacity) != pdo.map.len() {
        return Some("they are fixed, and more than are in use".to_owned());
    }
    let mapped: Vec<&Entry> = object.entries.iter().skip(1).collect();
    let is_identified = mapped.iter().any(|entry| entry.identifier.is_some());
    if is_identified && pdo_parameters::identifier_pattern(pdo, &mapped).is_none() {
        return Some("the identifiers of the entries follow no pattern".to_owned());
    }
    let of_entries = |entry: &Entry| of_entry(entry, expected(entry.sub.0), entry.default.is_some());
    object.entries.iter().find_map(of_entries).or_else(|| {
        let map = pdo.map.iter().map(|mapped| i128::from(mapped.parameter()));
        let values = object.entries.iter().skip(1).map(|entry| entry.default.as_ref()?.integer());
        let count = object.entries.first().and_then(|entry| entry.default.as_ref()?.integer());
        let is_said = count.is_some_and(|count| usize::try_from(count) == Ok(pdo.map.len()))
            && map.map(Some).chain(std::iter::repeat(Some(0))).zip(values).all(|(said, value)| said == value);
        (!is_said).then(|| "not only the entries that are in use have values".to_owned())
    })
}

/// What `map:` cannot name, and what would have another length there.
fn of_map(device: &Dictionary, pdo: &Pdo) -> Option<String> {
    let length = |mapped: &Mapped| match mapped.target {
        PdoTarget::Dummy(data_type) => data_type.bits(),
        PdoTarget::Entry(id) => device.entry(id).map(|entry| entry.data_type.bits().unwrap_or(0)),
    };
    let is_other = |mapped: &&Mapped| length(mapped) != Some(mapped.bits.into());
    pdo.map.iter().find(is_other).map(|mapped| match mapped.target {
        PdoTarget::Dummy(data_type) => format!("it maps {} bits of {data_type}", mapped.bits),
        PdoTarget::Entry(id) if device.entry(id).is_none() => {
            format!("it maps {id}, which is not there")
        }
        PdoTarget::Entry(id) => format!("it maps {} bits of {id}, which has another length", mapped.bits),
    })
}

fn of_entry(entry: &Entry, data_type: DataType, has_value: bool) -> Option<String> {
    let sub = entry.sub;
    if entry.data_type != data_type || entry.named_type.is_some() || entry.unit.is_some() {
        Some(format!("sub-index {sub} has another type than {data_type}"))
    } else if !has_value {
        Some(format!("sub-index {sub} has no value"))
    } else if !matches!(entry.access, Access::Ro | Access::Rw | Access::Const) {
        Some(format!("sub-index {sub} is `{}`", entry.access.word()))
    } else if !eds::keys(entry, EdsDefaults::All).is_empty() {
        Some(format!("sub-index {sub} has flags, or another access in the EDS"))
    } else {
        None
    }
}

/// The PDOs with what no key under `pdos:` says: kept otherwise than most parameters are, or breaking a rule with a name or an
/// access that is said of several PDOs at once, where no single one can be allowed to.
pub(super) fn not_said(device: &Dictionary, remarks: &Remarks) -> BTreeSet<(Direction, u16)> {
    let candidates: Vec<&Pdo> = device.pdos.iter().filter(|pdo| obstacle(device, pdo).is_none()).collect();
    let usual = pdo_parameters::storage(device, &candidates);
    let is_kept_otherwise = |entry: &Entry| entry.access.is_writable() && entry.stored != usual;
    let is_other = |pdo: &&Pdo| {
        let indices = [pdo.communication_index(), pdo.mapping_index()].map(Index);
        let objects: Vec<&Object> = indices.iter().filter_map(|index| device.objects.get(index)).collect();
        let is_name = |spot: &Spot| {
            indices.contains(&spot.index())
                && matches!(spot, Spot::ObjectFact(_, Fact::Name) | Spot::EntryFact(_, Fact::Name))
        };
        objects.iter().flat_map(|object| &object.entries).any(is_kept_otherwise)
            || objects.iter().any(|object| can_only_change_in_part(object))
            || remarks.broken_with.iter().any(is_name)
    };
    candidates.into_iter().filter(is_other).map(|pdo| (pdo.direction, pdo.number)).collect()
}

/// Whether mapped entries can be written, and their number cannot.
fn can_only_change_in_part(object: &Object) -> bool {
    let mut entries = object.entries.iter().map(|entry| entry.access.is_writable());
    object.role() == Role::PdoMapping
        && entries.next() == Some(false)
        && entries.any(|is_writable| is_writable)
}

/// What is to be said above the first of the PDOs that are written in full for one reason, by communication parameter
/// object.
pub(super) fn remarks(context: &Context<'_>) -> BTreeMap<Index, String> {
    let mut by_reason: BTreeMap<(Direction, String), Vec<&Pdo>> = BTreeMap::new();
    if context.style.short {
        for pdo in &context.device.pdos {
            let tried = context.style.pdos_in_full.contains(&(pdo.direction, pdo.number));
            let other = || tried.then(|| "they have what no key says".to_owned());
            if let Some(reason) = obstacle(context.device, pdo).or_else(other) {
                by_reason.entry((pdo.direction, reason)).or_default().push(pdo);
            }
        }
    }
    let remark = |((direction, reason), pdos): ((Direction, String), Vec<&Pdo>)| {
        let first = pdos.first()?;
        let which = match pdos.as_slice() {
            [one] => format!("{} {}", direction.pdo(), one.number),
            [.., last] => {
                format!("{} {}s from {} to {}", pdos.len(), direction.pdo(), first.number, last.number)
            }
            [] => return None,
        };
        Some((Index(first.communication_index()), format!("{which} in full, not under `pdos:`: {reason}")))
    };
    by_reason.into_iter().filter_map(remark).collect()
}
