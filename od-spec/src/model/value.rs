//! Values of entries, and conversion between an alias and its target.

use super::{DataType, Outside, Ratio, Rounding};

/// A default or parameter value.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// An integer or, as 0 or 1, a BOOLEAN.
    Integer(i128),
    /// The node-ID plus an offset (`$NODEID+0x180`).
    NodeId(u64),
    /// A floating-point number.
    Real(f64),
    /// A visible or unicode string.
    Text(String),
    /// An octet string.
    Bytes(Vec<u8>),
}

impl Value {
    /// The integer, with the formula resolved for a node.
    pub fn integer_for(&self, node: u8) -> Option<i128> {
        match self {
            Value::Integer(value) => Some(*value),
            Value::NodeId(offset) => Some(i128::from(*offset) + i128::from(node)),
            _ => None,
        }
    }

    /// The bytes of the value on the bus, least significant first, with a node-ID of 0 in a formula; `None` when the
    /// type does not have this value.
    pub fn bytes_in(&self, data_type: DataType) -> Option<Vec<u8>> {
        let integer = |raw: i128| {
            let (low, high) = data_type.range()?;
            let size = usize::from(data_type.bits()?.div_ceil(8));
            (low..=high).contains(&raw).then(|| raw.to_le_bytes()[..size].to_vec())
        };
        match (self, data_type) {
            (Value::Integer(raw), _) => integer(*raw),
            (Value::NodeId(offset), _) => integer(i128::from(*offset)),
            #[expect(clippy::cast_possible_truncation, reason = "the nearest value that the type has")]
            (Value::Real(number), DataType::Real32) => Some((*number as f32).to_le_bytes().to_vec()),
            (Value::Real(number), DataType::Real64) => Some(number.to_le_bytes().to_vec()),
            (Value::Text(text), DataType::VisibleString) => Some(text.clone().into_bytes()),
            (Value::Text(text), DataType::UnicodeString) => {
                Some(text.encode_utf16().flat_map(u16::to_le_bytes).collect())
            }
            (Value::Bytes(bytes), DataType::OctetString) => Some(bytes.clone()),
            _ => None,
        }
    }

    /// The integer, if the value is one and no formula.
    pub const fn integer(&self) -> Option<i128> {
        match self {
            Value::Integer(value) => Some(*value),
            _ => None,
        }
    }
}

/// The raw value that an alias shows for a raw value of its target; `None` stands for an SDO abort.
pub fn convert(
    target: i128,
    factor: Ratio,
    rounding: Rounding,
    outside: Outside,
    to: DataType,
) -> Option<i128> {
    let exact = Ratio::whole(target).checked_mul(factor)?;
    let floor = exact.floor();
    let rounded = match (exact.to_whole(), rounding) {
        (Some(whole), _) => whole,
        (None, Rounding::Down) => floor,
        (None, Rounding::Up) => floor + 1,
        (None, Rounding::Zero) => floor + i128::from(target < 0),
        (None, Rounding::Nearest) => {
            let rest = exact.checked_sub(Ratio::whole(floor))?;
            let half = rest.compare(Ratio::new(1, 2)?)?;
            floor + i128::from(half.is_gt() || (half.is_eq() && target >= 0))
        }
    };
    let (low, high) = to.range()?;
    if (low..=high).contains(&rounded) {
        return Some(rounded);
    }
    match outside {
        Outside::Saturate => Some(rounded.clamp(low, high)),
        Outside::Wrap => Some((rounded - low).rem_euclid(high - low + 1) + low),
        Outside::Abort => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_alias_saturates_wraps_or_aborts() {
        let to = |value, outside| convert(value, Ratio::ONE, Rounding::Down, outside, DataType::Integer16);
        for value in [-32768, -1, 0, 32767] {
            assert_eq!(to(value, Outside::Abort), Some(value));
        }
        assert_eq!(to(32768, Outside::Saturate), Some(32767));
        assert_eq!(to(-32769, Outside::Saturate), Some(-32768));
        assert_eq!(to(32768, Outside::Wrap), Some(-32768));
        assert_eq!(to(-32769, Outside::Wrap), Some(32767));
        assert_eq!(to(32768, Outside::Abort), None);
    }

    #[test]
    fn a_rescaling_alias_rounds_as_told() {
        let milli = Ratio::new(1, 1000).unwrap();
        let to = |value, rounding| {
            convert(value, milli, rounding, Outside::Saturate, DataType::Integer16).unwrap()
        };
        assert_eq!(to(560_999, Rounding::Down), 560);
        assert_eq!(to(560_001, Rounding::Up), 561);
        assert_eq!(to(560_500, Rounding::Nearest), 561);
        assert_eq!(to(560_499, Rounding::Nearest), 560);
        assert_eq!(to(-500, Rounding::Nearest), -1);
        assert_eq!(to(-999, Rounding::Zero), 0);
        assert_eq!(to(-999, Rounding::Down), -1);
        assert_eq!(to(7000, Rounding::Up), 7);
    }
}
