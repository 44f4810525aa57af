//! Generated state machines do what the tables of the specifications say, and what CiA 402 says: every transition in both directions,
//! every control word in every state, and long walks by chance.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cia402;
mod shapes;

use firmware_glue::state_machine::{
    ByDevice, Cause, MachineState, Refused, Start, StateHandler, StateMachine,
};
use od_generated::fullmo::{self, Fullmo};
use od_generated::pmc::{self, Pmc};
use od_spec::model;
use od_tests::compile_clean;

use cia402::{FAULT, NOT_READY, REACTION, STATES, WAYS};

/// A machine of a generated dictionary, as the tests look at it.
trait Drive: MachineState<Transition: Copy> + Start + std::fmt::Debug {
    const SPECIFICATION: &'static str;
    fn dictionary() -> Self::Dictionary;
    fn set_command(dictionary: &mut Self::Dictionary, word: u16);
    fn status(dictionary: &Self::Dictionary) -> u16;
    fn set_status(dictionary: &mut Self::Dictionary, word: u16);
    fn word(word: u16) -> Self::Word;
    fn of(word: u16) -> Option<Self>;
    fn name(self) -> &'static str;
    fn number(transition: Self::Transition) -> u8;
    /// What a control word asks for, by a table that was typed for the tests.
    fn asked(state: usize, before: u16, word: u16) -> Option<u8>;
}

macro_rules! drive {
    ($module:ident, $dictionary:ident, $word:ident, $status:ident, $path:literal, $asked:path,
        ($set_command:ident, $read_status:ident, $set_status:ident)) => {
        impl Drive for $module::machines::PowerDriveState {
            const SPECIFICATION: &'static str = $path;
            fn dictionary() -> $dictionary {
                $dictionary::new(1)
            }
            fn set_command(dictionary: &mut $dictionary, word: u16) {
                dictionary.$set_command($module::types::$word(word));
            }
            fn status(dictionary: &$dictionary) -> u16 {
                dictionary.$read_status().0
            }
            fn set_status(dictionary: &mut $dictionary, word: u16) {
                dictionary.$set_status($module::types::$status(word));
            }
            fn word(word: u16) -> $module::types::$word {
                $module::types::$word(word)
            }
            fn of(word: u16) -> Option<Self> {
                Self::of($module::types::$status(word))
            }
            fn name(self) -> &'static str {
                self.name()
            }
            fn number(transition: Self::Transition) -> u8 {
                transition.number()
            }
            fn asked(state: usize, before: u16, word: u16) -> Option<u8> {
                $asked(state, before, word)
            }
        }
    };
}

drive!(
    pmc,
    Pmc,
    Controlword,
    Statusword,
    "od-spec/devices/pitch-control-system.od.yaml",
    cia402::asked_of_pitch,
    (set_controlword, statusword, set_statusword)
);
drive!(
    fullmo,
    Fullmo,
    DriveControlword,
    DriveStatusword,
    "od-spec/devices/fullmo-drive.od.yaml",
    cia402::asked,
    (set_controlword, statusword, set_statusword)
);

/// An application that allows everything or nothing, and remembers what it was asked and notified of.
#[derive(Default)]
struct Says {
    allows: bool,
    asked: Vec<(u8, Cause)>,
    entered: Vec<(u8, Cause)>,
}

impl Says {
    fn yes() -> Self {
        Self { allows: true, ..Self::default() }
    }
}

impl<S: Drive> StateHandler<S> for Says {
    fn may(&mut self, _: &S::Dictionary, transition: S::Transition, cause: Cause) -> bool {
        self.asked.push((S::number(transition), cause));
        self.allows
    }

    fn entered(&mut self, dictionary: &mut S::Dictionary, transition: S::Transition, cause: Cause) {
        // The dictionary shows the state before the application is notified.
        assert_eq!(S::of(S::status(dictionary)), Some(S::enters(transition)));
        self.entered.push((S::number(transition), cause));
    }
}

