//! How raw values are carried in C, and how they are read from bytes and put there.

use od_gen::plan::{Members, Plan, ValueKind};
use od_spec::model::{DataType, Family, Value};

use super::super::literal::{Integer, real32, real64, string};

/// How a raw value is carried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Raw {
    /// With the bits that it has on the bus.
    Integer(Integer, u16),
    Bool,
    Single,
    Double,
    String,
    Time,
    /// A DOMAIN lies with the application: there is no value of it.
    Nothing,
}

impl Raw {
    pub(super) fn of(plan: &Plan<'_>, kind: &ValueKind) -> Self {
        match kind.data_type.family() {
            Family::Signed | Family::Unsigned => match Integer::of(kind.data_type) {
                // The bits of a word are counted without a sign.
                Some(integer) if is_bits(plan, kind) => {
                    Raw::Integer(integer.unsigned(), kind.data_type.bits().unwrap_or(64))
                }
                Some(integer) => Raw::Integer(integer, kind.data_type.bits().unwrap_or(64)),
                None => Raw::Nothing,
            },
            Family::Boolean => Raw::Bool,
            Family::Real if kind.data_type == DataType::Real32 => Raw::Single,
            Family::Real => Raw::Double,
            Family::VisibleString | Family::OctetString | Family::UnicodeString => Raw::String,
            Family::Time => Raw::Time,
            Family::Domain => Raw::Nothing,
        }
    }

    /// The type without a name of its own.
    pub(super) fn type_name(self) -> String {
        match self {
            Raw::Integer(integer, _) => integer.name(),
            Raw::Bool => "bool".to_owned(),
            Raw::Single => "float".to_owned(),
            Raw::Double => "double".to_owned(),
            Raw::String => "od_bytes_t".to_owned(),
            Raw::Time => "od_time_t".to_owned(),
            Raw::Nothing => "void".to_owned(),
        }
    }

    /// The value at a pointer.
    pub(super) fn load(self, pointer: &str) -> Option<String> {
        Some(match self {
            Raw::Integer(Integer { signed, bits }, on_bus) if u16::from(bits) == on_bus => {
                format!("od_get_{}{bits}({pointer})", if signed { 'i' } else { 'u' })
            }
            Raw::Integer(integer, on_bus) => {
                let get = if integer.signed { "signed" } else { "unsigned" };
                format!("({})od_get_{get}({pointer}, {}U)", integer.name(), on_bus / 8)
            }
            Raw::Bool => format!("(*{pointer} != 0U)"),
            Raw::Single => format!("od_get_real32({pointer})"),
            Raw::Double => format!("od_get_real64({pointer})"),
            Raw::Time => format!("od_get_time({pointer})"),
            Raw::String | Raw::Nothing => return None,
        })
    }

    /// Bits on the bus, where their number is fixed.
    pub(super) const fn bits(self) -> Option<u16> {
        match self {
            Raw::Integer(_, bits) => Some(bits),
            Raw::Bool => Some(1),
            Raw::Single => Some(32),
            Raw::Double => Some(64),
            Raw::Time => Some(48),
            Raw::String | Raw::Nothing => None,
        }
    }

    /// The statement that puts a value at a pointer.
    pub(super) fn store(self, pointer: &str, value: &str) -> Option<String> {
        Some(match self {
            Raw::Integer(Integer { signed, bits }, on_bus) if u16::from(bits) == on_bus => {
                format!("od_put_{}{bits}({pointer}, {value});", if signed { 'i' } else { 'u' })
            }
            Raw::Integer(integer, on_bus) => {
                let put = if integer.signed { "signed" } else { "unsigned" };
                format!("od_put_{put}({pointer}, {}U, {value});", on_bus / 8)
            }
            Raw::Bool => format!("*{pointer} = {value} ? 1U : 0U;"),
            Raw::Single => format!("od_put_real32({pointer}, {value});"),
            Raw::Double => format!("od_put_real64({pointer}, {value});"),
            Raw::Time => format!("od_put_time({pointer}, {value});"),
            Raw::String | Raw::Nothing => return None,
        })
    }

    /// That `value` is beyond what travels, for a width that C does not have.
    pub(super) fn is_outside(self) -> Option<String> {
        let Raw::Integer(integer, on_bus) = self else { return None };
        if u16::from(integer.bits) == on_bus {
            return None;
        }
        let high = (1i128 << if integer.signed { on_bus - 1 } else { on_bus }) - 1;
        let above = format!("(value > {})", integer.literal(high));
        Some(if integer.signed {
            format!("{above} || (value < {})", integer.literal(-high - 1))
        } else {
            above
        })
    }

    /// A value as a constant expression; `None` where C has none.
    pub(super) fn literal(self, value: &Value) -> Option<String> {
        match (self, value) {
            (Raw::Bool, Value::Integer(raw)) => Some(if *raw == 0 { "(false)" } else { "(true)" }.to_owned()),
            // The bits of a negative default of a word.
            (Raw::Integer(integer, on_bus), Value::Integer(raw)) if !integer.signed && *raw < 0 => {
                Some(integer.literal(raw + (1 << on_bus)))
            }
            (Raw::Integer(integer, _), Value::Integer(raw)) => Some(integer.literal(*raw)),
            (Raw::Single, Value::Real(real)) => real32(real.number()),
            (Raw::Double, Value::Real(real)) => real64(real.number()),
            (Raw::String, Value::Text(text)) if text.is_ascii() => Some(string(text.as_bytes())),
            _ => None,
        }
    }
}

fn is_bits(plan: &Plan<'_>, kind: &ValueKind) -> bool {
    let named = kind.named.as_ref().and_then(|name| plan.types.iter().find(|planned| planned.name == *name));
    named.is_some_and(|planned| matches!(planned.members, Members::Bits(_)))
}
