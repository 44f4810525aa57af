//! Words that are written where a standard has a number or a word of its own: data types, object types, access types, bit
//! rates.
//!
//! One table for the readers of EDS and XDD, for the rules over their texts, for what `odgen fix` writes, and for suggestions
//! in a specification. Only what leaves no doubt is in it: an `int` has 16 bits in a PLC and 32 in C.

use crate::model::{Access, BIT_RATES, DataType, Family};

/// A text in lower case, without spaces and the signs that divide words.
fn plain(text: &str) -> String {
    let is_divider = |c: &char| matches!(c, ' ' | '\t' | '_' | '-' | '/');
    text.chars().filter(|c| !is_divider(c)).map(|c| c.to_ascii_lowercase()).collect()
}

/// A text in front of the number that it ends with.
fn with_number(text: &str) -> Option<(&str, u16)> {
    let letters = text.trim_end_matches(|c: char| c.is_ascii_digit());
    Some((letters, text[letters.len()..].parse().ok()?))
}

/// The data type of a name: that of CiA 301, or one of C, Rust or a PLC.
pub fn data_type(text: &str) -> Option<DataType> {
    let lower = text.to_ascii_lowercase();
    let word = plain(lower.strip_suffix("_t").unwrap_or(&lower));
    if let Some((letters, width)) = with_number(&word) {
        let family = match letters {
            "integer" | "int" | "i" | "s" | "sint" | "signed" => Family::Signed,
            "unsigned" | "uint" | "u" | "uinteger" | "unsignedint" | "unsignedinteger" => Family::Unsigned,
            "real" | "float" | "f" => Family::Real,
            _ => return None,
        };
        let is_it = |known: &DataType| known.family() == family && known.bits() == Some(width);
        return DataType::ALL.into_iter().find(is_it);
    }
    Some(match word.as_str() {
        "bool" => DataType::Boolean,
        "sint" => DataType::Integer8,
        "dint" => DataType::Integer32,
        "lint" => DataType::Integer64,
        "usint" | "byte" => DataType::Unsigned8,
        "word" => DataType::Unsigned16,
        "udint" | "dword" => DataType::Unsigned32,
        "ulint" | "lword" => DataType::Unsigned64,
        "float" | "real" => DataType::Real32,
        "double" | "lreal" => DataType::Real64,
        "string" => DataType::VisibleString,
        "timediff" => DataType::TimeDifference,
        other => return DataType::ALL.into_iter().find(|known| plain(known.name()) == other),
    })
}

/// The number of an object type (CiA 301 table 42) by its name.
pub fn object_code(text: &str) -> Option<u8> {
    Some(match plain(text).as_str() {
        "null" => 0,
        "domain" => 2,
        "deftype" => 5,
        "defstruct" => 6,
        "var" | "variable" => 7,
        "array" => 8,
        "record" => 9,
        _ => return None,
    })
}

/// An access type, in the words of an EDS, an XDD or a manual.
pub fn access(text: &str) -> Option<Access> {
    Some(match plain(text).as_str() {
        "const" | "constant" => Access::Const,
        "ro" | "r" | "read" | "readonly" => Access::Ro,
        "wo" | "w" | "write" | "writeonly" => Access::Wo,
        "rw" | "wr" | "readwrite" => Access::Rw,
        "rwr" | "readwriteinput" => Access::Rwr,
        "rww" | "readwriteoutput" => Access::Rww,
        _ => return None,
    })
}

/// Yes or no.
pub(crate) fn yes_no(text: &str) -> Option<bool> {
    match plain(text).as_str() {
        "yes" | "true" => Some(true),
        "no" | "false" => Some(false),
        _ => None,
    }
}

