//! How far a long work is: one line that is written over, for people at a terminal.

use std::io::{IsTerminal as _, Write as _};

use crate::args::CheckFormat;

/// Who reads what a command says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Audience {
    /// People.
    People,
    /// Programs, which want nothing beside the messages.
    Programs,
}

impl Audience {
    /// Who reads messages in a format.
    pub(crate) const fn of(format: CheckFormat) -> Self {
        match format {
            CheckFormat::Human | CheckFormat::Short => Self::People,
            CheckFormat::Json | CheckFormat::Sarif | CheckFormat::Github => Self::Programs,
        }
    }
}

/// Back to the first column, and nothing behind it.
const EMPTY_LINE: &str = "\r\u{1b}[2K";

/// The line; nothing where nobody would see it.
pub(crate) struct Progress {
    done: &'static str,
    things: &'static str,
    total: usize,
    is_wanted: bool,
    is_shown: bool,
}

impl Progress {
    /// Of so many things, of which the line says what is done to them.
    pub(crate) fn new(done: &'static str, things: &'static str, total: usize, audience: Audience) -> Self {
        let is_terminal =
            std::io::stderr().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb");
        Self {
            done,
            things,
            total,
            is_wanted: total > 1 && audience == Audience::People && is_terminal,
            is_shown: false,
        }
    }

    /// So many are finished.
    pub(crate) fn show(&mut self, finished: usize) {
        if self.is_wanted && finished < self.total {
            let mut terminal = std::io::stderr();
            let _ =
                write!(terminal, "{EMPTY_LINE}{} {finished} of {} {}", self.done, self.total, self.things);
            let _ = terminal.flush();
            self.is_shown = true;
        }
    }

    /// Takes the line away, so that something else can be written.
    pub(crate) fn clear(&mut self) {
        if self.is_shown {
            let _ = write!(std::io::stderr(), "{EMPTY_LINE}");
            self.is_shown = false;
        }
    }
}
