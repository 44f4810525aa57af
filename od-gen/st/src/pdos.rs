//! PDOs: a structure of raw values, functions between it and the bytes of a frame, and function blocks between it and
//! quantities in their units.

use std::collections::BTreeMap;

use od_gen::plan::Words;
use od_spec::model::{Direction, Entry, EntryId, Fact, Object, Pdo, PdoTarget, TypeKind, Value};

use super::bits::Bits;
use super::constants::{Group, literal, raw};
use super::device::{Device, capitals, number};
use super::elementary::{Elementary, Kind};
use super::machines::Machine;
use super::names::{Scope, Wanted};
use super::phrases::Phrase;
use super::quantities::Quantity;
use super::text::{Declaration, Text};
use super::{LeftOut, Why};

/// A PDO that carries something.
pub(super) struct PlannedPdo<'a> {
    pub pdo: &'a Pdo,
    /// Name of the structure.
    pub type_name: String,
    block: String,
    /// Name of the function between bytes and structure; `None` where a number has no bits that the language can reach.
    pub bytes: Option<String>,
    pub fields: Vec<Field<'a>>,
}

/// A part of a PDO that is not a placeholder.
pub(super) struct Field<'a> {
    pub id: EntryId,
    entry: Option<(&'a Object, &'a Entry)>,
    /// Name in the structure and in the block.
    pub member: String,
    pub of_type: Elementary,
    /// First bit in the frame.
    pub first: u32,
    /// How many bits.
    pub bits: u32,
}

impl Field<'_> {
    /// Smallest and largest raw value that the bits can hold, where the type has others; none of a number that is not counted.
    pub(super) fn narrower(&self) -> Option<(i128, i128)> {
        if self.bits == self.of_type.bits() {
            return None;
        }
        match self.of_type.kind() {
            Kind::Signed => Some((-(1 << (self.bits - 1)), (1 << (self.bits - 1)) - 1)),
            Kind::Unsigned | Kind::BitString => Some((0, (1 << self.bits) - 1)),
            Kind::Bool | Kind::Real => None,
        }
    }

    /// The entry, where its whole value is mapped.
    fn whole(&self) -> Option<&Entry> {
        let (_, entry) = self.entry?;
        (entry.data_type.bits().map(u32::from) == Some(self.bits)).then_some(entry)
    }
}

/// The PDOs of a device, RPDOs first, with those that cannot be converted.
pub(super) fn pdos<'a>(device: &mut Device<'a>, left_out: &mut Vec<LeftOut>) -> Vec<PlannedPdo<'a>> {
    let key = device.dictionary.key.clone();
    let all: Vec<&'a Pdo> = device.dictionary.pdos.iter().filter(|pdo| !pdo.map.is_empty()).collect();
    let mut planned = Vec::new();
    for pdo in all {
        let label = label(pdo);
        let bits = pdo.bits();
        if bits > 64 {
            left_out.push(LeftOut { what: format!("{label} of {key}"), why: Why::TooLong { bits } });
            continue;
        }
        let name = device.prefixed(&label);
        let fields = fields(device, pdo);
        if fields.is_empty() {
            left_out.push(LeftOut { what: format!("{label} of {key}"), why: Why::OnlyPlaceholders });
            continue;
        }
        let has_real = fields.iter().any(|field| field.of_type.kind() == Kind::Real);
        let behind = match pdo.direction {
            Direction::Transmit => ["unpack", "in"],
            Direction::Receive => ["pack", "out"],
        };
        if has_real {
            left_out.push(LeftOut { what: format!("the bytes of {label} of {key}"), why: Why::RealInBytes });
        }
        planned.push(PlannedPdo {
            pdo,
            type_name: device.scope.give(capitals(&name, ""), "type"),
            block: device.scope.give(capitals(&name, behind[1]), "block"),
            bytes: (!has_real).then(|| device.scope.give(format!("{name}_{}", behind[0]), "bytes")),
            fields,
        });
    }
    planned
}

/// `TPDO1`.
pub(super) fn label(pdo: &Pdo) -> String {
    format!("{}{}", pdo.direction.pdo(), pdo.number)
}

