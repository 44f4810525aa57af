//! A PDO as its parameter objects say it: what the rules about PDOs read.

use crate::check::subject::Subject;
use crate::check::subject::entry_id;
use crate::diag::{Code, Diagnostic};
use crate::model::{DataType, Entry, EntryId, Fact, Index, Mapped, Pdo, PdoTarget, Value};
use crate::order::Arrange as _;
use crate::source::Span;

/// Bit of a COB-ID: the PDO does not exist (CiA 301, object 1400h).
pub(in crate::check) const NOT_VALID: i128 = 1 << 31;
/// Bit of a TPDO's COB-ID: no remote frames; reserved in an RPDO's.
pub(in crate::check) const NO_REMOTE_FRAMES: i128 = 1 << 30;

/// As the number of mapped entries: a multiplexed PDO, whose messages name the entry that they were read from.
pub(in crate::check) const SOURCE_ADDRESS: i128 = 254;
/// As the number of mapped entries: a multiplexed PDO, whose messages name the entry that they are written to.
pub(in crate::check) const DESTINATION_ADDRESS: i128 = 255;

/// Whether a number of mapped entries is not a count, but makes the PDO a multiplexed one (CiA 301, 11.4).
pub(in crate::check) const fn is_multiplexed(count: i128) -> bool {
    matches!(count, SOURCE_ADDRESS | DESTINATION_ADDRESS)
}

/// A parameter of a PDO with its value.
pub(in crate::check) struct Parameter<'a> {
    /// Which one.
    pub id: EntryId,
    /// The entry.
    pub entry: &'a Entry,
    /// Its value.
    pub value: &'a Value,
    /// Where the value is written.
    pub place: Span,
    /// The node-ID of a configured node.
    node: Option<u8>,
}

impl Parameter<'_> {
    /// A finding about its value.
    pub(in crate::check) fn finding(&self, code: &'static Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(code, self.place, message).about((self.id, Fact::Default))
    }

    /// The raw value. In a specification only a COB-ID can depend on the node-ID.
    pub(in crate::check) fn raw(&self) -> i128 {
        let raw = match self.node {
            Some(node) => self.value.integer_for(node),
            None => self.value.integer(),
        };
        raw.unwrap_or_default()
    }
}

/// `RPDO 1`.
pub(in crate::check) fn title(pdo: &Pdo) -> String {
    format!("{} {}", pdo.direction.pdo(), pdo.number)
}

impl<'a> Subject<'a> {
    /// A parameter with its value.
    pub(in crate::check) fn parameter(&self, index: u16, sub: u8) -> Option<Parameter<'a>> {
        let id = entry_id(index, sub);
        let entry = self.device.entry(id)?;
        let place = self.place(entry, Fact::Default);
        Some(Parameter { id, entry, value: entry.default.as_ref()?, place, node: self.node })
    }

    /// A communication parameter.
    pub(in crate::check) fn communication(&self, pdo: &Pdo, sub: u8) -> Option<Parameter<'a>> {
        self.parameter(pdo.communication_index(), sub)
    }

    /// The number of mapped entries.
    pub(in crate::check) fn mapping_count(&self, pdo: &Pdo) -> Option<Parameter<'a>> {
        self.parameter(pdo.mapping_index(), 0)
    }

    /// How many entries the PDO can map.
    pub(in crate::check) fn mapping_capacity(&self, pdo: &Pdo) -> i128 {
        let object = self.device.objects.get(&Index(pdo.mapping_index()));
        object.map_or(0, |object| object.highest().0.into())
    }

    /// All mapping parameters after the count that have a value, used or not.
    pub(in crate::check) fn mapping(&self, pdo: &Pdo) -> impl Iterator<Item = Parameter<'a>> {
        let (subject, index) = (*self, pdo.mapping_index());
        let object = self.device.objects.get(&Index(index));
        let subs = object.into_iter().flat_map(|object| object.counted().map(|entry| entry.sub.0));
        subs.filter_map(move |sub| subject.parameter(index, sub))
    }

    /// The mapping parameters that count.
    pub(in crate::check) fn mapped(&self, pdo: &Pdo) -> impl Iterator<Item = Parameter<'a>> {
        let count = self.mapping_count(pdo).map(|count| count.raw()).filter(|count| !is_multiplexed(*count));
        self.mapping(pdo)
            .filter(move |parameter| count.is_some_and(|count| i128::from(parameter.id.sub.0) <= count))
    }

    /// Where a mapping as a whole is reported: at a setting of it, or else where its count is.
    pub(in crate::check) fn mapping_place(&self, pdo: &Pdo) -> Span {
        let mut parameters = self.mapping(pdo).chain(self.mapping_count(pdo)).collect::<Vec<_>>();
        parameters.arrange_by_key(|parameter| parameter.id);
        let set = parameters.iter().rfind(|parameter| parameter.entry.is_set());
        set.or(parameters.first()).map_or(pdo.span, |parameter| parameter.place)
    }
}

/// What a mapping parameter refers to; `None` for 0, an empty one, and for what is not a mapping parameter.
pub(in crate::check) fn target(raw: i128) -> Option<Mapped> {
    Mapped::from_parameter(u32::try_from(raw).ok().filter(|raw| *raw != 0)?)
}

/// The data type of a placeholder.
pub(in crate::check) const fn placeholder(mapped: &Mapped) -> Option<DataType> {
    match mapped.target {
        PdoTarget::Dummy(data_type) => Some(data_type),
        PdoTarget::Entry(_) => None,
    }
}
