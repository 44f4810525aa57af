//! Why a program is not loaded and started, and what the node has then.

use od_bus::client::AccessError;
use od_bus::program::{FlashStatus, State};
use od_spec::model::EntryId;

use super::state_in_words;

/// What is done to a program, in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    Stop,
    Clear,
    Load,
    Start,
}

impl Step {
    pub(super) const fn verb(self) -> &'static str {
        match self {
            Self::Stop => "stop",
            Self::Clear => "delete",
            Self::Load => "load",
            Self::Start => "start",
        }
    }
}

/// Why a step failed.
#[derive(Debug)]
pub(super) enum Failure {
    /// The node refused an access, or did not answer.
    Access(EntryId, AccessError),
    /// The node has loaded the program and reports that it is not good.
    Flash(EntryId, FlashStatus),
    /// The memory of the node was busy all the time.
    Busy(EntryId),
    /// The node has taken a command and is in another state.
    State(EntryId, Option<State>),
    /// The user interrupted the command.
    Interrupted,
}

impl Failure {
    pub(super) const fn is_interrupt(&self) -> bool {
        matches!(self, Self::Interrupted)
    }

    /// What happened, as the end of a message.
    pub(super) fn why(&self) -> String {
        match self {
            Self::Access(id, error) => format!("{id}: {error}"),
            Self::Flash(id, status) => format!("{id}: {status}"),
            Self::Busy(id) => format!("{id}: the flash memory stays busy"),
            Self::State(id, state) => format!("{id}: {}", state_in_words(*state)),
            Self::Interrupted => "interrupted".to_owned(),
        }
    }
}

/// Whether a step has had an effect on the node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Effect {
    /// It was not begun, or the node refused it.
    None,
    /// It was begun, and the answer is missing.
    Unknown,
    /// Some of the data went to the node.
    Partly,
    /// The node has confirmed it.
    Done,
}

/// What the node has where a step failed.
pub(super) const fn left(step: Step, effect: Effect) -> &'static str {
    match (step, effect) {
        (Step::Stop, Effect::None | Effect::Partly) => "the program was neither stopped nor deleted",
        (Step::Stop, Effect::Unknown) => "whether the program was stopped is not known; it was not deleted",
        (Step::Stop, Effect::Done) | (Step::Clear, Effect::None | Effect::Partly) => {
            "the program is stopped, and was not deleted"
        }
        (Step::Clear, Effect::Unknown) => "the program is stopped; whether it was deleted is not known",
        (Step::Clear, Effect::Done) | (Step::Load, Effect::None) => {
            "the old program is deleted, and nothing of the new one was loaded"
        }
        (Step::Load, Effect::Partly) => "the old program is deleted, and the new one is not complete",
        (Step::Load, Effect::Unknown) => {
            "the old program is deleted; whether the new one is complete is not known"
        }
        (Step::Load, Effect::Done) => {
            "the old program is deleted; the new one was sent as a whole, and was not started"
        }
        (Step::Start, Effect::None | Effect::Partly) => "the new program is loaded, and was not started",
        (Step::Start, Effect::Unknown) => "the new program is loaded; whether it was started is not known",
        (Step::Start, Effect::Done) => {
            "the new program is loaded; the node has taken the command to start it"
        }
    }
}
