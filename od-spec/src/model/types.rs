//! The vocabulary of an object dictionary: index, data type, access, PDO mapping, storage.

use std::fmt;

/// Index of an object, `0001h..FFFFh`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Index(pub u16);

/// The field's notation: `6040h`.
impl fmt::Display for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04X}h", self.0)
    }
}

impl Index {
    /// As specifications write it: `0x6040`.
    pub fn notation(self) -> String {
        format!("0x{:04X}", self.0)
    }
}

/// Sub-index of an entry; 0 for a VAR and for the element count of arrays and records.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SubIndex(pub u8);

impl SubIndex {
    /// FFh, which any array or record may have: it describes the structure of the object and does not count.
    pub const STRUCTURE: Self = Self(0xFF);
}

impl fmt::Display for SubIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// Index and sub-index of one entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EntryId {
    /// The object.
    pub index: Index,
    /// The entry in it.
    pub sub: SubIndex,
}

/// `6040h`, or `30FAh.3` for a sub-index other than 0.
impl fmt::Display for EntryId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.sub.0 == 0 { self.index.fmt(f) } else { write!(f, "{}.{}", self.index, self.sub) }
    }
}

impl EntryId {
    /// As specifications write it: `0x6040`, or `0x30FA.3` for a sub-index other than 0.
    pub fn notation(self) -> String {
        if self.sub.0 == 0 {
            self.index.notation()
        } else {
            format!("{}.{}", self.index.notation(), self.sub)
        }
    }
}

/// A simple data type of CiA 301 (table 39).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[expect(missing_docs, reason = "the names are those of the standard")]
pub enum DataType {
    Boolean,
    Integer8,
    Integer16,
    Integer24,
    Integer32,
    Integer40,
    Integer48,
    Integer56,
    Integer64,
    Unsigned8,
    Unsigned16,
    Unsigned24,
    Unsigned32,
    Unsigned40,
    Unsigned48,
    Unsigned56,
    Unsigned64,
    Real32,
    Real64,
    VisibleString,
    OctetString,
    UnicodeString,
    TimeOfDay,
    TimeDifference,
    Domain,
}

impl DataType {
    /// All types, in the order of their codes' families.
    pub const ALL: [DataType; 25] = {
        use DataType::{
            Boolean, Domain, Integer8, Integer16, Integer24, Integer32, Integer40, Integer48, Integer56,
            Integer64, OctetString, Real32, Real64, TimeDifference, TimeOfDay, UnicodeString, Unsigned8,
            Unsigned16, Unsigned24, Unsigned32, Unsigned40, Unsigned48, Unsigned56, Unsigned64,
            VisibleString,
        };
        [
            Boolean,
            Integer8,
            Integer16,
            Integer24,
            Integer32,
            Integer40,
            Integer48,
            Integer56,
            Integer64,
            Unsigned8,
            Unsigned16,
            Unsigned24,
            Unsigned32,
            Unsigned40,
            Unsigned48,
            Unsigned56,
            Unsigned64,
            Real32,
            Real64,
            VisibleString,
            OctetString,
            UnicodeString,
            TimeOfDay,
            TimeDifference,
            Domain,
        ]
    };

    /// Index of the type in the dictionary (CiA 301 table 39), as an EDS writes it.
    pub const fn code(self) -> u16 {
        match self {
            DataType::Boolean => 0x01,
            DataType::Integer8 => 0x02,
            DataType::Integer16 => 0x03,
            DataType::Integer32 => 0x04,
            DataType::Unsigned8 => 0x05,
            DataType::Unsigned16 => 0x06,
            DataType::Unsigned32 => 0x07,
            DataType::Real32 => 0x08,
            DataType::VisibleString => 0x09,
            DataType::OctetString => 0x0A,
            DataType::UnicodeString => 0x0B,
            DataType::TimeOfDay => 0x0C,
            DataType::TimeDifference => 0x0D,
            DataType::Domain => 0x0F,
            DataType::Integer24 => 0x10,
            DataType::Real64 => 0x11,
            DataType::Integer40 => 0x12,
            DataType::Integer48 => 0x13,
            DataType::Integer56 => 0x14,
            DataType::Integer64 => 0x15,
            DataType::Unsigned24 => 0x16,
            DataType::Unsigned40 => 0x18,
            DataType::Unsigned48 => 0x19,
            DataType::Unsigned56 => 0x1A,
            DataType::Unsigned64 => 0x1B,
        }
    }

