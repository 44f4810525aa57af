//! Facts: what is said about an entry, an object or a device, where it is written, and who states it.
//!
//! A message points at a fact, a departure from a standard is one, a column of the documents shows one, a key of the
//! specification states one.

use crate::source::{FileId, Span};

macro_rules! facts {
    ($($(#[$meta:meta])* $variant:ident = $word:literal,)+) => {
        /// A kind of fact about an entry, an object or a device.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Fact { $($(#[$meta])* $variant,)+ }

        impl Fact {
            /// All kinds, in the order in which they are shown.
            pub const ALL: &'static [Fact] = &[$(Fact::$variant,)+];

            /// The fact of an English word.
            pub fn from_word(word: &str) -> Option<Self> {
                match word { $($word => Some(Fact::$variant),)+ _ => None }
            }

            /// The English word: the key that states the fact, where one key does.
            pub const fn word(self) -> &'static str {
                match self { $(Fact::$variant => $word,)+ }
            }
        }
    };
}

facts! {
    /// Name of an object or entry.
    Name = "name",
    /// VAR, ARRAY, RECORD or DOMAIN.
    ObjectType = "object-type",
    /// Number of elements of an array.
    Count = "count",
    /// That an entry is there at all.
    Presence = "added",
    /// Data type on the bus.
    Type = "type",
    /// Named values or bits of a type that is the same on the bus.
    Meaning = "meaning",
    /// Physical unit and scale.
    Unit = "unit",
    /// Access over the bus, with the lock.
    Access = "access",
    /// Into which PDOs it may be mapped.
    Mapping = "pdo",
    /// Value after factory reset, or the value that a configuration sets.
    Default = "default",
    /// Smallest allowed value.
    LowLimit = "min",
    /// Largest allowed value.
    HighLimit = "max",
    /// Values with a meaning of their own.
    Special = "special",
    /// What keeps the value over power-off.
    Storage = "stored",
    /// Whether a standard demands it.
    Category = "category",
    /// Manual revision that introduced it.
    Since = "since",
    /// Condition under which a write is accepted.
    WriteCondition = "writable-when",
    /// Error codes of the bits of a shared type.
    BitErrors = "bit-errors",
    /// Most bytes of a string.
    Capacity = "capacity",
    /// Name in generated code.
    Identifier = "identifier",
    /// What the EDS shows of an entry, or says about itself.
    Eds = "eds",
    /// Objects that belong together with an object.
    Links = "links",
    /// Danger that comes from it.
    Warning = "warning",
    /// Description.
    About = "about",
    /// What the printed manual leaves open.
    Gap = "gap",
    /// Words by which readers look for it.
    Search = "search",
    /// The entry that an alias shows.
    Alias = "alias",
    /// The flag of a COB-ID that forbids remote frames.
    RemoteFrames = "no-rtr",
    /// Bit rates that a device supports.
    BitRates = "bit-rates",
    /// Granularity of a device's PDO mapping.
    Granularity = "granularity",
    /// What a PDO carries.
    Map = "map",
    /// The maker: name and number.
    Vendor = "vendor",
    /// The product: name, code, order code.
    Product = "product",
    /// The product's revision (1018h.3).
    ProductRevision = "product-revision",
    /// Device type (1000h).
    DeviceType = "device-type",
    /// Simple boot-up as master or slave.
    BootUp = "boot-up",
    /// Multiplexed PDOs.
    GroupMessaging = "group-messaging",
    /// LSS slave.
    Lss = "lss",
    /// Data types that may be in an RPDO as placeholders.
    Dummies = "dummies",
    /// Indices at which a PLC may create network variables.
    DynamicChannels = "dynamic-channels",
    /// Modules of a bus coupler.
    Modules = "modules",
    /// What a file says beyond the other facts.
    Further = "key",
    /// How many PDOs a device has.
    PdoCount = "pdos",
    /// A condition between entries, and when it counts.
    Requirement = "require",
    /// What the device does on an error.
    Reaction = "reaction",
    /// How a state machine goes from one state to another.
    Transitions = "transitions",
    /// What shows an error.
    Shown = "shown",
    /// What resets an error.
    Reset = "reset",
    /// What entry chooses the reaction to an error.
    OptionCode = "option-code",
    /// The bits of the error register that an error sets.
    Register = "register",
    /// How urgent an error is.
    Priority = "priority",
    /// The languages of the texts.
    Languages = "languages",
    /// The printed manual: its issues, chapters and tables.
    Document = "document",
    /// What the printed manual says otherwise.
    Errata = "errata",
    /// A node of a network, as a DCF has it: node-ID, bit rate, names, network.
    Node = "node",
}

impl Fact {
    /// Whether an EDS states the fact in its keys, where another tool reads it. It does not
    /// state what is only in comments.
    pub const fn is_stated_by_eds(self) -> bool {
        match self {
            Self::Name
            | Self::ObjectType
            | Self::Count
            | Self::Presence
            | Self::Type
            | Self::Access
            | Self::Mapping
            | Self::Default
            | Self::LowLimit
            | Self::HighLimit
            | Self::Eds
            | Self::Links
            | Self::RemoteFrames
            | Self::BitRates
            | Self::Granularity
            | Self::Map
            | Self::Vendor
            | Self::Product
            | Self::ProductRevision
            | Self::DeviceType
            | Self::BootUp
            | Self::GroupMessaging
            | Self::Lss
            | Self::Dummies
            | Self::DynamicChannels
            | Self::Modules
            | Self::Further
            | Self::PdoCount
            | Self::Node => true,
            Self::Meaning
            | Self::Register
            | Self::Unit
            | Self::Special
            | Self::Storage
            | Self::Category
            | Self::Since
            | Self::WriteCondition
            | Self::BitErrors
            | Self::Capacity
            | Self::Identifier
            | Self::Warning
            | Self::About
            | Self::Gap
            | Self::Search
            | Self::Alias
            | Self::Requirement
            | Self::Reaction
            | Self::Transitions
            | Self::Shown
            | Self::Reset
            | Self::OptionCode
            | Self::Priority
            | Self::Languages
            | Self::Document
            | Self::Errata => false,
        }
    }
}

/// Who says a fact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Author {
    /// The maker of the device, in the specification itself.
    Maker,
    /// A library of a standard; the maker has added nothing.
    Library,
    /// No one: it follows from other facts.
    Derived,
    /// The user who configures a node: a setting laid over the maker's value.
    Setting,
}

