//! Values of entries, and conversion between an alias and its target.

use super::{DataType, Family, Outside, Ratio, Real, Rounding};

/// A default or parameter value.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// An integer or, as 0 or 1, a BOOLEAN.
    Integer(i128),
    /// The node-ID plus an offset (`$NODEID+0x180`).
    NodeId(u64),
    /// A floating-point number.
    Real(Real),
    /// A visible or unicode string.
    Text(String),
    /// An octet string.
    Bytes(Vec<u8>),
}

impl Value {
    /// The integer, with the formula resolved for a node; `None` for a value that is not an integer.
    pub fn integer_for(&self, node: u8) -> Option<i128> {
        match self {
            Value::Integer(value) => Some(*value),
            Value::NodeId(offset) => Some(i128::from(*offset) + i128::from(node)),
            Value::Real(_) | Value::Text(_) | Value::Bytes(_) => None,
        }
    }

    /// The bytes of the value on the bus (CiA 301 7.1.4), least significant first, with the formula resolved for a node;
    /// `None` when the type does not have this value. A BOOLEAN fills a byte.
    pub fn bytes_for(&self, data_type: DataType, node: u8) -> Option<Vec<u8>> {
        match data_type.family() {
            Family::Boolean | Family::Signed | Family::Unsigned => {
                let (low, high) = data_type.range()?;
                let size = usize::from(data_type.bits()?.div_ceil(8));
                let raw = self.integer_for(node).filter(|raw| (low..=high).contains(raw))?;
                raw.to_le_bytes().get(..size).map(<[u8]>::to_vec)
            }
            Family::Real => self.real().map(|real| real_bytes(real.number(), data_type)),
            Family::VisibleString => self.text().map(|text| text.as_bytes().to_vec()),
            Family::UnicodeString => {
                self.text().map(|text| text.encode_utf16().flat_map(u16::to_le_bytes).collect())
            }
            Family::OctetString => self.octets().map(<[u8]>::to_vec),
            // Nothing in a specification is such a value.
            Family::Time | Family::Domain => None,
        }
    }

    /// The value that bytes on the bus represent; `None` where the type has no value of these bytes: another number of
    /// them, a BOOLEAN that is neither 0 nor 1, a REAL that is not a number, bytes that are not a text. What has no
    /// values of its own, a time or a DOMAIN, has none either.
    pub fn from_bytes(data_type: DataType, bytes: &[u8]) -> Option<Self> {
        match data_type.family() {
            Family::Boolean | Family::Signed | Family::Unsigned => {
                if bytes.len() != usize::from(data_type.bits()?.div_ceil(8)) {
                    return None;
                }
                let is_negative = data_type.is_signed() && bytes.last().is_some_and(|byte| *byte >= 0x80);
                let mut whole = [if is_negative { 0xFF } else { 0 }; 16];
                whole.get_mut(..bytes.len())?.copy_from_slice(bytes);
                let raw = i128::from_le_bytes(whole);
                let (low, high) = data_type.range()?;
                (low..=high).contains(&raw).then_some(Value::Integer(raw))
            }
            Family::Real => real_of(data_type, bytes).map(Value::Real),
            // `bytes_for` writes them in UTF-8.
            Family::VisibleString => std::str::from_utf8(bytes).ok().map(|text| Value::Text(text.to_owned())),
            Family::UnicodeString => {
                let (units, rest) = bytes.as_chunks::<2>();
                let text = char::decode_utf16(units.iter().map(|unit| u16::from_le_bytes(*unit)));
                let text = text.collect::<Result<String, _>>().ok()?;
                rest.is_empty().then_some(Value::Text(text))
            }
            Family::OctetString => Some(Value::Bytes(bytes.to_vec())),
            Family::Time | Family::Domain => None,
        }
    }

    /// The integer, if the value is one and no formula.
    pub const fn integer(&self) -> Option<i128> {
        match self {
            Value::Integer(value) => Some(*value),
            Value::NodeId(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_) => None,
        }
    }

    /// The floating-point number, if the value is one.
    pub const fn real(&self) -> Option<&Real> {
        match self {
            Value::Real(real) => Some(real),
            Value::Integer(_) | Value::NodeId(_) | Value::Text(_) | Value::Bytes(_) => None,
        }
    }

    fn text(&self) -> Option<&str> {
        match self {
            Value::Text(text) => Some(text),
            Value::Integer(_) | Value::NodeId(_) | Value::Real(_) | Value::Bytes(_) => None,
        }
    }

    fn octets(&self) -> Option<&[u8]> {
        match self {
            Value::Bytes(bytes) => Some(bytes),
            Value::Integer(_) | Value::NodeId(_) | Value::Real(_) | Value::Text(_) => None,
        }
    }
}