fn fields<'a>(device: &Device<'a>, pdo: &Pdo) -> Vec<Field<'a>> {
    let mut fields = Vec::new();
    let mut wanted = Vec::new();
    for field in pdo.fields() {
        let PdoTarget::Entry(id) = field.mapped.target else { continue };
        let bits = u32::from(field.mapped.bits);
        if bits == 0 {
            continue;
        }
        let object = device.dictionary.objects.get(&id.index);
        let entry = object.and_then(|object| Some((object, object.entry(id.sub)?)));
        let words = entry.map_or_else(
            || Words::of("entry"),
            |(object, entry)| {
                let words = Words::of(&object.name);
                if object.is_structured() { words.and(&entry.name) } else { words }
            },
        );
        wanted.push(Wanted::new(words.snake(), number(id)));
        let whole = entry.filter(|(_, entry)| entry.data_type.bits().map(u32::from) == Some(bits));
        // A part of a value, or what is not a number, is one without a sign.
        let of_type =
            whole.and_then(|(_, entry)| Elementary::of(entry)).unwrap_or(Elementary::unsigned(bits));
        fields.push(Field { id, entry, member: String::new(), of_type, first: field.first_bit, bits });
    }
    let names = Scope::without(&["raw", "data"]).give_all(&wanted);
    for (field, name) in fields.iter_mut().zip(names) {
        field.member = name;
    }
    fields
}

/// The constants of a PDO: identifier, length, and when it is sent.
pub(super) fn constants(device: &mut Device<'_>) -> Vec<Group> {
    let all: Vec<&Pdo> = device.dictionary.pdos.iter().collect();
    let groups = all.into_iter().map(|pdo| {
        let label = label(pdo);
        let name = device.prefixed(&label);
        let mut about = vec![[label.as_str(), device.text(&pdo.about)].join(" ").trim_end().to_owned()];
        if !pdo.valid {
            about.push(device.phrase(Phrase::SwitchedOff, &[]));
        }
        if pdo.map.is_empty() {
            about.push(device.phrase(Phrase::Empty, &[]));
        }
        let mut list = Vec::new();
        let node = device.node;
        let mut add = |behind: &str, of_type: &str, value: String, note: Phrase| {
            let constant = device.scope.give(capitals(&name, behind), "pdo");
            let note = device.phrase(note, &[]);
            list.push(Declaration::new(constant, of_type, note).with_value(Some(value)));
        };
        match (&pdo.cob_id, node) {
            (Some(Value::NodeId(offset)), None) => {
                add("can_id_base", "UDINT", format!("16#{:03X}", offset & 0x1FFF_FFFF), Phrase::CanIdBase);
            }
            (Some(cob_id), node) => {
                if let Some(raw) = cob_id.integer_for(node.unwrap_or_default()) {
                    let note = if raw >> 29 & 1 == 1 { Phrase::LongCanId } else { Phrase::CanId };
                    add("can_id", "UDINT", format!("16#{:03X}", raw & 0x1FFF_FFFF), note);
                }
            }
            (None, _) => {}
        }
        add("length", "USINT", pdo.bits().div_ceil(8).to_string(), Phrase::FrameLength);
        if let Some(transmission) = pdo.transmission {
            add("transmission", "USINT", transmission.to_string(), Phrase::Transmission);
        }
        if let Some(time) = pdo.event_timer {
            add("event_timer", "UINT", time.to_string(), Phrase::EventTimer);
        }
        if let Some(time) = pdo.inhibit_time {
            add("inhibit_time", "UINT", time.to_string(), Phrase::InhibitTime);
        }
        Group::new(about, list)
    });
    groups.collect()
}

/// What a field of a PDO is in the blocks.
enum Meaning<'q, 'a> {
    /// A number with a unit.
    Quantity(&'q Quantity<'a>),
    /// Bits with names.
    Bits(&'q Bits<'a>),
    /// Anything else: as it is.
    Raw,
}

/// What the blocks of PDOs call.
pub(super) struct Called<'q, 'a> {
    pub quantities: &'q BTreeMap<EntryId, &'q Quantity<'a>>,
    pub bits: &'q [Bits<'a>],
    pub machines: &'q [Machine<'a>],
}

impl<'a> Called<'_, 'a> {
    fn meaning(&self, field: &Field<'_>) -> Meaning<'_, 'a> {
        let Some(entry) = field.whole() else { return Meaning::Raw };
        if let Some(quantity) = self.quantities.get(&field.id) {
            return Meaning::Quantity(quantity);
        }
        let named = entry.named_type.as_ref().map(|named| named.name.as_str());
        let bits = self.bits.iter().find(|bits| Some(bits.named.name.as_str()) == named);
        match bits.filter(|bits| bits.word == field.of_type) {
            Some(bits) => Meaning::Bits(bits),
            None => Meaning::Raw,
        }
    }
}

