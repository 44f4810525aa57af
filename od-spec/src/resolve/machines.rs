//! State machines and command codings.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use super::libraries::{self, Libraries};
use super::numbers::{to_u8, to_u32};
use super::refs::{Broken, NamesOf};
use super::scope::unknown;
use super::types::{with_gap, words};
use super::varied::Varied;
use crate::ast::{Lacking, MachineDecl, Name, Spec, TransitionDecl};
use crate::check::codes as rule_codes;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::keys::{COMMAND, Keys, STATE, TRANSITION};
use crate::limits::STATES;
use crate::model::{
    BitPattern, ByDevice, Command, Devices, Dictionary, EntryId, State, StateMachine, Transition,
};
use crate::order::Arrange as _;
use crate::source::{Span, Spanned};

pub(super) fn resolve(
    root: &Spec,
    libraries: &Libraries<'_>,
    names: &NamesOf<'_>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<String, StateMachine> {
    let (mut machines, varied) = (BTreeMap::new(), Varied::of(root));
    for decl in &root.machines {
        let Some(whole) = whole(decl, libraries, diagnostics) else { continue };
        if let Some(machine) = machine(&whole, names, &varied, broken, diagnostics) {
            machines.insert(decl.name.value.clone(), machine);
        }
    }
    machines
}

/// A declaration laid over the library's machine of its name, where `from:` says so.
fn whole<'a>(
    decl: &'a MachineDecl,
    libraries: &Libraries<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Cow<'a, MachineDecl>> {
    let Some(from) = &decl.from else {
        for key in decl.lacking().into_iter().filter(|_| !decl.unsure) {
            diagnostics.push(
                Diagnostic::new(
                    codes::MISSING_KEY,
                    decl.name.span,
                    format!("a state machine needs the key `{key}`, or `from`"),
                )
                .help(format!("add `{key}:`, or `from:` with a library that defines the machine")),
            );
        }
        return Some(Cow::Borrowed(decl));
    };
    let library = libraries.named(from, diagnostics)?;
    let Some(below) = libraries.machine(library, &decl.name.value) else {
        let what = format!("the state machine `{}`", shorten(&decl.name.value));
        let known = library.machines.iter().map(|machine| format!("`{}`", machine.name.value));
        let help = format!("it defines {}", known.collect::<Vec<_>>().join(", "));
        diagnostics.push(libraries::not_there(from, &what).help(help));
        return None;
    };
    let mut states = below.states.clone();
    for over in &decl.states {
        match states.iter_mut().find(|below| below.name.value == over.name.value) {
            Some(state) => {
                state.pattern = over.pattern.clone().or_else(|| state.pattern.clone());
                state.about = over.about.clone().or_else(|| state.about.clone());
                state.gap = over.gap.clone().or_else(|| state.gap.clone());
            }
            None => states.push(over.clone()),
        }
    }
    let mut transitions = below.transitions.clone();
    for over in &decl.transitions {
        match transitions.iter_mut().find(|below| below.number.value == over.number.value) {
            Some(transition) => {
                if !over.from.is_empty() {
                    transition.from.clone_from(&over.from);
                }
                transition.to = over.to.clone().or_else(|| transition.to.clone());
                transition.event = over.event.clone().or_else(|| transition.event.clone());
                transition.action = over.action.clone().or_else(|| transition.action.clone());
                transition.by_device = over.by_device.or(transition.by_device);
            }
            None => transitions.push(over.clone()),
        }
    }
    let mut commands = below.commands.clone();
    for over in &decl.commands {
        match commands.iter_mut().find(|below| below.name.value == over.name.value) {
            Some(command) => {
                command.pattern = over.pattern.clone().or_else(|| command.pattern.clone());
                command.send = over.send.or(command.send);
                command.about = over.about.clone().or_else(|| command.about.clone());
                command.gap = over.gap.clone().or_else(|| command.gap.clone());
                if !over.transitions.is_empty() {
                    command.transitions.clone_from(&over.transitions);
                }
            }
            None => commands.push(over.clone()),
        }
    }
    // What the library names and the device has not is reported where the library is named.
    let named = |below: &Option<Name>| Some(Spanned::new(below.as_ref()?.value.clone(), from.span));
    Some(Cow::Owned(MachineDecl {
        status: decl.status.clone().or_else(|| named(&below.status)),
        command: decl.command.clone().or_else(|| named(&below.command)),
        states,
        transitions,
        commands,
        ..decl.clone()
    }))
}

