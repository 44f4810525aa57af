//! Values in EDS notation (CiA 306 4.3).

use od_spec::model::{DataType, Entry, Object, TypeKind, Value};
use od_spec::wording::format_value;

/// How the values of an entry are written.
pub(crate) struct Notation<'a> {
    pub object: &'a Object,
    pub entry: &'a Entry,
    /// The node for which formulas are resolved; `None` to write `$NODEID`.
    pub node: Option<u8>,
}

impl Notation<'_> {
    /// A value: bit fields and PDO parameters in hexadecimal, other integers in decimal.
    pub(crate) fn text(&self, value: &Value) -> String {
        let width = self.digits();
        match (value, self.node) {
            (Value::NodeId(0), None) => "$NODEID".to_owned(),
            (Value::NodeId(offset), None) => format!("$NODEID+0x{offset:X}"),
            (Value::NodeId(offset), Some(node)) => format!("0x{:0width$X}", offset + u64::from(node)),
            (Value::Integer(raw), _) if self.is_hexadecimal() => format!("0x{raw:0width$X}"),
            (Value::Integer(raw), _) => raw.to_string(),
            // With a decimal point even where the number is whole.
            (Value::Real(real), _) => format!("{:?}", real.number()),
            (Value::Bytes(_), _) => format_value(self.entry, value),
            (Value::Text(text), _) => text.clone(),
        }
    }

    /// Hexadecimal digits of the entry's type.
    fn digits(&self) -> usize {
        usize::from(self.entry.data_type.bits().unwrap_or(32).div_ceil(4))
    }

    /// Whether integers are read bit by bit. Signed ones are decimal for every reader's sake.
    fn is_hexadecimal(&self) -> bool {
        let data_type = self.entry.data_type;
        let named = self.entry.named_type.as_ref().map(|named| &named.kind);
        let is_pdo_parameter = self.object.role().is_pdo_parameter() && data_type == DataType::Unsigned32;
        data_type.is_unsigned() && (matches!(named, Some(TypeKind::Bits(_))) || is_pdo_parameter)
    }
}
