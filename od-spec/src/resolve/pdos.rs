//! PDOs as a specification describes them, and their parameter objects.

use std::collections::BTreeMap;

use super::entries::{is_identifier, no_identifier};
use super::numbers::to_u8;
use super::pdo_objects::{communication_object, mapping_object};
use super::pdo_parameters::{Described, check_limits};
use super::pdo_times::{self, Step};
use super::refs::{Broken, Names};
use super::types::with_gap;
use super::values::{self, Expected};
use crate::ast::{Name, PdoDecl, PdosDecl};
use crate::check::codes as rule_codes;
use crate::decode::lexical::{self, NumberedRun};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::model::{
    DataType, DeviceInfo, Direction, EntryId, Fact, Index, Mapped, Object, Pdo, PdoTarget, SubIndex, Value,
    usual_pdo_storage,
};
use crate::order::Arrange as _;
use crate::source::{Span, Spanned};

/// Resolves the PDOs of a device and adds their parameter objects. A PDO whose parameter objects are written in full follows from
/// them; `written` says where an object is.
pub(super) fn resolve(
    decl: &PdosDecl,
    info: &DeviceInfo,
    languages: &[String],
    written: impl Fn(Index) -> Option<Span>,
    objects: &mut BTreeMap<Index, Object>,
    broken: &mut Broken,
    diagnostics: &mut Diagnostics,
) -> Vec<Pdo> {
    let mut pdos: Vec<Pdo> = Vec::new();
    let mut parameters: Vec<Object> = Vec::new();
    let names = Names::new(objects.values());
    let usual_storage = usual_pdo_storage(objects);
    let of_some = decl.list.iter().filter_map(|one| one.parameters.as_ref());
    for described in [&decl.receive, &decl.transmit].into_iter().flatten().chain(of_some) {
        check_limits(described, diagnostics);
    }
    for one in &decl.list {
        let in_full = parameter_indices(one).into_iter().filter_map(|index| Some((index, written(index)?)));
        if let Some((index, object)) = in_full.min() {
            diagnostics.push(stands_twice(one, index, object));
            continue;
        }
        let map = mapped(one, &names, objects, broken, diagnostics);
        let described = Described::new(decl, one, usual_storage, languages);
        let made =
            pdo(one, info, &map, diagnostics).filter(|pdo| is_of_one_kind(pdo, &described, diagnostics));
        match made {
            Some(pdo) => {
                let made = [
                    communication_object(&pdo, one, &described),
                    mapping_object(&pdo, one, &described, &map),
                ];
                let own = [described.communication_object(&pdo), described.mapping_object(&pdo)];
                let of_entries = made.iter().flat_map(|object| &object.entries).filter_map(|entry| {
                    Some(Spanned::new(entry.identifier.clone()?, entry.place(Fact::Identifier)))
                });
                check_identifiers(
                    own.into_iter().filter_map(|said| said.identifier).chain(of_entries),
                    diagnostics,
                );
                parameters.extend(made);
                pdos.push(pdo);
            }
            None => parameter_indices(one).into_iter().for_each(|index| broken.add(index, [])),
        }
    }
    pdos.extend(objects.values().filter_map(|object| Pdo::of_objects(object, objects)));
    pdos.arrange_by_key(|pdo| (pdo.direction, pdo.number));
    objects.extend(parameters.into_iter().map(|object| (object.index, object)));
    pdos
}

/// Reports identifiers of parameter objects and their entries that are not valid, each pattern once.
fn check_identifiers(identifiers: impl Iterator<Item = Name>, diagnostics: &mut Diagnostics) {
    for identifier in identifiers.filter(|identifier| !is_identifier(&identifier.value)) {
        if diagnostics.is_new(codes::BAD_NOTATION, identifier.span) {
            diagnostics.push(no_identifier(&identifier));
        }
    }
}

