//! State machines: how commands, a device's own work and what happens to it lead from state to state.
//!
//! Generated code describes each machine of a specification by the type of its states, which implements [`MachineState`]: what
//! states look like in the status word, which transitions there are, and which of them a command word asks for.
//! [`StateMachine`] is in one of these states, and shows it in the dictionary. Whether a transition may be made now, and what is to be done
//! then, the application says ([`StateHandler`]).
//!
//! ```
//! use firmware_glue::state_machine::{ByDevice, Cause, MachineState, Start, StateHandler, StateMachine};
//!
//! // What generated code says of a lamp: bit 0 of the command switches it, bit 0 of the status shows it.
//! #[derive(Default)]
//! struct Words { command: u8, status: u8 }
//!
//! #[derive(Debug, Clone, Copy, PartialEq, Eq)]
//! enum Lamp { Off, On }
//!
//! #[derive(Debug, Clone, Copy, PartialEq, Eq)]
//! enum Transition { Switched, Burnt }
//!
//! impl MachineState for Lamp {
//!     type Dictionary = Words;
//!     type Transition = Transition;
//!     type Word = u8;
//!     const TRANSITIONS: &'static [Transition] = &[Transition::Switched, Transition::Burnt];
//!
//!     fn leaves(transition: Transition) -> &'static [Self] {
//!         match transition { Transition::Switched => &[Self::Off], Transition::Burnt => &[Self::On] }
//!     }
//!     fn enters(transition: Transition) -> Self {
//!         match transition { Transition::Switched => Self::On, Transition::Burnt => Self::Off }
//!     }
//!     fn by_device(transition: Transition) -> ByDevice {
//!         match transition { Transition::Switched => ByDevice::Never, Transition::Burnt => ByDevice::Event }
//!     }
//!     fn asks(transition: Transition, before: u8, word: u8) -> bool {
//!         transition == Transition::Switched && before & 1 == 0 && word & 1 == 1
//!     }
//!     fn command(words: &Words) -> u8 { words.command }
//!     fn show(self, words: &mut Words) { words.status = words.status & !1 | u8::from(self == Self::On); }
//! }
//! impl Start for Lamp { const START: Self = Self::Off; }
//!
//! // What the firmware says: no light without a bulb.
//! struct Socket { has_bulb: bool }
//!
//! impl StateHandler<Lamp> for Socket {
//!     fn may(&mut self, _: &Words, transition: Transition, _: Cause) -> bool {
//!         transition == Transition::Burnt || self.has_bulb
//!     }
//! }
//!
//! let (mut words, mut socket) = (Words::default(), Socket { has_bulb: true });
//! let mut lamp = StateMachine::<Lamp>::new();
//! lamp.start(&mut words);
//!
//! words.command = 1; // a client writes
//! assert_eq!(lamp.step(&mut words, &mut socket), Some(Transition::Switched));
//! assert_eq!((lamp.state(), words.status), (Lamp::On, 1));
//!
//! socket.has_bulb = false;
//! assert_eq!(lamp.event(&mut words, &mut socket, Transition::Burnt), Ok(()));
//! assert_eq!((lamp.state(), words.status), (Lamp::Off, 0));
//! ```

/// How a device makes a transition that is not commanded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ByDevice {
    /// Only a command causes it, or the start.
    Never,
    /// When something happens to the device: [`StateMachine::event`].
    Event,
    /// When what the device does in the state is done: [`StateMachine::step`].
    Automatic,
}

/// What causes a transition this time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cause {
    /// The command word.
    Command,
    /// Something that happened to the device.
    Event,
    /// That the device is done with what it does in the state.
    Automatic,
}

/// Why a transition was not made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Refused {
    /// It does not leave the present state.
    NotFromHere,
    /// The device never makes it by itself.
    OnlyOnCommand,
    /// The application says that it may not be made now.
    NotNow,
}

/// The states of a machine with its transitions and commands, as generated code describes them.
pub trait MachineState: Copy + Eq + 'static {
    /// The dictionary that has the two words.
    type Dictionary;
    /// The transitions by number.
    type Transition: Copy + Eq + 'static;
    /// The command word.
    type Word: Copy;

    /// All transitions, ascending.
    const TRANSITIONS: &'static [Self::Transition];

    /// The states that a transition leaves; none at the start.
    fn leaves(transition: Self::Transition) -> &'static [Self];

    /// The state that a transition enters.
    fn enters(transition: Self::Transition) -> Self;

    /// How the device makes a transition without a command.
    fn by_device(transition: Self::Transition) -> ByDevice;

    /// Whether a command that asks for the transition is in a word; an edge is a difference from the word before.
    fn asks(transition: Self::Transition, before: Self::Word, word: Self::Word) -> bool;

    /// The command word of a dictionary.
    fn command(dictionary: &Self::Dictionary) -> Self::Word;

    /// Puts the state into the status word. Bits that say nothing about it stay.
    fn show(self, dictionary: &mut Self::Dictionary);
}

/// States of which one is the first after power-on.
pub trait Start: MachineState {
    /// The first state.
    const START: Self;
}

/// The application's part in a state machine.
pub trait StateHandler<S: MachineState> {
    /// Whether a transition may be made now. It is asked each time that there is a cause for the transition: a fault is reset when none is pending any more, a
    /// self-test or a quick stop is left when it is over. An action that has to be over before the new state is shown is begun here, and ends with `true`.
    fn may(&mut self, dictionary: &S::Dictionary, transition: S::Transition, cause: Cause) -> bool;

