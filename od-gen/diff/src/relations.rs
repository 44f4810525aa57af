//! What a device has in addition to its objects: error codes, state machines, conditions between entries.

use std::collections::BTreeSet;

use od_spec::model::{
    BitPattern, Constraint, ErrorCode, Expr, Fact, PatternBit, StateMachine, System, Transition,
};

use super::change::{Change, Class, Consequence, Place};
use super::objects::Devices;
use super::rules::{self, same_words};
use super::texts::{phrases, texts};
use super::types::Names;

/// The systems that the devices belong to.
#[derive(Clone, Copy)]
pub(super) struct Systems<'a> {
    pub old: &'a System,
    pub new: &'a System,
    pub devices: Devices<'a>,
    pub names: Names,
}

impl Systems<'_> {
    /// What differs in addition to the objects.
    pub(super) fn relations(self) -> Vec<Change> {
        let mut changes = self.any_error();
        changes.extend(self.errors());
        changes.extend(self.constraints());
        changes.extend(self.machines());
        changes
    }

    fn gone(self) -> Option<Consequence> {
        match self.names {
            Names::InCode => Some(Consequence::new(Class::Firmware, "the name is gone from generated code")),
            Names::Nowhere => None,
        }
    }

    fn errors(self) -> Vec<Change> {
        let of = |system: &'_ System, key: &str| -> Vec<ErrorCode> {
            system.errors.iter().filter(|error| error.devices.includes(key)).cloned().collect()
        };
        let old = of(self.old, &self.devices.old.key);
        let new = of(self.new, &self.devices.new.key);
        let codes: BTreeSet<u16> = old.iter().chain(&new).map(|error| error.code).collect();
        let mut changes = Vec::new();
        for code in codes {
            let find = |list: &[ErrorCode]| list.iter().position(|error| error.code == code);
            let place = Place::Error(code);
            match (find(&old).map(|at| &old[at]), find(&new).map(|at| &new[at])) {
                (Some(before), Some(after)) => changes.extend(self.error(before, after)),
                (Some(before), None) => changes.push(
                    Change::removed(place, &before.name)
                        .named(&before.name)
                        .so(Class::Plc, "a program waits for a code that never comes")
                        .with(self.gone()),
                ),
                (None, Some(after)) => changes.push(
                    Change::added(place, &after.name)
                        .named(&after.name)
                        .so(Class::Addition, "nothing waits for it yet"),
                ),
                (None, None) => {}
            }
        }
        changes
    }

    fn error(self, before: &ErrorCode, after: &ErrorCode) -> Vec<Change> {
        let (place, language) = (Place::Error(after.code), self.devices.language);
        let name = Change::text(place.clone(), Fact::Name, &before.name, &after.name);
        let renamed = (!same_words(&before.name, &after.name)).then(|| self.gone()).flatten();
        let name = name.map(|change| change.so(Class::Documents, "the code is the same").with(renamed));
        let priority =
            Change::of(place.clone(), Fact::Priority, before.priority.clone(), after.priority.clone())
                .map(|change| change.so(Class::Behaviour, "the device treats the error otherwise"));
        let reaction = texts(&place, Fact::Reaction, &before.reaction, &after.reaction, language);
        let reaction = reaction.into_iter().map(|change| behaves(change, DOES_SOMETHING_ELSE));
        let chosen = |error: &ErrorCode| error.option_code.map(|id| id.to_string());
        let option_code = Change::of(place.clone(), Fact::OptionCode, chosen(before), chosen(after))
            .map(|change| behaves(change, DOES_SOMETHING_ELSE));
        let reset = self.reset(before, after);
        let about = texts(&place, Fact::About, &before.about, &after.about, language);
        let found = name.into_iter().chain(priority).chain(reaction).chain(option_code);
        let kinds = |error: &ErrorCode| format!("0x{:02X}", error.register());
        let register = Change::text(place.clone(), Fact::Register, &kinds(before), &kinds(after))
            .map(|change| change.so(Class::Plc, "1001h and emergency messages report another kind of error"));
        let treats = |error: &ErrorCode, key: &str| error.treated_by.includes(key);
        let treated = (treats(before, &self.devices.old.key), treats(after, &self.devices.new.key));
        let yes_no = |is_it: bool| if is_it { "as stated" } else { "otherwise" };
        let treated = Change::text(place.clone(), Fact::Reaction, yes_no(treated.0), yes_no(treated.1))
            .map(|change| behaves(change, DOES_SOMETHING_ELSE).part("treated-by"));
        let search = phrases(&place, &before.search, &after.search, language);
        let found = found.chain(register).chain(treated).chain(reset).chain(about).chain(search);
        found.map(|change| change.named(&after.name)).collect()
    }

    /// What resets an error. What is said of every error of a device is compared once, for the device.
    fn reset(self, before: &ErrorCode, after: &ErrorCode) -> Vec<Change> {
        if before.reset.is_empty() && after.reset.is_empty() {
            return Vec::new();
        }
        let (old, new) = (before.reset_on(self.devices.old), after.reset_on(self.devices.new));
        let changes = texts(&Place::Error(after.code), Fact::Reset, old, new, self.devices.language);
        changes.into_iter().map(|change| behaves(change, RESET_OTHERWISE)).collect()
    }

    /// What is said of every error of the device.
    fn any_error(self) -> Vec<Change> {
        let (old, new) = (&self.devices.old.any_error, &self.devices.new.any_error);
        let facts = [
            (Fact::Shown, &old.shown, &new.shown, SHOWN_OTHERWISE),
            (Fact::Reaction, &old.reaction, &new.reaction, DOES_SOMETHING_ELSE),
            (Fact::Reset, &old.reset, &new.reset, RESET_OTHERWISE),
        ];
        let changes = facts.into_iter().flat_map(|(fact, old, new, because)| {
            let changes = texts(&Place::Device, fact, old, new, self.devices.language);
            changes.into_iter().map(move |change| behaves(change.part("any error"), because))
        });
        changes.collect()
    }

    fn constraints(self) -> Vec<Change> {
        let of = |system: &'_ System, key: &str| -> Vec<Constraint> {
            system.constraints.iter().filter(|one| one.devices.includes(key)).cloned().collect()
        };
        let old = of(self.old, &self.devices.old.key);
        let new = of(self.new, &self.devices.new.key);
        let names: BTreeSet<&str> = old.iter().chain(&new).map(|one| one.name.as_str()).collect();
        let written = |one: &Constraint| (shape(&one.require), one.when.as_ref().map(shape));
        let mut changes = Vec::new();
        for name in names {
            let find = |list: &[Constraint]| list.iter().position(|one| one.name == name);
            let place = Place::Constraint(name.to_owned());
            match (find(&old).map(|at| &old[at]), find(&new).map(|at| &new[at])) {
                (Some(before), Some(after)) => {
                    if written(before) != written(after) {
                        let change =
                            Change::text(place.clone(), Fact::Requirement, &text(before), &text(after));
                        changes.extend(change.map(|change| {
                            change.so(Class::Plc, "settings that were accepted can be refused")
                        }));
                    }
                    let language = self.devices.language;
                    changes.extend(texts(&place, Fact::About, &before.about, &after.about, language));
                }
                (Some(before), None) => {
                    let (class, because) = if new.iter().any(|one| written(one) == written(before)) {
                        (Class::Documents, "the same is asked under another name")
                    } else {
                        (Class::Addition, "more settings are accepted")
                    };
                    changes.push(Change::removed(place, text(before)).so(class, because).with(self.gone()));
                }
                (None, Some(after)) => {
                    let (class, because) = if old.iter().any(|one| written(one) == written(after)) {
                        (Class::Documents, "the same was asked under another name")
                    } else {
                        (Class::Plc, "settings that were accepted can be refused")
                    };
                    changes.push(Change::added(place, text(after)).so(class, because));
                }
                (None, None) => {}
            }
        }
        changes
    }

    fn machines(self) -> Vec<Change> {
        let has = |system: &'_ System, name: &str, key: &str| {
            system.machines.get(name).filter(|machine| machine.devices.includes(key)).cloned()
        };
        let names: BTreeSet<&String> = self.old.machines.keys().chain(self.new.machines.keys()).collect();
        let mut changes = Vec::new();
        for name in names {
            let place = Place::Machine(name.clone());
            let before = has(self.old, name, &self.devices.old.key);
            let after = has(self.new, name, &self.devices.new.key);
            match (before, after) {
                (Some(before), Some(after)) => changes.extend(self.machine(&place, &before, &after)),
                (Some(before), None) => changes.push(
                    Change::removed(place, shown_in(&before))
                        .so(Class::Plc, "a program that follows the states fails")
                        .with(self.gone()),
                ),
                (None, Some(after)) => changes.push(
                    Change::added(place, shown_in(&after)).so(Class::Addition, "nothing follows it yet"),
                ),
                (None, None) => {}
            }
        }
        changes
    }

    fn machine(self, place: &Place, old: &StateMachine, new: &StateMachine) -> Vec<Change> {
        let language = self.devices.language;
        let mut changes: Vec<Change> =
            Change::text(place.clone(), Fact::Alias, &shown_in(old), &shown_in(new))
                .map(|change| change.so(Class::Plc, "other entries show the state and take the commands"))
                .into_iter()
                .collect();
        let state = |machine: &StateMachine| {
            let states = machine.states.iter();
            let states = states.map(|one| (one.name.clone(), pattern(&one.pattern), one.about.clone()));
            states.collect::<Vec<_>>()
        };
        let command = |machine: &StateMachine| {
            let commands = machine.commands.iter();
            let commands = commands.map(|one| {
                let send = one.send.map(|send| format!(", sent as 0x{send:X}")).unwrap_or_default();
                (one.name.clone(), pattern(&one.pattern) + &send, one.about.clone())
            });
            commands.collect::<Vec<_>>()
        };
        let added = [
            (Class::Behaviour, "a program meets a state that it does not know"),
            (Class::Addition, "nothing gives it yet"),
        ];
        let lists = [("state", state(old), state(new)), ("command", command(old), command(new))];
        for ((word, old, new), (class, because)) in lists.into_iter().zip(added) {
            let names: BTreeSet<&String> = old.iter().chain(&new).map(|(name, ..)| name).collect();
            for name in names {
                let find = |list: &[(String, String, _)]| list.iter().position(|(one, ..)| one == name);
                let part = format!("{word} {name}");
                match (find(&old).map(|at| &old[at]), find(&new).map(|at| &new[at])) {
                    (Some((_, before, before_about)), Some((_, after, after_about))) => {
                        let change = Change::text(place.clone(), Fact::Meaning, before, after);
                        changes.extend(change.map(|change| {
                            change.part(part.clone()).so(Class::Plc, "the bits mean something else")
                        }));
                        let about = texts(place, Fact::About, before_about, after_about, language);
                        changes.extend(about.into_iter().map(|change| change.part(part.clone())));
                    }
                    (Some((_, before, _)), None) => changes.push(
                        Change::removed(place.clone(), before)
                            .part(part)
                            .so(Class::Plc, "a program that waits for it or gives it fails")
                            .with(self.gone()),
                    ),
                    (None, Some((_, after, _))) => {
                        changes.push(Change::added(place.clone(), after).part(part).so(class, because));
                    }
                    (None, None) => {}
                }
            }
        }
        changes.extend(self.transitions(place, &old.transitions, &new.transitions));
        changes.extend(effects(place, old, new));
        changes
    }

    fn transitions(self, place: &Place, old: &[Transition], new: &[Transition]) -> Vec<Change> {
        let language = self.devices.language;
        let ways = |one: &Transition| {
            let from = if one.from.is_empty() { "start".to_owned() } else { one.from.join(", ") };
            format!("from {from} to {}", one.to)
        };
        let numbers: BTreeSet<u8> = old.iter().chain(new).map(|one| one.number).collect();
        let mut changes = Vec::new();
        for number in numbers {
            let find = |list: &[Transition]| list.iter().position(|one| one.number == number);
            let part = format!("transition {number}");
            match (find(old).map(|at| &old[at]), find(new).map(|at| &new[at])) {
                (Some(before), Some(after)) => {
                    let change = Change::text(place.clone(), Fact::Meaning, &ways(before), &ways(after));
                    let change = change.map(|change| change.so(Class::Plc, "it leads elsewhere"));
                    changes.extend(change.map(|change| change.part(part.clone())));
                    let causes = (before.by_device.word(), after.by_device.word());
                    let change = Change::text(place.clone(), Fact::Reaction, causes.0, causes.1)
                        .map(|change| change.so(Class::Behaviour, "the device makes it by itself otherwise"));
                    changes.extend(change.map(|change| change.part(format!("{part}, by-device"))));
                    let words = [
                        ("event", &before.event, &after.event, "something else causes it"),
                        ("action", &before.action, &after.action, DOES_SOMETHING_ELSE),
                    ];
                    for (word, before, after, because) in words {
                        let found = texts(place, Fact::Reaction, before, after, language);
                        let found = found.into_iter().map(|change| behaves(change, because));
                        changes.extend(found.map(|change| change.part(format!("{part}, {word}"))));
                    }
                }
                (Some(before), None) => changes.push(
                    Change::removed(place.clone(), ways(before))
                        .part(part)
                        .so(Class::Plc, "a program that needs it waits for ever"),
                ),
                (None, Some(after)) => changes.push(
                    Change::added(place.clone(), ways(after))
                        .part(part)
                        .so(Class::Behaviour, "the device can change its state in another way"),
                ),
                (None, None) => {}
            }
        }
        changes
    }
}

