//! Machines of words of every kind: signed, of 32 bits, with a unit; without commands, without a start.

use firmware_glue::state_machine::{Cause, MachineState, Refused, StateHandler, StateMachine};

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod many {
    od_macros::object_dictionary!("shared/machines.od.yaml");
}

use many::Many;
use many::machines::{
    FixedCommand, FixedTransition, ShownCommand, ShownState, SignedMachine, SignedState, SignedTransition,
    SmallMachine, SmallState, SmallTransition, WideMachine, WideState, WideTransition,
};

/// Allows everything but one transition.
struct But<T>(Option<T>);

impl<S: MachineState> StateHandler<S> for But<S::Transition> {
    fn may(&mut self, _: &S::Dictionary, transition: S::Transition, _: Cause) -> bool {
        self.0 != Some(transition)
    }
}

#[test]
fn a_signed_word_is_its_bits() {
    let (mut od, mut machine) = (Many::new(1), SignedMachine::new());
    od.set_signed_status(-1);
    machine.start(&mut od);
    assert_eq!((machine.state(), od.signed_status()), (SignedState::Off, i16::MAX));
    od.set_signed_command(i16::MIN);
    assert_eq!(machine.step(&mut od, &mut But(None)), Some(SignedTransition::T2));
    assert_eq!((machine.state(), od.signed_status()), (SignedState::On, -1));
    assert_eq!(machine.step(&mut od, &mut But(None)), None);
    // The bit falls.
    od.set_signed_command(1);
    assert_eq!(machine.step(&mut od, &mut But(None)), Some(SignedTransition::T3));
    assert_eq!(machine.step(&mut od, &mut But(None)), None);
    assert_eq!(od.signed_status(), i16::MAX);
}

#[test]
fn a_word_of_32_bits() {
    let mut od = Many::new(1);
    od.set_wide_status(0x1234_5678);
    // It is not stated where it starts.
    let mut machine = WideMachine::at(WideState::Off);
    machine.start(&mut od);
    assert_eq!(od.wide_status(), 0x1234_5678);
    od.set_wide_command(0x8000_0001);
    assert_eq!(machine.step(&mut od, &mut But(Some(WideTransition::T200))), None);
    assert_eq!(
        machine.event(&mut od, &mut But(Some(WideTransition::T200)), WideTransition::T200),
        Err(Refused::NotNow)
    );
    assert_eq!(machine.event(&mut od, &mut But(None), WideTransition::T200), Ok(()));
    assert_eq!(od.wide_status(), 0x9234_5679);
    assert_eq!(machine.event(&mut od, &mut But(None), WideTransition::T200), Err(Refused::NotFromHere));
    assert_eq!(machine.event(&mut od, &mut But(None), WideTransition::T255), Ok(()));
    assert_eq!(od.wide_status(), 0x9234_5678);
}

#[test]
fn without_commands_and_with_two_ways_by_itself() {
    let mut od = Many::new(1);
    // Two transitions come from the start, so that the firmware says which state is first.
    let mut machine = SmallMachine::at(SmallState::First);
    machine.start(&mut od);
    od.set_small_command(many::units::Second(0xFF));
    let mut refused = machine.clone();
    assert_eq!(machine.step(&mut od, &mut But(None)), Some(SmallTransition::T2));
    assert_eq!(refused.step(&mut od, &mut But(Some(SmallTransition::T2))), Some(SmallTransition::T3));
    assert_eq!((refused.state(), od.small_status()), (SmallState::Third, many::types::Steps(2)));
    assert_eq!(format!("{machine:?}"), "StateMachine { state: Second, seen: Some(255) }");
}

#[test]
fn where_the_dictionary_has_no_word_or_no_transition_there_are_only_the_tables() {
    assert_eq!((FixedTransition::T0.number(), FixedTransition::T0.name()), (0, "transition 0"));
    assert!(FixedCommand::Nothing.is_given(many::units::Second(1).0, many::units::Second(0).0));
    assert_eq!(FixedCommand::Nothing.transitions(), []);
    assert_eq!((ShownState::Odd.bits(), ShownCommand::ALL.len()), ((1, 1), 1));
}

#[test]
fn nothing_is_made_before_it_is_asked_for() {
    let machine = StateMachine::<SignedState>::default();
    assert_eq!(machine.asked(i16::MIN).count(), 0);
}
