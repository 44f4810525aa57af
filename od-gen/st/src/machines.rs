//! State machines: the state in a status word, and commands in a control word.

use od_spec::model::{EntryId, StateMachine};

use super::device::{Device, capitals, joined};
use super::elementary::Elementary;
use super::names::Wanted;
use super::phrases::Phrase;
use super::text::{Declaration, Text};

/// A state machine of the device.
pub(super) struct Machine<'a> {
    pub of: &'a StateMachine,
    /// Type of the entry that shows the state.
    pub status: Elementary,
    command: Elementary,
    /// Name of the function that returns the state.
    pub state: String,
    give: String,
    /// What the names of its enums begin with.
    pub name: String,
    states: Vec<Declaration>,
    commands: Vec<Declaration>,
}

/// The state machines of a device whose entries are words, by name.
pub(super) fn machines<'a>(device: &mut Device<'a>) -> Vec<Machine<'a>> {
    let all: Vec<&StateMachine> = device.machines().collect();
    let planned = all.into_iter().filter_map(|machine| {
        let word = |id: EntryId| {
            let bits = u32::from(device.dictionary.entry(id)?.data_type.bits()?);
            (bits <= 64).then(|| Elementary::bit_string(bits))
        };
        let (status, command) = (word(machine.status)?, word(machine.command)?);
        let name = device.prefixed(&machine.name);
        Some(Machine {
            of: machine,
            status,
            command,
            state: device.scope.give(format!("{name}_state"), "machine"),
            give: device.scope.give(format!("{name}_command"), "machine"),
            states: states(device, machine, &name, status),
            commands: commands(device, machine, &name, command),
            name,
        })
    });
    planned.collect()
}

/// Constants of the states: number, mask and value of each.
fn states(device: &mut Device<'_>, machine: &StateMachine, name: &str, word: Elementary) -> Vec<Declaration> {
    let mut list = Constants::default();
    let no_state = device.phrase(Phrase::NoState, &[]);
    list.add(capitals(name, "state none"), "0", Elementary::Int, 0, &no_state);
    for (state, number) in machine.states.iter().zip(1..) {
        let name = joined(&format!("{name}_state"), &state.name);
        let (mask, value) = state.pattern.mask_and_value();
        let number_text = number.to_string();
        list.add(capitals(&name, ""), &number_text, Elementary::Int, number, device.text(&state.about));
        list.add(capitals(&name, "mask"), &number_text, word, mask.into(), "");
        list.add(capitals(&name, "value"), &number_text, word, value.into(), "");
    }
    list.named(device)
}

/// Constants of the commands: number, mask and value of each, and which bits have to change.
fn commands(
    device: &mut Device<'_>,
    machine: &StateMachine,
    name: &str,
    word: Elementary,
) -> Vec<Declaration> {
    let mut list = Constants::default();
    for (command, number) in machine.commands.iter().zip(1..) {
        let name = joined(&format!("{name}_command"), &command.name);
        let (mask, value) = command.pattern.mask_and_value();
        let (rising, falling) = command.pattern.edges();
        let number_text = number.to_string();
        list.add(capitals(&name, ""), &number_text, Elementary::Int, number, device.text(&command.about));
        list.add(capitals(&name, "mask"), &number_text, word, mask.into(), "");
        list.add(capitals(&name, "value"), &number_text, word, value.into(), "");
        for (bits, behind, phrase) in
            [(rising, "rising", Phrase::Rising), (falling, "falling", Phrase::Falling)]
        {
            if bits != 0 {
                let note = device.phrase(phrase, &[]);
                list.add(capitals(&name, behind), &number_text, word, bits.into(), &note);
            }
        }
        if let Some(send) = command.send {
            let note = device.phrase(Phrase::Send, &[]);
            list.add(capitals(&name, "send"), &number_text, word, send.into(), &note);
        }
    }
    list.named(device)
}

/// Constants whose names are not given yet.
#[derive(Default)]
struct Constants {
    wanted: Vec<Wanted>,
    declarations: Vec<Declaration>,
}

impl Constants {
    fn add(&mut self, name: String, number: &str, of_type: Elementary, value: i128, note: &str) {
        self.wanted.push(Wanted::new(name, number));
        let declaration = Declaration::new("", of_type.name(), note);
        self.declarations.push(declaration.with_value(Some(of_type.literal(value))));
    }

    fn named(self, device: &mut Device<'_>) -> Vec<Declaration> {
        let names = device.scope.give_all(&self.wanted);
        self.declarations.into_iter().zip(names).map(|(one, name)| Declaration { name, ..one }).collect()
    }
}

impl Machine<'_> {
    /// Numbers, masks and values.
    pub(super) fn print_constants(&self, device: &Device<'_>, text: &mut Text) {
        let StateMachine { name, status, command, .. } = self.of;
        text.comment(&[device.phrase(Phrase::StatesOf, &[name, &device.title(*status)])]);
        text.declarations(&self.states);
        if !self.commands.is_empty() {
            text.line("");
            text.comment(&[device.phrase(Phrase::CommandsOf, &[name, &device.title(*command)])]);
            text.declarations(&self.commands);
        }
    }

    /// The functions.
    pub(super) fn print(&self, device: &Device<'_>, text: &mut Text) {
        let Self { of: machine, status, command, state, give, .. } = self;
        text.line("");
        text.comment(
            &[device.phrase(Phrase::StateFunction, &[&machine.name, &device.title(machine.status)])],
        );
        text.line(&format!("FUNCTION {state} : INT"));
        text.variables("VAR_INPUT", &[Declaration::new("raw", status.name(), "")]);
        text.line(&format!("{state} := 0;"));
        for (at, one) in machine.states.iter().enumerate() {
            let (mask, value) = one.pattern.mask_and_value();
            let word = if at == 0 { "IF" } else { "ELSIF" };
            let shows =
                format!("(raw AND {}) = {}", status.literal(mask.into()), status.literal(value.into()));
            text.noted(&format!("{word} {shows} THEN"), &one.name);
            text.line(&format!("    {state} := {};", at + 1));
        }
        if !machine.states.is_empty() {
            text.line("END_IF;");
        }
        text.line("END_FUNCTION");
        if machine.commands.is_empty() {
            return;
        }
        text.line("");
        text.comment(&[device.phrase(Phrase::CommandFunction, &[&machine.name])]);
        text.line(&format!("FUNCTION {give} : {}", command.name()));
        let inputs = [Declaration::new("raw", command.name(), ""), Declaration::new("command", "INT", "")];
        text.variables("VAR_INPUT", &inputs);
        text.line(&format!("{give} := raw;"));
        text.block("CASE command OF", "END_CASE;", |text| {
            for (number, one) in (1..).zip(&machine.commands) {
                let (mask, value) = one.pattern.mask_and_value();
                let others = Elementary::literal(*command, !i128::from(mask));
                text.noted(&format!("{number}:"), &one.name);
                text.line(&format!("    {give} := (raw AND {others}) OR {};", command.literal(value.into())));
            }
        });
        text.line("END_FUNCTION");
    }
}
