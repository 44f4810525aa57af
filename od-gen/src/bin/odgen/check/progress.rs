//! How far a check of many files is: one line that is written over, for people at a terminal.

use std::io::{IsTerminal as _, Write as _};

use crate::args::CheckFormat;

/// Back to the first column, and nothing behind it.
const EMPTY_LINE: &str = "\r\u{1b}[2K";

/// The line; nothing where nobody would see it.
pub(super) struct Progress {
    total: usize,
    is_wanted: bool,
    is_shown: bool,
}

impl Progress {
    /// Of so many files.
    pub(super) fn new(total: usize, format: CheckFormat) -> Self {
        let is_for_people = match format {
            CheckFormat::Human | CheckFormat::Short => true,
            CheckFormat::Json | CheckFormat::Sarif | CheckFormat::Github => false,
        };
        let is_terminal =
            std::io::stderr().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb");
        Self { total, is_wanted: total > 1 && is_for_people && is_terminal, is_shown: false }
    }

    /// So many files are finished.
    pub(super) fn show(&mut self, finished: usize) {
        if self.is_wanted && finished < self.total {
            let mut terminal = std::io::stderr();
            let _ = write!(terminal, "{EMPTY_LINE}checked {finished} of {} files", self.total);
            let _ = terminal.flush();
            self.is_shown = true;
        }
    }

    /// Takes the line away, so that something else can be written.
    pub(super) fn clear(&mut self) {
        if self.is_shown {
            let _ = write!(std::io::stderr(), "{EMPTY_LINE}");
            self.is_shown = false;
        }
    }
}
