//! Bit fields: a structure with a member for each field, functions from the word and back, and masks.

use od_gen::plan::Words;
use od_spec::model::{BitField, Edge, NamedType, TypeKind};

use super::device::{Device, capitals, joined};
use super::elementary::{Elementary, convert};
use super::names::{Scope, Wanted};
use super::phrases::Phrase;
use super::text::{Declaration, Text};

/// A bit field.
pub(super) struct Bits<'a> {
    pub named: &'a NamedType,
    /// Type of all bits together.
    pub word: Elementary,
    /// Name of the structure.
    pub type_name: String,
    /// Name of the function from the word to the structure.
    pub unpack: String,
    pack: String,
    members: Vec<Member<'a>>,
    masks: Vec<Declaration>,
}

/// A member of the structure.
struct Member<'a> {
    field: &'a BitField,
    name: String,
    of_type: Elementary,
}

impl Member<'_> {
    /// The bits of the field, in their places.
    const fn mask(&self) -> i128 {
        self.most() << self.field.first
    }

    /// Largest value of the field.
    const fn most(&self) -> i128 {
        (1 << (self.field.last - self.field.first + 1)) - 1
    }

    /// How many of the word's steps one of the field's is.
    const fn weight(&self) -> i128 {
        1 << self.field.first
    }
}

/// The bit fields of a device, by name.
pub(super) fn bits<'a>(device: &mut Device<'a>) -> Vec<Bits<'a>> {
    let planned = device.bit_types().into_iter().filter_map(|named| {
        let TypeKind::Bits(fields) = &named.kind else { return None };
        let word = Elementary::bit_string(u32::from(named.base.bits()?));
        let reported: Vec<&BitField> = fields.iter().filter(|field| field.is_told()).collect();
        if reported.is_empty() {
            return None;
        }
        let name = device.name_of_type(named).to_owned();
        let wanted: Vec<Wanted> =
            reported.iter().map(|field| Wanted::new(member_name(field), number(field))).collect();
        let names = Scope::without(&[]).give_all(&wanted);
        let members =
            reported.iter().zip(names).map(|(field, name)| Member { field, name, of_type: type_of(field) });
        Some(Bits {
            named,
            word,
            type_name: device.scope.give(capitals(&name, "bits"), "type"),
            unpack: device.scope.give(format!("{name}_unpack"), "bits"),
            pack: device.scope.give(format!("{name}_pack"), "bits"),
            members: members.collect(),
            masks: masks(device, &name, word, &reported),
        })
    });
    planned.collect()
}

/// A field is one bit or a number.
const fn type_of(field: &BitField) -> Elementary {
    if field.first == field.last {
        return Elementary::Bool;
    }
    Elementary::unsigned((field.last - field.first + 1) as u32)
}

/// The name of a field, or its place where only modes give it names.
fn member_name(field: &BitField) -> String {
    let name = Words::of(&field.name).snake();
    if name.is_empty() { format!("bit_{}", field.first) } else { name }
}

/// What distinguishes a field from the others of its word.
fn number(field: &BitField) -> String {
    format!("b{}", field.first)
}

/// The constants of a bit field: masks under every name, of a run the weight of its lowest bit and its named values.
fn masks(device: &mut Device<'_>, name: &str, word: Elementary, fields: &[&BitField]) -> Vec<Declaration> {
    let mut wanted = Vec::new();
    let mut declarations = Vec::new();
    for field in fields {
        let of_type = type_of(field);
        let mask = ((1 << (field.last - field.first + 1)) - 1) << field.first;
        let place = device.place_of_bits(field.first, field.last);
        for (label, note) in labels(device, field) {
            let note = [place.as_str(), note.as_str()].join(" ").trim_end().to_owned();
            let name = joined(name, &label);
            wanted.push(Wanted::new(capitals(&name, "mask"), number(field)));
            declarations.push(Declaration::new("", word.name(), note).with_value(Some(word.literal(mask))));
            if of_type != Elementary::Bool {
                let note = device.phrase(Phrase::Shift, &[]);
                wanted.push(Wanted::new(capitals(&name, "shift"), number(field)));
                declarations
                    .push(Declaration::new("", "USINT", note).with_value(Some(field.first.to_string())));
            }
            for value in &field.values {
                wanted.push(Wanted::new(
                    capitals(&name, &value.name),
                    format!("{}_{}", number(field), value.value),
                ));
                let of_type = if of_type == Elementary::Bool { Elementary::Usint } else { of_type };
                let declaration = Declaration::new("", of_type.name(), device.text(&value.about));
                declarations.push(declaration.with_value(Some(of_type.literal(value.value))));
            }
        }
    }
    let names = device.scope.give_all(&wanted);
    declarations
        .into_iter()
        .zip(names)
        .map(|(declaration, name)| Declaration { name, ..declaration })
        .collect()
}

