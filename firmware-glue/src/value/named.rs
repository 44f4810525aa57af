//! Enums and bit fields: newtypes around their raw number, so that a value without a name is still a value.

use core::fmt;

/// A raw number that has no name in an enum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UnknownValue<T>(pub T);

/// A value of an enum, with its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NamedValue {
    /// The raw value.
    pub value: i64,
    /// Its name in the specification.
    pub name: &'static str,
}

/// A bit of a bit field, or a run of bits, with its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NamedBits {
    /// Lowest bit, from 0 on.
    pub first: u8,
    /// Highest bit, up to 63.
    pub last: u8,
    /// Name in the specification.
    pub name: &'static str,
}

/// A type of which some values have names.
pub trait Enumeration: Copy {
    /// Name of the type, as the specification spells it.
    const TYPE: &'static str;
    /// Values with their names, ascending.
    const NAMES: &'static [NamedValue];

    /// The raw value.
    fn number(self) -> i64;

    /// The name of the value, where it has one.
    fn name(self) -> Option<&'static str> {
        let at = Self::NAMES.binary_search_by_key(&self.number(), |named| named.value).ok()?;
        Self::NAMES.get(at).map(|named| named.name)
    }

    /// Whether the value has a name.
    fn is_known(self) -> bool {
        self.name().is_some()
    }
}

/// A type whose bits have names.
pub trait BitField: Copy {
    /// Name of the type, as the specification spells it.
    const TYPE: &'static str;
    /// Every used part, ascending.
    const FIELDS: &'static [NamedBits];

    /// The raw value.
    fn bits(self) -> u64;
}

/// Writes `battery type: lead gel (2)`, or `battery type: 9` for a value without a name.
#[doc(hidden)]
pub fn show_value<T: Enumeration>(value: T, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match value.name() {
        Some(name) => write!(f, "{}: {name} ({})", T::TYPE, value.number()),
        None => write!(f, "{}: {}", T::TYPE, value.number()),
    }
}

/// Writes `statusword: 0x0237 (ready to switch on, step = 3)`: the parts that are not 0.
#[doc(hidden)]
pub fn show_bits<T: BitField>(value: T, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    write!(f, "{}: {:#06x}", T::TYPE, value.bits())?;
    let mut separator = " (";
    for NamedBits { first, last, name } in T::FIELDS {
        let part = value.bits() >> first & (u64::MAX >> (63 - (last - first)));
        match (part, first == last) {
            (0, _) => continue,
            (_, true) => write!(f, "{separator}{name}")?,
            (_, false) => write!(f, "{separator}{name} = {part}")?,
        }
        separator = ", ";
    }
    if separator == ", " { f.write_str(")") } else { Ok(()) }
}

/// Implements what every enum can do.
#[macro_export]
macro_rules! enumeration {
    ($name:ident($raw:ty) = $label:literal { $($value:literal => $text:literal,)* }) => {
        impl $crate::Enumeration for $name {
            const TYPE: &'static str = $label;
            const NAMES: &'static [$crate::named::NamedValue] =
                &[$($crate::named::NamedValue { value: $value, name: $text }),*];

            fn number(self) -> i64 {
                i64::try_from($crate::quantity::Raw::number(self.0)).unwrap_or_default()
            }
        }

        impl $name {
            /// The value of a raw number, if it has a name.
            pub fn known(raw: $raw) -> ::core::result::Result<Self, $crate::UnknownValue<$raw>> {
                if $crate::Enumeration::is_known(Self(raw)) {
                    ::core::result::Result::Ok(Self(raw))
                } else {
                    ::core::result::Result::Err($crate::UnknownValue(raw))
                }
            }
        }

        impl ::core::fmt::Debug for $name {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                $crate::named::show_value(*self, f)
            }
        }

        $crate::defmt_named!($name, value);
    };
}

/// Implements what every bit field can do.
#[macro_export]
macro_rules! bit_field {
    ($name:ident = $label:literal { $($first:literal..=$last:literal => $text:literal,)* }) => {
        impl $crate::BitField for $name {
            const TYPE: &'static str = $label;
            const FIELDS: &'static [$crate::named::NamedBits] =
                &[$($crate::named::NamedBits { first: $first, last: $last, name: $text }),*];

            fn bits(self) -> u64 {
                self.0.into()
            }
        }

        impl ::core::fmt::Debug for $name {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                $crate::named::show_bits(*self, f)
            }
        }

        $crate::defmt_named!($name, bits);
    };
}

#[cfg(feature = "defmt")]
#[doc(hidden)]
#[macro_export]
macro_rules! defmt_named {
    ($name:ident, $kind:ident) => {
        impl $crate::defmt::Format for $name {
            fn format(&self, f: $crate::defmt::Formatter<'_>) {
                $crate::defmt_named!(@ $kind, *self, f);
            }
        }
    };
    (@ value, $value:expr, $f:expr) => { $crate::named::log_value($value, $f) };
    (@ bits, $value:expr, $f:expr) => { $crate::named::log_bits($value, $f) };
}

#[cfg(not(feature = "defmt"))]
#[doc(hidden)]
#[macro_export]
macro_rules! defmt_named {
    ($name:ident, $kind:ident) => {};
}

/// Logs a value with its name.
#[cfg(feature = "defmt")]
#[doc(hidden)]
pub fn log_value<T: Enumeration>(value: T, f: defmt::Formatter<'_>) {
    defmt::write!(f, "{=str}: {=str} ({=i64})", T::TYPE, value.name().unwrap_or("?"), value.number());
}

/// Logs the bits.
#[cfg(feature = "defmt")]
#[doc(hidden)]
pub fn log_bits<T: BitField>(value: T, f: defmt::Formatter<'_>) {
    defmt::write!(f, "{=str}: {=u64:#x}", T::TYPE, value.bits());
}

/// Logs types that have a `name`.
#[cfg(feature = "defmt")]
#[doc(hidden)]
#[macro_export]
macro_rules! defmt_text {
    ($name:ident) => {
        impl $crate::defmt::Format for $name {
            fn format(&self, f: $crate::defmt::Formatter<'_>) {
                $crate::named::log_text(self.name(), f);
            }
        }
    };
}

/// Logs types that have a `name`.
#[cfg(not(feature = "defmt"))]
#[doc(hidden)]
#[macro_export]
macro_rules! defmt_text {
    ($name:ident) => {};
}

/// Logs a name.
#[cfg(feature = "defmt")]
#[doc(hidden)]
pub fn log_text(name: &str, f: defmt::Formatter<'_>) {
    defmt::write!(f, "{=str}", name);
}