/// Where a fact is written, and who states it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Statement {
    /// Where it is written; for a derived fact, where it follows from.
    pub span: Span,
    /// Who says it.
    pub author: Author,
}

impl Statement {
    /// A fact that is written at `span`: the maker's if that is in the maker's specification.
    pub const fn written(span: Span, maker: FileId) -> Self {
        let author = if span.file.is_one_with(maker) { Author::Maker } else { Author::Library };
        Self { span, author }
    }

    /// A fact that follows from what is written at `span`.
    pub const fn derived(span: Span) -> Self {
        Self { span, author: Author::Derived }
    }
}

/// What is known about the facts of one thing. A fact that is not stated has no statement.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Facts {
    /// Ascending by fact; a handful.
    stated: Vec<(Fact, Statement)>,
}

impl Facts {
    /// Nothing stated.
    pub const fn none() -> Self {
        Self { stated: Vec::new() }
    }

    /// Where a fact is written, and who states it.
    pub fn get(&self, fact: Fact) -> Option<Statement> {
        let at = self.stated.binary_search_by_key(&fact, |(stated, _)| *stated).ok()?;
        Some(self.stated[at].1)
    }

    /// States a fact, or states it anew.
    pub fn state(&mut self, fact: Fact, statement: Statement) {
        match self.stated.binary_search_by_key(&fact, |(stated, _)| *stated) {
            Ok(at) => self.stated[at].1 = statement,
            Err(at) => self.stated.insert(at, (fact, statement)),
        }
    }

    /// The facts that are stated, in order.
    pub fn said_by(&self, author: Author) -> impl Iterator<Item = Fact> {
        self.stated.iter().filter(move |(_, statement)| statement.author == author).map(|(fact, _)| *fact)
    }

    /// Whether the fact is stated.
    pub fn is_said_by(&self, fact: Fact, author: Author) -> bool {
        self.get(fact).is_some_and(|statement| statement.author == author)
    }
}

impl FromIterator<(Fact, Statement)> for Facts {
    fn from_iter<T: IntoIterator<Item = (Fact, Statement)>>(list: T) -> Self {
        // As many as an entry usually has.
        let mut facts = Self { stated: Vec::with_capacity(8) };
        for (fact, statement) in list {
            facts.state(fact, statement);
        }
        facts
    }
}

/// A fact in which an object says something else than the standard that it is taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Departure {
    /// What of the object.
    pub part: Part,
    /// The fact.
    pub fact: Fact,
}

/// A part of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Part {
    /// The object itself.
    Object,
    /// What all elements of an array have in common.
    Elements,
    /// One entry.
    Entry(super::SubIndex),
    /// A run of entries.
    Entries {
        /// The first.
        first: super::SubIndex,
        /// The last.
        last: super::SubIndex,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::SourceMap;

    #[test]
    fn a_fact_is_stated_once_and_by_one() {
        let mut sources = SourceMap::new();
        let (maker, library) = (sources.add("maker", "x"), sources.add("library", "x"));
        let at = |file| Statement::written(sources.whole(file), maker);
        let mut facts = Facts::none();
        facts.state(Fact::Default, at(library));
        facts.state(Fact::Name, at(maker));
        assert!(facts.is_said_by(Fact::Default, Author::Library));
        facts.state(Fact::Default, at(maker));
        assert_eq!(facts.said_by(Author::Maker).collect::<Vec<_>>(), [Fact::Name, Fact::Default]);
        assert_eq!(facts.get(Fact::Unit), None);
    }
}
