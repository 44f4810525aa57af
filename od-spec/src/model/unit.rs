//! Physical units with exact scales.

use super::{Expr, Ratio, Statement, Text};

/// A physical unit: what one raw step is worth.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Unit {
    /// Name in the specification, such as `decicelsius`.
    pub name: String,
    /// Symbol, such as `°C`.
    pub symbol: String,
    /// One raw step in `symbol`: 1/10 for a raw value in tenths of a degree.
    pub scale: Ratio,
    /// What the raw value 0 means, in `symbol`: -40 for a raw value that counts from -40 °C.
    pub offset: Ratio,
    /// One `symbol` in terms of another symbol: a millivolt is 1/1000 V.
    pub base: Option<Base>,
    /// What other entries make of one raw step, where the user sets the unit up.
    pub formula: Option<Expr>,
    /// Meaning.
    pub about: Text,
    /// Where it is defined, and by whom.
    pub stated: Statement,
}

/// The relation of a unit's symbol to a more basic one.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Base {
    /// The basic symbol.
    pub symbol: String,
    /// Basic symbols per symbol of the unit.
    pub factor: Ratio,
}

impl Unit {
    /// The basic symbol in which values are compared: the base's, or else the unit's own.
    pub fn base_symbol(&self) -> &str {
        self.base.as_ref().map_or(&self.symbol, |base| &base.symbol)
    }

    /// One raw step in the basic symbol; `None` if the fraction does not fit 128 bits.
    pub fn step(&self) -> Option<Ratio> {
        self.base.as_ref().map_or(Some(self.scale), |base| self.scale.checked_mul(base.factor))
    }

    /// One raw step in the given symbol, if the unit knows it.
    pub fn step_in(&self, symbol: &str) -> Option<Ratio> {
        self.per_symbol(symbol)?.checked_mul(self.scale)
    }

    /// What the raw value 0 means in the given symbol, if the unit knows it.
    pub fn offset_in(&self, symbol: &str) -> Option<Ratio> {
        self.per_symbol(symbol)?.checked_mul(self.offset)
    }

    /// How many of the given symbol make one of the unit's own.
    fn per_symbol(&self, symbol: &str) -> Option<Ratio> {
        match &self.base {
            _ if symbol == self.symbol => Some(Ratio::ONE),
            Some(base) if symbol == base.symbol => Some(base.factor),
            Some(_) | None => None,
        }
    }

    /// The quantity that a raw value represents, in the basic symbol; `None` if the fraction does not fit 128 bits.
    pub fn quantity(&self, raw: i128) -> Option<Ratio> {
        let above = Ratio::whole(raw).checked_mul(self.step()?)?;
        above.checked_add(self.offset_in(self.base_symbol())?)
    }

    /// How many raw steps a quantity in the given symbol is, which need not be a whole number.
    pub fn steps(&self, quantity: Ratio, symbol: &str) -> Option<Ratio> {
        quantity.checked_sub(self.offset_in(symbol)?)?.checked_div(self.step_in(symbol)?)
    }

    /// A raw value that need not be whole in [`symbol`](Self::symbol), if a decimal writes it.
    pub fn decimal(&self, raw: Ratio) -> Option<String> {
        let value = raw.checked_mul(self.scale)?.checked_add(self.offset)?;
        value.to_decimal(value.decimal_places()?.max(1))
    }

    /// Whether a raw value is the number of symbols that it represents.
    pub fn is_plain(&self) -> bool {
        self.scale == Ratio::ONE && self.offset == Ratio::ZERO
    }

    /// A raw value in [`symbol`](Self::symbol), with as many decimal places as a step and the offset have: `50.0`. Where no
    /// decimal writes these exactly, such as a third, the formula: `7 × 1/3`, `7 × 1/3 + -40`.
    pub fn amount(&self, raw: i128) -> String {
        let value =
            Ratio::whole(raw).checked_mul(self.scale).and_then(|above| above.checked_add(self.offset));
        let places = self.scale.decimal_places().zip(self.offset.decimal_places());
        let places = places.map(|(of_scale, of_offset)| of_scale.max(of_offset));
        value.and_then(|value| value.to_decimal(places?)).unwrap_or_else(|| {
            let offset =
                if self.offset == Ratio::ZERO { String::new() } else { format!(" + {}", self.offset) };
            format!("{raw} × {}{offset}", self.scale)
        })
    }

    /// The same with its symbol, as a specification writes it: `50.0 °C`.
    pub fn show(&self, raw: i128) -> String {
        format!("{} {}", self.amount(raw), self.symbol)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::SourceMap;

    fn ratio(numerator: i128, denominator: i128) -> Ratio {
        Ratio::new(numerator, denominator).unwrap()
    }

    fn unit(scale: Ratio, offset: Ratio) -> Unit {
        let mut sources = SourceMap::new();
        let file = sources.add("unit.od.yaml", "");
        Unit {
            name: "unit".to_owned(),
            symbol: "mV".to_owned(),
            scale,
            offset,
            base: Some(Base { symbol: "V".to_owned(), factor: ratio(1, 1000) }),
            formula: None,
            about: Text::default(),
            stated: Statement::derived(sources.whole(file)),
        }
    }

    #[test]
    fn a_raw_value_counts_from_the_offset() {
        let unit = unit(Ratio::whole(10), Ratio::whole(-5000));
        assert_eq!([unit.show(0), unit.show(499), unit.show(501)], ["-5000 mV", "-10 mV", "10 mV"]);
        assert_eq!(unit.quantity(700), Some(Ratio::whole(2)));
        assert_eq!(unit.steps(Ratio::whole(2), "V"), Some(Ratio::whole(700)));
        assert_eq!(unit.steps(Ratio::whole(-4995), "mV"), Some(ratio(1, 2)));
        assert_eq!(unit.steps(Ratio::whole(2), "A"), None);
        assert!(!unit.is_plain());
    }

    #[test]
    fn amounts_have_the_places_of_scale_and_offset() {
        assert_eq!(unit(ratio(1, 10), ratio(-27_315, 100)).amount(2932), "20.05");
        assert_eq!(unit(Ratio::ONE, Ratio::whole(-40)).amount(0), "-40");
        assert_eq!(unit(ratio(1, 3), Ratio::ZERO).amount(7), "7 × 1/3");
        assert_eq!(unit(ratio(1, 3), Ratio::whole(-40)).amount(7), "7 × 1/3 + -40");
        assert_eq!(unit(Ratio::ONE, ratio(1, 3)).amount(7), "7 × 1 + 1/3");
    }
}
