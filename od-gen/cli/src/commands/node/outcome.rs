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
    /// So many values were sent.
    pub(super) sent: usize,
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
    /// Not all is done: it failed, or it was not its turn.
    NotDone,
    /// It started again.
    Started,
}

impl<'a> Outcome<'a> {
    /// After an exit code and so many writes.
    pub(super) const fn after(target: Target<'a>, code: u8, sent: usize) -> Self {
        let state = match code {
            SUCCESS => State::Done,
            DIFFERS => State::Differs,
            _ => State::NotDone,
        };
        Self { target, code, state, sent }
    }

    /// Before anything was sent.
    pub(super) const fn untouched(target: Target<'a>, code: u8, state: State) -> Self {
        Self { target, code, state, sent: 0 }
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
        let sent = match self.sent {
            0 => String::new(),
            1 => ", 1 value was sent".to_owned(),
            sent => format!(", {sent} values were sent"),
        };
        let state = match self.state {
            State::Done => done.to_owned(),
            State::Differs => "differs".to_owned(),
            State::Unfit => format!("cannot be {done}, left as it was"),
            State::NotDone if self.sent == 0 => format!("not {done}, left as it was"),
            State::NotDone => format!("not {done}{sent}"),
            State::Started => format!("started again in the middle{sent}"),
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
