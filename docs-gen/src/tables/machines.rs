//! States, transitions and commands of a state machine.

use od_spec::model::{BitPattern, Command, Dictionary, Entry, EntryId, PatternBit, StateMachine, TypeKind};

use super::Columns;
use crate::diagrams::machine::picture;
use crate::language::Word;
use crate::source::Source;
use crate::view::cell::entry_anchor;
use crate::view::{Align, Cell, Grid, Row};

/// A pattern in groups of four bits, most significant first: `xxxx xxxx x01x 0001`.
fn pattern(pattern: &BitPattern) -> String {
    let mut text = String::new();
    for (at, bit) in pattern.0.iter().enumerate() {
        if at > 0 && (pattern.0.len() - at).is_multiple_of(4) {
            text.push(' ');
        }
        text.push(match bit {
            PatternBit::Zero | PatternBit::Falling => '0',
            PatternBit::One | PatternBit::Rising => '1',
            PatternBit::Any => 'x',
        });
    }
    text
}

/// One bit of a command.
const fn level(bit: PatternBit) -> &'static str {
    match bit {
        PatternBit::Zero => "0",
        PatternBit::One => "1",
        PatternBit::Any => "x",
        PatternBit::Rising => "0→1",
        PatternBit::Falling => "1→0",
    }
}

/// What a command wants of a bit.
fn bit_of(pattern: &BitPattern, bit: usize) -> PatternBit {
    let at = pattern.0.len().checked_sub(bit + 1);
    at.and_then(|at| pattern.0.get(at).copied()).unwrap_or(PatternBit::Any)
}

/// The bits that any command looks at, the highest first.
fn bits_of_commands(machine: &StateMachine) -> Vec<usize> {
    let width = machine.commands.iter().map(|command| command.pattern.0.len()).max().unwrap_or(0);
    let is_looked_at = |bit: &usize| {
        machine.commands.iter().any(|command| bit_of(&command.pattern, *bit) != PatternBit::Any)
    };
    (0..width).rev().filter(is_looked_at).collect()
}

/// Whether the code of a command has a bit at 1 that the command leaves open.
fn sends_open(command: &Command, bit: usize) -> bool {
    bit_of(&command.pattern, bit) == PatternBit::Any && command.send.is_some_and(|code| code >> bit & 1 == 1)
}