/// A number in IEEE 754; of 32 bits, the nearest that there is.
#[expect(clippy::cast_possible_truncation, reason = "the nearest value that the type has")]
fn real_bytes(number: f64, data_type: DataType) -> Vec<u8> {
    if data_type == DataType::Real32 {
        (number as f32).to_le_bytes().to_vec()
    } else {
        number.to_le_bytes().to_vec()
    }
}

/// The number of bytes in IEEE 754, as its shortest text says it.
fn real_of(data_type: DataType, bytes: &[u8]) -> Option<Real> {
    let text = if data_type == DataType::Real32 {
        f32::from_le_bytes(bytes.try_into().ok()?).to_string()
    } else {
        f64::from_le_bytes(bytes.try_into().ok()?).to_string()
    };
    Real::read(&text, data_type)
}

/// The raw value that an alias shows for a raw value of its target; `None` means an SDO abort.
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
    fn bytes_are_those_on_the_bus() {
        let bytes = |value: Value, data_type| value.bytes_for(data_type, 5);
        let text = || Value::Text("aé".to_owned());
        for (value, data_type, expected) in [
            (Value::Integer(1), DataType::Boolean, Some(vec![1])),
            (Value::Integer(-2), DataType::Integer24, Some(vec![0xFE, 0xFF, 0xFF])),
            (Value::Integer(0x1234), DataType::Unsigned16, Some(vec![0x34, 0x12])),
            (Value::NodeId(0x180), DataType::Unsigned32, Some(vec![0x85, 1, 0, 0])),
            (Value::NodeId(0), DataType::Unsigned8, Some(vec![5])),
            (Value::Real(1.5.into()), DataType::Real32, Some(vec![0, 0, 0xC0, 0x3F])),
            (Value::Real((-2.0).into()), DataType::Real64, Some(vec![0, 0, 0, 0, 0, 0, 0, 0xC0])),
            (Value::Text("ab".to_owned()), DataType::VisibleString, Some(b"ab".to_vec())),
            (text(), DataType::UnicodeString, Some(vec![0x61, 0, 0xE9, 0])),
            (Value::Bytes(vec![1, 0xFF]), DataType::OctetString, Some(vec![1, 0xFF])),
            (Value::Integer(128), DataType::Integer8, None),
            (Value::NodeId(251), DataType::Unsigned8, None),
            (Value::Integer(1), DataType::Real32, None),
            (Value::Integer(1), DataType::VisibleString, None),
            (Value::Integer(1), DataType::TimeOfDay, None),
            (text(), DataType::OctetString, None),
            (Value::Bytes(vec![1]), DataType::Domain, None),
        ] {
            assert_eq!(bytes(value.clone(), data_type), expected, "{value:?} as {data_type}");
        }
    }

    #[test]
    fn bytes_are_read_back() {
        for data_type in DataType::ALL {
            let Some((low, high)) = data_type.range() else { continue };
            for raw in [low, low + 1, 0, high - 1, high] {
                let value = Value::Integer(raw);
                let bytes = value.bytes_for(data_type, 5).unwrap();
                assert_eq!(Value::from_bytes(data_type, &bytes), Some(value), "{raw} as {data_type}");
                let longer = [&bytes[..], &[0]].concat();
                assert_eq!(Value::from_bytes(data_type, &longer), None, "{raw} as {data_type} and a byte");
                assert_eq!(Value::from_bytes(data_type, &bytes[1..]), None, "{raw} as {data_type}, cut off");
            }
        }
        let read = Value::from_bytes;
        assert_eq!(read(DataType::Boolean, &[2]), None);
        let tenth = Value::Real(Real::read("0.1", DataType::Real32).unwrap());
        assert_eq!(
            read(DataType::Real32, &tenth.bytes_for(DataType::Real32, 1).unwrap()),
            Some(tenth.clone())
        );
        assert_eq!(read(DataType::Real64, &tenth.bytes_for(DataType::Real64, 1).unwrap()), Some(tenth));
        assert_eq!(read(DataType::Real32, &f32::NAN.to_le_bytes()), None);
        assert_eq!(read(DataType::Real64, &f64::INFINITY.to_le_bytes()), None);
        assert_eq!(read(DataType::Real64, &[0; 4]), None);
        let text = Value::Text("aé".to_owned());
        assert_eq!(read(DataType::VisibleString, "aé".as_bytes()), Some(text.clone()));
        assert_eq!(read(DataType::VisibleString, &[0xE9]), None);
        assert_eq!(read(DataType::UnicodeString, &[0x61, 0, 0xE9, 0]), Some(text));
        assert_eq!(read(DataType::UnicodeString, &[0x61]), None);
        assert_eq!(read(DataType::UnicodeString, &[0, 0xD8]), None);
        assert_eq!(read(DataType::OctetString, &[1, 0xFF]), Some(Value::Bytes(vec![1, 0xFF])));
        assert_eq!(read(DataType::Domain, &[1]), None);
        assert_eq!(read(DataType::TimeOfDay, &[0; 6]), None);
    }

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
    fn a_rescaling_alias_rounds_as_stated() {
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
