//! What can be compared: an EDS states fewer facts than a specification.

use od_spec::ascii::transliterate;
use od_spec::model::{Access, Entry, Fact, PdoMapping, Value};

/// The facts that both sides can state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Scope {
    /// All of them: both sides are specifications.
    Everything,
    /// What an EDS states: one side is one.
    WhatAnEdsStates,
    /// What a DCF states, in which the node-ID is not a formula but a number: one side is one, and the other is not.
    WhatADcfStates,
}

impl Scope {
    /// Whether both sides are specifications.
    pub const fn is_everything(self) -> bool {
        match self {
            Self::Everything => true,
            Self::WhatAnEdsStates | Self::WhatADcfStates => false,
        }
    }

    /// Whether both sides can state the fact.
    pub(super) const fn states(self, fact: Fact) -> bool {
        self.is_everything() || fact.is_stated_by_eds()
    }

    /// A name; an EDS has it in ASCII.
    pub(super) fn name(self, name: &str) -> String {
        if self.is_everything() { name.to_owned() } else { transliterate(name) }
    }

    /// Access over the bus, and whether a lock guards it. An EDS says of a locked entry that it cannot be written.
    pub(super) const fn access(self, entry: &Entry) -> (Access, bool) {
        if self.is_everything() { (entry.access, entry.locked) } else { (entry.eds.access, false) }
    }

    /// The PDOs into which an entry may be mapped. In an EDS the access states the direction.
    pub(super) fn mapping(self, entry: &Entry) -> PdoMapping {
        if self.is_everything() || entry.pdo == PdoMapping::None {
            return entry.pdo;
        }
        match entry.eds.access {
            Access::Rww | Access::Wo => PdoMapping::Receive,
            Access::Rwr | Access::Ro | Access::Const => PdoMapping::Transmit,
            Access::Rw => PdoMapping::Both,
        }
    }

    /// Smallest and largest value. An EDS has one range, which takes the special values in; the ends of the data type are
    /// not limits, because some tools write them and others do not.
    pub(super) fn limits(self, entry: &Entry) -> (Option<Value>, Option<Value>) {
        if self.is_everything() || entry.data_type.range().is_none() {
            return entry.limits();
        }
        let ((low, high), ends) = (entry.hull(), entry.data_type.range());
        (
            low.filter(|low| ends.is_none_or(|(lowest, _)| *low > lowest)).map(Value::Integer),
            high.filter(|high| ends.is_none_or(|(_, highest)| *high < highest)).map(Value::Integer),
        )
    }

    /// The defaults of an entry on both sides, where both can say whether it has one.
    pub(super) fn defaults<'a>(
        self,
        old: &'a Entry,
        new: &'a Entry,
    ) -> Option<(Option<&'a Value>, Option<&'a Value>)> {
        let (before, after) = (old.default.as_ref(), new.default.as_ref());
        if self.is_everything() {
            return (before != after).then_some((before, after));
        }
        // No text at all is no default in an EDS.
        let stated = |value: &&Value| !matches!(value, Value::Text(text) if text.is_empty());
        let (before, after) = (before.filter(stated), after.filter(stated));
        let is_withheld = match (before, after) {
            (Some(_), None) => !old.eds.default,
            (None, Some(_)) => !new.eds.default,
            (Some(_), Some(_)) | (None, None) => false,
        };
        let same = before == after || (self == Self::WhatADcfStates && are_of_one_node(before, after));
        (!is_withheld && !same).then_some((before, after))
    }
}

/// Whether one value is the other's formula for some node.
fn are_of_one_node(one: Option<&Value>, other: Option<&Value>) -> bool {
    match (one, other) {
        (Some(Value::NodeId(offset)), Some(Value::Integer(raw)))
        | (Some(Value::Integer(raw)), Some(Value::NodeId(offset))) => {
            (1..=127).contains(&(raw - i128::from(*offset)))
        }
        _ => false,
    }
}
