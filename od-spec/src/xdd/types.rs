//! Data types: by their index, or by the element of a parameter.

use roxmltree::Node;

use super::tree::child;
use crate::model::DataType;

/// The data type of an index in hexadecimal digits: `0007`, or with less of them.
pub(super) fn of_index(text: &str) -> Option<DataType> {
    let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")).unwrap_or(text);
    let code = u16::from_str_radix(digits, 16).ok()?;
    DataType::ALL.into_iter().find(|known| known.code() == code)
}

/// The data type that an element below a parameter, or below a type of the list, names.
pub(super) fn of_element(parameter: Node<'_, '_>) -> Option<DataType> {
    parameter.children().filter(Node::is_element).find_map(|element| {
        Some(match element.tag_name().name() {
            "BOOL" => DataType::Boolean,
            "SINT" => DataType::Integer8,
            "INT" => DataType::Integer16,
            "DINT" => DataType::Integer32,
            "LINT" => DataType::Integer64,
            "USINT" | "BYTE" | "CHAR" => DataType::Unsigned8,
            "UINT" | "WORD" => DataType::Unsigned16,
            "UDINT" | "DWORD" => DataType::Unsigned32,
            "ULINT" | "LWORD" => DataType::Unsigned64,
            "REAL" => DataType::Real32,
            "LREAL" => DataType::Real64,
            "STRING" => DataType::VisibleString,
            "WSTRING" => DataType::UnicodeString,
            // The exact type is lost; one with a value is no DOMAIN.
            "BITSTRING" if child(parameter, "defaultValue").is_some() => DataType::OctetString,
            "BITSTRING" => DataType::Domain,
            _ => return None,
        })
    })
}
