//! The parameter objects that a PDO has: communication (1400h, 1800h and following) and mapping (1600h, 1A00h and following).

use crate::ast::PdoDecl;
use crate::model::{
    Access, DataType, Entry, Fact, Index, Mapped, Object, ObjectKind, Origin, Pdo, Statement, Storage,
    SubIndex, Text, Value,
};
use crate::source::{Span, Spanned};

/// A parameter of a PDO.
struct Parameter {
    sub: u8,
    name: String,
    data_type: DataType,
    writable: bool,
    default: Option<Value>,
    /// Where the value stands.
    stated: Statement,
    about: &'static str,
}

impl Parameter {
    fn into_entry(self, span: Span) -> Entry {
        let access = if self.writable { Access::Rw } else { Access::Ro };
        Entry {
            default: self.default,
            stored: if self.writable { Storage::Communication } else { Storage::No },
            facts: [(Fact::Default, self.stated)].into_iter().collect(),
            about: english(self.about),
            ..Entry::new(SubIndex(self.sub), self.name, self.data_type, access, span)
        }
    }
}

fn object(index: u16, name: String, parameters: Vec<Parameter>, span: Span) -> Object {
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
        links: Vec::new(),
        about: Text::default(),
        entries: parameters.into_iter().map(|parameter| parameter.into_entry(span)).collect(),
        span,
    }
}

fn english(text: &str) -> Text {
    if text.is_empty() { Text::default() } else { Text::new([("en", text)]) }
}

/// A value that is written in the specification, or follows from the number of the PDO.
fn stated(written: Option<Span>, decl: &PdoDecl) -> Statement {
    match written {
        Some(span) => Statement::written(span, span.file),
        None => Statement::derived(decl.number.span),
    }
}

pub(super) fn communication_object(pdo: &Pdo, decl: &PdoDecl) -> Object {
    let title = pdo.direction.pdo();
    let number = |value: u16| Some(Value::Integer(i128::from(value)));
    let mut list = vec![
        Parameter {
            sub: 1,
            name: format!("COB-ID used by {title}"),
            data_type: DataType::Unsigned32,
            writable: true,
            default: pdo.cob_id.clone(),
            stated: stated(decl.cob_id.as_ref().map(|text| text.span), decl),
            about: "CAN identifier; bit 31: PDO not valid, bit 30: no remote frames (TPDO)",
        },
        Parameter {
            sub: 2,
            name: "transmission type".to_owned(),
            data_type: DataType::Unsigned8,
            writable: true,
            default: pdo.transmission.and_then(|transmission| number(transmission.into())),
            stated: stated(decl.transmission.map(|value| value.span), decl),
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
            stated: stated(decl.inhibit_time.map(|value| value.span), decl),
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
            stated: stated(decl.event_timer.map(|value| value.span), decl),
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
            stated: stated(decl.sync_start.map(|value| value.span), decl),
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
            stated: stated(None, decl),
            about: "",
        },
    );
    let name = format!("{title} {} communication parameter", pdo.number);
    let mut object = object(pdo.communication_index(), name, list, pdo.span);
    if let (Some(flag), Some(cob_id)) = (decl.no_rtr, object.entries.get_mut(1)) {
        cob_id.facts.state(Fact::RemoteFrames, stated(Some(flag.span), decl));
    }
    object
}

pub(super) fn mapping_object(pdo: &Pdo, decl: &PdoDecl, map: &[Spanned<Mapped>]) -> Object {
    let title = pdo.direction.pdo();
    let mapped = i128::try_from(map.len()).unwrap_or_default();
    let mut list = vec![Parameter {
        sub: 0,
        name: "number of mapped entries".to_owned(),
        data_type: DataType::Unsigned8,
        writable: pdo.variable_mapping,
        default: Some(Value::Integer(mapped)),
        stated: stated(Some(decl.span), decl),
        about: "0 disables the mapping while it is changed",
    }];
    list.extend((1..=pdo.capacity).map(|sub| {
        let mapped = map.get(usize::from(sub) - 1);
        Parameter {
            sub,
            name: format!("mapped entry {sub}"),
            data_type: DataType::Unsigned32,
            writable: pdo.variable_mapping,
            default: Some(Value::Integer(mapped.map_or(0, |mapped| mapped.value.parameter().into()))),
            stated: stated(mapped.map(|mapped| mapped.span), decl),
            about: "bits 31..16 index, 15..8 sub-index, 7..0 length in bits",
        }
    }));
    let name = format!("{title} {} mapping parameter", pdo.number);
    let mut object = object(pdo.mapping_index(), name, list, pdo.span);
    if let (Some(capacity), Some(count)) = (decl.capacity, object.entries.first_mut()) {
        count.facts.state(Fact::Capacity, stated(Some(capacity.span), decl));
    }
    object
}