/// A PDO with a parameter object that is also written in full.
fn stands_twice(decl: &PdoDecl, index: Index, object: Span) -> Diagnostic {
    let pdo = format!("{} {}", decl.direction.pdo(), decl.number.value);
    Diagnostic::new(codes::PDO_DESCRIBED_TWICE, object, format!("{index} is a parameter object of {pdo}"))
        .about(index)
        .label("written in full")
        .with(decl.number.span, "the PDO, of which its parameter objects are made")
        .help(format!("remove the object, or {pdo} from `pdos:`; a PDO has one description"))
}

/// Whether the mapping can be changed is said by `mapping:`; the access of the number of mapped entries does not say otherwise.
fn is_of_one_kind(pdo: &Pdo, described: &Described<'_>, diagnostics: &mut Diagnostics) -> bool {
    let access = described.mapped(pdo).access;
    let Some(access) = access.filter(|access| access.value.is_writable() != pdo.variable_mapping) else {
        return true;
    };
    let (kind, otherwise) = if pdo.variable_mapping { ("variable", "fixed") } else { ("fixed", "variable") };
    let message = format!(
        "the number of mapped entries of {} {} is `{}`, but its mapping is {kind}",
        pdo.direction.pdo(),
        pdo.number,
        access.value.word()
    );
    diagnostics.push(
        Diagnostic::new(codes::CONFLICTING_KEYS, access.span, message)
            .with(pdo.span, "the PDO")
            .help(format!("correct the access, or write `mapping: {otherwise}` at the PDO")),
    );
    false
}

/// The communication and mapping parameter of a PDO.
fn parameter_indices(decl: &PdoDecl) -> [Index; 2] {
    let base = decl.direction.first_communication_index();
    [base, base + 0x200].map(|base| Index(base + (decl.number.value - 1) % 0x200))
}

fn pdo(
    decl: &PdoDecl,
    info: &DeviceInfo,
    map: &[Spanned<Mapped>],
    diagnostics: &mut Diagnostics,
) -> Option<Pdo> {
    let valid = decl.valid.is_none_or(|valid| valid.value);
    let used = to_u8(i128::try_from(map.len()).unwrap_or(i128::MAX));
    if let Some(capacity) = decl.capacity.as_ref().filter(|_| decl.is_fixed()) {
        diagnostics.push(
            Diagnostic::new(
                codes::CONFLICTING_KEYS,
                capacity.span,
                "`capacity` has no effect here: the mapping is fixed",
            )
            .help("remove it; a fixed mapping has the entries of `map:` and no others"),
        );
    }
    let capacity = match &decl.capacity {
        _ if decl.is_fixed() => used,
        Some(capacity) => to_u8(capacity.value),
        None => 64 / info.granularity.max(1),
    };
    Some(Pdo {
        direction: decl.direction,
        number: decl.number.value,
        cob_id: Some(cob_id(decl, valid, diagnostics)?),
        valid,
        transmission: Some(decl.transmission.map_or(255, |value| to_u8(value.value))),
        inhibit_time: pdo_times::read(decl.inhibit_time.as_ref(), Step::HundredMicroseconds, diagnostics),
        event_timer: pdo_times::read(decl.event_timer.as_ref(), Step::Millisecond, diagnostics),
        sync_start: decl.sync_start.map(|value| to_u8(value.value)),
        variable_mapping: !decl.is_fixed(),
        capacity,
        map: map.iter().map(|mapped| mapped.value.clone()).collect(),
        about: with_gap(&decl.about, &decl.gap),
        span: decl.number.span,
    })
}

/// Bits 31 and 30 of a COB-ID entry, which keys of their own set.
const FLAGS: i128 = 0b11 << 30;