fn machine(
    decl: &MachineDecl,
    names: &NamesOf<'_>,
    varied: &Varied<'_>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<StateMachine> {
    let on = Devices::listed(decl.devices.iter().flatten().map(|key| key.value.as_str()));
    let mut found: Option<(&Dictionary, EntryId, EntryId)> = None;
    for (device, names) in names.each(&on) {
        let mut find = |name: &Option<Name>| {
            names.find(name.as_ref()?, |id| device.entry(id).is_some(), broken, diagnostics)
        };
        let (status, command) = (find(&decl.status)?, find(&decl.command)?);
        match found {
            Some((first, ..)) if !matches!(found, Some((_, one, other)) if (one, other) == (status, command)) =>
            {
                diagnostics.push(
                    Diagnostic::new(
                        rule_codes::DUPLICATE_NAME,
                        decl.name.span,
                        format!(
                            "state machine `{}` has other entries on `{}` than on `{}`",
                            shorten(&decl.name.value),
                            device.key,
                            first.key
                        ),
                    )
                    .help("describe a machine per device, each with its `devices:`"),
                );
                return None;
            }
            Some(_) => {}
            None => found = Some((device, status, command)),
        }
    }
    let (device, status, command) = found?;
    for (id, written) in [(status, &decl.status), (command, &decl.command)] {
        let keys = names.each(&on).map(|(device, _)| device.key.as_str());
        let place = written.as_ref().map_or(decl.name.span, |name| name.span);
        let help = "describe a machine per device, each with its `devices:`";
        if varied.is_refused(id.index, place, keys, help, diagnostics) {
            return None;
        }
        if width(id, device).is_none() {
            let data_type = device.entry(id)?.data_type;
            let message = format!("{id} is {data_type}, whose bits are neither states nor commands");
            diagnostics.push(
                Diagnostic::new(codes::PATTERN_WIDTH, place, message)
                    .help("name an entry of an integer type"),
            );
            return None;
        }
    }
    if decl.states.len() > STATES {
        let message = format!("{} states; a state machine has at most {STATES}", decl.states.len());
        diagnostics.push(
            Diagnostic::new(codes::TOO_MUCH, decl.name.span, message)
                .help("describe several machines, each with the states that its status entry distinguishes"),
        );
        return None;
    }
    check_complete(decl, diagnostics);
    let states: Vec<State> = decl
        .states
        .iter()
        .filter_map(|state| {
            let pattern = state.pattern.as_ref()?;
            check_width(pattern, status, device, diagnostics)?;
            let (name, pattern) = (state.name.value.clone(), pattern.value.clone());
            Some(State { name, pattern, about: with_gap(&state.about, &state.gap), span: state.name.span })
        })
        .collect();
    check_states_differ(decl, &states, diagnostics);
    let transitions = transitions(decl, diagnostics);
    let commands = commands(decl, command, device, diagnostics);
    let place = |entry: &Option<Name>| entry.as_ref().map_or(decl.name.span, |name| name.span);
    Some(StateMachine {
        name: decl.name.value.clone(),
        devices: on,
        status,
        command,
        states,
        transitions,
        commands,
        span: decl.name.span,
        entry_places: (place(&decl.status), place(&decl.command)),
    })
}

/// The transitions, between states that the machine has.
fn transitions(decl: &MachineDecl, diagnostics: &mut Diagnostics) -> Vec<Transition> {
    let names: BTreeSet<&str> = decl.states.iter().map(|state| state.name.value.as_str()).collect();
    let known = |name: &Name, diagnostics: &mut Diagnostics| {
        let found = names.contains(name.value.as_str());
        if !found {
            let names = names.iter().copied();
            let otherwise = "name one of the machine's states";
            unknown(codes::UNKNOWN_STATE, name, "state", names, otherwise, diagnostics);
        }
        found
    };
    let mut transitions: Vec<Transition> = Vec::new();
    let commanded: BTreeSet<i128> =
        decl.commands.iter().flat_map(|one| &one.transitions).map(|number| number.value).collect();
    for one in &decl.transitions {
        let from = match one.from.as_slice() {
            [start] if start.value == "start" => Vec::new(),
            [any] if any.value == "any" => decl.states.iter().map(|state| state.name.value.clone()).collect(),
            list => {
                list.iter().filter(|name| known(name, diagnostics)).map(|name| name.value.clone()).collect()
            }
        };
        let Some(to) = one.to.as_ref().filter(|to| known(to, diagnostics)) else { continue };
        transitions.push(Transition {
            number: to_u8(one.number.value),
            to: to.value.clone(),
            event: words(&one.event),
            action: words(&one.action),
            by_device: by_device(one, &from, to, commanded.contains(&one.number.value), diagnostics),
            from,
            span: one.number.span,
        });
    }
    transitions.arrange_by_key(|transition| transition.number);
    transitions
}

