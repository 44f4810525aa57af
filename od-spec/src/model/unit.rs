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
        if symbol == self.symbol {
            Some(self.scale)
        } else if symbol == self.base_symbol() {
            self.step()
        } else {
            None
        }
    }

    /// A raw value in [`symbol`](Self::symbol), with as many decimal places as a step has: `50.0`. Where no decimal writes a
    /// step exactly, such as a third, the product: `7 × 1/3`.
    pub fn amount(&self, raw: i128) -> String {
        let value = Ratio::whole(raw).checked_mul(self.scale);
        let places = self.scale.decimal_places();
        value.and_then(|value| value.to_decimal(places?)).unwrap_or_else(|| format!("{raw} × {}", self.scale))
    }

    /// The same with its symbol, as a specification writes it: `50.0 °C`.
    pub fn show(&self, raw: i128) -> String {
        format!("{} {}", self.amount(raw), self.symbol)
    }
}