impl PlannedPdo<'_> {
    /// The structure of raw values; of what is sent to the device with its defaults.
    pub(super) fn print_type(&self, device: &Device<'_>, text: &mut Text) {
        let label = label(self.pdo);
        let phrase = match self.pdo.direction {
            Direction::Transmit => Phrase::Transmitted,
            Direction::Receive => Phrase::Received,
        };
        text.line("");
        text.comment(&[
            device.phrase(phrase, &[&label, &self.pdo.bits().to_string()]),
            device.phrase(Phrase::NoImage, &[]),
            device.text(&self.pdo.about).to_owned(),
        ]);
        let members = self.fields.iter().map(|field| {
            let value = self.default(field).and_then(|value| literal(field.of_type, value, device.node));
            Declaration::new(&field.member, field.of_type.name(), note(device, field)).with_value(value)
        });
        text.structure(&self.type_name, &members.collect::<Vec<_>>());
    }

    /// What a field begins with: nothing where it only comes in.
    fn default<'f>(&self, field: &'f Field<'_>) -> Option<&'f Value> {
        let value = field.whole()?.default.as_ref()?;
        (self.pdo.direction == Direction::Receive).then_some(value)
    }

    /// The function block.
    pub(super) fn print_block(&self, device: &Device<'_>, text: &mut Text, called: &Called<'_, '_>) {
        match self.pdo.direction {
            Direction::Transmit => self.print_in(device, text, called),
            Direction::Receive => self.print_out(device, text, called),
        }
    }

    fn print_in(&self, device: &Device<'_>, text: &mut Text, called: &Called<'_, '_>) {
        let (mut outputs, mut statements) = (Vec::new(), Vec::new());
        let mut scope = Scope::without(&["raw"]);
        for field in &self.fields {
            let note = note(device, field);
            let member = &field.member;
            let name = scope.give(member.clone(), number(field.id));
            match called.meaning(field) {
                Meaning::Quantity(quantity) => {
                    let valid = scope.give(format!("{name}_valid"), number(field.id));
                    outputs.push(Declaration::new(&name, "LREAL", format!("{}; {note}", quantity.symbol())));
                    outputs.push(Declaration::new(&valid, "BOOL", ""));
                    statements.push(format!(
                        "{valid} := {}(raw := raw.{member}, value := {name});",
                        quantity.to_value
                    ));
                }
                Meaning::Bits(bits) => {
                    outputs.push(Declaration::new(&name, &bits.type_name, note));
                    statements.push(format!("{name} := {}(raw := raw.{member});", bits.unpack));
                }
                Meaning::Raw => {
                    outputs.push(Declaration::new(&name, field.of_type.name(), note));
                    statements.push(format!("{name} := raw.{member};"));
                }
            }
            let is_shown =
                |machine: &&Machine<'_>| machine.of.status == field.id && machine.status == field.of_type;
            for machine in called.machines.iter().filter(is_shown) {
                let behind = Words::of(&machine.of.name).snake();
                let state = scope.give(format!("{name}_{behind}_state"), number(field.id));
                outputs.push(Declaration::new(&state, "INT", &machine.of.name));
                statements.push(format!("{state} := {}(raw := raw.{member});", machine.state));
            }
        }
        text.line("");
        text.comment(&[device.phrase(Phrase::InBlock, &[&label(self.pdo)])]);
        text.line(&format!("FUNCTION_BLOCK {}", self.block));
        text.variables("VAR_INPUT", &[Declaration::new("raw", &self.type_name, "")]);
        text.variables("VAR_OUTPUT", &outputs);
        text.lines(&statements);
        text.line("END_FUNCTION_BLOCK");
    }

    fn print_out(&self, device: &Device<'_>, text: &mut Text, called: &Called<'_, '_>) {
        let (mut inputs, mut statements) = (Vec::new(), Vec::new());
        let mut outputs = vec![Declaration::new("raw", &self.type_name, "")];
        let mut scope = Scope::without(&["raw"]);
        for field in &self.fields {
            let note = note(device, field);
            let member = &field.member;
            let name = scope.give(member.clone(), number(field.id));
            let default = self.default(field);
            let quantity = match called.meaning(field) {
                Meaning::Quantity(quantity) => quantity.to_raw.as_ref().map(|to_raw| (quantity, to_raw)),
                Meaning::Bits(_) | Meaning::Raw => None,
            };
            if let Some((quantity, to_raw)) = quantity {
                let accepted = scope.give(format!("{name}_accepted"), number(field.id));
                // Without a default the quantity that the raw 0 of the structure is, so that an input that is not set
                // changes nothing.
                let start = default.and_then(|value| raw(value, device.node)).unwrap_or(0);
                let start = Some(quantity.literal(start));
                let note = format!("{}; {note}", quantity.symbol());
                inputs.push(Declaration::new(&name, "LREAL", note).with_value(start));
                outputs.push(Declaration::new(&accepted, "BOOL", ""));
                statements.push(format!("{accepted} := {to_raw}(value := {name}, raw := raw.{member});"));
            } else {
                let start = default.and_then(|value| literal(field.of_type, value, device.node));
                inputs.push(Declaration::new(&name, field.of_type.name(), note).with_value(start));
                let assignment = format!("raw.{member} := {name};");
                let Some(condition) = field.whole().and_then(|entry| allowed(entry, field.of_type, &name))
                else {
                    statements.push(assignment);
                    continue;
                };
                let accepted = scope.give(format!("{name}_accepted"), number(field.id));
                outputs.push(Declaration::new(&accepted, "BOOL", ""));
                statements.push(format!("{accepted} := {condition};"));
                statements.push(format!("IF {accepted} THEN"));
                statements.push(format!("    {assignment}"));
                statements.push("END_IF;".to_owned());
            }
        }
        text.line("");
        text.comment(&[device.phrase(Phrase::OutBlock, &[&label(self.pdo)])]);
        text.line(&format!("FUNCTION_BLOCK {}", self.block));
        text.variables("VAR_INPUT", &inputs);
        text.variables("VAR_OUTPUT", &outputs);
        text.lines(&statements);
        text.line("END_FUNCTION_BLOCK");
    }
}

