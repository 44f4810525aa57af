//! Frames: the bytes of a PDO from its raw values, and back.
//!
//! Only sums, quotients and conversions between types of one width are used: these do the same on every controller, whatever
//! its byte order. A cast of the frame to a structure would not.

use od_spec::model::Direction;

use super::device::Device;
use super::elementary::{Elementary, Kind, convert};
use super::pdos::{Field, PlannedPdo};
use super::phrases::Phrase;
use super::text::{Declaration, Text};

/// A frame.
const BYTES: &str = "ARRAY [0..7] OF BYTE";

/// The bits of a field that lie in one byte.
struct Piece {
    byte: u32,
    /// Lowest bit in the byte.
    first: u32,
    /// How many bits.
    count: u32,
    /// The bit of the field that the lowest one is.
    of_field: u32,
}

impl Piece {
    const fn mask(&self) -> u32 {
        ((1 << self.count) - 1) << self.first
    }
}

/// The pieces of a field, byte by byte.
fn pieces(field: &Field<'_>) -> impl Iterator<Item = Piece> {
    let (first, end) = (field.first, field.first + field.bits);
    (first / 8..end.div_ceil(8)).map(move |byte| {
        let (from, to) = (first.max(byte * 8), end.min(byte * 8 + 8));
        Piece { byte, first: from - byte * 8, count: to - from, of_field: from - first }
    })
}

impl PlannedPdo<'_> {
    /// The function between bytes and structure.
    pub(super) fn print_bytes(&self, device: &Device<'_>, text: &mut Text) {
        let Some(name) = &self.bytes else { return };
        match self.pdo.direction {
            Direction::Transmit => self.print_unpack(device, text, name),
            Direction::Receive => self.print_pack(device, text, name),
        }
    }

    fn print_unpack(&self, device: &Device<'_>, text: &mut Text, name: &str) {
        let length = self.pdo.bits().div_ceil(8).to_string();
        text.line("");
        text.comment(&[device.phrase(Phrase::Unpack, &[&length])]);
        text.line(&format!("FUNCTION {name} : {}", self.type_name));
        text.variables("VAR_INPUT", &[Declaration::new("data", BYTES, "")]);
        text.variables("VAR", &[Declaration::new("raw", &self.type_name, "")]);
        for field in &self.fields {
            let member = format!("raw.{}", field.member);
            text.line(&format!("{member} := {};", of_bytes(field)));
            // The bits of a negative number go on to the left.
            if let Some((_, most)) = field.narrower().filter(|_| field.of_type.kind() == Kind::Signed) {
                text.block(&format!("IF {member} > {most} THEN"), "END_IF;", |text| {
                    text.line(&format!("{member} := {member} - {};", 1_i128 << field.bits));
                });
            }
        }
        text.line(&format!("{name} := raw;"));
        text.line("END_FUNCTION");
    }

    fn print_pack(&self, device: &Device<'_>, text: &mut Text, name: &str) {
        let length = self.pdo.bits().div_ceil(8);
        let local = |at: usize| format!("u{}", at + 1);
        text.line("");
        text.comment(&[device.phrase(Phrase::Pack, &[&length.to_string()])]);
        text.line(&format!("FUNCTION {name} : BOOL"));
        text.variables("VAR_INPUT", &[Declaration::new("raw", &self.type_name, "")]);
        text.variables("VAR_IN_OUT", &[Declaration::new("data", BYTES, "")]);
        let locals = self.fields.iter().enumerate().map(|(at, field)| {
            Declaration::new(local(at), Elementary::unsigned(field.bits).name(), field.member.as_str())
        });
        text.variables("VAR", &locals.collect::<Vec<_>>());
        text.line(&format!("{name} := FALSE;"));
        for field in &self.fields {
            let Some((least, most)) = field.narrower() else { continue };
            let member = format!("raw.{}", field.member);
            let condition = match field.of_type.kind() {
                Kind::Signed => format!("({member} < {least}) OR ({member} > {most})"),
                Kind::BitString => {
                    let number = Elementary::unsigned(field.bits);
                    format!("{} > {most}", convert(field.of_type, number, &member))
                }
                Kind::Unsigned | Kind::Bool | Kind::Real => format!("{member} > {most}"),
            };
            text.block(&format!("IF {condition} THEN"), "END_IF;", |text| text.line("RETURN;"));
        }
        for (at, field) in self.fields.iter().enumerate() {
            print_number(text, field, &local(at));
        }
        for byte in 0..length {
            let parts: Vec<String> = self
                .fields
                .iter()
                .enumerate()
                .flat_map(|(at, field)| pieces(field).map(move |piece| (at, field, piece)))
                .filter(|(.., piece)| piece.byte == byte)
                .map(|(at, field, piece)| to_byte(field, &piece, &local(at)))
                .collect();
            let all = if parts.is_empty() { "16#00".to_owned() } else { parts.join(" OR ") };
            text.line(&format!("data[{byte}] := {all};"));
        }
        text.line(&format!("{name} := TRUE;"));
        text.line("END_FUNCTION");
    }
}

