//! What became of a node that something was done with.

use od_bus::client::{Bus, Client};

use super::Target;
use crate::exit::{DIFFERS, SUCCESS};
use crate::report::Report;

/// A node, and what became of it.
pub(super) struct Outcome<'a> {
    pub(super) target: Target<'a>,
    /// The exit code that it has for itself.
    pub(super) code: u8,
    pub(super) state: State,
}

/// In which state a node is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// All is done.
    Done,
    /// It was looked at, and has other values.
    Differs,
    /// It cannot get what it is to get; nothing was sent.
    Unfit,
    /// It was not its turn, or what was to be done failed before anything was sent.
    LeftAlone,
    /// So many values were sent, and not all is done.
    Sent(usize),
    /// It started again.
    Started,
}

impl<'a> Outcome<'a> {
    /// After an exit code and so many writes.
    pub(super) const fn after(target: Target<'a>, code: u8, writes: usize) -> Self {
        let state = match (code, writes) {
            (SUCCESS, _) => State::Done,
            (DIFFERS, _) => State::Differs,
            (_, 0) => State::LeftAlone,
            (_, writes) => State::Sent(writes),
        };
        Self { target, code, state }
    }

    /// A node that was done with first may have started again while others were.
    pub(super) fn heed_start<B: Bus>(&mut self, client: &mut Client<B>, report: &Report) {
        let is_told = matches!(self.state, State::Started | State::Unfit);
        if !is_told && let Err(failed) = self.target.has_started(client, report) {
            self.code = worse(self.code, failed);
            self.state = State::Started;
        }
    }

    /// The line about it, where something is `compared` or `restored`.
    pub(super) fn line(&self, done: &str) -> String {
        let state = match self.state {
            State::Done => done.to_owned(),
            State::Differs => "differs".to_owned(),
            State::Unfit => format!("cannot be {done}, left as it was"),
            State::LeftAlone => format!("not {done}, left as it was"),
            State::Sent(1) => format!("not {done}, 1 value was sent"),
            State::Sent(writes) => format!("not {done}, {writes} values were sent"),
            State::Started => "started again in the middle".to_owned(),
        };
        format!("  {}  {state}\n", self.target.name())
    }
}

/// The exit code for two things: an error outweighs a difference.
pub(super) fn worse(one: u8, other: u8) -> u8 {
    match (one, other) {
        (SUCCESS | DIFFERS, SUCCESS | DIFFERS) => one.max(other),
        (SUCCESS | DIFFERS, failed) | (failed, _) => failed,
    }
}
