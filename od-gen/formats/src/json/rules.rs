//! Error codes, state machines, constraints, errata.

use od_spec::model::{
    Constraint, Document, Erratum, ErratumPlace, ErrorCode, PatternBit, StateMachine, TableId,
};
use serde::Serialize;
use serde_json::{Value as Json, json};

use super::{
    Described, SearchWords, Words, described, entry_id, index, integer, search_words, with_description, words,
};
use crate::hexadecimal;

#[derive(Serialize)]
pub(super) struct ErrorView<'a> {
    code: String,
    name: &'a str,
    on: &'a [String],
    priority: Option<&'a str>,
    reaction: Words<'a>,
    option_code: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    treated_by: Option<&'a [String]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    register: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reset: Option<Words<'a>>,
    #[serde(flatten)]
    about: Described<'a>,
    #[serde(skip_serializing_if = "SearchWords::is_empty")]
    search: SearchWords<'a>,
}

pub(super) fn error(error: &ErrorCode) -> ErrorView<'_> {
    ErrorView {
        code: hexadecimal::prefixed(error.code, 4),
        name: &error.name,
        on: error.devices.keys(),
        priority: error.priority.as_deref(),
        reaction: words(&error.reaction),
        option_code: error.option_code.map(entry_id),
        treated_by: (error.treated_by != error.devices).then(|| error.treated_by.keys()),
        register: error.kinds.iter().map(|kind| kind.word()).collect(),
        reset: (!error.reset.is_empty()).then(|| words(&error.reset)),
        about: described(&error.about),
        search: search_words(&error.search),
    }
}

#[derive(Serialize)]
pub(super) struct MachineView<'a> {
    name: &'a str,
    on: &'a [String],
    status: String,
    command: String,
    states: Vec<Json>,
    transitions: Vec<Json>,
    commands: Vec<Json>,
}

fn pattern(bits: &[PatternBit]) -> String {
    bits.iter()
        .map(|bit| match bit {
            PatternBit::Zero => '0',
            PatternBit::One => '1',
            PatternBit::Any => 'x',
            PatternBit::Rising => 'r',
            PatternBit::Falling => 'f',
        })
        .collect()
}

pub(super) fn machine(machine: &StateMachine) -> MachineView<'_> {
    MachineView {
        name: &machine.name,
        on: machine.devices.keys(),
        status: entry_id(machine.status),
        command: entry_id(machine.command),
        states: machine
            .states
            .iter()
            .map(|state| {
                let map = json!({"name": state.name, "pattern": pattern(&state.pattern.0)});
                with_description(map, &state.about)
            })
            .collect(),
        transitions: machine
            .transitions
            .iter()
            .map(|transition| {
                json!({
                    "number": transition.number,
                    "from": transition.from,
                    "to": transition.to,
                    "event": words(&transition.event),
                    "action": words(&transition.action),
                    "by_device": transition.by_device.word(),
                })
            })
            .collect(),
        commands: machine
            .commands
            .iter()
            .map(|command| {
                let map = json!({
                    "name": command.name,
                    "pattern": pattern(&command.pattern.0),
                    "send": command.send,
                    "transitions": command.transitions,
                });
                with_description(map, &command.about)
            })
            .collect(),
    }
}

#[derive(Serialize)]
pub(super) struct ConstraintView<'a> {
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    series: Option<Json>,
    devices: &'a [String],
    require: &'a str,
    when: Option<&'a str>,
    #[serde(flatten)]
    about: Described<'a>,
}

pub(super) fn constraint(constraint: &Constraint) -> ConstraintView<'_> {
    ConstraintView {
        name: &constraint.name,
        series: constraint.series.as_ref().map(|one| json!({"name": one.name, "n": one.number})),
        devices: constraint.devices.keys(),
        require: &constraint.require.text,
        when: constraint.when.as_ref().map(|when| when.text.as_str()),
        about: described(&constraint.about),
    }
}

#[derive(Serialize)]
pub(super) struct ErratumView<'a> {
    at: Vec<String>,
    on: &'a [String],
    kind: &'static str,
    place: Words<'a>,
    prints: Words<'a>,
    reads: Words<'a>,
    because: Words<'a>,
    tables: Vec<Json>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    facts: Vec<&'static str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    of: Vec<Json>,
    #[serde(skip_serializing_if = "Option::is_none")]
    basis: Option<&'static str>,
}

pub(super) fn erratum<'a>(erratum: &'a Erratum, document: &Document) -> ErratumView<'a> {
    let table = |id: &TableId| {
        let section = document.sections.get(id.section)?;
        Some(json!({"section": section.number, "number": section.tables.get(id.table)?.number}))
    };
    ErratumView {
        at: erratum
            .at
            .iter()
            .map(|place| match place {
                ErratumPlace::Object(one) => index(*one),
                ErratumPlace::Entry(id) => format!("{}.{}", index(id.index), id.sub),
            })
            .collect(),
        on: erratum.devices.keys(),
        kind: erratum.kind.word(),
        place: words(&erratum.place),
        prints: words(&erratum.prints),
        reads: words(&erratum.reads),
        because: words(&erratum.because),
        tables: erratum.tables.iter().filter_map(table).collect(),
        facts: erratum.unprinted.iter().flat_map(|one| &one.facts).map(|fact| fact.word()).collect(),
        of: erratum.unprinted.iter().flat_map(|one| &one.of).map(|value| integer(*value)).collect(),
        basis: erratum.unprinted.as_ref().map(|one| one.basis.word()),
    }
}
