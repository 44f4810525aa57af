//! Bit tables and value tables of named types, and pictures of registers.

use od_spec::model::{
    BitErrors, BitField, BitUsage, Devices, Dictionary, Edge, Entry, EnumValue, ModeMeaning, NamedType,
    Object, TypeKind,
};

use super::Columns;
use super::variants::device_keys;
use crate::language::Word;
use crate::source::Source;
use crate::view::cell::entry_anchor;
use crate::view::{BitBox, BitPicture, BitPictureRow, Cell, Grid, Row};

impl Source<'_> {
    /// The bits of a type, with the masks of so many bits where they are wanted. Where several entries share the type and report
    /// different error codes, the codes name their entry.
    pub(crate) fn bits(&self, named: &NamedType, fields: &[BitField], masks: Option<u8>) -> Grid {
        let rows = fields
            .iter()
            .map(|field| {
                let bits = if field.first == field.last {
                    field.first.to_string()
                } else {
                    format!("{}..{}", field.first, field.last)
                };
                let name = match field.usage {
                    BitUsage::Used => field.name.as_str(),
                    BitUsage::Reserved => self.word(Word::Reserved),
                    BitUsage::Unused => self.word(Word::Unused),
                };
                let active = match (field.edge, field.active) {
                    (Some(Edge::Rising), _) => "0→1",
                    (Some(Edge::Falling), _) => "1→0",
                    (Some(Edge::Both), _) => self.word(Word::BothEdges),
                    (None, 0) => "0",
                    (None, _) => "",
                };
                Row::of(vec![
                    Cell::plain(bits),
                    masks.map_or_else(Cell::default, |width| self.mask(field, width)),
                    field.mnemonic.as_ref().map_or_else(Cell::default, Cell::plain),
                    Cell::plain(name),
                    self.meaning(field).stated(self.stated_of_type(named, field.first.into())),
                    Cell::plain(active),
                    field.clamp.as_ref().map_or_else(Cell::default, Cell::plain),
                    field.priority.as_ref().map_or_else(Cell::default, Cell::plain),
                    self.codes(named, field),
                ])
            })
            .collect();
        let grid = Columns::new()
            .right(self, "bit", Word::Bit)
            .left(self, "mask", Word::Mask)
            .left(self, "mnemonic", Word::Mnemonic)
            .left(self, "name", Word::Name)
            .left(self, "meaning", Word::Meaning)
            .center(self, "active", Word::Active)
            .left(self, "clamp", Word::Clamp)
            .center(self, "priority", Word::Priority)
            .left(self, "error_codes", Word::AlarmCode)
            .grid(rows, &["bit", "name"]);
        Grid { bits: Some(picture(named)), ..grid }
    }

    /// The mask of a bit or run of bits; a run without a meaning needs none, and what a mask is too narrow for has none.
    fn mask(&self, field: &BitField, width: u8) -> Cell {
        if field.last >= width {
            return Cell::plain("-");
        }
        if field.usage != BitUsage::Used && field.first != field.last {
            return Cell::default();
        }
        let mask = (1u128 << (field.last + 1)) - (1 << field.first);
        Cell::plain(self.wording.hexadecimal(mask, usize::from(width.div_ceil(4))))
    }

    fn meaning(&self, field: &BitField) -> Cell {
        let mut cell = self.text(&field.about);
        for value in &field.values {
            cell = cell.line().text(format!("{} = {}", value.value, value.name));
            if !value.supported {
                cell = cell.text(format!(" ({})", self.word(Word::NotSupported)));
            }
            let about = self.text(&value.about);
            if !about.is_empty() {
                cell = cell.text(": ").and(about);
            }
        }
        for ModeMeaning { mode, name, about, .. } in &field.modes {
            cell = cell.line().text(format!("{}: {name}", mode.value));
            let about = self.text(about);
            if !about.is_empty() {
                cell = cell.text("; ").and(about);
            }
        }
        cell
    }

    /// Error codes of a bit: those of the type, then those of each entry that has the type. Where devices differ, they are
    /// named.
    fn codes(&self, named: &NamedType, field: &BitField) -> Cell {
        let mut cell = self.error_codes(&field.error_codes().collect::<Vec<_>>());
        let codes_of = |entry: &Entry| -> Vec<u16> {
            let of_field =
                entry.bit_errors.iter().filter(|errors| (field.first..=field.last).contains(&errors.bit));
            of_field.flat_map(BitErrors::error_codes).collect()
        };
        for id in self.with_bit_errors(&named.name).iter().copied() {
            let codes_on = |device: &Dictionary| {
                let entry = device.entry(id)?;
                let has_type = entry.named_type.as_ref().is_some_and(|its_type| its_type.name == named.name);
                has_type.then(|| codes_of(entry))
            };
            let mut variants = self.variants(id.index, |device, _| codes_on(device));
            let several = variants.len() > 1;
            variants.retain(|devices| {
                devices.first().and_then(|device| codes_on(device)).is_some_and(|codes| !codes.is_empty())
            });
            for devices in variants {
                let Some(device) = devices.first() else { continue };
                let place = if several { format!("{} {id}", device_keys(&devices)) } else { id.to_string() };
                let codes = self.error_codes(&codes_on(device).unwrap_or_default());
                cell = cell
                    .line()
                    .and(self.link_on(&Devices::one(&device.key), id.index, place, entry_anchor(id)))
                    .text(": ")
                    .and(codes);
            }
        }
        cell
    }

    /// Links to error codes, separated by commas.
    fn error_codes(&self, codes: &[u16]) -> Cell {
        let mut cell = Cell::default();
        for code in codes {
            if !cell.is_empty() {
                cell = cell.text(", ");
            }
            cell = cell.and(self.error_link(*code));
        }
        cell
    }

    /// What a raw value of a bit field sets: its bits and runs by name; nothing for 0.
    pub(crate) fn set_bits(&self, fields: &[BitField], raw: i128) -> Option<String> {
        let set = self.wording.set_bits(fields, raw);
        if set.is_empty() {
            return None;
        }
        if set.len() == fields.len() && fields.iter().all(|field| field.first == field.last) {
            return Some(self.word(Word::AllBits).to_owned());
        }
        Some(set.join(", "))
    }

    /// The values of an enum.
    pub(crate) fn values(&self, named: &NamedType, values: &[EnumValue]) -> Grid {
        let rows = values
            .iter()
            .map(|value| {
                Row::of(vec![
                    Cell::plain(self.wording.enum_number(named.base, value.value)),
                    Cell::plain(&value.name),
                    self.text(&value.about).stated(self.stated_of_type(named, value.value)),
                    if value.supported { Cell::default() } else { Cell::plain(self.word(Word::No)) },
                ])
            })
            .collect();
        Columns::new()
            .right(self, "value", Word::Value)
            .left(self, "name", Word::Name)
            .left(self, "meaning", Word::Meaning)
            .center(self, "supported", Word::Supported)
            .grid(rows, &["value", "name"])
    }
}

