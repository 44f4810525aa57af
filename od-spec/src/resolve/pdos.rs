//! PDOs and the communication and mapping objects that follow from them.

use std::collections::BTreeMap;

use super::refs::{Broken, Names};
use super::types::words;
use super::values::{self, Expected};
use super::{to_u8, to_u16};
use crate::ast::{Name, PdoDecl};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{
    Access, DataType, DeviceInfo, Direction, EdsPolicy, Entry, EntryId, Facts, Index, Mapped, Object,
    ObjectKind, Origin, Pdo, PdoMapping, PdoTarget, Storage, SubIndex, Text, Value,
};
use crate::source::Span;

/// Whether an index belongs to the PDO parameters of CiA 301.
pub(super) const fn is_pdo_index(index: Index) -> bool {
    matches!(index.0, 0x1400..=0x1BFF)
}

/// Resolves the PDOs of a device and adds their parameter objects.
pub(super) fn resolve(
    list: &[PdoDecl],
    info: &DeviceInfo,
    objects: &mut BTreeMap<Index, Object>,
    broken: &mut Broken,
    diagnostics: &mut Diagnostics,
) -> Vec<Pdo> {
    let names = Names::new(objects.values());
    let mut pdos: Vec<Pdo> = Vec::new();
    for decl in list {
        match pdo(decl, info, &names, objects, broken, diagnostics) {
            Some(pdo) => pdos.push(pdo),
            None => parameters(decl).into_iter().for_each(|index| broken.add(index, None)),
        }
    }
    pdos.sort_by_key(|pdo| (pdo.direction, pdo.number));
    for pdo in &pdos {
        let (communication, mapping) = (communication_object(pdo), mapping_object(pdo));
        objects.insert(communication.index, communication);
        objects.insert(mapping.index, mapping);
    }
    pdos
}

/// The communication and mapping parameter of a PDO.
fn parameters(decl: &PdoDecl) -> [Index; 2] {
    let base = decl.direction.first_communication_index();
    [base, base + 0x200].map(|base| Index(base + (decl.number.value - 1) % 0x200))
}