    /// Called after a transition, when the dictionary shows the new state.
    fn entered(&mut self, dictionary: &mut S::Dictionary, transition: S::Transition, cause: Cause) {
        let _ = (dictionary, transition, cause);
    }
}

/// A state machine: the state that it is in, and the command word that it saw last.
///
/// After the dictionary is made, and whenever its values were set back, [`start`](Self::start) shows the state. Then [`step`](Self::step) is called in every
/// cycle and, so that no edge is missed, after each write to the command word (`Application::changed`); [`event`](Self::event), when something
/// happens to the device.
///
/// A word commands as long as it is in the dictionary, as the levels of a control word do: `0x000F` leads from "ready
/// to switch on" in two steps to "operation enabled". A firmware that does not want that calls
/// [`command`](Self::command) with each word that is written, and nothing else.
#[derive(Debug, Clone)]
pub struct StateMachine<S: MachineState> {
    state: S,
    seen: Option<S::Word>,
}

impl<S: Start> Default for StateMachine<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Start> StateMachine<S> {
    /// In the first state after power-on.
    #[must_use]
    pub const fn new() -> Self {
        Self::at(S::START)
    }
}

impl<S: MachineState> StateMachine<S> {
    /// In a state. The first word that it sees has no edges.
    #[must_use]
    pub const fn at(state: S) -> Self {
        Self { state, seen: None }
    }

    /// The state that it is in.
    #[must_use]
    pub const fn state(&self) -> S {
        self.state
    }

    /// Shows the state in the dictionary. Edges count from the command word that is there now.
    pub fn start(&mut self, dictionary: &mut S::Dictionary) {
        self.seen = Some(S::command(dictionary));
        self.state.show(dictionary);
    }

    /// The transitions that a command word asks for in this state, ascending. Nothing changes.
    pub fn asked(&self, word: S::Word) -> impl Iterator<Item = S::Transition> {
        let before = self.seen.unwrap_or(word);
        self.ways().filter(move |transition| S::asks(*transition, before, word))
    }

    /// Makes at most one transition, and shows the state: one that the dictionary's command word asks for, or else one that is automatic. Of several,
    /// it is the first that the application allows.
    pub fn step<H: StateHandler<S>>(
        &mut self,
        dictionary: &mut S::Dictionary,
        handler: &mut H,
    ) -> Option<S::Transition> {
        let word = S::command(dictionary);
        self.command(dictionary, handler, word).or_else(|| self.automatic(dictionary, handler))
    }

    /// Makes at most one transition that a command word asks for, and shows the state. An edge counts once: what was not allowed then needs another.
    pub fn command<H: StateHandler<S>>(
        &mut self,
        dictionary: &mut S::Dictionary,
        handler: &mut H,
        word: S::Word,
    ) -> Option<S::Transition> {
        let mut asked = self.asked(word);
        let made = asked.find(|transition| handler.may(dictionary, *transition, Cause::Command));
        drop(asked);
        self.seen = Some(word);
        self.make(dictionary, handler, made, Cause::Command)
    }

    /// Makes at most one automatic transition, and shows the state.
    pub fn automatic<H: StateHandler<S>>(
        &mut self,
        dictionary: &mut S::Dictionary,
        handler: &mut H,
    ) -> Option<S::Transition> {
        let made = self.ways().find(|transition| {
            S::by_device(*transition) == ByDevice::Automatic
                && handler.may(dictionary, *transition, Cause::Automatic)
        });
        self.make(dictionary, handler, made, Cause::Automatic)
    }

    /// Makes a transition because something happened to the device.
    ///
    /// # Errors
    /// It does not leave the present state, needs a command, or is not allowed now. The state stays.
    pub fn event<H: StateHandler<S>>(
        &mut self,
        dictionary: &mut S::Dictionary,
        handler: &mut H,
        transition: S::Transition,
    ) -> Result<(), Refused> {
        let refused = if S::by_device(transition) == ByDevice::Never {
            Some(Refused::OnlyOnCommand)
        } else if !S::leaves(transition).contains(&self.state) {
            Some(Refused::NotFromHere)
        } else if !handler.may(dictionary, transition, Cause::Event) {
            Some(Refused::NotNow)
        } else {
            None
        };
        let made = if refused.is_none() { Some(transition) } else { None };
        self.make(dictionary, handler, made, Cause::Event);
        refused.map_or(Ok(()), Err)
    }

    /// The transitions that leave the present state.
    fn ways(&self) -> impl Iterator<Item = S::Transition> + use<S> {
        let state = self.state;
        S::TRANSITIONS.iter().copied().filter(move |transition| S::leaves(*transition).contains(&state))
    }

    fn make<H: StateHandler<S>>(
        &mut self,
        dictionary: &mut S::Dictionary,
        handler: &mut H,
        transition: Option<S::Transition>,
        cause: Cause,
    ) -> Option<S::Transition> {
        if let Some(transition) = transition {
            self.state = S::enters(transition);
        }
        self.state.show(dictionary);
        if let Some(transition) = transition {
            handler.entered(dictionary, transition, cause);
        }
        transition
    }
}

#[cfg(feature = "defmt")]
impl<S: MachineState + defmt::Format> defmt::Format for StateMachine<S> {
    fn format(&self, f: defmt::Formatter<'_>) {
        self.state.format(f);
    }
}
