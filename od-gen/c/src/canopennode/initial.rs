//! What the variables begin with.

use od_gen::plan::factory;
use od_spec::model::{Entry, EntryId};
use od_spec::wording::Radix;

use super::super::literal::{Integer, real32, real64, string};
use super::cell::Cell;

/// The longest string literal that every compiler takes (C99 5.2.4.1).
const LONGEST_LITERAL: usize = 4095;

/// The initialiser of a variable: the value after a factory reset, without the node-ID.
pub(super) fn initialiser(id: EntryId, entry: &Entry, cell: Cell) -> String {
    let bytes = factory(id, entry).and_then(|value| value.bytes_for(entry.data_type, 0)).unwrap_or_default();
    let number = |width: usize| little_endian(bytes.get(..width).unwrap_or(&bytes));
    let literal = match cell {
        Cell::Boolean => Integer { signed: false, bits: 8 }.literal(number(1).into()),
        Cell::Integer(integer) => integer_literal(id, entry, integer, number(usize::from(integer.bits / 8))),
        // A number that is not valid is not a default.
        Cell::Real32 => {
            let number = f32::from_le_bytes(bytes.first_chunk().copied().unwrap_or_default());
            real32(number.into()).unwrap_or_else(|| "0.0F".to_owned())
        }
        Cell::Real64 => {
            let number = f64::from_le_bytes(bytes.first_chunk().copied().unwrap_or_default());
            real64(number).unwrap_or_else(|| "0.0".to_owned())
        }
        Cell::Bytes(length) => {
            let room = usize::try_from(length).unwrap_or(usize::MAX);
            let used = bytes.get(..bytes.len().min(room)).unwrap_or_default();
            list(used.iter().map(|byte| format!("0x{byte:02X}U")))
        }
        Cell::Characters(_) if bytes.len() >= LONGEST_LITERAL => {
            list(bytes.iter().map(|byte| format!("(char)0x{byte:02X}U")))
        }
        Cell::Characters(_) => string(&bytes),
        Cell::WideCharacters(_) => {
            let (units, _) = bytes.as_chunks::<2>();
            list(units.iter().map(|unit| format!("0x{:04X}U", u16::from_le_bytes(*unit))))
        }
    };
    // In a place of its own, brackets are needed around nothing.
    match literal.strip_prefix('(').and_then(|inside| inside.strip_suffix(')')) {
        Some(inside) if !literal.starts_with("(char)") => inside.to_owned(),
        _ => literal,
    }
}

fn integer_literal(id: EntryId, entry: &Entry, integer: Integer, bits: u64) -> String {
    if !integer.signed && Radix::of(Some(id.index), entry) == Radix::Hexadecimal {
        return integer.pattern(bits, integer.bits);
    }
    let value = i128::from(bits);
    let is_negative = integer.signed && bits >> (integer.bits - 1) & 1 == 1;
    integer.literal(if is_negative { value - (1 << integer.bits) } else { value })
}

/// Bytes after which everything is zero.
fn list(items: impl Iterator<Item = String>) -> String {
    let items: Vec<String> = items.collect();
    if items.is_empty() { "{0U}".to_owned() } else { format!("{{{}}}", items.join(", ")) }
}

fn little_endian(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte))
}
