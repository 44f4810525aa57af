//! State machines and command codings.

use std::collections::BTreeMap;

use super::refs::{Broken, Names};
use super::scope::unknown;
use super::types::words;
use super::{to_u8, to_u32};
use crate::ast::{MachineDecl, Name, Spec};
use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::{BitPattern, Command, Dictionary, EntryId, State, StateMachine, Transition};
use crate::source::Spanned;
use crate::yaml::shorten;

pub(super) fn resolve(
    root: &Spec,
    devices: &[Dictionary],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<String, StateMachine> {
    root.machines
        .iter()
        .filter_map(|decl| Some((decl.name.value.clone(), machine(decl, devices, broken, diagnostics)?)))
        .collect()
}

fn machine(
    decl: &MachineDecl,
    devices: &[Dictionary],
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<StateMachine> {
    let on: Vec<String> = decl.on.iter().flatten().map(|key| key.value.clone()).collect();
    let meant = |device: &&Dictionary| on.is_empty() || on.contains(&device.key);
    let mut found: Option<(&Dictionary, EntryId, EntryId)> = None;
    for device in devices.iter().filter(meant) {
        let names = Names::new(device.objects.values());
        let mut find = |name: &Option<Name>| {
            names.find(name.as_ref()?, |id| device.entry(id).is_some(), broken, diagnostics)
        };
        let (status, command) = (find(&decl.status)?, find(&decl.command)?);
        match found {
            Some((first, ..)) if !matches!(found, Some((_, one, other)) if (one, other) == (status, command)) =>
            {
                diagnostics.push(
                    Diagnostic::new(
                        Code::DuplicateName,
                        decl.name.span,
                        format!(
                            "state machine `{}` has other entries on `{}` than on `{}`",
                            shorten(&decl.name.value),
                            device.key,
                            first.key
                        ),
                    )
                    .help("describe a machine per device, each with its `on:`"),
                );
                return None;
            }
            Some(_) => {}
            None => found = Some((device, status, command)),
        }
    }
    let (device, status, command) = found?;
    let states: Vec<State> = decl
        .states
        .iter()
        .filter_map(|(name, pattern, about)| {
            check_width(pattern.as_ref()?, status, device, diagnostics)?;
            Some(State { name: name.value.clone(), pattern: pattern.clone()?.value, about: words(about) })
        })
        .collect();
    check_states_differ(decl, &states, diagnostics);
    let known = |name: &Name, diagnostics: &mut Diagnostics| {
        let names = decl.states.iter().map(|(name, ..)| name.value.as_str());
        let found = names.clone().any(|state| state == name.value);
        if !found {
            let otherwise = "name one of the machine's states";
            diagnostics.push(unknown(Code::UnknownState, name, "state", names, otherwise));
        }
        found
    };
    let mut transitions: Vec<Transition> = Vec::new();
    for one in &decl.transitions {
        let from = match one.from.as_slice() {
            [start] if start.value == "start" => Vec::new(),
            [any] if any.value == "any" => decl.states.iter().map(|(name, ..)| name.value.clone()).collect(),
            list => {
                list.iter().filter(|name| known(name, diagnostics)).map(|name| name.value.clone()).collect()
            }
        };
        let Some(to) = one.to.as_ref().filter(|to| known(to, diagnostics)) else { continue };
        transitions.push(Transition {
            number: to_u8(one.number.value),
            from,
            to: to.value.clone(),
            event: words(&one.event),
            action: words(&one.action),
        });
    }
    transitions.sort_by_key(|transition| transition.number);
    let commands = commands(decl, command, device, diagnostics);
    Some(StateMachine {
        name: decl.name.value.clone(),
        devices: on,
        status,
        command,
        states,
        transitions,
        commands,
    })
}

fn commands(
    decl: &MachineDecl,
    entry: EntryId,
    device: &Dictionary,
    diagnostics: &mut Diagnostics,
) -> Vec<Command> {
    let mut commands = Vec::new();
    for one in &decl.commands {
        let Some(pattern) = &one.pattern else { continue };
        if check_width(pattern, entry, device, diagnostics).is_none() {
            continue;
        }
        let (mask, value) = pattern.value.mask_and_value();
        if let Some(send) = &one.send
            && (u64::from(to_u32(send.value)) & mask != value || send.value >> pattern.value.0.len() != 0)
        {
            diagnostics.push(
                Diagnostic::new(
                    Code::CommandMismatch,
                    send.span,
                    format!("{:04X}h does not give this command", send.value),
                )
                .label(format!("bits {mask:04X}h must be {value:04X}h"))
                .with(pattern.span, "the command's bits")
                .help("correct the code or the pattern"),
            );
        }
        for number in &one.transitions {
            if !decl.transitions.iter().any(|transition| transition.number.value == number.value) {
                diagnostics.push(
                    Diagnostic::new(
                        Code::UnknownState,
                        number.span,
                        format!("there is no transition {}", number.value),
                    )
                    .help("name a number from the machine's `transitions:`"),
                );
            }
        }
        commands.push(Command {
            name: one.name.value.clone(),
            pattern: pattern.value.clone(),
            send: one.send.as_ref().map(|send| to_u32(send.value)),
            transitions: one.transitions.iter().map(|number| to_u8(number.value)).collect(),
            about: words(&one.about),
        });
    }
    commands
}

/// A pattern has as many bits as the entry it describes.
fn check_width(
    pattern: &Spanned<BitPattern>,
    entry: EntryId,
    device: &Dictionary,
    diagnostics: &mut Diagnostics,
) -> Option<()> {
    let width = device.entry(entry)?.data_type.bits()?;
    let given = pattern.value.0.len();
    if usize::from(width) == given {
        return Some(());
    }
    diagnostics.push(
        Diagnostic::new(
            Code::PatternWidth,
            pattern.span,
            format!("the pattern has {given} bits, {entry} has {width}"),
        )
        .help(format!("write {width} places, most significant bit first")),
    );
    None
}

/// No value of the status entry may show two states.
fn check_states_differ(decl: &MachineDecl, states: &[State], diagnostics: &mut Diagnostics) {
    for (at, state) in states.iter().enumerate() {
        let (mask, value) = state.pattern.mask_and_value();
        for other in &states[at + 1..] {
            let (other_mask, other_value) = other.pattern.mask_and_value();
            let common = mask & other_mask;
            if value & common != other_value & common {
                continue;
            }
            let span = |name: &str| decl.states.iter().find(|(n, ..)| n.value == name).map(|(n, ..)| n.span);
            let (Some(here), Some(there)) = (span(&other.name), span(&state.name)) else { continue };
            diagnostics.push(
                Diagnostic::new(
                    Code::AmbiguousStates,
                    here,
                    format!("`{}` and `{}` can look the same in the status entry", state.name, other.name),
                )
                .label("this state")
                .with(there, "and this one")
                .help("give the patterns a bit that is 0 in one state and 1 in the other"),
            );
        }
    }
}
