//! Enum types, in the form that CODESYS V3 and TwinCAT 3 take: with a base type and a value for each name.

use od_gen::plan::Words;
use od_spec::model::{BitUsage, EnumValue, StateMachine, TypeKind};

use super::device::{Device, capitals, joined};
use super::elementary::{Elementary, Kind};
use super::machines::Machine;
use super::names::{Scope, Wanted};
use super::phrases::Phrase;
use super::text::Text;

/// An enum.
pub(super) struct Enum {
    name: String,
    base: Elementary,
    about: Vec<String>,
    /// Name, value and note of each.
    values: Vec<(String, i128, String)>,
}

/// The enums of a device: its types, named values of runs of bits, states and commands.
pub(super) fn enums(device: &mut Device<'_>, machines: &[Machine<'_>]) -> Vec<Enum> {
    let mut found = Vec::new();
    for named in device.types() {
        let name = device.name_of_type(named).to_owned();
        match &named.kind {
            TypeKind::Enum(values) => {
                let base = Elementary::of_type(named.base).filter(|base| base.kind() != Kind::Bool);
                let about = vec![named.name.clone(), device.text(&named.about).to_owned()];
                found.extend(base.map(|base| of_values(device, capitals(&name, ""), base, about, values)));
            }
            TypeKind::Bits(fields) => {
                let runs =
                    fields.iter().filter(|field| field.usage == BitUsage::Used && !field.values.is_empty());
                for field in runs {
                    let base = Elementary::unsigned(u32::from(field.last - field.first + 1));
                    let place = device.place_of_bits(field.first, field.last);
                    let about = vec![
                        format!("{}, {place}: {}", named.name, field.name),
                        device.text(&field.about).to_owned(),
                    ];
                    let name = joined(&name, if field.name.is_empty() { &place } else { &field.name });
                    found.push(of_values(device, capitals(&name, ""), base, about, &field.values));
                }
            }
        }
    }
    for Machine { of: machine, name, .. } in machines {
        found.push(states(device, machine, name));
        if !machine.commands.is_empty() {
            found.push(commands(device, machine, name));
        }
    }
    found
}

fn of_values(
    device: &mut Device<'_>,
    name: String,
    base: Elementary,
    about: Vec<String>,
    values: &[EnumValue],
) -> Enum {
    let values = values.iter().map(|value| (value.name.as_str(), value.value, note_of(device, value)));
    let values = members(values.collect());
    Enum { name: device.scope.give(name, "enum"), base, about, values }
}

/// What is said of a value of an enum.
pub(super) fn note_of(device: &Device<'_>, value: &EnumValue) -> String {
    let mut notes = vec![value.name.clone()];
    let about = device.text(&value.about);
    if !about.is_empty() {
        notes.push(about.to_owned());
    }
    if !value.supported {
        notes.push(device.phrase(Phrase::Unsupported, &[]));
    }
    notes.join("; ")
}

fn states(device: &mut Device<'_>, machine: &StateMachine, name: &str) -> Enum {
    let none = ("none", 0, device.phrase(Phrase::NoState, &[]));
    let states =
        (1..).zip(&machine.states).map(|(number, state)| (state.name.as_str(), number, state.name.clone()));
    let values = members(std::iter::once(none).chain(states).collect());
    let about = vec![device.phrase(Phrase::StatesOf, &[&machine.name, &device.title(machine.status)])];
    Enum { name: device.scope.give(capitals(name, "states"), "enum"), base: Elementary::Int, about, values }
}

fn commands(device: &mut Device<'_>, machine: &StateMachine, name: &str) -> Enum {
    let none = ("none", 0, String::new());
    let commands =
        (1..).zip(&machine.commands).map(|(number, one)| (one.name.as_str(), number, one.name.clone()));
    let values = members(std::iter::once(none).chain(commands).collect());
    let about = vec![device.phrase(Phrase::CommandsOf, &[&machine.name, &device.title(machine.command)])];
    Enum { name: device.scope.give(capitals(name, "commands"), "enum"), base: Elementary::Int, about, values }
}

/// The members of an enum, whose names differ.
fn members(values: Vec<(&str, i128, String)>) -> Vec<(String, i128, String)> {
    let number =
        |value: i128| if value < 0 { format!("m{}", value.unsigned_abs()) } else { value.to_string() };
    let wanted: Vec<Wanted> =
        values.iter().map(|(name, value, _)| Wanted::new(Words::of(name).snake(), number(*value))).collect();
    let names = Scope::without(&[]).give_all(&wanted);
    names.into_iter().zip(values).map(|(name, (_, value, note))| (name, value, note)).collect()
}

impl Enum {
    pub(super) fn print(&self, text: &mut Text) {
        text.line("");
        text.comment(&self.about);
        text.line("{attribute 'qualified_only'}");
        text.line("{attribute 'strict'}");
        text.line(&format!("TYPE {} :", self.name));
        text.block("(", &format!(") {};", self.base.name()), |text| {
            for (at, (name, value, note)) in self.values.iter().enumerate() {
                let comma = if at + 1 == self.values.len() { "" } else { "," };
                text.noted(&format!("{name} := {}{comma}", self.base.literal(*value)), note);
            }
        });
        text.line("END_TYPE");
    }
}
