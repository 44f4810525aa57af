//! The printed manual: its revision, its chapters and tables, and what it says otherwise.

use std::collections::BTreeMap;
use std::fmt;

use super::{Axis, Date, Devices, Direction, EntryId, Fact, Flow, Index, Phrases, Switch, Text, Timing};

/// The printed manual that a specification represents.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Document {
    /// Title of the manual.
    pub source: Option<String>,
    /// What it is about, below its title.
    pub subtitle: Text,
    /// The maker's address, in lines.
    pub address: Text,
    /// More about it.
    pub about: Text,
    /// Issue that the specification holds.
    pub revision: Option<Issue>,
    /// Earlier issues, oldest first.
    pub history: Vec<Issue>,
    /// Abbreviations.
    pub glossary: BTreeMap<String, Text>,
    /// Chapters and sections with their tables, in order.
    pub sections: Vec<Section>,
}

/// The place of a table in a [`Document`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct TableId {
    /// Position of the section.
    pub section: usize,
    /// Position in the section's tables.
    pub table: usize,
}

impl Document {
    /// All tables, in order.
    pub fn tables(&self) -> impl Iterator<Item = (TableId, &Section, &Table)> {
        self.sections.iter().enumerate().flat_map(|(at, section)| {
            let id = move |table| TableId { section: at, table };
            section.tables.iter().enumerate().map(move |(table, content)| (id(table), section, content))
        })
    }
}

/// One issue of the manual.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Issue {
    /// Its number, as printed.
    pub number: String,
    /// Its date.
    pub date: Date,
    /// What changed.
    pub about: Text,
}

/// A chapter or section.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Section {
    /// Number, as printed: `4.1.1`; empty for parts without one.
    pub number: String,
    /// Heading.
    pub title: Text,
    /// Tables in it.
    pub tables: Vec<Table>,
    /// What it contains, in order.
    pub content: Vec<Content>,
    /// Words by which readers look for it.
    pub search: Phrases,
}

/// What a section contains.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Content {
    /// The table at this position of [`Section::tables`].
    Table(usize),
    /// Text.
    Prose(Prose),
}

/// Text of the manual.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Prose {
    /// How it is read.
    pub kind: ProseKind,
    /// The items of a list, or one text; each line of it is a paragraph or formula.
    pub items: Vec<Text>,
    /// The objects whose own warnings it says in full.
    pub warns_for: Vec<Index>,
}

/// How a text of the manual is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ProseKind {
    /// Running text.
    Text,
    /// Something that is easily overlooked.
    Note,
    /// A danger for people, machine or data.
    Warning,
    /// What is done one after the other.
    Steps,
    /// A list without an order.
    List,
    /// Formulas.
    Formula,
    /// What the manual leaves open.
    Gap,
}

impl ProseKind {
    /// The word of a specification.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Steps => "steps",
            Self::List => "list",
            Self::Formula => "formula",
            Self::Gap => "gap",
        }
    }
}

/// A table of the manual.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Table {
    /// Number, as printed; `None` for tables without one.
    pub number: Option<u16>,
    /// Caption.
    pub title: Text,
    /// Number and caption of the picture that is drawn of it.
    pub figure: Option<Figure>,
    /// What fills it.
    pub content: TableContent,
    /// The keys of the columns that are printed; empty where that is not stated.
    pub columns: Vec<String>,
    /// The values or first bits of its rows in the order as printed; ascending where there are none.
    pub order: Vec<i128>,
}

/// A numbered figure of the manual: the picture of a [`Table`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Number, as printed.
    pub number: u16,
    /// Caption; that of the table, unless the figure has one of its own.
    pub title: Text,
}

impl Table {
    /// The figure, where table and picture are under one caption, which is the figure's.
    #[must_use]
    pub fn as_figure(&self) -> Option<&Figure> {
        self.figure.as_ref().filter(|figure| self.number.is_none() && figure.title == self.title)
    }
}