/// The raw value of a field from the bytes that it lies in; of a narrow signed number without its sign.
fn of_bytes(field: &Field<'_>) -> String {
    let number = Elementary::unsigned(field.bits);
    if field.of_type == Elementary::Bool {
        let bit = format!("(data[{}] AND 16#{:02X}) <> 0", field.first / 8, 1 << (field.first % 8));
        return bit;
    }
    let terms: Vec<String> = pieces(field)
        .map(|piece| {
            let byte = format!("data[{}]", piece.byte);
            let byte = if piece.count == 8 { byte } else { format!("{byte} AND 16#{:02X}", piece.mask()) };
            let mut term = convert(Elementary::Byte, number, &byte);
            if piece.first > 0 {
                term = format!("{term} / {}", 1_u32 << piece.first);
            }
            if piece.of_field > 0 {
                term = format!("{term} * {}", 1_u64 << piece.of_field);
            }
            term
        })
        .collect();
    let sum = terms.join(" + ");
    let word = Elementary::bit_string(field.bits);
    match field.of_type.kind() {
        Kind::BitString => convert(number, field.of_type, &sum),
        // A number of a whole width goes through its bits, which keep the sign.
        Kind::Signed if field.narrower().is_none() => {
            convert(word, field.of_type, &convert(number, word, &sum))
        }
        Kind::Signed | Kind::Unsigned | Kind::Bool | Kind::Real => convert(number, field.of_type, &sum),
    }
}

/// Puts the bits of a field into an unsigned number.
fn print_number(text: &mut Text, field: &Field<'_>, local: &str) {
    let number = Elementary::unsigned(field.bits);
    let word = Elementary::bit_string(field.bits);
    let member = format!("raw.{}", field.member);
    let of_bits = |expression: &str| convert(word, number, expression);
    match (field.of_type.kind(), field.narrower()) {
        (Kind::Bool, _) => {
            text.block(&format!("IF {member} THEN"), "ELSE", |text| text.line(&format!("{local} := 1;")));
            text.indented("END_IF;", |text| text.line(&format!("{local} := 0;")));
        }
        (Kind::Signed, None) => {
            text.line(&format!("{local} := {};", of_bits(&convert(field.of_type, word, &member))));
        }
        (Kind::Signed, Some(_)) => {
            let all = 1_i128 << field.bits;
            text.block(&format!("IF {member} < 0 THEN"), "ELSE", |text| {
                text.line(&format!(
                    "{local} := {};",
                    convert(field.of_type, number, &format!("{member} + {all}"))
                ));
            });
            text.indented("END_IF;", |text| {
                text.line(&format!("{local} := {};", convert(field.of_type, number, &member)));
            });
        }
        (Kind::BitString, _) => {
            text.line(&format!("{local} := {};", convert(field.of_type, number, &member)));
        }
        (Kind::Unsigned | Kind::Real, _) => text.line(&format!("{local} := {member};")),
    }
}

/// The part of a byte that a piece of a field is.
fn to_byte(field: &Field<'_>, piece: &Piece, local: &str) -> String {
    let number = Elementary::unsigned(field.bits);
    let mut part = local.to_owned();
    if piece.of_field > 0 {
        part = format!("{part} / {}", 1_u64 << piece.of_field);
    }
    if piece.of_field + piece.count < number.bits() {
        part = format!("{part} MOD {}", 1_u32 << piece.count);
    }
    if piece.first > 0 {
        part = format!("({part}) * {}", 1_u32 << piece.first);
    }
    convert(number, Elementary::Byte, &part)
}
