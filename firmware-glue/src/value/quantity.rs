//! Physical units with exact scales.

use core::fmt;

use crate::value::image::OutOfRange;

/// An exact scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Fraction {
    /// Above the line; positive.
    pub numerator: u64,
    /// Below the line; positive.
    pub denominator: u64,
}

/// An exact offset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SignedFraction {
    /// Above the line.
    pub numerator: i64,
    /// Below the line; positive.
    pub denominator: u64,
}

impl SignedFraction {
    /// No offset.
    pub const ZERO: Self = Self { numerator: 0, denominator: 1 };
}

/// A quantity counted in steps of another unit.
#[doc(hidden)]
pub struct Steps {
    /// Whole steps, rounded down.
    pub whole: i128,
    /// Whether nothing is left of the quantity.
    pub is_exact: bool,
}

/// A raw value with its unit. One raw step is [`SCALE`](Self::SCALE) times [`SYMBOL`](Self::SYMBOL), and they are counted from
/// [`OFFSET`](Self::OFFSET); nothing is ever a float.
pub trait Quantity: Copy {
    /// The unit's symbol, such as `mV`.
    const SYMBOL: &'static str;
    /// One raw step in the symbol.
    const SCALE: Fraction;
    /// One raw step in the unit's base.
    const STEP: Fraction;
    /// What the raw value 0 means in the symbol.
    const OFFSET: SignedFraction = SignedFraction::ZERO;
    /// What the raw value 0 means in the unit's base.
    const ORIGIN: SignedFraction = SignedFraction::ZERO;
    /// What quantities have to share to be converted into each other, such as V for millivolts and volts.
    type Base;
    /// The same unit around another raw type.
    type With<T>;

    /// The raw value.
    fn number(self) -> i128;

    /// A quantity with this raw value, if the raw type has it.
    fn from_number<T: Raw>(number: i128) -> Option<Self::With<T>>;

    /// The same quantity in another unit.
    ///
    /// # Errors
    /// [`OutOfRange`] when it is no whole number of the other unit's steps, or does not fit its raw type.
    fn convert<Q, T>(self) -> Result<Q::With<T>, OutOfRange>
    where
        Q: Quantity<Base = Self::Base>,
        T: Raw,
    {
        let Steps { whole, is_exact } = self.in_steps_of::<Q>().ok_or(OutOfRange)?;
        if is_exact { Q::from_number(whole).ok_or(OutOfRange) } else { Err(OutOfRange) }
    }

    /// The same quantity in another unit, rounded down to its steps.
    ///
    /// # Errors
    /// [`OutOfRange`] when it does not fit the raw type.
    fn convert_down<Q, T>(self) -> Result<Q::With<T>, OutOfRange>
    where
        Q: Quantity<Base = Self::Base>,
        T: Raw,
    {
        let Steps { whole, .. } = self.in_steps_of::<Q>().ok_or(OutOfRange)?;
        Q::from_number(whole).ok_or(OutOfRange)
    }

    /// The quantity in steps of another unit; `None` where 128 bits do not hold the product.
    #[doc(hidden)]
    fn in_steps_of<Q: Quantity>(self) -> Option<Steps> {
        let wide = |number: u64| i128::from(number);
        let numerator = wide(Self::STEP.numerator).checked_mul(wide(Q::STEP.denominator))?;
        let denominator = wide(Self::STEP.denominator).checked_mul(wide(Q::STEP.numerator))?;
        let product = self.number().checked_mul(numerator)?;
        let (product, denominator) = if Self::ORIGIN == Q::ORIGIN {
            (product, denominator)
        } else {
            // The distance of the origins is so many steps of the other unit, too.
            let [here, there] = [Self::ORIGIN, Q::ORIGIN];
            let (here_below, there_below) = (wide(here.denominator), wide(there.denominator));
            let apart = i128::from(here.numerator)
                .checked_mul(there_below)?
                .checked_sub(i128::from(there.numerator).checked_mul(here_below)?)?
                .checked_mul(wide(Q::STEP.denominator))?;
            let below = here_below.checked_mul(there_below)?.checked_mul(wide(Q::STEP.numerator))?;
            let sum = product.checked_mul(below)?.checked_add(apart.checked_mul(denominator)?)?;
            (sum, denominator.checked_mul(below)?)
        };
        Some(Steps {
            whole: product.checked_div_euclid(denominator)?,
            is_exact: product.checked_rem_euclid(denominator)? == 0,
        })
    }
}

/// An integer type that raw values have.
pub trait Raw: Copy {
    /// The value.
    fn number(self) -> i128;
    /// The value, if the type has it.
    fn from_number(number: i128) -> Option<Self>;
}

macro_rules! raw {
    ($($type:ty)+) => {
        $(impl Raw for $type {
            #[inline]
            fn number(self) -> i128 {
                self.into()
            }

            #[inline]
            fn from_number(number: i128) -> Option<Self> {
                Self::try_from(number).ok()
            }
        })+
    };
}

raw!(i8 i16 i32 i64 u8 u16 u32 u64);