/// A state by its place in the table of CiA 402.
fn state<S: Drive>(at: usize) -> S {
    S::of(STATES[at].2).unwrap()
}

/// The place of a state in the table of CiA 402.
fn at<S: Drive>(state: S) -> usize {
    let name = state.name().to_lowercase().replace('-', " ");
    STATES.iter().position(|(known, ..)| *known == name).unwrap()
}

fn transition<S: Drive>(number: u8) -> S::Transition {
    S::TRANSITIONS.iter().copied().find(|one| S::number(*one) == number).unwrap()
}

fn model<S: Drive>() -> model::StateMachine {
    compile_clean(S::SPECIFICATION).unwrap().machines["power drive"].clone()
}

fn both(pitch: fn(), fullmo: fn()) {
    pitch();
    fullmo();
}

/// The types say what the tables of the specification say, and what CiA 402 says.
fn tables_agree<S: Drive>() {
    let model = model::<S>();
    assert_eq!(model.states.len(), STATES.len());
    for state in &model.states {
        let found = state.pattern.mask_and_value();
        let name = state.name.to_lowercase().replace('-', " ");
        assert!(
            STATES.iter().any(|(known, mask, value)| (*known, u64::from(*mask), u64::from(*value))
                == (name.as_str(), found.0, found.1)),
            "{name}"
        );
    }
    assert_eq!(S::TRANSITIONS.len(), model.transitions.len());
    for (one, said) in S::TRANSITIONS.iter().zip(&model.transitions) {
        let names: Vec<&str> = S::leaves(*one).iter().map(|state| state.name()).collect();
        assert_eq!(
            (S::number(*one), names, S::enters(*one).name()),
            (said.number, said.from.iter().map(String::as_str).collect(), said.to.as_str())
        );
        let how = match said.by_device {
            model::ByDevice::Never => ByDevice::Never,
            model::ByDevice::Event => ByDevice::Event,
            model::ByDevice::Automatic => ByDevice::Automatic,
        };
        assert_eq!(S::by_device(*one), how);
    }
    // CiA 402, by number.
    let numbers: Vec<u8> = S::TRANSITIONS.iter().map(|one| S::number(*one)).collect();
    assert_eq!(numbers, (0..=16).collect::<Vec<_>>());
    for (number, from, to) in WAYS {
        let one = transition::<S>(number);
        assert_eq!((S::leaves(one), S::enters(one)), ([state::<S>(from)].as_slice(), state(to)), "{number}");
    }
    assert_eq!(S::leaves(transition::<S>(13)).len(), STATES.len());
    assert_eq!(S::enters(transition::<S>(13)), state(REACTION));
    assert!(S::leaves(transition::<S>(0)).is_empty());
    assert_eq!((S::START, S::enters(transition::<S>(0))), (state(NOT_READY), state(NOT_READY)));
    for number in 0..=16 {
        assert_eq!(
            S::by_device(transition::<S>(number)) == ByDevice::Automatic,
            [1, 12, 14].contains(&number),
            "{number}"
        );
    }
}

#[test]
fn the_types_say_what_the_tables_say() {
    both(tables_agree::<pmc::machines::PowerDriveState>, tables_agree::<fullmo::machines::PowerDriveState>);
}

/// Every word in every state, after three words before: exactly what the typed tables say, and nothing that CiA 402 does not say.
fn words_ask<S: Drive>() {
    for from in 0..STATES.len() {
        for before in [0_u16, 0x0080, 0xFFFF] {
            let mut machine = StateMachine::at(state::<S>(from));
            let mut dictionary = S::dictionary();
            S::set_command(&mut dictionary, before);
            machine.start(&mut dictionary);
            // All words of the ten bits that mean something, with the other bits clear and set.
            for word in (0..0x400_u16).flat_map(|word| [word, word | 0xFC00]) {
                let asked: Vec<u8> = machine.asked(S::word(word)).map(S::number).collect();
                assert_eq!(
                    asked,
                    Vec::from_iter(S::asked(from, before, word)),
                    "{from} {before:04X} {word:04X}"
                );
                assert!(
                    asked.iter().all(|one| cia402::asked(from, before, word) == Some(*one)),
                    "{from} {word:04X}"
                );
            }
        }
    }
}