/// The named types of an object's entries, each once.
pub(crate) fn types_of(object: &Object) -> Vec<&NamedType> {
    let mut types: Vec<&NamedType> = Vec::new();
    for named in object.entries.iter().filter_map(|entry| entry.named_type.as_deref()) {
        if types.iter().all(|before| before.name != named.name) {
            types.push(named);
        }
    }
    types
}

/// A register in rows of 16 bits, the highest first.
fn picture(named: &NamedType) -> BitPicture {
    let fields = match &named.kind {
        TypeKind::Bits(fields) => fields.as_slice(),
        TypeKind::Enum(_) => &[],
    };
    let bits = named.base.bits().map_or(64, |bits| u8::try_from(bits).unwrap_or(64));
    let rows = (0..bits.div_ceil(16)).rev().map(|row| {
        let (first, last) = (row * 16, bits.min(row * 16 + 16) - 1);
        let inside = fields.iter().rev().filter(|field| field.first <= last && field.last >= first);
        let fields = inside.map(|field| {
            let (from, to) = (field.first.max(first), field.last.min(last));
            BitBox {
                last: to,
                first: from,
                width: to - from + 1,
                name: field.name.clone(),
                usage: match field.usage {
                    BitUsage::Used => "used",
                    BitUsage::Reserved => "reserved",
                    BitUsage::Unused => "unused",
                },
            }
        });
        BitPictureRow { last, first, fields: fields.collect() }
    });
    BitPicture { name: named.name.clone(), rows: rows.collect() }
}
