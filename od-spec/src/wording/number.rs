//! Numbers: patterns and counts, physical values, node-ID formulas.

use super::{Notation, Word, Wording};
use crate::model::{DataType, Entry, Index, Ratio, TypeKind, Unit, Value};

/// How the numbers of an entry are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Radix {
    /// A pattern of bits: hexadecimal, as wide as the type.
    Hexadecimal,
    /// A count, a measure or a code: decimal.
    Decimal,
}

impl Radix {
    /// That of an entry; without an index, what the entry alone shows.
    pub fn of(index: Option<Index>, entry: &Entry) -> Self {
        match entry.named_type.as_ref().map(|named| &named.kind) {
            Some(TypeKind::Bits(_)) => Self::Hexadecimal,
            Some(TypeKind::Enum(_)) => Self::Decimal,
            None => {
                // Identities, COB-IDs and mapping parameters: they are not used in decimal.
                let is_code = entry.data_type == DataType::Unsigned32 && entry.unit.is_none();
                let is_communication = index.is_some_and(Index::is_communication_profile);
                if is_code && is_communication { Self::Hexadecimal } else { Self::Decimal }
            }
        }
    }

    /// That of a special value: a pattern where the standards print one.
    pub fn of_special(entry: &Entry, raw: i128) -> Self {
        let is_bits = matches!(entry.named_type.as_ref().map(|named| &named.kind), Some(TypeKind::Bits(_)));
        let highest_byte_is_full =
            entry.data_type.bits().is_some_and(|bits| bits >= 8 && raw >> (bits - 8) == 0xFF);
        let is_pattern = entry.data_type.is_unsigned() && (raw > 0xFFFF || highest_byte_is_full);
        if is_bits || is_pattern { Self::Hexadecimal } else { Self::Decimal }
    }
}

impl Wording {
    /// A hexadecimal number of at least so many digits: `0180h` in the documents, `0x0180` elsewhere.
    pub fn hexadecimal(self, number: u128, digits: usize) -> String {
        match self.notation {
            Notation::Manual => format!("{number:0digits$X}h"),
            Notation::Eds | Notation::Rust | Notation::Json | Notation::Diagnostic => {
                format!("0x{number:0digits$X}")
            }
        }
    }

    /// A raw value as the hexadecimal digits of its type: `FFh` for -1 in 8 bits.
    pub fn pattern(self, data_type: DataType, raw: i128) -> String {
        let bits = data_type.bits().unwrap_or(64);
        self.hexadecimal(raw.rem_euclid(1 << bits).unsigned_abs(), usize::from(bits.div_ceil(4)))
    }

    /// A raw value as its radix has it.
    pub(super) fn raw(self, radix: Radix, data_type: DataType, raw: i128) -> String {
        match radix {
            Radix::Hexadecimal => self.pattern(data_type, raw),
            Radix::Decimal => raw.to_string(),
        }
    }

    /// The number of an enum's value, in decimal; in the manual also as a pattern where that reads otherwise, as manuals and
    /// standards print either: `-113 (8Fh)`.
    pub fn enum_number(self, data_type: DataType, raw: i128) -> String {
        let reads_alike = (0..10).contains(&raw) || (data_type.is_signed() && raw >= 0);
        match self.notation {
            Notation::Manual if !reads_alike => format!("{raw} ({})", self.pattern(data_type, raw)),
            Notation::Manual | Notation::Eds | Notation::Rust | Notation::Json | Notation::Diagnostic => {
                raw.to_string()
            }
        }
    }

    /// The node-ID plus an offset: `180h + node-ID`, `$NODEID+0x180`. An offset with flag bits of a COB-ID has all its digits.
    pub fn node_id_formula(self, offset: u64) -> String {
        match self.notation {
            Notation::Manual => format!("{} + {}", self.cob_id(offset.into()), self.word(Word::NodeId)),
            Notation::Eds | Notation::Rust | Notation::Json | Notation::Diagnostic => {
                format!("$NODEID+0x{offset:X}")
            }
        }
    }

