//! What refers to the objects of a device: PDOs, views, conditions, error codes, constraints, state machines.

use std::collections::BTreeMap;

use od_spec::expr::Expr;
use od_spec::model::{
    BitErrors, BitField, Dictionary, Entry, EntryId, Index, Pdo, PdoField, PdoTarget, TypeKind,
};

use crate::language::Word;
use crate::source::Source;
use crate::source::series;
use crate::tables::pdos;
use crate::view::{Cell, Used};

/// What refers to each object of a device, worked out once.
pub(crate) struct Uses(BTreeMap<Index, Vec<Used>>);

impl Uses {
    /// Everything that refers to an object of the device.
    pub(crate) fn new(source: &Source<'_>, device: &Dictionary) -> Self {
        let mut uses = Self(BTreeMap::new());
        uses.add_pdos(source, device);
        uses.add_entries(source, device);
        uses.add_option_codes(source, device);
        uses.add_constraints(source, device);
        uses.add_machines(source, device);
        uses
    }

    fn add_pdos(&mut self, source: &Source<'_>, device: &Dictionary) {
        for pdo in &device.pdos {
            for field in pdo.fields() {
                if let PdoTarget::Entry(id) = field.mapped.target {
                    self.add(id, "pdos", source.word(Word::Pdos), pdo_line(source, device, pdo, field));
                }
            }
        }
    }

    fn add_entries(&mut self, source: &Source<'_>, device: &Dictionary) {
        for (id, _, entry) in device.entries() {
            if let Some(alias) = &entry.alias {
                let conversion = source.wording.conversion(alias);
                let line = source.named_entry(device, id).text(format!("; {conversion}"));
                self.add(alias.target, "aliases", source.word(Word::Alias), line);
            }
            for operand in entry.writable_when.iter().flat_map(Expr::entries) {
                self.add(operand.id, "conditions", source.word(Word::Gates), source.named_entry(device, id));
            }
            for code in codes(entry) {
                let error = source.system.errors.iter().find(|error| error.code == code);
                let name = format!(" {}", error.map_or("", |error| &error.name));
                let line = source.error_link(code).text(name);
                self.add(id, "errors", source.word(Word::ErrorCodes), line);
            }
        }
    }

    fn add_option_codes(&mut self, source: &Source<'_>, device: &Dictionary) {
        let errors = source.system.errors.iter().filter(|error| error.devices.includes(&device.key));
        for error in errors {
            let Some(id) = error.option_code.filter(|id| device.entry(*id).is_some()) else { continue };
            let line = source.error_link(error.code).text(format!(" {}", error.name));
            self.add(id, "reactions", source.word(Word::Chooses), line);
        }
    }

    fn add_constraints(&mut self, source: &Source<'_>, device: &Dictionary) {
        for constraint in &source.system.constraints {
            let conditions = std::iter::once(&constraint.require).chain(&constraint.when);
            let applies = constraint.devices.includes(&device.key);
            for operand in conditions.flat_map(Expr::entries) {
                if operand.device.as_ref().map_or(applies, |key| *key == device.key) {
                    let anchor = source.constraint_anchor(constraint);
                    let line = Cell::default().link(series::title(constraint), anchor, "constraints");
                    self.add(operand.id, "constraints", source.word(Word::Constraints), line);
                }
            }
        }
    }

    fn add_machines(&mut self, source: &Source<'_>, device: &Dictionary) {
        let machines = source.system.machines.values();
        for machine in machines.filter(|machine| machine.devices.includes(&device.key)) {
            for (id, word) in [(machine.status, Word::Status), (machine.command, Word::Command)] {
                let line = Cell::plain(format!("{} ({})", machine.name, source.word(word)));
                self.add(id, "machines", source.word(Word::Machines), line);
            }
        }
    }

    fn add(&mut self, id: EntryId, kind: &'static str, title: &str, line: Cell) {
        let uses = self.0.entry(id.index).or_default();
        let at = uses.iter().position(|used| used.kind == kind).unwrap_or_else(|| {
            uses.push(Used { kind, title: title.to_owned(), lines: Vec::new() });
            uses.len() - 1
        });
        let lines = &mut uses[at].lines;
        if !lines.contains(&line) {
            lines.push(line);
        }
    }

    /// What refers to an object.
    pub(crate) fn of(&self, index: Index) -> Vec<Used> {
        self.0.get(&index).cloned().unwrap_or_default()
    }
}

/// A PDO that carries an entry, and where: `TPDO 1 (Byte 2, Bit 4, 4 bit)`.
fn pdo_line(source: &Source<'_>, device: &Dictionary, pdo: &Pdo, field: PdoField<'_>) -> Cell {
    let mut place = format!("{} {}", source.word(Word::Byte), field.byte());
    if field.bit() > 0 {
        place = format!("{place}, {} {}", source.word(Word::Bit), field.bit());
    }
    let off = if pdo.valid { String::new() } else { format!(", {}", source.word(Word::Off)) };
    Cell::default()
        .link(format!("{} {}", pdo.direction.pdo(), pdo.number), pdos::anchor(pdo), device.key.clone())
        .text(format!(" ({place}, {} bit{off})", field.mapped.bits))
}

/// Error codes that come with the bits of an entry.
fn codes(entry: &Entry) -> Vec<u16> {
    let mut codes: Vec<u16> = entry.bit_errors.iter().flat_map(BitErrors::error_codes).collect();
    if let Some(TypeKind::Bits(fields)) = entry.named_type.as_ref().map(|named| &named.kind) {
        codes.extend(fields.iter().flat_map(BitField::error_codes));
    }
    codes.sort_unstable();
    codes.dedup();
    codes
}