/// How the device makes a transition by itself; a cause that cannot be is reported.
fn by_device(
    one: &TransitionDecl,
    from: &[String],
    to: &Name,
    is_commanded: bool,
    diagnostics: &mut Diagnostics,
) -> ByDevice {
    let is_start = one.from.iter().any(|name| name.value == "start");
    let Some(written) = one.by_device else {
        return if is_start || is_commanded { ByDevice::Never } else { ByDevice::Event };
    };
    let number = one.number.value;
    let (message, label, help) = match written.value {
        ByDevice::Automatic | ByDevice::Event if is_start => (
            format!("transition {number} is the start, which has no other cause"),
            "nothing comes before power-on",
            "remove the key",
        ),
        ByDevice::Automatic if from.contains(&to.value) => (
            format!("transition {number} would be made again and again"),
            "it leaves the state that it enters",
            "leave the state out of `from:`, or write `event`",
        ),
        ByDevice::Never if !is_start && !is_commanded => (
            format!("nothing causes transition {number}"),
            "the device never does, and no command either",
            "name the transition in `transitions:` of a command, or write `event` or `automatic`",
        ),
        ByDevice::Never | ByDevice::Event | ByDevice::Automatic => return written.value,
    };
    diagnostics.push(Diagnostic::new(codes::WRONG_TRANSITION, written.span, message).label(label).help(help));
    written.value
}

fn commands(
    decl: &MachineDecl,
    entry: EntryId,
    device: &Dictionary,
    diagnostics: &mut Diagnostics,
) -> Vec<Command> {
    let mut commands = Vec::new();
    let known: BTreeSet<i128> = decl.transitions.iter().map(|transition| transition.number.value).collect();
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
                    codes::COMMAND_MISMATCH,
                    send.span,
                    format!("{:04X}h does not give this command", send.value),
                )
                .label(format!("bits {mask:04X}h must be {value:04X}h"))
                .with(pattern.span, "the command's bits")
                .help("correct the code or the pattern"),
            );
        }
        for number in &one.transitions {
            if !known.contains(&number.value) {
                diagnostics.push(
                    Diagnostic::new(
                        codes::UNKNOWN_STATE,
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
            about: with_gap(&one.about, &one.gap),
            span: one.name.span,
        });
    }
    commands
}

/// States, transitions and commands have what makes them, here or in the library.
fn check_complete(decl: &MachineDecl, diagnostics: &mut Diagnostics) {
    let mut check = |keys: &Keys, place: Span, decl: &dyn Lacking| {
        for key in decl.lacking() {
            let message = format!("{} needs the key `{key}`", keys.name);
            diagnostics
                .push(Diagnostic::new(codes::MISSING_KEY, place, message).help(format!("add `{key}:`")));
        }
    };
    for state in &decl.states {
        check(&STATE, state.name.span, state);
    }
    for transition in &decl.transitions {
        check(&TRANSITION, transition.number.span, transition);
    }
    for command in &decl.commands {
        check(&COMMAND, command.name.span, command);
    }
}

/// A pattern has as many bits as the entry it describes.
fn check_width(
    pattern: &Spanned<BitPattern>,
    entry: EntryId,
    device: &Dictionary,
    diagnostics: &mut Diagnostics,
) -> Option<()> {
    let width = width(entry, device)?;
    let given = pattern.value.0.len();
    if usize::from(width) == given {
        return Some(());
    }
    diagnostics.push(
        Diagnostic::new(
            codes::PATTERN_WIDTH,
            pattern.span,
            format!("the pattern has {given} bits, {entry} has {width}"),
        )
        .help(format!("write {width} places, most significant bit first")),
    );
    None
}

/// The bits of an entry that mean states or commands; `None` for one of another type than an integer.
fn width(entry: EntryId, device: &Dictionary) -> Option<u16> {
    let data_type = device.entry(entry)?.data_type;
    data_type.bits().filter(|_| data_type.is_integer())
}

/// No value of the status entry may show two states.
fn check_states_differ(decl: &MachineDecl, states: &[State], diagnostics: &mut Diagnostics) {
    let places: BTreeMap<&str, Span> =
        decl.states.iter().rev().map(|state| (state.name.value.as_str(), state.name.span)).collect();
    for (at, later) in states.iter().enumerate() {
        let (later_mask, later_value) = later.pattern.mask_and_value();
        // One other state is enough: the next message names another.
        let state = states[..at].iter().find(|state| {
            let (mask, value) = state.pattern.mask_and_value();
            let common = mask & later_mask;
            value & common == later_value & common
        });
        let span = |name: &str| places.get(name).copied();
        if let Some(state) = state
            && let (Some(later_place), Some(earlier_place)) = (span(&later.name), span(&state.name))
        {
            diagnostics.push(
                Diagnostic::new(
                    codes::AMBIGUOUS_STATES,
                    later_place,
                    format!("`{}` and `{}` can look the same in the status entry", state.name, later.name),
                )
                .label("this state")
                .with(earlier_place, "and this one")
                .help("give the patterns a bit that is 0 in one state and 1 in the other"),
            );
        }
    }
}