const DOES_SOMETHING_ELSE: &str = "the device does something else";
const RESET_OTHERWISE: &str = "what reset the error before may not do it any more";
const SHOWN_OTHERWISE: &str = "a program looks for errors elsewhere";

/// A text that says how the device behaves, and so is more than words.
fn behaves(mut change: Change, because: &'static str) -> Change {
    change.consequences.clear();
    change.so(Class::Behaviour, because)
}

/// The transitions that a command causes.
fn effects(place: &Place, old: &StateMachine, new: &StateMachine) -> Vec<Change> {
    let list = |numbers: &[u8]| {
        let numbers: Vec<String> = numbers.iter().map(u8::to_string).collect();
        if numbers.is_empty() { "none".to_owned() } else { numbers.join(", ") }
    };
    let changes = old.commands.iter().filter_map(|before| {
        let after = new.commands.iter().find(|command| command.name == before.name)?;
        let change = Change::text(
            place.clone(),
            Fact::Reaction,
            &list(&before.transitions),
            &list(&after.transitions),
        )?;
        let part = format!("command {}, transitions", after.name);
        Some(change.part(part).so(Class::Behaviour, "the command does something else"))
    });
    changes.collect()
}

fn shape(condition: &Expr) -> impl PartialEq + use<> {
    condition.alternatives.clone()
}

