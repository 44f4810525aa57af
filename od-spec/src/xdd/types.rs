//! Data types: by their index, by a word, or by the element of a parameter.

use roxmltree::Node;

use super::tree::child;
use crate::model::DataType;
use crate::notation::words;

/// The data type of an index in hexadecimal digits: `0007`, or with less of them.
pub(super) fn of_index(text: &str) -> Option<DataType> {
    let digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")).unwrap_or(text);
    DataType::from_code(u16::from_str_radix(digits, 16).ok()?)
}

/// The data type of a word: that of an element, where `INT` has the length that it has in a PLC, or one that is known
/// elsewhere.
pub(super) fn of_word(word: &str) -> Option<DataType> {
    match word {
        "INT" => Some(DataType::Integer16),
        "UINT" => Some(DataType::Unsigned16),
        "CHAR" => Some(DataType::Unsigned8),
        "WSTRING" => Some(DataType::UnicodeString),
        other => words::data_type(other),
    }
}

/// The data type that an element below a parameter, or below a type of the list, names.
pub(super) fn of_element(parameter: Node<'_, '_>) -> Option<DataType> {
    let elements = parameter.children().filter(Node::is_element);
    elements.map(|element| element.tag_name().name()).find_map(|name| match name {
        // The exact type is lost; one with a value is no DOMAIN.
        "BITSTRING" if child(parameter, "defaultValue").is_some() => Some(DataType::OctetString),
        "BITSTRING" => Some(DataType::Domain),
        _ => of_word(name),
    })
}