/// Writes a quantity with its unit: `50.0 °C`; where the scale is no short decimal, `7 × 1/3 s`.
#[doc(hidden)]
pub fn show<Q: Quantity>(quantity: Q, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let Fraction { numerator, denominator } = Q::SCALE;
    let SignedFraction { numerator: above, denominator: below } = Q::OFFSET;
    let raw = quantity.number();
    let is_exact = |power: u64| power.is_multiple_of(denominator) && power.is_multiple_of(below);
    let places = (0u32..=12).find(|places| 10u64.checked_pow(*places).is_some_and(is_exact));
    let scaled = places.and_then(|places| {
        let power = 10u64.checked_pow(places)?;
        let factor = i128::from(power / denominator).checked_mul(numerator.into())?;
        let offset = i128::from(power / below).checked_mul(above.into())?;
        Some((raw.checked_mul(factor)?.checked_add(offset)?, places))
    });
    match scaled {
        Some((value, 0)) => write!(f, "{value} {}", Q::SYMBOL),
        Some((value, places)) => {
            let sign = if value < 0 { "-" } else { "" };
            let (value, power) = (value.unsigned_abs(), 10u128.pow(places));
            let width = usize::try_from(places).unwrap_or_default();
            write!(f, "{sign}{}.{:0width$} {}", value / power, value % power, Q::SYMBOL)
        }
        None if above == 0 => write!(f, "{raw} × {numerator}/{denominator} {}", Q::SYMBOL),
        None => write!(f, "{raw} × {numerator}/{denominator} + {above}/{below} {}", Q::SYMBOL),
    }
}

/// Makes a unit: a newtype around any raw integer.
#[macro_export]
macro_rules! unit {
    (
        $(#[$about:meta])*
        pub struct $name:ident = $symbol:literal, scale $n:literal / $d:literal, step $sn:literal / $sd:literal of $base:ident
        $(, offset $on:literal / $od:literal, origin $bn:literal / $bd:literal)?;
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
        #[repr(transparent)]
        pub struct $name<__T>(pub __T);

        $crate::quantity! {
            $name = $symbol, scale $n / $d, step $sn / $sd of $base
            $(, offset $on / $od, origin $bn / $bd)?
        }
    };
}

/// Makes a newtype around any raw integer a unit.
#[macro_export]
macro_rules! quantity {
    (
        $name:ident = $symbol:literal, scale $n:literal / $d:literal, step $sn:literal / $sd:literal of $base:ident
        $(, offset $on:literal / $od:literal, origin $bn:literal / $bd:literal)?
    ) => {
        impl<__T: $crate::quantity::Raw> $crate::Quantity for $name<__T> {
            const SYMBOL: &'static str = $symbol;
            const SCALE: $crate::quantity::Fraction =
                $crate::quantity::Fraction { numerator: $n, denominator: $d };
            const STEP: $crate::quantity::Fraction =
                $crate::quantity::Fraction { numerator: $sn, denominator: $sd };
            $(
                const OFFSET: $crate::quantity::SignedFraction =
                    $crate::quantity::SignedFraction { numerator: $on, denominator: $od };
                const ORIGIN: $crate::quantity::SignedFraction =
                    $crate::quantity::SignedFraction { numerator: $bn, denominator: $bd };
            )?
            type Base = bases::$base;
            type With<__U> = $name<__U>;

            fn number(self) -> i128 {
                self.0.number()
            }

            fn from_number<__U: $crate::quantity::Raw>(number: i128) -> ::core::option::Option<$name<__U>> {
                <__U as $crate::quantity::Raw>::from_number(number).map($name)
            }
        }

        /// The value with its unit.
        impl<__T: $crate::quantity::Raw> ::core::fmt::Display for $name<__T> {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                $crate::quantity::show(*self, f)
            }
        }

        /// The value with its unit.
        impl<__T: $crate::quantity::Raw> ::core::fmt::Debug for $name<__T> {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                $crate::quantity::show(*self, f)
            }
        }

        $crate::defmt_quantity!($name);
    };
}

#[cfg(feature = "defmt")]
#[doc(hidden)]
#[macro_export]
macro_rules! defmt_quantity {
    ($name:ident) => {
        impl<__T: $crate::quantity::Raw> $crate::defmt::Format for $name<__T> {
            fn format(&self, f: $crate::defmt::Formatter<'_>) {
                $crate::quantity::log(*self, f);
            }
        }
    };
}

#[cfg(not(feature = "defmt"))]
#[doc(hidden)]
#[macro_export]
macro_rules! defmt_quantity {
    ($name:ident) => {};
}

/// Logs a quantity: raw value, scale, offset and symbol.
#[cfg(feature = "defmt")]
#[doc(hidden)]
pub fn log<Q: Quantity>(quantity: Q, f: defmt::Formatter<'_>) {
    let Fraction { numerator, denominator } = Q::SCALE;
    let SignedFraction { numerator: above, denominator: below } = Q::OFFSET;
    if above != 0 {
        defmt::write!(
            f,
            "{=i128} × {=u64}/{=u64} + {=i64}/{=u64} {=str}",
            quantity.number(),
            numerator,
            denominator,
            above,
            below,
            Q::SYMBOL
        );
    } else if (numerator, denominator) == (1, 1) {
        defmt::write!(f, "{=i128} {=str}", quantity.number(), Q::SYMBOL);
    } else {
        defmt::write!(
            f,
            "{=i128} × {=u64}/{=u64} {=str}",
            quantity.number(),
            numerator,
            denominator,
            Q::SYMBOL
        );
    }
}