#[test]
fn every_control_word_asks_for_what_it_should() {
    both(words_ask::<pmc::machines::PowerDriveState>, words_ask::<fullmo::machines::PowerDriveState>);
}

/// Each transition of each command, from each state: made where the table has it and the application allows it, and not otherwise.
fn commands_lead<S: Drive>() {
    let model = model::<S>();
    let mut made = std::collections::BTreeSet::new();
    for command in &model.commands {
        let Some(send) = command.send else { continue };
        let send = u16::try_from(send).unwrap();
        for from in 0..STATES.len() {
            let expected = S::asked(from, 0, send);
            for allows in [true, false] {
                let (mut machine, mut dictionary) = (StateMachine::at(state::<S>(from)), S::dictionary());
                let mut says = Says { allows, ..Says::default() };
                machine.start(&mut dictionary);
                assert_eq!(S::of(S::status(&dictionary)), Some(state(from)));
                let found = machine.command(&mut dictionary, &mut says, S::word(send)).map(S::number);
                assert_eq!(found, expected.filter(|_| allows), "{} from {from}", command.name);
                let to = found.map_or(from, |number| at(S::enters(transition::<S>(number))));
                assert_eq!((machine.state(), S::of(S::status(&dictionary))), (state(to), Some(state(to))));
                assert_eq!(says.asked, Vec::from_iter(expected.map(|number| (number, Cause::Command))));
                assert_eq!(says.entered, Vec::from_iter(found.map(|number| (number, Cause::Command))));
                made.extend(found);
            }
        }
    }
    // All but the start, the fault, and what only the device does.
    assert_eq!(made.into_iter().collect::<Vec<_>>(), [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 15, 16]);
}

#[test]
fn commands_lead_where_the_table_says() {
    both(commands_lead::<pmc::machines::PowerDriveState>, commands_lead::<fullmo::machines::PowerDriveState>);
}

/// Each transition as an event, from each state.
fn events_lead<S: Drive>() {
    for one in S::TRANSITIONS {
        for from in 0..STATES.len() {
            for allows in [true, false] {
                let (mut machine, mut dictionary) = (StateMachine::at(state::<S>(from)), S::dictionary());
                let mut says = Says { allows, ..Says::default() };
                machine.start(&mut dictionary);
                let found = machine.event(&mut dictionary, &mut says, *one);
                let expected = if S::by_device(*one) == ByDevice::Never {
                    Err(Refused::OnlyOnCommand)
                } else if !S::leaves(*one).contains(&state(from)) {
                    Err(Refused::NotFromHere)
                } else if allows {
                    Ok(())
                } else {
                    Err(Refused::NotNow)
                };
                assert_eq!(found, expected, "{} from {from}", S::number(*one));
                let to = if found.is_ok() { S::enters(*one) } else { state(from) };
                assert_eq!((machine.state(), S::of(S::status(&dictionary))), (to, Some(to)));
                assert_eq!(says.entered.len(), usize::from(found.is_ok()));
            }
        }
    }
}

#[test]
fn events_lead_where_the_table_says() {
    both(events_lead::<pmc::machines::PowerDriveState>, events_lead::<fullmo::machines::PowerDriveState>);
}

