//! The error register (1001h), and the errors of a device as generated code lists them.

/// Kinds of errors, one bit each: 1001h (CiA 301 table 48).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ErrorRegister(u8);

impl ErrorRegister {
    /// No error.
    pub const NONE: Self = Self(0);
    /// Any error; set with every other.
    pub const GENERIC: Self = Self(1 << 0);
    /// Current.
    pub const CURRENT: Self = Self(1 << 1);
    /// Voltage.
    pub const VOLTAGE: Self = Self(1 << 2);
    /// Temperature.
    pub const TEMPERATURE: Self = Self(1 << 3);
    /// Communication: overrun, error state.
    pub const COMMUNICATION: Self = Self(1 << 4);
    /// What the device profile says.
    pub const PROFILE: Self = Self(1 << 5);
    /// What the manufacturer says.
    pub const MANUFACTURER: Self = Self(1 << 7);

    /// The bits of a number; the reserved bit 6 is left out.
    #[must_use]
    pub const fn from_bits(bits: u8) -> Self {
        Self(bits & !(1 << 6))
    }

    /// The bits as a number.
    #[must_use]
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// These kinds and more.
    #[must_use]
    pub const fn with(self, more: Self) -> Self {
        Self(self.0 | more.0)
    }

    /// The kind that an error code belongs to by its class (CiA 301 table 21), and the generic bit; none of an "error reset".
    #[must_use]
    pub const fn of_code(code: u16) -> Self {
        let kind = match code >> 8 {
            0x00 => return Self::NONE,
            0x20..=0x2F => Self::CURRENT,
            0x30..=0x3F => Self::VOLTAGE,
            0x40..=0x4F => Self::TEMPERATURE,
            0x81..=0x82 => Self::COMMUNICATION,
            0xFF => Self::MANUFACTURER,
            _ => Self::NONE,
        };
        kind.with(Self::GENERIC)
    }

    /// The bits that another node sent, whatever they are.
    pub(crate) const fn received(bits: u8) -> Self {
        Self(bits)
    }
}

/// An error of a device: the type `errors::ErrorCode` of generated code.
pub trait DeviceError: Copy {
    /// The error code (603Fh, 1003h, the emergency message).
    fn code(self) -> u16;

    /// The bits of 1001h that it sets.
    fn register(self) -> ErrorRegister;
}