    /// The name a specification uses: the standard's name in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            DataType::Boolean => "boolean",
            DataType::Integer8 => "integer8",
            DataType::Integer16 => "integer16",
            DataType::Integer24 => "integer24",
            DataType::Integer32 => "integer32",
            DataType::Integer40 => "integer40",
            DataType::Integer48 => "integer48",
            DataType::Integer56 => "integer56",
            DataType::Integer64 => "integer64",
            DataType::Unsigned8 => "unsigned8",
            DataType::Unsigned16 => "unsigned16",
            DataType::Unsigned24 => "unsigned24",
            DataType::Unsigned32 => "unsigned32",
            DataType::Unsigned40 => "unsigned40",
            DataType::Unsigned48 => "unsigned48",
            DataType::Unsigned56 => "unsigned56",
            DataType::Unsigned64 => "unsigned64",
            DataType::Real32 => "real32",
            DataType::Real64 => "real64",
            DataType::VisibleString => "visible-string",
            DataType::OctetString => "octet-string",
            DataType::UnicodeString => "unicode-string",
            DataType::TimeOfDay => "time-of-day",
            DataType::TimeDifference => "time-difference",
            DataType::Domain => "domain",
        }
    }

    /// The type of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|data_type| data_type.name() == name)
    }

    /// The type of an index in the dictionary.
    pub fn from_code(code: u16) -> Option<Self> {
        Self::ALL.into_iter().find(|data_type| data_type.code() == code)
    }

    /// Width in bits on the bus; `None` for variable length. A BOOLEAN has 1 bit in a PDO.
    pub const fn bits(self) -> Option<u16> {
        Some(match self {
            DataType::Boolean => 1,
            DataType::Integer8 | DataType::Unsigned8 => 8,
            DataType::Integer16 | DataType::Unsigned16 => 16,
            DataType::Integer24 | DataType::Unsigned24 => 24,
            DataType::Integer32 | DataType::Unsigned32 | DataType::Real32 => 32,
            DataType::Integer40 | DataType::Unsigned40 => 40,
            DataType::Integer48 | DataType::Unsigned48 | DataType::TimeOfDay | DataType::TimeDifference => 48,
            DataType::Integer56 | DataType::Unsigned56 => 56,
            DataType::Integer64 | DataType::Unsigned64 | DataType::Real64 => 64,
            DataType::VisibleString | DataType::OctetString | DataType::UnicodeString | DataType::Domain => {
                return None;
            }
        })
    }

    /// What its values are.
    pub const fn family(self) -> Family {
        match self {
            DataType::Boolean => Family::Boolean,
            DataType::Integer8
            | DataType::Integer16
            | DataType::Integer24
            | DataType::Integer32
            | DataType::Integer40
            | DataType::Integer48
            | DataType::Integer56
            | DataType::Integer64 => Family::Signed,
            DataType::Unsigned8
            | DataType::Unsigned16
            | DataType::Unsigned24
            | DataType::Unsigned32
            | DataType::Unsigned40
            | DataType::Unsigned48
            | DataType::Unsigned56
            | DataType::Unsigned64 => Family::Unsigned,
            DataType::Real32 | DataType::Real64 => Family::Real,
            DataType::VisibleString => Family::VisibleString,
            DataType::OctetString => Family::OctetString,
            DataType::UnicodeString => Family::UnicodeString,
            DataType::TimeOfDay | DataType::TimeDifference => Family::Time,
            DataType::Domain => Family::Domain,
        }
    }

    /// Whether it is an INTEGERn.
    pub const fn is_signed(self) -> bool {
        matches!(self.family(), Family::Signed)
    }

    /// Whether it is an UNSIGNEDn.
    pub const fn is_unsigned(self) -> bool {
        matches!(self.family(), Family::Unsigned)
    }

    /// Whether it is a string, whose length varies up to a capacity.
    pub const fn is_string(self) -> bool {
        matches!(self.family(), Family::VisibleString | Family::OctetString | Family::UnicodeString)
    }

    /// Whether it is an INTEGERn or UNSIGNEDn.
    pub const fn is_integer(self) -> bool {
        self.is_signed() || self.is_unsigned()
    }

    /// Smallest and largest value of an integer or a BOOLEAN.
    pub fn range(self) -> Option<(i128, i128)> {
        match self.family() {
            Family::Boolean => Some((0, 1)),
            Family::Signed => self.bits().map(|bits| (-(1 << (bits - 1)), (1 << (bits - 1)) - 1)),
            Family::Unsigned => self.bits().map(|bits| (0, (1 << bits) - 1)),
            Family::Real
            | Family::VisibleString
            | Family::OctetString
            | Family::UnicodeString
            | Family::Time
            | Family::Domain => None,
        }
    }

    /// Whether values of the type may travel in a PDO (CiA 301: everything of fixed length).
    pub const fn is_mappable(self) -> bool {
        self.bits().is_some()
    }

    /// Whether the type may be in an RPDO as a placeholder (0001h..0007h).
    pub const fn is_dummy(self) -> bool {
        self.code() <= 0x07
    }
}