/// What the device does by itself, by the manuals: the pitch controller by Tables 42 and 50; the Fullmo drive as CiA 402, where its manual says nothing.
#[test]
fn the_device_does_by_itself_what_the_manuals_say() {
    let by_itself = |list: Vec<(u8, ByDevice)>| -> Vec<u8> {
        list.into_iter().filter(|(_, how)| *how == ByDevice::Event).map(|(number, _)| number).collect()
    };
    let pitch = pmc::machines::PowerDriveTransition::ALL.map(|one| (one.number(), one.by_device()));
    assert_eq!(by_itself(pitch.to_vec()), [2, 3, 4, 5, 7, 9, 10, 11, 13, 15, 16]);
    let fullmo = fullmo::machines::PowerDriveTransition::ALL.map(|one| (one.number(), one.by_device()));
    assert_eq!(by_itself(fullmo.to_vec()), [13]);
}

/// The status word has other bits, too.
fn other_bits_stay<S: Drive>() {
    for (from, (_, mask, value)) in STATES.iter().enumerate() {
        for word in [0, 0xFFFF, 0xA5A5, 0x5A5A] {
            let (mut machine, mut dictionary) = (StateMachine::at(state::<S>(from)), S::dictionary());
            S::set_status(&mut dictionary, word);
            machine.start(&mut dictionary);
            assert_eq!(S::status(&dictionary), word & !mask | value);
        }
    }
}

#[test]
fn only_the_bits_of_the_state_change() {
    both(
        other_bits_stay::<pmc::machines::PowerDriveState>,
        other_bits_stay::<fullmo::machines::PowerDriveState>,
    );
}

/// One word leads through two states, one transition in each step; the self-test and a quick stop end by themselves.
fn steps<S: Drive>() {
    let (mut machine, mut dictionary, mut says) = (StateMachine::<S>::new(), S::dictionary(), Says::yes());
    machine.start(&mut dictionary);
    let mut step = |word, dictionary: &mut S::Dictionary, says: &mut Says| {
        S::set_command(dictionary, word);
        machine.step(dictionary, says).map(S::number)
    };
    assert_eq!(step(0, &mut dictionary, &mut Says::default()), None, "the self-test is not over");
    assert_eq!(step(0, &mut dictionary, &mut says), Some(1));
    assert_eq!(step(0, &mut dictionary, &mut says), None);
    assert_eq!(step(0x0106, &mut dictionary, &mut says), Some(2));
    assert_eq!(step(0x010F, &mut dictionary, &mut says), Some(3));
    assert_eq!(step(0x010F, &mut dictionary, &mut says), Some(4));
    assert_eq!(step(0x010F, &mut dictionary, &mut says), None);
    assert_eq!(step(0x010B, &mut dictionary, &mut says), Some(11));
    assert_eq!(step(0x010B, &mut dictionary, &mut Says::default()), None, "the quick stop is not over");
    assert_eq!(step(0x010B, &mut dictionary, &mut says), Some(12));
    let causes: Vec<Cause> = says.entered.iter().map(|(_, cause)| *cause).collect();
    assert_eq!(causes[0], Cause::Automatic);
    assert_eq!(causes[1..5], [Cause::Command; 4]);
    assert_eq!(causes[5..], [Cause::Automatic]);
}

#[test]
fn a_word_commands_as_long_as_it_is() {
    both(steps::<pmc::machines::PowerDriveState>, steps::<fullmo::machines::PowerDriveState>);
}

/// A fault is reset by an edge: a bit that is there from the start is not an edge, one edge counts once, and one that
/// came too early is over.
fn resets<S: Drive>() {
    let (mut dictionary, mut says) = (S::dictionary(), Says::yes());
    let mut machine = StateMachine::at(state::<S>(FAULT));
    S::set_command(&mut dictionary, 0x80);
    assert_eq!(machine.step(&mut dictionary, &mut says).map(S::number), None, "the first word has no edges");
    machine = StateMachine::at(state::<S>(FAULT));
    machine.start(&mut dictionary);
    assert_eq!(machine.step(&mut dictionary, &mut says).map(S::number), None, "the bit was set before");
    for (word, pending, expected) in
        [(0, false, None), (0x80, true, None), (0x80, false, None), (0, false, None), (0x80, false, Some(15))]
    {
        says.allows = !pending;
        S::set_command(&mut dictionary, word);
        assert_eq!(machine.step(&mut dictionary, &mut says).map(S::number), expected);
    }
    assert_eq!(machine.state(), state(cia402::DISABLED));
}

