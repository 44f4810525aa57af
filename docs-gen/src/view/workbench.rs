//! What the page of a device calculates with: types, units, limits and names of its entries, without their texts.

use od_spec::model::EntryId;
use serde::ser::SerializeSeq as _;
use serde::{Serialize, Serializer};

use crate::view::long_list::LongList;

/// What the workbench of a device's page calculates with. A page has it once, in few bytes: lists without keys, and without their empty ends.
#[derive(Debug, Clone, Serialize)]
pub struct Workbench {
    /// How numbers are written: `.` or `,`.
    pub decimal_sign: &'static str,
    /// Fixed words by their keys, each with its text.
    pub phrases: Vec<(&'static str, &'static str)>,
    /// SDO abort codes, each with eight hexadecimal digits and what it means.
    pub aborts: Vec<(&'static str, &'static str)>,
    /// Units: symbol, then numerator and denominator of a raw step, then of what the raw value 0 means.
    pub scales: Vec<(String, [Whole; 4])>,
    /// Enums and bit fields.
    pub named_types: Vec<WorkType>,
    /// State machines.
    pub machines: Vec<WorkMachine>,
    /// PDOs.
    pub frames: Vec<WorkFrame>,
    /// Objects: index and entries.
    pub lines: LongList<(u16, Vec<WorkEntry>)>,
}

/// A PDO: name, index of the communication parameter, and what is mapped, each with index, sub-index and bits.
pub type WorkFrame = (String, u16, Vec<(u16, u8, u8)>);

/// A number that scripts read exactly: as a text where they have no exact number for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Whole(pub i128);

/// What the bits or values of a type are.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum WorkType {
    /// Fields by ascending bit.
    Bits(Vec<WorkField>),
    /// Values, ascending.
    Values(Vec<WorkValue>),
}

/// A bit, or a run of bits.
#[derive(Debug, Clone)]
pub struct WorkField {
    /// Lowest bit.
    pub first: u8,
    /// Highest bit.
    pub last: u8,
    /// Name; empty where it has none.
    pub name: String,
    /// `used`, `reserved`, `unused`.
    pub usage: &'static str,
    /// The level that means "active".
    pub active: u8,
    /// Named values of a run.
    pub values: Vec<WorkValue>,
    /// Names in a mode of operation: mode and name.
    pub modes: Vec<(String, String)>,
}

/// A value with a name.
#[derive(Debug, Clone)]
pub struct WorkValue {
    /// Raw value.
    pub raw: Whole,
    /// Name.
    pub name: String,
    /// Whether the device has it.
    pub is_supported: bool,
}

/// A state machine: the entries that show its state and take its commands, and the patterns of both, each with its name. A pattern has a character for each bit,
/// the highest first: `0`, `1`, `x` for either, `r` and `f` for a change to 1 and to 0.
#[derive(Debug, Clone, Serialize)]
pub struct WorkMachine {
    /// Index and sub-index of the entry that shows the state.
    pub status: (u16, u8),
    /// Index and sub-index of the entry that takes the commands.
    pub command: (u16, u8),
    /// States: pattern and name.
    pub states: Vec<(String, String)>,
    /// Commands: pattern and name.
    pub commands: Vec<(String, String)>,
}

/// An entry, as a list: sub-index, code of the data type, [`rights`](Self::rights), names in Rust, C and Structured Text, positions of unit and type counted from 1 (0:
/// none), default, lower and upper limit, special values, and [`part`](Self::part).
#[derive(Debug, Clone)]
pub struct WorkEntry {
    /// Index and sub-index.
    pub id: EntryId,
    /// Code of the data type (CiA 301 table 39).
    pub code: u16,
    /// Sum of what can be done with it: 1 read, 2 write, 4 map into RPDOs, 8 map into TPDOs, 16 write only while the device is unlocked, 32 write under a condition.
    pub rights: u8,
    /// Names in Rust, C and Structured Text; empty where there is none.
    pub names: [String; 3],
    /// Position of the unit, counted from 1; 0 for none.
    pub scale: usize,
    /// Position of the type, counted from 1; 0 for none.
    pub named_type: usize,
    /// Default: its bytes in hexadecimal digits, or `$` and what is added to the node-ID.
    pub default: Option<String>,
    /// Smallest allowed value.
    pub low: Option<WorkLimit>,
    /// Largest allowed value, or the bytes that a string may have.
    pub high: Option<WorkLimit>,
    /// Values with a meaning of their own.
    pub special: Vec<WorkValue>,
    /// What its value consists of: `mapping`, or a COB-ID of `sync`, `time`, `channel`, `rpdo`, `tpdo`; empty for a plain number.
    pub part: &'static str,
}