/// When a number without a unit is one that the device takes; `None` where every one is.
fn allowed(entry: &Entry, of_type: Elementary, name: &str) -> Option<String> {
    let (Kind::Signed | Kind::Unsigned) = of_type.kind() else { return None };
    let is = |raw: i128| format!("({name} = {})", of_type.literal(raw));
    let mut cases: Vec<String> = Vec::new();
    if let Some(TypeKind::Enum(values)) = entry.named_type.as_ref().map(|named| &named.kind) {
        let taken = values.iter().filter(|value| value.supported && entry.allows(value.value));
        cases.extend(taken.map(|value| is(value.value)));
    } else {
        let (least, most) = entry.data_type.range()?;
        let low =
            entry.low.filter(|low| *low > least).map(|low| format!("({name} >= {})", of_type.literal(low)));
        let high = entry
            .high
            .filter(|high| *high < most)
            .map(|high| format!("({name} <= {})", of_type.literal(high)));
        cases.push(match (low, high) {
            (Some(low), Some(high)) => format!("({low} AND {high})"),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => return None,
        });
    }
    cases.extend(
        entry
            .special
            .iter()
            .map(|special| is(special.value))
            .filter(|case| !cases.contains(case))
            .collect::<Vec<_>>(),
    );
    Some(cases.join(" OR "))
}

/// What a field is.
fn note(device: &Device<'_>, field: &Field<'_>) -> String {
    let Some((object, entry)) = field.entry else {
        return format!("{} {}", field.id, device.phrase(Phrase::Unknown, &[]));
    };
    let mut notes = vec![device.title(field.id)];
    notes.extend(entry.unit.as_ref().map(|unit| device.wording.step(unit)));
    notes.extend(device.wording.range(object.index, entry));
    if let Some(bits) = entry.data_type.bits().map(u32::from).filter(|bits| *bits != field.bits) {
        notes.push(device.phrase(Phrase::PartMapped, &[&field.bits.to_string(), &bits.to_string()]));
    }
    let warning = device.text(&entry.warning);
    if !warning.is_empty() {
        notes.push(format!("{}: {warning}", device.wording.fact(Fact::Warning)));
    }
    notes.join("; ")
}