#[test]
fn a_fault_is_reset_by_an_edge() {
    both(resets::<pmc::machines::PowerDriveState>, resets::<fullmo::machines::PowerDriveState>);
}

/// An application that decides by the bits of a number.
struct Chance(u32);

impl<S: Drive> StateHandler<S> for Chance {
    fn may(&mut self, _: &S::Dictionary, transition: S::Transition, _: Cause) -> bool {
        self.0 >> S::number(transition) & 1 == 1
    }
}

/// What a naive machine knows: the place of its state, and the word before.
struct Naive {
    state: usize,
    before: u16,
}

impl Naive {
    fn enter(&mut self, number: u8) {
        self.state = match WAYS.iter().find(|(way, ..)| *way == number) {
            Some((.., to)) => *to,
            None => REACTION,
        };
    }

    /// A word that is in the dictionary, while the application allows the transitions of some bits.
    fn step<S: Drive>(&mut self, word: u16, allowed: u32) {
        let may = |number: u8| allowed >> number & 1 == 1;
        let asked = S::asked(self.state, self.before, word).filter(|number| may(*number));
        self.before = word;
        let automatic = WAYS
            .iter()
            .find(|(way, from, _)| [1, 12, 14].contains(way) && *from == self.state)
            .map(|(way, ..)| *way);
        if let Some(number) = asked.or(automatic.filter(|number| may(*number))) {
            self.enter(number);
        }
    }

    fn event(&mut self, number: u8, happens: bool, allowed: u32) {
        let leaves = number == 13 || WAYS.iter().any(|(way, from, _)| *way == number && *from == self.state);
        if leaves && happens && allowed >> number & 1 == 1 {
            self.enter(number);
        }
    }
}

/// A long walk compared with a naive machine: words with the useful bits more often than others, events of every
/// number.
fn walk<S: Drive>() {
    let mut seed = 0x2545_F491_4F6C_DD1D_u64;
    let mut random = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        u32::try_from(seed >> 32).unwrap()
    };
    let (mut machine, mut dictionary) = (StateMachine::<S>::new(), S::dictionary());
    machine.start(&mut dictionary);
    let mut naive = Naive { state: NOT_READY, before: 0 };
    let mut seen = [0_u32; 8];
    for _ in 0..200_000 {
        let allowed = random() | random();
        let others = u16::try_from(random() & 0xFFFF).unwrap();
        let (_, mask, _) = STATES[naive.state];
        let before = S::status(&dictionary) & mask | others & !mask;
        S::set_status(&mut dictionary, before);
        if random() % 8 > 0 {
            let words =
                [0x0006, 0x0007, 0x000F, 0x010F, 0x0107, 0x010B, 0x0002, 0x0000, 0x0080, 0x0106, others];
            let word = words[usize::try_from(random()).unwrap() % words.len()];
            S::set_command(&mut dictionary, word);
            machine.step(&mut dictionary, &mut Chance(allowed));
            naive.step::<S>(word, allowed);
        } else {
            let number = u8::try_from(random() % 17).unwrap();
            let one = transition::<S>(number);
            let _ = machine.event(&mut dictionary, &mut Chance(allowed), one);
            naive.event(number, S::by_device(one) != ByDevice::Never, allowed);
        }
        assert_eq!(at(machine.state()), naive.state);
        let (_, mask, value) = STATES[naive.state];
        assert_eq!(S::status(&dictionary), before & !mask | value);
        seen[naive.state] += 1;
    }
    // The self-test is over soon, and never comes again.
    assert!(seen[1..].iter().all(|times| *times > 300), "{seen:?}");
}

#[test]
fn a_long_walk_ends_where_a_naive_machine_does() {
    both(walk::<pmc::machines::PowerDriveState>, walk::<fullmo::machines::PowerDriveState>);
}
