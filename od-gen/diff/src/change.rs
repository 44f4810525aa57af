//! A change: one fact before and after, and what follows from it.

use std::borrow::Cow;

use od_spec::model::{EntryId, Fact, Index, SubIndex};
use od_spec::order::Arrange as _;

/// What a change does to those who use the old dictionary; by ascending weight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Only documents and comments read differently.
    Documents,
    /// Something can be done that could not be done before; what worked still does.
    Addition,
    /// A PLC project still loads, but the device does something else.
    Behaviour,
    /// Firmware that uses the generated code does not compile any more.
    Firmware,
    /// What devices in the field have stored is lost with the new firmware.
    Stored,
    /// A PLC project reads, writes or maps something that is gone, refused, or means something else now.
    Plc,
}

impl Class {
    /// All classes, the lightest first.
    pub const ALL: [Self; 6] =
        [Self::Documents, Self::Addition, Self::Behaviour, Self::Firmware, Self::Stored, Self::Plc];

    /// The word for programs and the command line.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Documents => "documents",
            Self::Addition => "addition",
            Self::Behaviour => "behaviour",
            Self::Firmware => "firmware",
            Self::Stored => "stored",
            Self::Plc => "plc",
        }
    }

    /// What a person reads.
    pub const fn phrase(self) -> &'static str {
        match self {
            Self::Documents => "documents only",
            Self::Addition => "compatible addition",
            Self::Behaviour => "changes behaviour",
            Self::Firmware => "BREAKS firmware code",
            Self::Stored => "BREAKS stored parameters",
            Self::Plc => "BREAKS PLC projects",
        }
    }
}

/// A consequence of a change.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Consequence {
    /// What kind.
    pub class: Class,
    /// Why, in a few words.
    pub because: Cow<'static, str>,
}

impl Consequence {
    pub(super) const fn new(class: Class, because: &'static str) -> Self {
        Self { class, because: Cow::Borrowed(because) }
    }
}

/// What a change is about. Their order is that of a report.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// What all devices share: title, maker, manual.
    System,
    /// A device as a whole.
    Device,
    /// An object.
    Object(Index),
    /// An entry, or a run of entries that change in the same way.
    Entries {
        /// The object.
        index: Index,
        /// The first entry.
        first: SubIndex,
        /// The last entry.
        last: SubIndex,
    },
    /// A physical unit, by name.
    Unit(String),
    /// An enum or bit field, by name.
    Type(String),
    /// An error code.
    Error(u16),
    /// A state machine, by name.
    Machine(String),
    /// A condition between entries, by name.
    Constraint(String),
}

impl Place {
    /// One entry.
    pub(super) const fn entry(id: EntryId) -> Self {
        Self::Entries { index: id.index, first: id.sub, last: id.sub }
    }

    /// The object that it is, or is part of.
    pub const fn index(&self) -> Option<Index> {
        match self {
            Self::Object(index) | Self::Entries { index, .. } => Some(*index),
            Self::System
            | Self::Device
            | Self::Unit(_)
            | Self::Type(_)
            | Self::Error(_)
            | Self::Machine(_)
            | Self::Constraint(_) => None,
        }
    }

    /// By which places are ordered: objects and their entries are together.
    fn order(&self) -> (u8, u16, u16, u16, &str) {
        match self {
            Self::System => (0, 0, 0, 0, ""),
            Self::Device => (1, 0, 0, 0, ""),
            Self::Object(index) => (2, index.0, 0, 0, ""),
            Self::Entries { index, first, last } => (2, index.0, 1 + u16::from(first.0), last.0.into(), ""),
            Self::Unit(name) => (3, 0, 0, 0, name),
            Self::Type(name) => (4, 0, 0, 0, name),
            Self::Error(code) => (5, *code, 0, 0, ""),
            Self::Machine(name) => (6, 0, 0, 0, name),
            Self::Constraint(name) => (7, 0, 0, 0, name),
        }
    }
}

/// Whether something came, went or is another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// It was not there before.
    Added,
    /// It is not there any more.
    Removed,
    /// It is another.
    Changed,
}

impl Kind {
    /// `+`, `-`, `~`.
    pub const fn sign(self) -> char {
        match self {
            Self::Added => '+',
            Self::Removed => '-',
            Self::Changed => '~',
        }
    }

    /// The word for programs.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Added => "added",
            Self::Removed => "removed",
            Self::Changed => "changed",
        }
    }
}

/// A fact before and after.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Change {
    /// What it is about.
    pub place: Place,
    /// What that is called, where the place alone does not say it.
    pub name: String,
    /// A part of it, such as `bit 5` of a bit field.
    pub part: Option<String>,
    /// The fact.
    pub fact: Fact,
    /// The value before; `None` where nothing was said.
    pub before: Option<String>,
    /// The value after; `None` where nothing is said any more.
    pub after: Option<String>,
    /// What follows, the heaviest first; at least one.
    pub consequences: Vec<Consequence>,
}

