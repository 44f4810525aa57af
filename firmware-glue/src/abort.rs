//! SDO abort codes.

use core::fmt;

/// Why an access was refused, as an SDO server reports it to its client (CiA 301 table 20).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct AbortCode(pub u32);

macro_rules! codes {
    ($($(#[$about:meta])* $name:ident = $code:literal, $text:literal;)+) => {
        impl AbortCode {
            $($(#[$about])* pub const $name: Self = Self($code);)+

            /// All codes that the standard defines, ascending.
            pub const ALL: &'static [Self] = &[$(Self::$name,)+];

            /// What the code means, in a few words; `reserved` for one that the standard does not define.
            pub const fn text(self) -> &'static str {
                match self { $(Self::$name => $text,)+ _ => "reserved" }
            }
        }
    };
}

codes! {
    /// 0503 0000h: the toggle bit did not alternate.
    TOGGLE_BIT = 0x0503_0000, "toggle bit not alternated";
    /// 0504 0000h: the other side did not answer in time.
    TIMEOUT = 0x0504_0000, "SDO protocol timed out";
    /// 0504 0001h: a command specifier that the server does not know, or not now.
    COMMAND = 0x0504_0001, "command specifier not valid or unknown";
    /// 0504 0002h: a block size outside 1 to 127.
    BLOCK_SIZE = 0x0504_0002, "invalid block size";
    /// 0504 0003h: a wrong sequence number in a block.
    SEQUENCE = 0x0504_0003, "invalid sequence number";
    /// 0504 0004h: the CRC of a block transfer does not match.
    CRC = 0x0504_0004, "CRC error";
    /// 0504 0005h: no memory for the transfer.
    OUT_OF_MEMORY = 0x0504_0005, "out of memory";
    /// 0601 0000h: an access that the object does not support, such as a change of a PDO mapping in use.
    UNSUPPORTED_ACCESS = 0x0601_0000, "unsupported access to an object";
    /// 0601 0001h: reading what can only be written.
    WRITE_ONLY = 0x0601_0001, "attempt to read a write-only object";
    /// 0601 0002h: writing what can only be read.
    READ_ONLY = 0x0601_0002, "attempt to write a read-only object";
    /// 0602 0000h: there is no object with this index.
    NO_OBJECT = 0x0602_0000, "object does not exist";
    /// 0604 0041h: the entry cannot be mapped into this PDO.
    NOT_MAPPABLE = 0x0604_0041, "object cannot be mapped to the PDO";
    /// 0604 0042h: more entries or bits than the PDO takes.
    PDO_LENGTH = 0x0604_0042, "number and length of mapped objects would exceed PDO length";
    /// 0604 0043h: a value that does not go with the value of another entry.
    INCOMPATIBLE = 0x0604_0043, "general parameter incompatibility";
    /// 0604 0047h: the device contradicts itself.
    INTERNAL = 0x0604_0047, "general internal incompatibility in the device";
    /// 0606 0000h: hardware failed, such as the memory for parameters.
    HARDWARE = 0x0606_0000, "access failed due to a hardware error";
    /// 0607 0010h: the data does not have the form of the type.
    LENGTH = 0x0607_0010, "length of service parameter does not match";
    /// 0607 0012h: more bytes than the type has.
    TOO_LONG = 0x0607_0012, "length of service parameter too high";
    /// 0607 0013h: fewer bytes than the type has.
    TOO_SHORT = 0x0607_0013, "length of service parameter too low";
    /// 0609 0011h: the object has no such sub-index.
    NO_SUB_INDEX = 0x0609_0011, "sub-index does not exist";
    /// 0609 0030h: a value that the entry does not take.
    INVALID_VALUE = 0x0609_0030, "invalid value for parameter";
    /// 0609 0031h: a value above the high limit.
    TOO_HIGH = 0x0609_0031, "value of parameter written too high";
    /// 0609 0032h: a value below the low limit.
    TOO_LOW = 0x0609_0032, "value of parameter written too low";
    /// 0609 0036h: a maximum below the minimum.
    MAXIMUM_BELOW_MINIMUM = 0x0609_0036, "maximum value is less than minimum value";
    /// 060A 0023h: the SDO connection is not available.
    NO_CONNECTION = 0x060A_0023, "resource not available: SDO connection";
    /// 0800 0000h: anything else.
    GENERAL = 0x0800_0000, "general error";
    /// 0800 0020h: the application cannot take or keep the data, such as a wrong signature in 1010h.
    NOT_STORED = 0x0800_0020, "data cannot be transferred or stored to the application";
    /// 0800 0021h: the device is controlled locally.
    LOCAL_CONTROL = 0x0800_0021, "data cannot be transferred because of local control";
    /// 0800 0022h: not in the present state of the device: locked, or its write condition does not hold.
    DEVICE_STATE = 0x0800_0022, "data cannot be transferred because of the present device state";
    /// 0800 0023h: there is no object dictionary.
    NO_DICTIONARY = 0x0800_0023, "no object dictionary is present";
    /// 0800 0024h: there is no value yet.
    NO_DATA = 0x0800_0024, "no data available";
}

/// `0602 0000h: object does not exist`.
impl fmt::Display for AbortCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04X} {:04X}h: {}", self.0 >> 16, self.0 & 0xFFFF, self.text())
    }
}

impl fmt::Debug for AbortCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl core::error::Error for AbortCode {}

#[cfg(feature = "defmt")]
impl defmt::Format for AbortCode {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{=u32:#010x}: {=str}", self.0, self.text());
    }
}