fn pdo(
    decl: &PdoDecl,
    info: &DeviceInfo,
    names: &Names,
    objects: &BTreeMap<Index, Object>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<Pdo> {
    let valid = decl.valid.is_none_or(|valid| valid.value);
    let cob_id = cob_id(decl, valid, diagnostics)?;
    let map: Vec<Mapped> = decl
        .map
        .iter()
        .filter_map(|name| mapped(name, decl, info, names, objects, broken, diagnostics))
        .collect();
    let title = format!("{} {}", decl.direction.pdo(), decl.number.value);
    let bits: u32 = map.iter().map(|mapped| u32::from(mapped.bits)).sum();
    if bits > 64 {
        let parts = map.iter().map(|mapped| mapped.bits.to_string()).collect::<Vec<_>>().join(" + ");
        let diagnostic =
            Diagnostic::new(codes::PDO_TOO_LONG, decl.span, format!("{title} carries {bits} bits"))
                .label(format!("{parts} bits; a PDO holds 64"));
        diagnostics.push(match narrower(&map, objects) {
            Some(hint) => diagnostic.help(hint),
            None => diagnostic.help("move entries to another PDO"),
        });
        return None;
    }
    check_granularity(decl, info, &map, &title, diagnostics);
    let capacity = capacity(decl, info, &map, &title, diagnostics)?;
    if decl.direction == Direction::Receive && decl.no_rtr.is_some_and(|flag| flag.value) {
        let span = decl.no_rtr.map_or(decl.span, |flag| flag.span);
        diagnostics.push(
            Diagnostic::new(codes::BAD_PDO_KEY, span, "an RPDO is not asked for by remote frames")
                .help("remove `no-rtr:`; bit 30 of an RPDO's COB-ID is reserved"),
        );
    }
    let transmission = decl.transmission.map_or(255, |value| to_u8(value.value));
    let reserved = (241..=251).contains(&transmission)
        || (decl.direction == Direction::Receive && matches!(transmission, 252 | 253));
    if let (true, Some(value)) = (reserved, &decl.transmission) {
        diagnostics.push(
            Diagnostic::new(
                codes::BAD_TRANSMISSION,
                value.span,
                format!("transmission type {transmission} is reserved for {title}"),
            )
            .help(
                "0 to 240: synchronous; 254 and 255: event-driven; 252 and 253: on remote frames, TPDOs only",
            )
            .note("CiA 301 table 56"),
        );
    }
    Some(Pdo {
        direction: decl.direction,
        number: decl.number.value,
        cob_id,
        valid,
        transmission,
        inhibit_time: decl.inhibit_time.map(|value| to_u16(value.value)),
        event_timer: decl.event_timer.map(|value| to_u16(value.value)),
        sync_start: decl.sync_start.map(|value| to_u8(value.value)),
        variable_mapping: !decl.fixed,
        capacity,
        map,
        about: words(&decl.about),
        span: decl.number.span,
    })
}

/// What is mapped comes in multiples of the device's granularity.
fn check_granularity(
    decl: &PdoDecl,
    info: &DeviceInfo,
    map: &[Mapped],
    title: &str,
    diagnostics: &mut Diagnostics,
) {
    let granularity = info.granularity.max(1);
    if let Some(mapped) = map.iter().find(|mapped| mapped.bits % granularity != 0) {
        diagnostics.push(
            Diagnostic::new(
                codes::BAD_PDO_KEY,
                decl.span,
                format!("{title} maps {} bits, the device's granularity is {granularity}", mapped.bits),
            )
            .help("lower the device's `granularity:`, or map entries of its multiples"),
        );
    }
}

/// The COB-ID entry with its flag bits.
fn cob_id(decl: &PdoDecl, valid: bool, diagnostics: &mut Diagnostics) -> Option<Value> {
    let expected = Expected { data_type: DataType::Unsigned32, named: None, unit: None };
    let id = match &decl.cob_id {
        Some(text) => match values::read(&text.value, text.span, expected) {
            Ok(value) => {
                check_cob_id(&value, text, diagnostics)?;
                value
            }
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
    let no_rtr = decl.direction == Direction::Transmit && decl.no_rtr.is_some_and(|flag| flag.value);
    let flags = u32::from(!valid) << 31 | u32::from(no_rtr) << 30;
    Some(match id {
        Value::NodeId(offset) => Value::NodeId(offset | u64::from(flags)),
        Value::Integer(raw) => Value::Integer(raw | i128::from(flags)),
        other => other,
    })
}

/// CAN identifiers that CiA 301 table 35 keeps from configurable services; 002h to 07Fh since version 4.2.
pub(crate) const RESTRICTED: [(i128, i128); 8] = [
    (0x000, 0x000),
    (0x001, 0x07F),
    (0x101, 0x180),
    (0x581, 0x5FF),
    (0x601, 0x67F),
    (0x6E0, 0x6E0),
    (0x701, 0x77F),
    (0x780, 0x7FF),
];

fn check_cob_id(value: &Value, text: &Name, diagnostics: &mut Diagnostics) -> Option<()> {
    for node in 1..=127 {
        let id = value.integer_for(node)?;
        let of_node =
            if matches!(value, Value::NodeId(_)) { format!(" (node {node})") } else { String::new() };
        let problem = if id > 0x7FF {
            Some(format!("{id:X}h{of_node} is no 11-bit identifier"))
        } else if RESTRICTED.iter().any(|(low, high)| (*low..=*high).contains(&id)) {
            Some(format!("{id:03X}h{of_node} is kept for another service"))
        } else {
            None
        };
        if let Some(problem) = problem {
            diagnostics.push(
                Diagnostic::new(codes::BAD_COB_ID, text.span, problem)
                    .help("write a free identifier without flag bits; `valid:` and `no-rtr:` set these")
                    .note("CiA 301 table 35: restricted CAN identifiers"),
            );
            return None;
        }
    }
    Some(())
}

fn capacity(
    decl: &PdoDecl,
    info: &DeviceInfo,
    map: &[Mapped],
    title: &str,
    diagnostics: &mut Diagnostics,
) -> Option<u8> {
    let used = to_u8(i128::try_from(map.len()).unwrap_or(i128::MAX));
    if decl.fixed {
        if map.is_empty() {
            diagnostics.push(
                Diagnostic::new(
                    codes::BAD_PDO_KEY,
                    decl.span,
                    format!("{title} has a fixed mapping of nothing"),
                )
                .help("map something, or let the mapping be `variable`"),
            );
            return None;
        }
        return Some(used);
    }
    let capacity = match &decl.capacity {
        Some(capacity) => to_u8(capacity.value),
        None => 64 / info.granularity.max(1),
    };
    if capacity == 0 || used > capacity {
        let span = decl.capacity.map_or(decl.span, |capacity| capacity.span);
        diagnostics.push(
            Diagnostic::new(
                codes::BAD_PDO_KEY,
                span,
                format!("{title} maps {used} entries, but offers {capacity}"),
            )
            .help("raise `capacity:`, or lower the device's `granularity:`"),
        );
        return None;
    }
    Some(capacity)
}

fn mapped(
    name: &Name,
    decl: &PdoDecl,
    info: &DeviceInfo,
    names: &Names,
    objects: &BTreeMap<Index, Object>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<Mapped> {
    if let Some(dummy) = DataType::from_name(&name.value) {
        let problem = if decl.direction == Direction::Transmit {
            Some("a TPDO has no placeholders".to_owned())
        } else if !info.dummies.contains(&dummy) {
            Some(format!("the device takes no {dummy} placeholder"))
        } else {
            None
        };
        if let Some(problem) = problem {
            diagnostics.push(
                Diagnostic::new(codes::BAD_DUMMY, name.span, problem)
                    .help("list the type in the device's `dummies:`; placeholders stand in RPDOs only"),
            );
            return None;
        }
        return Some(Mapped { target: PdoTarget::Dummy(dummy), bits: to_u8(i128::from(dummy.bits()?)) });
    }
    let find = |id: EntryId| objects.get(&id.index).and_then(|object| object.entry(id.sub));
    let id = names.find(name, |id| find(id).is_some(), broken, diagnostics)?;
    let entry = find(id)?;
    if !entry.pdo.allows(decl.direction) {
        let problem = match entry.pdo {
            PdoMapping::None => format!("{id} cannot be mapped into PDOs"),
            _ => format!("{id} cannot be mapped into {}s", decl.direction.pdo()),
        };
        let members = objects.get(&id.index).filter(|object| object.is_structured() && id.sub.0 == 0);
        let member =
            members.and_then(|object| object.entries.iter().find(|one| one.pdo.allows(decl.direction)));
        let help = match member {
            None if members.is_some() => {
                format!(
                    "that is the number of its entries, none of which has `pdo: {}`",
                    decl.direction.word()
                )
            }
            Some(member) => format!(
                "that is the number of its entries; map one of them, such as `0x{:04X}.{}`",
                id.index.0, member.sub
            ),
            None => format!("give the entry `pdo: {}`, or map another one", decl.direction.word()),
        };
        diagnostics.push(
            Diagnostic::new(codes::NOT_MAPPABLE, name.span, problem)
                .label(entry.name.clone())
                .with(entry.span, format!("`pdo: {}`, `{}`", entry.pdo.word(), entry.access.word()))
                .help(help),
        );
        return None;
    }
    Some(Mapped { target: PdoTarget::Entry(id), bits: to_u8(i128::from(entry.data_type.bits()?)) })
}

/// Proposes the 16-bit views that would make a mapping fit.
fn narrower(map: &[Mapped], objects: &BTreeMap<Index, Object>) -> Option<String> {
    let total: u32 = map.iter().map(|mapped| u32::from(mapped.bits)).sum();
    map.iter().find_map(|mapped| {
        let PdoTarget::Entry(id) = mapped.target else { return None };
        let (object, view) = objects.values().find_map(|object| {
            let entry = object.entries.first()?;
            (entry.alias.as_ref()?.target == id).then_some((object, entry))
        })?;
        let bits = total - u32::from(mapped.bits) + u32::from(view.data_type.bits()?);
        Some(format!(
            "{} is {id} as {}: mapping it instead makes {bits}",
            object.index,
            view.data_type.name()
        ))
    })
}

struct Parameter {
    sub: u8,
    name: String,
    data_type: DataType,
    writable: bool,
    default: Value,
    about: &'static str,
}

fn object(index: u16, name: String, parameters: Vec<Parameter>, span: Span) -> Object {
    let entries = parameters.into_iter().map(|parameter| {
        let access = if parameter.writable { Access::Rw } else { Access::Ro };
        Entry {
            sub: SubIndex(parameter.sub),
            name: parameter.name,
            data_type: parameter.data_type,
            named_type: None,
            access,
            locked: false,
            pdo: PdoMapping::None,
            default: Some(parameter.default),
            low: None,
            high: None,
            unit: None,
            special: Vec::new(),
            stored: if parameter.writable { Storage::Communication } else { Storage::No },
            alias: None,
            category: None,
            since: None,
            writable_when: None,
            capacity: None,
            identifier: None,
            bit_errors: Vec::new(),
            eds: EdsPolicy { access, default: true, no_write: false, no_scan: false },
            facts: Facts::none(),
            about: english(parameter.about),
            span,
        }
    });
    Object {
        index: Index(index),
        name,
        identifier: None,
        kind: ObjectKind::Record,
        origin: Origin::Pdo,
        profile: None,
        departures: Vec::new(),
        category: None,
        since: None,
        about: Text::default(),
        entries: entries.collect(),
        span,
    }
}

fn english(text: &str) -> Text {
    if text.is_empty() {
        return Text::default();
    }
    Text::new([("en", text)])
}

fn communication_object(pdo: &Pdo) -> Object {
    let title = pdo.direction.pdo();
    let number = |value: u16| Value::Integer(i128::from(value));
    let mut list = vec![
        Parameter {
            sub: 1,
            name: format!("COB-ID used by {title}"),
            data_type: DataType::Unsigned32,
            writable: true,
            default: pdo.cob_id.clone(),
            about: "CAN identifier; bit 31: PDO not valid, bit 30: no remote frames (TPDO)",
        },
        Parameter {
            sub: 2,
            name: "transmission type".to_owned(),
            data_type: DataType::Unsigned8,
            writable: true,
            default: number(u16::from(pdo.transmission)),
            about: "0 to 240: synchronous; 254, 255: event-driven; 252, 253: on remote frame",
        },
    ];
    if let Some(time) = pdo.inhibit_time {
        list.push(Parameter {
            sub: 3,
            name: "inhibit time".to_owned(),
            data_type: DataType::Unsigned16,
            writable: true,
            default: number(time),
            about: "least time between two transmissions, in 100 µs",
        });
    }
    if let Some(time) = pdo.event_timer {
        list.push(Parameter {
            sub: 5,
            name: "event timer".to_owned(),
            data_type: DataType::Unsigned16,
            writable: true,
            default: number(time),
            about: "longest time between two transmissions or, for an RPDO, receptions, in ms; 0: off",
        });
    }
    if let Some(start) = pdo.sync_start {
        list.push(Parameter {
            sub: 6,
            name: "SYNC start value".to_owned(),
            data_type: DataType::Unsigned8,
            writable: true,
            default: number(u16::from(start)),
            about: "SYNC counter value of the first transmission; 0: any",
        });
    }
    let highest = list.last().map_or(0, |parameter| parameter.sub);
    list.insert(
        0,
        Parameter {
            sub: 0,
            name: "highest sub-index supported".to_owned(),
            data_type: DataType::Unsigned8,
            writable: false,
            default: number(u16::from(highest)),
            about: "",
        },
    );
    let name = format!("{title} {} communication parameter", pdo.number);
    object(pdo.communication_index(), name, list, pdo.span)
}

fn mapping_object(pdo: &Pdo) -> Object {
    let title = pdo.direction.pdo();
    let mapped = i128::try_from(pdo.map.len()).unwrap_or_default();
    let mut list = vec![Parameter {
        sub: 0,
        name: "number of mapped entries".to_owned(),
        data_type: DataType::Unsigned8,
        writable: pdo.variable_mapping,
        default: Value::Integer(mapped),
        about: "0 disables the mapping while it is changed",
    }];
    list.extend((1..=pdo.capacity).map(|sub| Parameter {
        sub,
        name: format!("mapped entry {sub}"),
        data_type: DataType::Unsigned32,
        writable: pdo.variable_mapping,
        default: Value::Integer(
            pdo.map.get(usize::from(sub) - 1).map_or(0, |mapped| i128::from(mapped.parameter())),
        ),
        about: "bits 31..16 index, 15..8 sub-index, 7..0 length in bits",
    }));
    object(pdo.mapping_index(), format!("{title} {} mapping parameter", pdo.number), list, pdo.span)
}
