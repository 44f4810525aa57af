//! The data types of CiA 301.

/// Data type, by its index in the dictionary (CiA 301 table 39).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
#[expect(missing_docs, reason = "the names are those of the standard")]
pub enum DataType {
    Boolean = 0x01,
    Integer8 = 0x02,
    Integer16 = 0x03,
    Integer32 = 0x04,
    Unsigned8 = 0x05,
    Unsigned16 = 0x06,
    Unsigned32 = 0x07,
    Real32 = 0x08,
    VisibleString = 0x09,
    OctetString = 0x0A,
    UnicodeString = 0x0B,
    TimeOfDay = 0x0C,
    TimeDifference = 0x0D,
    Domain = 0x0F,
    Integer24 = 0x10,
    Real64 = 0x11,
    Integer40 = 0x12,
    Integer48 = 0x13,
    Integer56 = 0x14,
    Integer64 = 0x15,
    Unsigned24 = 0x16,
    Unsigned40 = 0x18,
    Unsigned48 = 0x19,
    Unsigned56 = 0x1A,
    Unsigned64 = 0x1B,
}

/// The data types whose length varies up to a capacity. With the numbers of [`DataType`], the one becomes the other without a
/// search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum StringType {
    Visible = DataType::VisibleString as u8,
    Octet = DataType::OctetString as u8,
    Unicode = DataType::UnicodeString as u8,
}

impl DataType {
    /// Whether it is an INTEGERn.
    pub const fn is_signed(self) -> bool {
        match self {
            Self::Integer8
            | Self::Integer16
            | Self::Integer24
            | Self::Integer32
            | Self::Integer40
            | Self::Integer48
            | Self::Integer56
            | Self::Integer64 => true,
            Self::Boolean
            | Self::Unsigned8
            | Self::Unsigned16
            | Self::Unsigned24
            | Self::Unsigned32
            | Self::Unsigned40
            | Self::Unsigned48
            | Self::Unsigned56
            | Self::Unsigned64
            | Self::Real32
            | Self::Real64
            | Self::VisibleString
            | Self::OctetString
            | Self::UnicodeString
            | Self::TimeOfDay
            | Self::TimeDifference
            | Self::Domain => false,
        }
    }

    /// Whether it is a string, whose length varies up to its capacity.
    pub const fn is_string(self) -> bool {
        self.string().is_some()
    }

    /// Whether limits can be about it: INTEGERn, UNSIGNEDn or REALn.
    pub const fn has_order(self) -> bool {
        self.is_integer() || matches!(self, Self::Real32 | Self::Real64)
    }

    /// Whether it is a number that lists of values are about: INTEGERn or UNSIGNEDn.
    pub const fn is_integer(self) -> bool {
        self.integer_bits().is_some()
    }

    /// Bytes of a value; `None` of a string and of a DOMAIN, whose length varies.
    pub const fn size(self) -> Option<u16> {
        match self {
            Self::Boolean | Self::Integer8 | Self::Unsigned8 => Some(1),
            Self::Integer16 | Self::Unsigned16 => Some(2),
            Self::Integer24 | Self::Unsigned24 => Some(3),
            Self::Integer32 | Self::Unsigned32 | Self::Real32 => Some(4),
            Self::Integer40 | Self::Unsigned40 => Some(5),
            Self::Integer48 | Self::Unsigned48 | Self::TimeOfDay | Self::TimeDifference => Some(6),
            Self::Integer56 | Self::Unsigned56 => Some(7),
            Self::Integer64 | Self::Unsigned64 | Self::Real64 => Some(8),
            Self::VisibleString | Self::OctetString | Self::UnicodeString | Self::Domain => None,
        }
    }

    /// Bits of an INTEGERn or UNSIGNEDn.
    pub(crate) const fn integer_bits(self) -> Option<u32> {
        match self {
            Self::Integer8 | Self::Unsigned8 => Some(8),
            Self::Integer16 | Self::Unsigned16 => Some(16),
            Self::Integer24 | Self::Unsigned24 => Some(24),
            Self::Integer32 | Self::Unsigned32 => Some(32),
            Self::Integer40 | Self::Unsigned40 => Some(40),
            Self::Integer48 | Self::Unsigned48 => Some(48),
            Self::Integer56 | Self::Unsigned56 => Some(56),
            Self::Integer64 | Self::Unsigned64 => Some(64),
            Self::Boolean
            | Self::Real32
            | Self::Real64
            | Self::VisibleString
            | Self::OctetString
            | Self::UnicodeString
            | Self::TimeOfDay
            | Self::TimeDifference
            | Self::Domain => None,
        }
    }

    /// Which string it is, if it is one.
    #[inline]
    pub(crate) const fn string(self) -> Option<StringType> {
        match self {
            Self::VisibleString => Some(StringType::Visible),
            Self::OctetString => Some(StringType::Octet),
            Self::UnicodeString => Some(StringType::Unicode),
            Self::Boolean
            | Self::Integer8
            | Self::Integer16
            | Self::Integer24
            | Self::Integer32
            | Self::Integer40
            | Self::Integer48
            | Self::Integer56
            | Self::Integer64
            | Self::Unsigned8
            | Self::Unsigned16
            | Self::Unsigned24
            | Self::Unsigned32
            | Self::Unsigned40
            | Self::Unsigned48
            | Self::Unsigned56
            | Self::Unsigned64
            | Self::Real32
            | Self::Real64
            | Self::TimeOfDay
            | Self::TimeDifference
            | Self::Domain => None,
        }
    }
}