    /// A COB-ID entry with its flag bits (CiA 301 7.5.2.35): `80000300h + node-ID`; empty for what is not a number.
    pub fn cob_id_entry(self, cob_id: &Value) -> String {
        self.masked(cob_id, u64::from(u32::MAX))
    }

    /// The CAN-ID of a COB-ID entry, which has up to 29 bits: `300h + node-ID`; empty for what is not a number.
    pub fn can_id(self, cob_id: &Value) -> String {
        self.masked(cob_id, 0x1FFF_FFFF)
    }

    fn masked(self, cob_id: &Value, mask: u64) -> String {
        match cob_id {
            Value::NodeId(offset) => self.node_id_formula(offset & mask),
            Value::Integer(raw) => self.cob_id(raw.unsigned_abs() & u128::from(mask)),
            Value::Real(_) | Value::Text(_) | Value::Bytes(_) => String::new(),
        }
    }

    /// Three digits, or eight where flag bits or a 29-bit CAN-ID are set.
    fn cob_id(self, raw: u128) -> String {
        self.hexadecimal(raw, if raw > 0xFFFF { 8 } else { 3 })
    }

    /// A mapping parameter (CiA 301 7.5.2.36): in the documents by its parts, index, sub-index and bits: `6040 00 10h`.
    pub fn mapping_parameter(self, parameter: u32) -> String {
        match self.notation {
            Notation::Manual => {
                format!("{:04X} {:02X} {:02X}h", parameter >> 16, parameter >> 8 & 0xFF, parameter & 0xFF)
            }
            Notation::Eds | Notation::Rust | Notation::Json | Notation::Diagnostic => {
                self.hexadecimal(parameter.into(), 8)
            }
        }
    }

    /// A raw value in its unit: `50.0 °C`.
    pub fn physical(self, unit: &Unit, raw: i128) -> String {
        self.quantity(&self.decimal(&unit.amount(raw)), &unit.symbol)
    }

    /// The same with the raw value after it, where that is another number and the reader has to send it: `50.0 °C
    /// (500)`.
    pub(super) fn physical_and_raw(self, unit: &Unit, raw: i128) -> String {
        self.with_raw(unit, &self.decimal(&unit.amount(raw)), &raw.to_string())
    }

    /// An amount with its symbol, and the raw value where that is another number and the reader has to send it.
    pub(super) fn with_raw(self, unit: &Unit, amount: &str, raw: &str) -> String {
        let amount = self.quantity(amount, &unit.symbol);
        match self.notation {
            Notation::Eds | Notation::Manual if !unit.is_plain() => format!("{amount} ({raw})"),
            Notation::Eds | Notation::Manual | Notation::Rust | Notation::Json | Notation::Diagnostic => {
                amount
            }
        }
    }

    /// What one raw step is worth, as a heading says it: `0.1 °C`; of a step of 1 the symbol alone. An offset follows:
    /// `0.1 °C from -40 °C`.
    pub fn step(self, unit: &Unit) -> String {
        if unit.is_plain() { unit.symbol.clone() } else { self.counted_step(unit) }
    }

    /// What one raw step is worth, and what it is counted from, as a sentence says it: `1 mV`, `0.1 °C from -40 °C`.
    pub fn counted_step(self, unit: &Unit) -> String {
        let amount = |number: Ratio| self.quantity(&self.decimal(&number.to_string()), &unit.symbol);
        let step = amount(unit.scale);
        if unit.offset == Ratio::ZERO {
            return step;
        }
        format!("{step} {} {}", self.word(Word::From), amount(unit.offset))
    }

    /// A number with the symbol of its unit, where it has one: `50.0 °C`. In the manual, signs of plane angle follow the number
    /// directly: `0.01°`.
    pub fn quantity(self, amount: &str, symbol: &str) -> String {
        let space = match (self.notation, symbol) {
            (_, "") | (Notation::Manual, "°" | "′" | "″") => "",
            _ => " ",
        };
        format!("{amount}{space}{symbol}")
    }

    /// A number that was written with a decimal point, as the language writes it.
    pub fn decimal(self, number: &str) -> String {
        self.language.decimal(number)
    }
}