/// The COB-ID entry with its flag bits.
fn cob_id(decl: &PdoDecl, valid: bool, diagnostics: &mut Diagnostics) -> Option<Value> {
    let expected = Expected { data_type: DataType::Unsigned32, named: None, unit: None, special: &[] };
    let id = match &decl.cob_id {
        Some(text) => match values::read(&text.value, text.span, expected, &mut diagnostics.suggestions) {
            Ok(value) => without_flags(value, text, diagnostics)?,
            Err(diagnostic) => {
                diagnostics.push(*diagnostic);
                return None;
            }
        },
        None if decl.number.value <= 4 => {
            let base = match decl.direction {
                Direction::Receive => 0x200,
                Direction::Transmit => 0x180,
            };
            Value::NodeId(base + 0x100 * u64::from(decl.number.value - 1))
        }
        None if !valid => Value::Integer(0),
        None => {
            diagnostics.push(
                Diagnostic::new(
                    codes::MISSING_KEY,
                    decl.number.span,
                    format!("{} {} needs the key `cob-id`", decl.direction.pdo(), decl.number.value),
                )
                .help("the predefined connection set has COB-IDs for PDOs 1 to 4 only: add `cob-id:`, or `valid: no`"),
            );
            return None;
        }
    };
    let flags = u32::from(!valid) << 31 | u32::from(decl.no_rtr.is_some_and(|flag| flag.value)) << 30;
    Some(match id {
        Value::NodeId(offset) => Value::NodeId(offset | u64::from(flags)),
        Value::Integer(raw) => Value::Integer(raw | i128::from(flags)),
        other => other,
    })
}

/// Refuses an identifier with flag bits: `cob-id:` is the identifier alone.
fn without_flags(value: Value, text: &Name, diagnostics: &mut Diagnostics) -> Option<Value> {
    if value.integer_for(1).is_none_or(|raw| raw & FLAGS == 0) {
        return Some(value);
    }
    diagnostics.push(
        Diagnostic::new(
            rule_codes::BAD_COB_ID,
            text.span,
            "flag bits 31 and 30 are not part of the identifier",
        )
        .help("write a free identifier without flag bits; `valid:` and `no-rtr:` set these"),
    );
    None
}

/// What the elements of `map:` name, each with its length; whether it can be mapped is for the rules to say.
fn mapped(
    decl: &PdoDecl,
    names: &Names<'_>,
    objects: &BTreeMap<Index, Object>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Vec<Spanned<Mapped>> {
    let bits = |data_type: DataType| data_type.bits().map_or(0, |bits| to_u8(i128::from(bits)));
    let find = |id: EntryId| objects.get(&id.index).and_then(|object| object.entry(id.sub));
    let mut all = Vec::with_capacity(decl.map.len());
    for name in &decl.map {
        if let Some(dummy) = DataType::from_name(&name.value) {
            let mapped = Mapped { target: PdoTarget::Dummy(dummy), bits: bits(dummy) };
            all.push(Spanned::new(mapped, name.span));
            continue;
        }
        let ids = match lexical::run_by_index(&name.value) {
            Some(run) => in_run(run, name.span, objects, broken, diagnostics),
            None => names.find(name, |id| find(id).is_some(), broken, diagnostics).into_iter().collect(),
        };
        for (id, entry) in ids.into_iter().filter_map(|id| Some((id, find(id)?))) {
            let mapped = Mapped { target: PdoTarget::Entry(id), bits: bits(entry.data_type) };
            all.push(Spanned::new(mapped, name.span));
        }
    }
    all
}

/// The entries of a run; without those that the object does not have.
fn in_run(
    run: NumberedRun,
    place: Span,
    objects: &BTreeMap<Index, Object>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Vec<EntryId> {
    let index = run.index;
    let Some(object) = objects.get(&index) else {
        if !broken.has(index) {
            diagnostics.push(broken.missing(EntryId { index, sub: run.subs.first }, false, place));
        }
        return Vec::new();
    };
    let (there, missing): (Vec<SubIndex>, Vec<SubIndex>) =
        run.subs.subs().partition(|sub| object.entry(*sub).is_some());
    if !missing.is_empty() && !broken.has(index) {
        let several = if missing.len() == 1 { "sub-index" } else { "sub-indices" };
        let missing: Vec<String> = missing.iter().map(SubIndex::to_string).collect();
        let message = format!("{index} has no {several} {}", shorten(&missing.join(", ")));
        diagnostics.push(
            Diagnostic::new(codes::UNKNOWN_ENTRY, place, message)
                .about(index)
                .with(object.span, "the object")
                .help("correct the run, or name the entries one by one"),
        );
    }
    there.into_iter().map(|sub| EntryId { index, sub }).collect()
}