/// What the values of a data type are. Code that treats types differently decides by the family, with an arm for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Family {
    /// Yes or no.
    Boolean,
    /// INTEGERn.
    Signed,
    /// UNSIGNEDn.
    Unsigned,
    /// REALn.
    Real,
    /// Characters of ISO 646.
    VisibleString,
    /// Bytes.
    OctetString,
    /// Characters of 16 bits.
    UnicodeString,
    /// Days and milliseconds.
    Time,
    /// A block of variable length that the application keeps.
    Domain,
}

/// The standard's spelling: `UNSIGNED16`, `VISIBLE_STRING`.
impl fmt::Display for DataType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name().to_uppercase().replace('-', "_"))
    }
}

macro_rules! word_enum {
    ($(#[$meta:meta])* $name:ident { $($(#[$variant_meta:meta])* $variant:ident = $word:literal,)+ }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $name { $($(#[$variant_meta])* $variant,)+ }

        impl $name {
            /// The words of a specification, in order.
            pub const WORDS: &'static [&'static str] = &[$($word,)+];

            /// The word that a specification uses.
            pub const fn word(self) -> &'static str {
                match self { $($name::$variant => $word,)+ }
            }

            /// The value of a word.
            pub fn from_word(word: &str) -> Option<Self> {
                match word { $($word => Some($name::$variant),)+ _ => None }
            }
        }
    };
}

word_enum! {
    /// Who may read and write an entry over the bus (CiA 306 4.6.3.2), seen from the bus.
    Access {
        /// Never changes.
        Const = "const",
        /// Read only.
        Ro = "ro",
        /// Write only.
        Wo = "wo",
        /// Read and write; where it is mappable, the PDO mapping states the direction.
        Rw = "rw",
        /// Read and write, a process input: may be mapped into TPDOs.
        Rwr = "rwr",
        /// Read and write, a process output: may be mapped into RPDOs.
        Rww = "rww",
    }
}

/// Access over the bus, and whether a service lock guards writing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AccessRight {
    /// The access.
    pub access: Access,
    /// Writable only while the device is unlocked for service (the manual's `r(w)`).
    pub locked: bool,
}

impl Access {
    /// Whether an SDO client may read.
    pub const fn is_readable(self) -> bool {
        match self {
            Access::Const | Access::Ro | Access::Rw | Access::Rwr | Access::Rww => true,
            Access::Wo => false,
        }
    }

    /// Whether an SDO client may write.
    pub const fn is_writable(self) -> bool {
        match self {
            Access::Wo | Access::Rw | Access::Rwr | Access::Rww => true,
            Access::Const | Access::Ro => false,
        }
    }