impl Source<'_> {
    pub(crate) fn states(&self, machine: &StateMachine) -> Grid {
        let stated = self.stated_of_machine(machine);
        let rows = machine
            .states
            .iter()
            .map(|state| {
                Row::of(vec![
                    Cell::default().code(pattern(&state.pattern)).stated(stated),
                    Cell::plain(&state.name),
                    self.text(&state.about).stated(stated),
                ])
            })
            .collect();
        let title =
            self.name_of(machine, machine.status).unwrap_or_else(|| self.word(Word::Pattern).to_owned());
        let grid = Columns::new()
            .with("pattern", title, Align::Left)
            .left(self, "state", Word::State)
            .left(self, "meaning", Word::Meaning)
            .grid(rows, &["pattern", "state"]);
        let patterns: Vec<String> = machine.states.iter().map(|state| pattern(&state.pattern)).collect();
        let status = self.target(&machine.devices, machine.status.index, entry_anchor(machine.status));
        let drawn = picture(machine, &patterns, status, |number| self.code_of(machine, number));
        Grid { machine: Some(drawn), ..grid }
    }

    /// The code that takes a transition: that of the command which means it most of all, as it takes the fewest others.
    fn code_of(&self, machine: &StateMachine, transition: u8) -> String {
        let sent = machine.commands.iter().filter_map(|command| Some((command, command.send?)));
        let meant = sent.filter(|(command, _)| command.transitions.contains(&transition));
        let code = meant.min_by_key(|(command, _)| command.transitions.len()).map(|(_, code)| code);
        let data_type = self.entry_of(machine, machine.command).map(|entry| entry.data_type);
        let reported = |(code, data_type)| self.wording.pattern(data_type, i128::from(code));
        code.zip(data_type).map_or_else(String::new, reported)
    }

    pub(crate) fn transitions(&self, machine: &StateMachine) -> Grid {
        let stated = self.stated_of_machine(machine);
        let rows = machine
            .transitions
            .iter()
            .map(|transition| {
                Row::of(vec![
                    Cell::plain(transition.number.to_string()),
                    Cell::plain(transition.from.join(", ")).stated(stated),
                    Cell::plain(&transition.to).stated(stated),
                    self.text(&transition.event).stated(stated),
                    self.text(&transition.action).stated(stated),
                ])
            })
            .collect();
        Columns::new()
            .right(self, "transition", Word::Transition)
            .left(self, "from", Word::From)
            .left(self, "to", Word::To)
            .left(self, "event", Word::Event)
            .left(self, "action", Word::Action)
            .grid(rows, &["transition", "from", "to", "event", "action"])
    }

    /// What the levels of open bits are, where a code has one at 1.
    pub(crate) fn about_commands(&self, machine: &StateMachine) -> Cell {
        let bits = bits_of_commands(machine);
        let sends_open = |command: &Command| bits.iter().any(|bit| sends_open(command, *bit));
        let needs_it = machine.commands.iter().any(sends_open);
        if needs_it { Cell::plain(self.word(Word::OpenBits)) } else { Cell::default() }
    }

    /// One row per command, with a column for every bit that any command looks at.
    pub(crate) fn commands(&self, machine: &StateMachine) -> Grid {
        let stated = self.stated_of_machine(machine);
        let bits = bits_of_commands(machine);
        let mut columns = Columns::new().left(self, "command", Word::Command);
        for bit in &bits {
            let name = self.bit_name(machine, *bit).unwrap_or_default();
            columns = columns.with(
                "bit",
                format!("{} {bit} {name}", self.word(Word::Bit)).trim_end(),
                Align::Center,
            );
        }
        let columns = columns
            .left(self, "send", Word::Send)
            .left(self, "transitions", Word::Transition)
            .left(self, "meaning", Word::Meaning);
        let data_type = self.entry_of(machine, machine.command).map(|entry| entry.data_type);
        let rows = machine
            .commands
            .iter()
            .map(|command| {
                let mut cells = vec![Cell::plain(&command.name)];
                cells.extend(bits.iter().map(|bit| {
                    let sent = if sends_open(command, *bit) { " (1)" } else { "" };
                    Cell::plain(format!("{}{sent}", level(bit_of(&command.pattern, *bit))))
                }));
                let send = command.send.zip(data_type);
                cells.push(send.map_or_else(Cell::default, |(value, data_type)| {
                    Cell::plain(self.wording.pattern(data_type, i128::from(value))).stated(stated)
                }));
                let transitions: Vec<String> = command.transitions.iter().map(u8::to_string).collect();
                cells.push(Cell::plain(transitions.join(", ")).stated(stated));
                cells.push(self.text(&command.about).stated(stated));
                Row::of(cells)
            })
            .collect();
        columns.grid(rows, &["command", "bit"])
    }

    /// The devices shown that have the machine.
    fn having<'b>(&'b self, machine: &'b StateMachine) -> impl Iterator<Item = &'b Dictionary> {
        self.devices.iter().copied().filter(|device| machine.devices.includes(&device.key))
    }

    fn name_of(&self, machine: &StateMachine, id: EntryId) -> Option<String> {
        self.having(machine).find_map(|device| device.entry_name(id))
    }

    fn entry_of<'b>(&'b self, machine: &'b StateMachine, id: EntryId) -> Option<&'b Entry> {
        self.having(machine).find_map(|device| device.entry(id))
    }

    fn bit_name(&self, machine: &StateMachine, bit: usize) -> Option<String> {
        let named = self.entry_of(machine, machine.command)?.named_type.as_ref()?;
        let TypeKind::Bits(fields) = &named.kind else { return None };
        let bit = u8::try_from(bit).ok()?;
        Some(fields.iter().find(|field| (field.first..=field.last).contains(&bit))?.name.clone())
    }
}