/// The names of a field, each with what is said of it: its own, and those that it has in a mode.
fn labels(device: &Device<'_>, field: &BitField) -> Vec<(String, String)> {
    let mut labels = Vec::new();
    if !field.name.is_empty() {
        labels.push((field.name.clone(), remarks(device, field).join("; ")));
    }
    for meaning in &field.modes {
        let about = device.text(&meaning.about);
        let about = if about.is_empty() { String::new() } else { format!(": {about}") };
        let mode = device.phrase(Phrase::InMode, &[&meaning.mode.value, &meaning.name]);
        labels.push((format!("{} {}", meaning.mode.value, meaning.name), format!("{mode}{about}")));
    }
    labels
}

/// What is worth knowing of a field in addition to its place.
fn remarks(device: &Device<'_>, field: &BitField) -> Vec<String> {
    let mut remarks = Vec::new();
    if !field.name.is_empty() {
        remarks.push(field.name.clone());
    }
    if field.active == 0 {
        remarks.push(device.phrase(Phrase::ActiveLow, &[]));
    }
    remarks.extend(field.edge.map(|edge| {
        let phrase = match edge {
            Edge::Rising => Phrase::RisingEdge,
            Edge::Falling => Phrase::FallingEdge,
            Edge::Both => Phrase::BothEdges,
        };
        device.phrase(phrase, &[])
    }));
    let about = device.text(&field.about);
    if !about.is_empty() {
        remarks.push(about.to_owned());
    }
    remarks
}

impl Bits<'_> {
    /// Masks and values.
    pub(super) fn print_constants(&self, device: &Device<'_>, text: &mut Text) {
        text.comment(&[
            device.phrase(Phrase::BitsOf, &[&self.named.name]),
            device.text(&self.named.about).to_owned(),
        ]);
        text.declarations(&self.masks);
    }

    /// The structure.
    pub(super) fn print_type(&self, device: &Device<'_>, text: &mut Text) {
        text.line("");
        text.comment(&[
            device.phrase(Phrase::BitsOf, &[&self.named.name]),
            device.text(&self.named.about).to_owned(),
        ]);
        let members = self.members.iter().map(|Member { field, name, of_type }| {
            let mut note = vec![device.place_of_bits(field.first, field.last)];
            note.extend(remarks(device, field));
            let modes = field.modes.iter();
            note.extend(modes.map(|one| device.phrase(Phrase::InMode, &[&one.mode.value, &one.name])));
            Declaration::new(name, of_type.name(), note.join("; "))
        });
        text.structure(&self.type_name, &members.collect::<Vec<_>>());
    }

    /// The functions.
    pub(super) fn print(&self, device: &Device<'_>, text: &mut Text) {
        let Self { named, word, type_name, unpack, pack, members, .. } = self;
        let number = Elementary::unsigned(word.bits());
        text.line("");
        text.comment(&[device.phrase(Phrase::UnpackBits, &[&named.name])]);
        text.line(&format!("FUNCTION {unpack} : {type_name}"));
        text.variables("VAR_INPUT", &[Declaration::new("raw", word.name(), "")]);
        text.variables("VAR", &[Declaration::new("bits", type_name, "")]);
        for member in members {
            let some = format!("raw AND {}", word.literal(member.mask()));
            let value = if member.of_type == Elementary::Bool {
                format!("({some}) <> 0")
            } else {
                let value = convert(*word, number, &some);
                let value =
                    if member.weight() == 1 { value } else { format!("{value} / {}", member.weight()) };
                convert(number, member.of_type, &value)
            };
            text.line(&format!("bits.{} := {value};", member.name));
        }
        text.line(&format!("{unpack} := bits;"));
        text.line("END_FUNCTION");

        text.line("");
        text.comment(&[device.phrase(Phrase::PackBits, &[&named.name])]);
        text.line(&format!("FUNCTION {pack} : BOOL"));
        text.variables("VAR_INPUT", &[Declaration::new("bits", type_name, "")]);
        text.variables("VAR_IN_OUT", &[Declaration::new("raw", word.name(), "")]);
        text.variables("VAR", &[Declaration::new("joined", word.name(), "")]);
        text.line(&format!("{pack} := FALSE;"));
        let too_large = members.iter().filter(|member| member.of_type != Elementary::Bool);
        let too_large = too_large.filter(|member| member.most() < (1 << member.of_type.bits()) - 1);
        for member in too_large {
            text.block(&format!("IF bits.{} > {} THEN", member.name, member.most()), "END_IF;", |text| {
                text.line("RETURN;");
            });
        }
        text.line(&format!("joined := {};", word.literal(0)));
        for Member { name, of_type, field, .. } in members {
            let weight = 1_i128 << field.first;
            if *of_type == Elementary::Bool {
                text.block(&format!("IF bits.{name} THEN"), "END_IF;", |text| {
                    text.line(&format!("joined := joined OR {};", word.literal(weight)));
                });
            } else {
                let value = convert(*of_type, number, &format!("bits.{name}"));
                let value = if weight == 1 { value } else { format!("{value} * {weight}") };
                text.line(&format!("joined := joined OR {};", convert(number, *word, &value)));
            }
        }
        text.line("raw := joined;");
        text.line(&format!("{pack} := TRUE;"));
        text.line("END_FUNCTION");
    }
}
