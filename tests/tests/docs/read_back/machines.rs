//! Tables of state machines.

use od_spec::model::{PatternBit, StateMachine};

use super::cells::flat;
use crate::markdown::Table;

fn pattern_cell(bit: PatternBit) -> &'static str {
    match bit {
        PatternBit::Zero => "0",
        PatternBit::One => "1",
        PatternBit::Any => "x",
        PatternBit::Rising => "0→1",
        PatternBit::Falling => "1→0",
    }
}

pub(super) fn check_states(table: &Table, machine: &StateMachine) {
    assert_eq!(table.rows.len(), machine.states.len());
    for (row, state) in table.rows.iter().zip(&machine.states) {
        let bits: Vec<&str> = state.pattern.0.iter().map(|bit| pattern_cell(*bit)).collect();
        assert_eq!(row[0].replace(' ', ""), bits.concat());
        assert_eq!(table.cell(row, "State"), state.name);
        assert_eq!(table.cell(row, "Meaning"), flat(state.about.get("en").unwrap_or_default()));
    }
}

pub(super) fn check_transitions(table: &Table, machine: &StateMachine) {
    assert_eq!(table.rows.len(), machine.transitions.len());
    for (row, transition) in table.rows.iter().zip(&machine.transitions) {
        assert_eq!(table.cell(row, "Transition"), transition.number.to_string());
        assert_eq!(table.cell(row, "From"), transition.from.join(", "));
        assert_eq!(table.cell(row, "To"), transition.to);
        assert_eq!(table.cell(row, "Event"), flat(transition.event.get("en").unwrap_or_default()));
        assert_eq!(table.cell(row, "Action"), flat(transition.action.get("en").unwrap_or_default()));
    }
}

pub(super) fn check_commands(table: &Table, machine: &StateMachine) {
    assert_eq!(table.rows.len(), machine.commands.len());
    for (row, command) in table.rows.iter().zip(&machine.commands) {
        assert_eq!(table.cell(row, "Command"), command.name);
        let width = command.pattern.0.len();
        for (at, bit) in command.pattern.0.iter().enumerate() {
            let title = format!("Bit {}", width - 1 - at);
            let column = table
                .columns
                .iter()
                .position(|column| column == &title || column.starts_with(&format!("{title} ")));
            // A bit without a column is free in every command.
            let Some(column) = column else {
                assert_eq!(*bit, PatternBit::Any, "{} {title}", command.name);
                continue;
            };
            let sent = command.send.map(|code| code & (1 << (width - 1 - at)) != 0);
            let is_open_and_sent = (*bit, sent) == (PatternBit::Any, Some(true));
            let expected = if is_open_and_sent { "x (1)" } else { pattern_cell(*bit) };
            assert_eq!(row[column], expected, "{} {title}", command.name);
        }
        let send = command.send.map_or(String::new(), |value| format!("{value:04X}h"));
        assert_eq!(table.cell(row, "Code"), send, "{}", command.name);
        let transitions: Vec<String> = command.transitions.iter().map(u8::to_string).collect();
        assert_eq!(table.cell(row, "Transition"), transitions.join(", "), "{}", command.name);
    }
}