impl Change {
    /// A change without consequences yet; `None` where there is none.
    pub(super) fn of(
        place: Place,
        fact: Fact,
        before: Option<String>,
        after: Option<String>,
    ) -> Option<Self> {
        (before != after).then(|| Self {
            place,
            name: String::new(),
            part: None,
            fact,
            before,
            after,
            consequences: Vec::new(),
        })
    }

    /// A change of a text that is always there.
    pub(super) fn text(place: Place, fact: Fact, before: &str, after: &str) -> Option<Self> {
        Self::of(place, fact, Some(before.to_owned()), Some(after.to_owned()))
    }

    /// A change whose values are too long to be said.
    pub(super) const fn unsaid(place: Place, fact: Fact) -> Self {
        Self {
            place,
            name: String::new(),
            part: None,
            fact,
            before: None,
            after: None,
            consequences: Vec::new(),
        }
    }

    /// Something came.
    pub(super) fn added(place: Place, what: impl Into<String>) -> Self {
        let consequences = Vec::new();
        let after = Some(what.into());
        Self {
            place,
            name: String::new(),
            part: None,
            fact: Fact::Presence,
            before: None,
            after,
            consequences,
        }
    }

    /// Something went.
    pub(super) fn removed(place: Place, what: impl Into<String>) -> Self {
        let Self { place, name, part, fact, before, after, consequences } = Self::added(place, what);
        Self { place, name, part, fact, before: after, after: before, consequences }
    }

    pub(super) fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    pub(super) fn part(self, part: impl Into<String>) -> Self {
        Self { part: Some(part.into()), ..self }
    }

    /// With these consequences as well.
    pub(super) fn with(mut self, consequences: impl IntoIterator<Item = Consequence>) -> Self {
        self.follows(consequences);
        self
    }

    /// Adds consequences, each once.
    pub(super) fn follows(&mut self, consequences: impl IntoIterator<Item = Consequence>) {
        self.consequences.extend(consequences);
        self.consequences.arrange_by(|one, other| other.cmp(one));
        self.consequences.dedup();
    }

    /// With one consequence.
    pub(super) fn so(self, class: Class, because: &'static str) -> Self {
        self.with([Consequence::new(class, because)])
    }

    /// Whether something came, went or is another.
    pub const fn kind(&self) -> Kind {
        match (self.fact, &self.before, &self.after) {
            (Fact::Presence | Fact::Special, None, Some(_)) => Kind::Added,
            (Fact::Presence | Fact::Special, Some(_), None) => Kind::Removed,
            _ => Kind::Changed,
        }
    }

    /// The heaviest consequence.
    pub fn class(&self) -> Class {
        self.consequences.iter().map(|consequence| consequence.class).max().unwrap_or(Class::Documents)
    }

    /// The classes of its consequences, the heaviest first, each once.
    pub fn classes(&self) -> Vec<Class> {
        let mut classes: Vec<Class> = self.consequences.iter().map(|one| one.class).collect();
        classes.dedup();
        classes
    }

    fn order(&self) -> (impl Ord + '_, impl Ord + '_) {
        ((self.place.order(), self.fact != Fact::Presence), (self.fact, natural(self.part.as_deref())))
    }
}

/// A part with the number in it as a number, so that bit 10 follows bit 9.
fn natural(part: Option<&str>) -> (u64, &str) {
    let part = part.unwrap_or_default();
    let digits = part.trim_start_matches(|c: char| !c.is_ascii_digit());
    let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
    (digits[..end].parse().unwrap_or_default(), part)
}

/// Brings changes into the order of a report, says what is said twice once, and lets runs of entries that change in the
/// same way be one change.
pub(super) fn tidy(mut changes: Vec<Change>) -> Vec<Change> {
    for change in &mut changes {
        if change.consequences.is_empty() {
            change.follows([Consequence::new(Class::Documents, "nothing that a program uses")]);
        }
        // What documents say is not news next to a heavier consequence.
        if change.class() != Class::Documents {
            change.consequences.retain(|consequence| consequence.class != Class::Documents);
        }
    }
    changes.arrange_by(|one, other| one.order().cmp(&other.order()));
    changes.dedup();
    join(changes)
}

/// Joins changes of entries that follow each other.
fn join(changes: Vec<Change>) -> Vec<Change> {
    let mut joined: Vec<Change> = Vec::new();
    for change in changes {
        let next = joined.iter_mut().rev().take_while(|one| one.place.index() == change.place.index());
        let mut run = next.filter(|one| one.is_continued_by(&change));
        let Some(before) = run.next() else {
            joined.push(change);
            continue;
        };
        if let (Place::Entries { last, .. }, Place::Entries { last: end, .. }) =
            (&mut before.place, &change.place)
        {
            *last = *end;
        }
    }
    joined
}

impl Change {
    /// Whether another change says the same about the next sub-index.
    fn is_continued_by(&self, next: &Change) -> bool {
        let follows = match (&self.place, &next.place) {
            (Place::Entries { index, last, .. }, Place::Entries { index: other, first, .. }) => {
                index == other && last.0.checked_add(1) == Some(first.0)
            }
            _ => false,
        };
        follows
            && (self.fact, &self.part, &self.before, &self.after, &self.consequences)
                == (next.fact, &next.part, &next.before, &next.after, &next.consequences)
    }
}
