//! Values: defaults, special values, values of enums.

use super::{Notation, Radix, Wording};
use crate::model::{
    DataType, Entry, EnumValues, Index, Real, RealLimits, Role, SpecialValue, TypeKind, Value,
};
use crate::scalar;

impl Wording {
    /// A value of an entry. Without an index, what follows from the entry alone.
    pub fn value(self, index: Option<Index>, entry: &Entry, value: &Value) -> String {
        match value {
            Value::Integer(raw) => self.integer(index, entry, *raw),
            Value::NodeId(offset) => self.node_id_formula(*offset),
            Value::Real(real) => self.real(entry, real),
            Value::Text(text) => self.text(text),
            Value::Bytes(bytes) => self.bytes(bytes),
        }
    }

    fn integer(self, index: Option<Index>, entry: &Entry, raw: i128) -> String {
        match entry.special.iter().find(|special| special.value == raw) {
            Some(special) => format!("{} ({})", self.special_number(entry, raw), special.name),
            None => self.ordinary(index, entry, raw),
        }
    }

    /// With a decimal point even where the number is whole, and with its unit where the product has a decimal.
    pub(super) fn real(self, entry: &Entry, real: &Real) -> String {
        let number = self.decimal(&format!("{:?}", real.number()));
        let Some(unit) = &entry.unit else { return number };
        if unit.is_plain() {
            return self.quantity(&number, &unit.symbol);
        }
        let exact = scalar::decimal(&real.number().to_string());
        let shown = exact.and_then(|exact| unit.decimal(exact));
        shown.map_or_else(|| number.clone(), |shown| self.with_raw(unit, &self.decimal(&shown), &number))
    }

    /// A raw value that has no meaning of its own.
    pub(super) fn ordinary(self, index: Option<Index>, entry: &Entry, raw: i128) -> String {
        if entry.data_type == DataType::Boolean {
            return raw.to_string();
        }
        if let Some(TypeKind::Enum(values)) = entry.named_type.as_ref().map(|named| &named.kind) {
            return self.enum_value(entry.data_type, values, raw);
        }
        if let Some(unit) = &entry.unit
            && Radix::of(index, entry) == Radix::Decimal
        {
            return self.physical_and_raw(unit, raw);
        }
        let is_mapping = index.is_some_and(|index| Role::of(index) == Role::PdoMapping) && entry.sub.0 > 0;
        match u32::try_from(raw) {
            Ok(parameter) if is_mapping => self.mapping_parameter(parameter),
            _ => self.raw(Radix::of(index, entry), entry.data_type, raw),
        }
    }

    fn enum_value(self, data_type: DataType, values: &EnumValues, raw: i128) -> String {
        let number = self.enum_number(data_type, raw);
        let Some(value) = values.of(raw) else { return number };
        match self.notation {
            Notation::Eds | Notation::Manual => format!("{number}: {}", value.name),
            Notation::Rust | Notation::Json | Notation::Diagnostic => value.name.clone(),
        }
    }

    /// The number of a special value: `FFFFFFFFh`, `-32768`.
    pub fn special_number(self, entry: &Entry, raw: i128) -> String {
        self.raw(Radix::of_special(entry, raw), entry.data_type, raw)
    }

    /// A special value in a list: `FFFFFFFFh: monitoring off`.
    pub fn special(self, entry: &Entry, special: &SpecialValue) -> String {
        format!("{}: {}", self.special_number(entry, special.value), special.name)
    }

    /// An empty text is not a value to a tool, and no default to a person.
    fn text(self, text: &str) -> String {
        match self.notation {
            Notation::Eds | Notation::Manual | Notation::Rust if text.is_empty() => "\"\"".to_owned(),
            Notation::Eds | Notation::Manual | Notation::Rust | Notation::Json | Notation::Diagnostic => {
                text.to_owned()
            }
        }
    }

    fn bytes(self, bytes: &[u8]) -> String {
        let between = match self.notation {
            Notation::Manual | Notation::Rust => " ",
            Notation::Eds | Notation::Json | Notation::Diagnostic => "",
        };
        bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(between)
    }
}

/// A value as a message shows it, and as a specification may write it.
pub fn format_value(entry: &Entry, value: &Value) -> String {
    Wording::english(Notation::Diagnostic).value(None, entry, value)
}

/// The values that an entry allows apart from its special ones, as a message shows them: the limits or, where there are
/// none, the ends of the data type: `0.0 °C to 40.0 °C`.
pub fn allowed(entry: &Entry) -> String {
    let wording = Wording::english(Notation::Diagnostic);
    let Some((lowest, highest)) = entry.data_type.range() else {
        let end = |limit: &Option<Real>, open: &str| {
            limit.as_ref().map_or_else(|| open.to_owned(), |limit| wording.real(entry, limit))
        };
        let RealLimits { low, high } = &entry.real_limits;
        return format!("{} to {}", end(low, "-infinity"), end(high, "infinity"));
    };
    let end = |raw: i128| wording.ordinary(None, entry, raw);
    format!("{} to {}", end(entry.low.unwrap_or(lowest)), end(entry.high.unwrap_or(highest)))
}