/// What fills a table.
#[derive(Debug, Clone, PartialEq)]
pub enum TableContent {
    /// One row per object: index, object type, name, type, access, storage.
    Overview(Vec<Index>),
    /// The objects' entries in detail.
    Objects(Vec<Index>),
    /// Bits of a named type.
    Bits(BitTable),
    /// Values of a named type.
    Values(String),
    /// Error codes.
    Errors(Vec<u16>),
    /// Error codes with the device's reactions.
    Reactions(Vec<u16>),
    /// States of a state machine.
    States(String),
    /// Transitions of a state machine.
    Transitions(String),
    /// Commands of a state machine.
    Commands(String),
    /// The entries of an ordering constraint with their defaults.
    Ladder(LadderTable),
    /// A sequence of events, step by step.
    Timing(Timing),
    /// Switches with a hysteresis, and the values at which they go on and off.
    Hysteresis(Vec<Switch>),
    /// Blocks, and what goes from one to another.
    Flow(Flow),
    /// Marks on an axis, and the spans between them.
    Axis(Axis),
    /// Default PDOs.
    Pdos(PdoTable),
    /// Rows of text.
    Rows {
        /// Column headings.
        columns: Vec<Text>,
        /// Cells.
        rows: Vec<Vec<Text>>,
    },
    /// Abbreviations.
    Glossary,
    /// Issues of the manual.
    History,
}

impl TableContent {
    /// The objects that its rows are about, as listed.
    #[must_use]
    pub fn objects(&self) -> &[Index] {
        match self {
            Self::Overview(objects) | Self::Objects(objects) => objects,
            Self::Bits(_)
            | Self::Values(_)
            | Self::Errors(_)
            | Self::Reactions(_)
            | Self::States(_)
            | Self::Transitions(_)
            | Self::Commands(_)
            | Self::Ladder(_)
            | Self::Timing(_)
            | Self::Hysteresis(_)
            | Self::Flow(_)
            | Self::Axis(_)
            | Self::Pdos(_)
            | Self::Rows { .. }
            | Self::Glossary
            | Self::History => &[],
        }
    }

    /// The keys of the columns that such a table can have in the documents, in their order.
    #[must_use]
    pub const fn columns(&self) -> &'static [&'static str] {
        match self {
            Self::Overview(_) => &["index", "object", "name", "type", "access", "mem", "device"],
            Self::Objects(_) => &[
                "index",
                "sub",
                "name",
                "type",
                "access",
                "map",
                "default",
                "unit",
                "range",
                "stored",
                "description",
                "device",
            ],
            Self::Bits(_) => {
                &["bit", "mask", "mnemonic", "name", "meaning", "active", "clamp", "priority", "error_codes"]
            }
            Self::Values(_) => &["value", "name", "meaning", "supported"],
            Self::Errors(_) => &["code", "name", "device", "priority", "register", "description"],
            Self::Reactions(_) => &["name", "code", "reaction"],
            Self::States(_) => &["pattern", "state", "meaning"],
            Self::Transitions(_) => &["transition", "from", "to", "event", "action"],
            Self::Commands(_) => &["command", "bit", "send", "transitions", "meaning"],
            Self::Ladder(_) => &["relation", "meaning", "default", "name", "object", "device"],
            Self::Timing(_) => &["step", "event", "cause", "level"],
            Self::Hysteresis(_) => &["switches", "on", "off", "on_from", "off_from"],
            Self::Flow(_) => &["block", "from", "entries", "does"],
            Self::Axis(_) => &["kind", "name", "from", "to", "entries", "does"],
            Self::Pdos(_) => &["pdo", "cob_id", "enabled", "index", "sub", "default", "object"],
            Self::Rows { .. } => &["text"],
            Self::Glossary => &["abbreviation", "meaning"],
            Self::History => &["number", "date", "description"],
        }
    }
}

/// The bits of a named type.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BitTable {
    /// Name of the bit field type.
    pub named_type: String,
    /// Where the masks of the bits are shown, too: width of a mask, 1 to 64 bits. Bits beyond it have none.
    pub masks: Option<u8>,
}

/// The entries of an ordering constraint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LadderTable {
    /// Name of the constraint.
    pub constraint: String,
    /// What each entry is called there, in the order of the constraint; empty where the names of the entries are enough.
    pub labels: Vec<Text>,
}

/// The default PDOs of one device and direction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PdoTable {
    /// Key of the device.
    pub device: String,
    /// Direction.
    pub direction: Direction,
}

/// A place where the printed manual says something else than the specification, or nothing at all.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Erratum {
    /// Objects or entries it is about; empty for none in particular.
    pub at: Vec<ErratumPlace>,
    /// Devices it is about.
    pub devices: Devices,
    /// What kind of fact.
    pub kind: ErratumKind,
    /// Where the manual prints it.
    pub place: Text,
    /// What it prints.
    pub prints: Text,
    /// What the specification says.
    pub reads: Text,
    /// Why.
    pub because: Text,
    /// Tables of the document that [`place`](Self::place) names.
    pub tables: Vec<TableId>,
    /// Facts that the manual does not print, where it is about such.
    pub unprinted: Option<Unprinted>,
}

