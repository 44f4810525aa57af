//! The parameter objects that a PDO has: communication (1400h, 1800h and following) and mapping (1600h, 1A00h and following).

use super::pdo_parameters::{Described, Kept, Said};
use crate::ast::PdoDecl;
use crate::model::{
    Access, CommunicationParameter, DataType, Entry, Fact, Index, Mapped, Object, ObjectKind, Origin, Pdo,
    Phrases, Statement, Storage, SubIndex, Text, Value,
};
use crate::source::{Span, Spanned};
use crate::wording::Language;

crate::texts! {
    /// What an entry of these objects is for, where its name does not say it.
    enum About in "pdo parameters" {
        CobId = "cob_id",
        Transmission = "transmission",
        InhibitTime = "inhibit_time",
        EventTimer = "event_timer",
        SyncStart = "sync_start",
        Mapped = "mapped",
        Mapping = "mapping",
    }
}

/// A parameter of a PDO.
struct Parameter {
    sub: u8,
    said: Said,
    data_type: DataType,
    /// Where nothing is said about it.
    access: Access,
    default: Option<Value>,
    /// Where the value is written.
    stated: Option<Statement>,
    about: Option<About>,
}

impl Parameter {
    fn into_entry(self, kept: Kept, languages: &[String], span: Span) -> Entry {
        let Said { name: (name, named), identifier, access, min, max, .. } = self.said;
        let right = access.map_or(self.access, |access| access.value);
        let storage = kept.said.map_or(kept.usual, |said| said.value);
        let facts = [
            (Fact::Name, named),
            (Fact::Identifier, identifier.as_ref().map(|identifier| identifier.span)),
            (Fact::Access, access.map(|access| access.span)),
            (Fact::LowLimit, min.map(|min| min.span)),
            (Fact::HighLimit, max.map(|max| max.span)),
            (Fact::Storage, kept.said.filter(|_| right.is_writable()).map(|said| said.span)),
        ];
        let facts = facts
            .into_iter()
            .filter_map(|(fact, span)| span.map(|span| (fact, Statement::written(span, span.file))))
            .chain(self.stated.map(|stated| (Fact::Default, stated)));
        Entry {
            identifier: identifier.map(|identifier| identifier.value),
            default: self.default,
            low: min.map(|min| min.value),
            high: max.map(|max| max.value),
            stored: if right.is_writable() { storage } else { Storage::No },
            facts: facts.collect(),
            about: self.about.map_or_else(Text::default, |about| {
                let texts = Language::ALL.iter().map(|language| (language.code(), about.text(*language)));
                Text::among(texts, languages)
            }),
            ..Entry::new(SubIndex(self.sub), name, self.data_type, right, span)
        }
    }
}

fn object(
    index: u16,
    said: Said,
    parameters: Vec<Parameter>,
    described: &Described<'_>,
    span: Span,
) -> Object {
    let (kept, languages) = (described.kept, described.languages);
    Object {
        index: Index(index),
        name: said.name.0,
        identifier: said.identifier.map(|identifier| identifier.value),
        kind: ObjectKind::Record,
        origin: Origin::Pdo,
        profile: None,
        departures: Vec::new(),
        category: None,
        since: None,
        links: Vec::new(),
        editor: None,
        warning: Text::default(),
        about: Text::default(),
        search: Phrases::default(),
        entries: parameters
            .into_iter()
            .map(|parameter| parameter.into_entry(kept, languages, span))
            .collect(),
        span,
    }
}

/// What a communication parameter is for; nothing where its name says it.
const fn about(parameter: CommunicationParameter) -> Option<About> {
    use CommunicationParameter as Kind;
    match parameter {
        Kind::Count | Kind::Reserved => None,
        Kind::CobId => Some(About::CobId),
        Kind::Transmission => Some(About::Transmission),
        Kind::InhibitTime => Some(About::InhibitTime),
        Kind::EventTimer => Some(About::EventTimer),
        Kind::SyncStart => Some(About::SyncStart),
    }
}

