//! Tables of keys, and what the values and keys of maps look like.

/// The keys of one kind of map.
#[derive(Debug)]
pub struct Keys {
    /// What such a map describes, with its article: `an object`.
    pub name: &'static str,
    /// The keys, in the order the reference shows them.
    pub keys: &'static [Key],
    /// Which of the keys depend on each other.
    pub choices: &'static [Choice],
}

impl Keys {
    /// The key of a name.
    pub fn get(&self, name: &str) -> Option<&'static Key> {
        let first = name.as_bytes().first();
        // Most keys begin otherwise: there is no need to compare the rest.
        self.keys.iter().find(|key| key.name.as_bytes().first() == first && key.name == name)
    }
}

/// Keys of one map that depend on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// Exactly one of them must be there.
    One(&'static [&'static str]),
    /// At least one of them must be there.
    Any(&'static [&'static str]),
    /// At least one of them must be there, or in what the map takes its keys from.
    AnyInherited(&'static [&'static str]),
    /// All of them are there, or none.
    Together(&'static [&'static str]),
}

impl Choice {
    /// The keys.
    pub const fn keys(self) -> &'static [&'static str] {
        match self {
            Self::One(keys) | Self::Any(keys) | Self::AnyInherited(keys) | Self::Together(keys) => keys,
        }
    }
}

/// Whether a map needs a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// It may be left out, unless a [`Choice`] needs it.
    Optional,
    /// The map itself must have it.
    Required,
    /// The map must have it, or what the map takes it from: a library, a similar object, the level above.
    Inherited,
}

/// One key.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// The key as written.
    pub name: &'static str,
    /// What its value looks like.
    pub shape: Shape,
    /// Whether it must be there.
    pub need: Need,
    /// What it means.
    pub about: &'static str,
    /// A value as it may be written, where the shape alone does not show it.
    pub example: Option<&'static str>,
}

/// What a value looks like.
#[derive(Debug, Clone, Copy)]
pub enum Shape {
    /// Any text but an empty one.
    Text,
    /// A text that an EDS shows in its header, and that may be empty there.
    HeaderText,
    /// A text, or a map from language code to text.
    Words,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// `yes` or `no`.
    YesNo,
    /// An integer in a range.
    Integer(i128, i128),
    /// The version of the language.
    Version,
    /// `2009-05-27`.
    Date,
    /// `2009-05-27 09:00`.
    DateTime,
    /// An index: `0x6040`.
    Index,
    /// An error code: `0x3210`.
    ErrorCode,
    /// An entry: `0x30FA.3`, or by name.
    Entry,
    /// An entry, or a run of entries of one object: `0x2021.1..4`.
    Entries,
    /// An access type, `locked` may follow.
    Access,
    /// A data type or a named type.
    Type,
    /// A value of an entry: number, physical value, enum name, text or `$NODEID` formula.
    Value,
    /// A value; a list of values, one for each element of an array, or of the bits of a bit field that are 1,
    /// `[enable, {mode: homing}]`; or a map from device to one of these.
    Default,
    /// What a node's parameter is set to: a value, a list of the bits that are 1, or a map with the entries of an object.
    Setting,
    /// A fraction: `1/10`.
    Ratio,
    /// A fraction that may be negative or 0: `-40`.
    SignedRatio,
    /// A fraction and a symbol: `1/1000 V`.
    Base,
    /// A time in steps of its key, 0 to 65535, or with its unit: `10 ms`.
    Time,
    /// A number from 0 to 255, or numbers that follow each other: `0..11`.
    Numbers,
    /// A condition between entries.
    Condition,
    /// A term of a condition: `0x6092.1 / 0x6092.2`.
    Formula,
    /// Bits, most significant first: `xxxx xxxx x01x 0001`.
    Pattern,
    /// A name with placeholders for numbers: `Receive PDO {pdo} Mapping`.
    NumberedName(NumberedName),
    /// A map with fixed keys.
    Map(&'static Keys),
    /// A map whose keys are data.
    MapOf(KeyKind, &'static Shape),
    /// A list.
    List(&'static Shape),
    /// One value, or a list of them.
    OneOrMore(&'static Shape),
    /// A short form (a scalar) or a map.
    ShortOr(&'static Shape, &'static Keys),
    /// The name of a feature; after a colon, how many channels it has, if it has some.
    Feature,
    /// The name of something that is defined elsewhere.
    NameOf(NameOf),
}

/// What a text is the name of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum NameOf {
    /// A unit.
    Unit,
    /// An enum or a bit field.
    NamedType,
    /// A data type.
    DataType,
    /// A library among those that are used.
    Library,
    /// A library that is built in, or the path of one.
    LibraryFile,
    /// The path of a file of the specification.
    File,
    /// A device.
    Device,
    /// A feature of a library.
    Feature,
    /// A bit or run of bits of the type that is named next to it; its name or its number.
    Bit,
    /// A state of the state machine; `start` and `any` are others.
    State,
    /// A state machine.
    Machine,
    /// A constraint.
    Constraint,
    /// An error code, or a run of them; `all` is every one.
    Errors,
    /// An earlier block of the diagram.
    Block,
    /// A mark of the axis.
    Mark,
}

/// What a name with placeholders is the name of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NumberedName {
    /// A parameter object of PDOs, or an entry that each has once.
    Parameter,
    /// A mapped entry, which has a number of its own.
    MappedEntry,
}

/// What the keys of a map are that carries data in its keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyKind {
    /// A name.
    Name,
    /// The key of a device that is described elsewhere.
    Device,
    /// A short key of lower-case letters, digits and `-`, which also names the device's files.
    DeviceKey,
    /// A name of letters, digits, `-` and `_`, which also names folders and files.
    Place,
    /// Such a name, or a run of numbers: `1..200`.
    Machines,
    /// A language code.
    Language,
    /// An index, or a run of them: `0x3511..0x3519`.
    Indices,
    /// A sub-index from 1 to 254.
    SubIndex,
    /// A sub-index from 1 to 254, or a run of them: `1..4`.
    SubIndices,
    /// A bit, or bits `0..3`.
    Bits,
    /// An integer.
    Integer,
    /// A 16-bit error code, or a range `0x3281..0x3288`.
    ErrorCodes,
    /// A number from 1 to 512.
    PdoNumber,
    /// A number from 0 to 255.
    Number,
}

/// The version of the language that the compiler reads.
pub const VERSION: i128 = 1;

/// Most channels of a feature: 254 elements of 64 channels each.
pub const CHANNELS: i128 = 254 * CHANNELS_OF_ELEMENT;
/// Most channels of an element.
pub(super) const CHANNELS_OF_ELEMENT: i128 = 64;

pub(super) const U8: Shape = Shape::Integer(0, 0xFF);
pub(super) const U32: Shape = Shape::Integer(0, 0xFFFF_FFFF);
pub(super) const DEVICES: Shape = Shape::OneOrMore(&Shape::NameOf(NameOf::Device));
/// Phrases by language.
pub(super) const PHRASES: Shape = Shape::MapOf(KeyKind::Language, &Shape::OneOrMore(&Shape::Text));
pub(super) const INDICES: Shape = Shape::List(&Shape::Index);
