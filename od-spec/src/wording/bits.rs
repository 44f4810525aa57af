//! Bit fields: what is set in a value.

use super::{Word, Wording};
use crate::model::BitField;

impl Wording {
    /// The fields that are not 0 in a value, each by its name; of a run of bits also its value, with its meaning if it has one.
    pub fn set_bits(self, fields: &[BitField], raw: i128) -> Vec<String> {
        let named = fields.iter().filter_map(|field| {
            let value = value_of(field, raw);
            if value == 0 {
                return None;
            }
            let name = match (field.name.as_str(), field.first == field.last) {
                ("", true) => format!("{} {}", self.word(Word::NamelessBit), field.first),
                ("", false) => format!("{} {}..{}", self.word(Word::NamelessBits), field.first, field.last),
                (name, _) => name.to_owned(),
            };
            if field.first == field.last {
                return Some(name);
            }
            let known = field.values.iter().find(|known| known.value == value);
            Some(match known {
                Some(known) => format!("{name} = {value} {}", known.name),
                None => format!("{name} = {value}"),
            })
        });
        named.collect()
    }
}

/// The value of a field inside that of all bits.
const fn value_of(field: &BitField, raw: i128) -> i128 {
    raw >> field.first & !(!0 << (field.last - field.first + 1))
}