    /// The access type of an EDS, which holds the direction of the PDO mapping as well.
    pub const fn joined(self, pdo: PdoMapping) -> Self {
        match (self, pdo) {
            (Access::Rw, PdoMapping::Receive) => Access::Rww,
            (Access::Rw, PdoMapping::Transmit) => Access::Rwr,
            (access, _) => access,
        }
    }
}

word_enum! {
    /// Into which PDOs an entry may be mapped.
    PdoMapping {
        /// Not at all.
        None = "none",
        /// Into RPDOs: the device receives it.
        Receive = "receive",
        /// Into TPDOs: the device sends it.
        Transmit = "transmit",
        /// Into both.
        Both = "both",
    }
}

impl PdoMapping {
    /// Whether it may be mapped into a PDO of this direction.
    pub const fn allows(self, direction: Direction) -> bool {
        match self {
            PdoMapping::None => false,
            PdoMapping::Receive => matches!(direction, Direction::Receive),
            PdoMapping::Transmit => matches!(direction, Direction::Transmit),
            PdoMapping::Both => true,
        }
    }
}

word_enum! {
    /// Direction of a PDO, seen from the device.
    Direction {
        /// RPDO.
        Receive = "receive",
        /// TPDO.
        Transmit = "transmit",
    }
}

impl Direction {
    /// `RPDO` or `TPDO`.
    pub const fn pdo(self) -> &'static str {
        match self {
            Direction::Receive => "RPDO",
            Direction::Transmit => "TPDO",
        }
    }

    /// Index of the communication parameter of PDO 1 (CiA 301).
    pub const fn first_communication_index(self) -> u16 {
        match self {
            Direction::Receive => 0x1400,
            Direction::Transmit => 0x1800,
        }
    }
}

word_enum! {
    /// Which "store parameters" command (1010h) saves an entry.
    Storage {
        /// Lost at power-off.
        No = "no",
        /// 1010h.2, communication parameters.
        Communication = "communication",
        /// 1010h.3, application parameters.
        Application = "application",
        /// 1010h.4 and above, manufacturer parameters.
        Manufacturer = "manufacturer",
        /// Kept by the device itself over power-off, without a command.
        Remanent = "remanent",
    }
}

word_enum! {
    /// Whether a standard demands an object.
    Category {
        /// Every device of the profile has it.
        Mandatory = "mandatory",
        /// A device may leave it out.
        Optional = "optional",
        /// Demanded under a condition.
        Conditional = "conditional",
    }
}

word_enum! {
    /// What a 16-bit alias gives for a value outside its own range.
    Outside {
        /// The nearest value it can show.
        Saturate = "saturate",
        /// The low bits.
        Wrap = "wrap",
        /// An SDO abort.
        Abort = "abort",
    }
}

word_enum! {
    /// How a rescaling alias rounds.
    Rounding {
        /// Towards minus infinity.
        Down = "down",
        /// Towards plus infinity.
        Up = "up",
        /// To the nearest, halves away from zero.
        Nearest = "nearest",
        /// Towards zero.
        Zero = "zero",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_follow_width_and_sign() {
        assert_eq!(DataType::Integer8.range(), Some((-128, 127)));
        assert_eq!(DataType::Unsigned64.range(), Some((0, i128::from(u64::MAX))));
        assert_eq!(DataType::Integer64.range(), Some((i128::from(i64::MIN), i128::from(i64::MAX))));
        assert_eq!(DataType::Real32.range(), None);
    }

    #[test]
    fn names_and_codes_are_unique() {
        let names: std::collections::BTreeSet<_> = DataType::ALL.iter().map(|t| t.name()).collect();
        let codes: std::collections::BTreeSet<_> = DataType::ALL.iter().map(|t| t.code()).collect();
        assert_eq!((names.len(), codes.len()), (25, 25));
        assert_eq!(DataType::from_name("integer24"), Some(DataType::Integer24));
        assert_eq!(DataType::TimeOfDay.to_string(), "TIME_OF_DAY");
        assert_eq!([0x10, 0x0E].map(DataType::from_code), [Some(DataType::Integer24), None]);
    }
}