/// Facts that the printed manual does not state.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Unprinted {
    /// The facts of the places of the erratum; of its devices where it has no place.
    pub facts: Vec<Fact>,
    /// The values or bits of the type that it is about; all where there are none.
    pub of: Vec<i128>,
    /// Where they come from instead.
    pub basis: Basis,
}

impl Unprinted {
    /// The words of facts that an erratum can name.
    pub const FACTS: &'static [&'static str] = &[
        Fact::Name.word(),
        Fact::Type.word(),
        Fact::Meaning.word(),
        Fact::Unit.word(),
        Fact::Access.word(),
        Fact::Mapping.word(),
        Fact::Default.word(),
        Fact::LowLimit.word(),
        Fact::HighLimit.word(),
        Fact::Storage.word(),
        Fact::About.word(),
        Fact::Transitions.word(),
        Fact::Vendor.word(),
        Fact::Product.word(),
        Fact::ProductRevision.word(),
        Fact::DeviceType.word(),
        Fact::BitRates.word(),
        Fact::PdoCount.word(),
        Fact::Reaction.word(),
    ];
}

/// Where a fact comes from that the printed manual does not state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Basis {
    /// A standard says it.
    Standard,
    /// It is assumed.
    Assumption,
}

impl Basis {
    /// The words of a specification.
    pub const WORDS: &'static [&'static str] = &["standard", "assumption"];

    /// The word that a specification uses.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Assumption => "assumption",
        }
    }

    /// The basis of a word.
    pub fn from_word(word: &str) -> Option<Self> {
        match word {
            "standard" => Some(Self::Standard),
            "assumption" => Some(Self::Assumption),
            _ => None,
        }
    }
}

/// What an erratum is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ErratumPlace {
    /// A whole object.
    Object(Index),
    /// One entry.
    Entry(EntryId),
}

impl ErratumPlace {
    /// The object.
    pub const fn index(self) -> Index {
        match self {
            ErratumPlace::Object(index) => index,
            ErratumPlace::Entry(id) => id.index,
        }
    }
}

/// `6040h` for an object, `3020h.5` for an entry, also at sub-index 0.
impl fmt::Display for ErratumPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ErratumPlace::Object(index) => index.fmt(f),
            ErratumPlace::Entry(id) => write!(f, "{}.{}", id.index, id.sub),
        }
    }
}

macro_rules! erratum_kinds {
    ($($(#[$meta:meta])* $variant:ident = $word:literal,)+) => {
        /// What kind of fact an erratum corrects.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum ErratumKind { $($(#[$meta])* $variant,)+ }

        impl ErratumKind {
            /// The words of a specification.
            pub const WORDS: &'static [&'static str] = &[$($word,)+];

            /// The word that a specification uses.
            pub const fn word(self) -> &'static str {
                match self { $(ErratumKind::$variant => $word,)+ }
            }

            /// The kind of a word.
            pub fn from_word(word: &str) -> Option<Self> {
                match word { $($word => Some(ErratumKind::$variant),)+ _ => None }
            }
        }
    };
}

erratum_kinds! {
    /// An index.
    Index = "index",
    /// A name.
    Name = "name",
    /// A data type.
    Type = "type",
    /// The sign of a type or value.
    Sign = "sign",
    /// An access right.
    Access = "access",
    /// VAR, ARRAY or RECORD.
    ObjectType = "object-type",
    /// A sub-index or the number of them.
    SubIndex = "sub-index",
    /// The number of elements or rows.
    Count = "count",
    /// A default value.
    Default = "default",
    /// A limit.
    Limit = "limit",
    /// A unit or scale.
    Unit = "unit",
    /// PDO mapping or its direction.
    Pdo = "pdo",
    /// Whether a value is stored.
    Stored = "stored",
    /// A bit table.
    Bits = "bits",
    /// A value table.
    Values = "values",
    /// A table's number, caption or headings.
    Table = "table",
    /// Running text.
    Text = "text",
    /// The manual is silent and a value had to be chosen.
    Gap = "gap",
    /// The manual departs from a CiA profile; the manual's word is kept.
    Profile = "profile",
}