/// A bit rate of CiA 301 in kbit/s, of a number of kbit/s or bit/s, with its unit or without: `500`, `500000`, `500 Kbps`.
pub(crate) fn bit_rate(text: &str) -> Option<u16> {
    let word = plain(text);
    let unit = word.trim_start_matches(|c: char| c.is_ascii_digit());
    let number: u32 = word[..word.len() - unit.len()].parse().ok()?;
    let bits = match unit {
        // Every rate in bit/s is far above every one in kbit/s.
        "" if number <= 1000 => number.checked_mul(1000)?,
        "" | "bit" | "bits" | "bps" | "baud" => number,
        "k" | "kb" | "kbit" | "kbits" | "kbps" | "kbaud" => number.checked_mul(1000)?,
        "m" | "mb" | "mbit" | "mbits" | "mbps" | "mbaud" => number.checked_mul(1_000_000)?,
        _ => return None,
    };
    BIT_RATES.into_iter().find(|rate| u32::from(*rate) * 1000 == bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_data_type_is_known_by_many_names() {
        for known in DataType::ALL {
            for name in [known.name().to_owned(), known.to_string(), known.to_string().replace('_', " ")] {
                assert_eq!(data_type(&name), Some(known), "{name}");
            }
        }
        for (names, known) in [
            (
                &["UNSIGNED 16", "Unsigned_16", "U16", "uint16", "UINT16", "uint16_t", "WORD"][..],
                DataType::Unsigned16,
            ),
            (&["INTEGER8", "int8_t", "i8", "S8", "SINT"], DataType::Integer8),
            (&["Unsigned24", "u24"], DataType::Unsigned24),
            (&["REAL32", "float32", "f32", "float", "REAL"], DataType::Real32),
            (&["VisibleString", "visible string", "STRING"], DataType::VisibleString),
            (&["BOOL", "boolean"], DataType::Boolean),
            (&["TIME_DIFF", "time difference"], DataType::TimeDifference),
        ] {
            for name in names {
                assert_eq!(data_type(name), Some(known), "{name}");
            }
        }
        for name in ["", "int", "uint", "UNSIGNED", "uint9", "real16", "u", "16", "0x0007", "PDO_MAPPING"] {
            assert_eq!(data_type(name), None, "{name}: 16 bits in a PLC, 32 in C, or none");
        }
    }

    #[test]
    fn words_are_known_in_any_spelling() {
        let codes = ["NULL", "Domain", "DEFTYPE", "DefStruct", "var", "ARRAY", "Record"].map(object_code);
        assert_eq!(codes, [0, 2, 5, 6, 7, 8, 9].map(Some));
        assert_eq!(["", "7", "VARS"].map(object_code), [None; 3]);
        for (words, known) in [
            (&["R/W", "rw", "RW", "readWrite", "read/write", "Read-Write", "w/r"][..], Access::Rw),
            (&["R", "read only", "readOnly", "RO"], Access::Ro),
            (&["W", "write_only", "write"], Access::Wo),
            (&["readWriteInput", "RWR"], Access::Rwr),
            (&["readWriteOutput"], Access::Rww),
            (&["constant", "CONST"], Access::Const),
        ] {
            for word in words {
                assert_eq!(access(word), Some(known), "{word}");
            }
        }
        assert_eq!(["", "noAccess", "UNKNOWN", "rwx"].map(access), [None; 4]);
        assert_eq!(["Yes", "no", "TRUE", "maybe"].map(yes_no), [Some(true), Some(false), Some(true), None]);
    }

    #[test]
    fn a_bit_rate_is_known_in_every_unit() {
        for text in ["500", "500000", "500K", "500 Kbps", "500 kbit/s", "500kBaud", "500000 bit/s"] {
            assert_eq!(bit_rate(text), Some(500), "{text}");
        }
        assert_eq!(
            ["1M", "1 Mbit/s", "1000", "1000000", "10000"].map(bit_rate),
            [1000, 1000, 1000, 1000, 10].map(Some)
        );
        for text in ["", "0", "K", "333", "auto", "500G", "4294967295M", "99999999999"] {
            assert_eq!(bit_rate(text), None, "{text}");
        }
    }
}
