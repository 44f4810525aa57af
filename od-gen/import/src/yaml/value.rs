//! Values as a person would write them: by name, in the unit, bit patterns in hexadecimal.

use od_spec::model::{Entry, EnumValues, Index, NamedType, Ratio, Role, TypeKind, Unit, Value};
use od_spec::scalar;

use super::node::Node;

/// A default, or a limit.
pub(crate) fn value(index: Index, entry: &Entry, value: &Value) -> Node {
    match value {
        Value::NodeId(0) => Node::plain("$NODEID"),
        Value::NodeId(offset) => Node::Plain(format!("$NODEID + 0x{offset:X}")),
        Value::Integer(raw) => integer(index, entry, *raw),
        Value::Real(real) => Node::Plain(format!("{:?}", real.number())),
        Value::Text(text) => Node::text(text.clone()),
        Value::Bytes(bytes) => {
            let pairs: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
            Node::Text(pairs.join(" "))
        }
    }
}

/// A default, or a limit, as its text without the quotes of YAML.
pub fn value_text(index: Index, entry: &Entry, of: &Value) -> String {
    match value(index, entry, of) {
        Node::Text(text) | Node::Plain(text) => text,
        // A value is never a list or a map.
        Node::List(_) | Node::Map(_) | Node::Block(_) => String::new(),
    }
}

fn integer(index: Index, entry: &Entry, raw: i128) -> Node {
    if entry.data_type.range() == Some((0, 1)) {
        return Node::yes_no(raw != 0);
    }
    if let Some(value) = enum_values(entry).and_then(|values| values.of(raw)) {
        return Node::text(value.name.clone());
    }
    match (hexadecimal(index, entry), u32::try_from(raw)) {
        (Some(Hex::Halves), Ok(raw)) => return Node::hex32(raw),
        (Some(Hex::Halves | Hex::Digits), _) if raw >= 0 => return hex(raw),
        (Some(Hex::Halves | Hex::Digits) | None, _) => {}
    }
    let physical = entry
        .unit
        .as_ref()
        .filter(|_| enum_values(entry).is_none_or(|values| values.is_empty()))
        .and_then(|unit| physical(unit, raw));
    physical.map_or_else(|| Node::plain(raw), Node::Text)
}

/// A bit pattern: `0x8001`, `0x0002_0192`.
pub(super) fn hex(raw: i128) -> Node {
    match u32::try_from(raw) {
        Ok(raw @ 0x1_0000..) => Node::hex32(raw),
        _ => Node::Plain(format!("0x{raw:X}")),
    }
}

fn enum_values(entry: &Entry) -> Option<&EnumValues> {
    match entry.named_type.as_deref() {
        Some(NamedType { kind: TypeKind::Enum(values), .. }) => Some(values),
        Some(NamedType { kind: TypeKind::Bits(_), .. }) | None => None,
    }
}

/// How a bit pattern is written.
enum Hex {
    /// Two halves of a 32-bit number.
    Halves,
    /// As many digits as it has.
    Digits,
}

/// Whether the values of an entry are read bit by bit.
fn hexadecimal(index: Index, entry: &Entry) -> Option<Hex> {
    if !entry.data_type.is_unsigned() {
        return None;
    }
    match (Role::of(index), entry.sub.0) {
        (Role::DeviceType, _) | (Role::Identity | Role::PdoMapping, 1..) => return Some(Hex::Halves),
        (Role::PdoCommunication, 1) | (Role::SdoServer | Role::SdoClient, 1 | 2) => return Some(Hex::Digits),
        _ => {}
    }
    let cob_id = matches!((index.0, entry.sub.0), (0x1005 | 0x1012 | 0x1014, 0) | (0x1028, 1..));
    let bits = matches!(entry.named_type.as_deref(), Some(NamedType { kind: TypeKind::Bits(_), .. }));
    (cob_id || bits).then_some(Hex::Digits)
}

/// `50.0 °C`, if it reads as the raw value.
fn physical(unit: &Unit, raw: i128) -> Option<String> {
    let number = scalar::decimal(&unit.amount(raw))?;
    let symbol = &unit.symbol;
    let readable = symbol.trim() == symbol
        && !symbol.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-'));
    let steps = unit.steps(number, symbol)?;
    (readable && !symbol.is_empty() && steps == Ratio::whole(raw)).then(|| unit.show(raw))
}