/// A limit of a value.
#[derive(Debug, Clone)]
pub enum WorkLimit {
    /// A raw value.
    Whole(Whole),
    /// A REAL, as a program writes it.
    Real(String),
}

/// A piece of a list.
#[derive(Serialize)]
#[serde(untagged)]
enum Piece<'a> {
    Whole(Whole),
    Text(&'a str),
    Values(&'a [WorkValue]),
    Modes(&'a [(String, String)]),
}

impl Piece<'_> {
    /// What a script has where a list ended before it.
    const fn is_empty(&self) -> bool {
        match self {
            Self::Whole(number) => number.0 == 0,
            Self::Text(text) => text.is_empty(),
            Self::Values(values) => values.is_empty(),
            Self::Modes(modes) => modes.is_empty(),
        }
    }

    fn list<S: Serializer>(pieces: &[Self], serializer: S) -> Result<S::Ok, S::Error> {
        let end = pieces.iter().rposition(|piece| !piece.is_empty()).map_or(0, |last| last + 1);
        let mut list = serializer.serialize_seq(Some(end))?;
        for piece in &pieces[..end] {
            list.serialize_element(piece)?;
        }
        list.end()
    }
}

impl From<u8> for Piece<'_> {
    fn from(number: u8) -> Self {
        Self::Whole(Whole(number.into()))
    }
}

impl Serialize for Whole {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        /// The whole numbers up to this one are numbers of scripts.
        const SAFE: i64 = (1 << 53) - 1;
        match i64::try_from(self.0) {
            Ok(number) if (-SAFE..=SAFE).contains(&number) => serializer.serialize_i64(number),
            Ok(_) | Err(_) => serializer.collect_str(&self.0),
        }
    }
}

impl Serialize for WorkValue {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let unsupported = u8::from(!self.is_supported);
        Piece::list(&[Piece::Whole(self.raw), Piece::Text(&self.name), unsupported.into()], serializer)
    }
}

impl Serialize for WorkField {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let pieces = [
            self.first.into(),
            self.last.into(),
            Piece::Text(&self.name),
            Piece::Text(if self.usage == "used" { "" } else { self.usage }),
            u8::from(self.active == 0).into(),
            Piece::Values(&self.values),
            Piece::Modes(&self.modes),
        ];
        Piece::list(&pieces, serializer)
    }
}

impl Serialize for WorkEntry {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fn limit(limit: Option<&WorkLimit>) -> Piece<'_> {
            match limit {
                // A limit of 0 is not the same as none.
                Some(WorkLimit::Whole(Whole(0))) => Piece::Text("0"),
                Some(WorkLimit::Whole(number)) => Piece::Whole(*number),
                Some(WorkLimit::Real(number)) => Piece::Text(number),
                None => Piece::Text(""),
            }
        }
        let position = |position: usize| Piece::Whole(Whole(i128::try_from(position).unwrap_or_default()));
        let [rust, c, st] = &self.names;
        let pieces = [
            self.id.sub.0.into(),
            Piece::Whole(Whole(self.code.into())),
            self.rights.into(),
            Piece::Text(rust),
            Piece::Text(c),
            Piece::Text(st),
            position(self.scale),
            position(self.named_type),
            self.default.as_deref().map_or(Piece::Whole(Whole(0)), Piece::Text),
            limit(self.low.as_ref()),
            limit(self.high.as_ref()),
            Piece::Values(&self.special),
            Piece::Text(self.part),
        ];
        Piece::list(&pieces, serializer)
    }
}