/// A constraint as it is written.
fn text(constraint: &Constraint) -> String {
    match &constraint.when {
        None => constraint.require.text.clone(),
        Some(when) => format!("{} when {}", constraint.require.text, when.text),
    }
}

fn shown_in(machine: &StateMachine) -> String {
    format!("{} with commands in {}", machine.status, machine.command)
}

fn pattern(pattern: &BitPattern) -> String {
    let bit = |bit: &PatternBit| match bit {
        PatternBit::Zero => '0',
        PatternBit::One => '1',
        PatternBit::Any => 'x',
        PatternBit::Rising => 'r',
        PatternBit::Falling => 'f',
    };
    pattern.0.iter().map(bit).collect()
}

/// What all devices share: title, maker, manual.
pub(super) fn system(old: &System, new: &System, is_everything: bool, language: &str) -> Vec<Change> {
    let place = Place::System;
    let mut changes: Vec<Change> = Vec::new();
    let number = |system: &System| format!("0x{:08X}", system.vendor.number);
    changes.extend(
        Change::text(place.clone(), Fact::Vendor, &number(old), &number(new))
            .map(|change| change.part("number").with(rules::identity())),
    );
    let name = |system: &System| {
        let name = &system.vendor.name;
        if is_everything { name.clone() } else { od_spec::ascii::transliterate(name) }
    };
    changes.extend(
        Change::text(place.clone(), Fact::Vendor, &name(old), &name(new))
            .map(|change| change.part("name").so(Class::Documents, "masters compare numbers")),
    );
    if !is_everything {
        return changes;
    }
    changes.extend(
        Change::text(place.clone(), Fact::Name, &old.title, &new.title)
            .map(|change| change.so(Class::Documents, "a title")),
    );
    let languages = |system: &System| system.languages.join(", ");
    changes.extend(
        Change::text(place, Fact::Languages, &languages(old), &languages(new))
            .map(|change| change.so(Class::Documents, "texts for people")),
    );
    changes.extend(super::manual::changes(old, new, language));
    changes
}