/// A value that is written in the specification, or follows from the number of the PDO.
fn stated(written: Option<Span>, decl: &PdoDecl) -> Statement {
    match written {
        Some(span) => Statement::written(span, span.file),
        None => Statement::derived(decl.number.span),
    }
}

pub(super) fn communication_object(pdo: &Pdo, decl: &PdoDecl, described: &Described<'_>) -> Object {
    use CommunicationParameter as Kind;
    let number = |value: Option<u16>| value.map(|value| Value::Integer(value.into()));
    let parameter = |kind: Kind| {
        let said = described.communication(kind, pdo);
        let (there, default, written) = match kind {
            Kind::Count => (true, None, None),
            Kind::CobId => (true, pdo.cob_id.clone(), decl.cob_id.as_ref().map(|text| text.span)),
            Kind::Transmission => {
                let value = number(pdo.transmission.map(u16::from));
                (true, value, decl.transmission.map(|value| value.span))
            }
            Kind::InhibitTime => {
                let value = number(pdo.inhibit_time);
                (value.is_some(), value, decl.inhibit_time.as_ref().map(|value| value.span))
            }
            Kind::Reserved => {
                let value = said.default.map(|value| Value::Integer(value.value));
                (described.has_reserved(), value, said.default.map(|value| value.span))
            }
            Kind::EventTimer => {
                let value = number(pdo.event_timer);
                (value.is_some(), value, decl.event_timer.as_ref().map(|value| value.span))
            }
            Kind::SyncStart => {
                let value = number(pdo.sync_start.map(u16::from));
                (value.is_some(), value, decl.sync_start.map(|value| value.span))
            }
        };
        there.then(|| Parameter {
            sub: kind.sub(),
            said,
            data_type: kind.data_type(),
            access: kind.usual_access(),
            stated: (default.is_some() || kind == Kind::Count).then(|| stated(written, decl)),
            default,
            about: about(kind),
        })
    };
    let mut list: Vec<Parameter> = Kind::ALL.into_iter().filter_map(parameter).collect();
    let highest = list.last().map(|parameter| u16::from(parameter.sub));
    if let Some(count) = list.first_mut() {
        count.default = number(highest);
    }
    let said = described.communication_object(pdo);
    let mut object = object(pdo.communication_index(), said, list, described, pdo.span);
    // What is said about a PDO is at this object where the objects are written in full.
    object.about = pdo.about.clone();
    if let (Some(flag), Some(cob_id)) = (decl.no_rtr, object.entries.get_mut(1)) {
        cob_id.facts.state(Fact::RemoteFrames, stated(Some(flag.span), decl));
    }
    object
}

pub(super) fn mapping_object(
    pdo: &Pdo,
    decl: &PdoDecl,
    described: &Described<'_>,
    map: &[Spanned<Mapped>],
) -> Object {
    let mapped = i128::try_from(map.len()).unwrap_or_default();
    let access = if pdo.variable_mapping { Access::Rw } else { Access::Ro };
    let mut list = vec![Parameter {
        sub: 0,
        said: described.mapped(pdo),
        data_type: DataType::Unsigned8,
        access,
        default: Some(Value::Integer(mapped)),
        stated: Some(stated(Some(decl.span), decl)),
        about: Some(About::Mapped),
    }];
    list.extend((1..=pdo.capacity).map(|sub| {
        let mapped = map.get(usize::from(sub) - 1);
        Parameter {
            sub,
            said: described.entry(sub, pdo),
            data_type: DataType::Unsigned32,
            access,
            default: Some(Value::Integer(mapped.map_or(0, |mapped| mapped.value.parameter().into()))),
            stated: Some(stated(mapped.map(|mapped| mapped.span), decl)),
            about: Some(About::Mapping),
        }
    }));
    let said = described.mapping_object(pdo);
    let mut object = object(pdo.mapping_index(), said, list, described, pdo.span);
    if let (Some(capacity), Some(count)) = (decl.capacity, object.entries.first_mut()) {
        count.facts.state(Fact::Capacity, stated(Some(capacity.span), decl));
    }
    object
}
