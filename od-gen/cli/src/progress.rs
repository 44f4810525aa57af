//! How far a long work is: one line that is written over, for people at a terminal.

use std::io::{IsTerminal as _, Stderr, Write};

/// Who reads what a command says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Audience {
    /// People.
    People,
    /// Programs, which want only the messages.
    Programs,
}

/// Back to the first column, and nothing after it.
const EMPTY_LINE: &str = "\r\u{1b}[2K";

/// The line; nothing where it would not be seen.
pub(crate) struct Progress<W = Stderr> {
    terminal: W,
    done: &'static str,
    things: &'static str,
    total: usize,
    is_wanted: bool,
    is_shown: bool,
}

impl Progress {
    /// Of so many things, of which the line says what is done to them; on the terminal of the messages, if they go to one.
    pub(crate) fn new(done: &'static str, things: &'static str, total: usize, audience: Audience) -> Self {
        let is_terminal =
            std::io::stderr().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb");
        let mut progress = Self::on(std::io::stderr(), done, things, total);
        progress.is_wanted &= audience == Audience::People && is_terminal;
        progress
    }
}

impl<W: Write> Progress<W> {
    /// The same on any terminal.
    pub(crate) const fn on(terminal: W, done: &'static str, things: &'static str, total: usize) -> Self {
        Self { terminal, done, things, total, is_wanted: total > 1, is_shown: false }
    }

    /// So many are finished.
    pub(crate) fn show(&mut self, finished: usize) {
        if self.is_wanted && finished < self.total {
            let Self { terminal, done, things, total, .. } = self;
            let _ = write!(terminal, "{EMPTY_LINE}{done} {finished} of {total} {things}");
            let _ = terminal.flush();
            self.is_shown = true;
        }
    }

    /// Takes the line away, so that something else can be written.
    pub(crate) fn clear(&mut self) {
        if self.is_shown {
            let _ = write!(self.terminal, "{EMPTY_LINE}");
            self.is_shown = false;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_is_written_over_and_taken_away() {
        let mut progress = Progress::on(Vec::new(), "wrote", "files", 3);
        (1..=3).for_each(|finished| progress.show(finished));
        progress.clear();
        progress.clear();
        let text = String::from_utf8(progress.terminal).unwrap_or_default();
        let line = |finished: usize| format!("{EMPTY_LINE}wrote {finished} of 3 files");
        // That all are finished, what comes next says.
        assert_eq!(text, format!("{}{}{EMPTY_LINE}", line(1), line(2)));
    }

    #[test]
    fn one_thing_needs_no_line_and_programs_get_none() {
        let mut one = Progress::on(Vec::new(), "wrote", "files", 1);
        one.show(0);
        one.clear();
        assert!(one.terminal.is_empty());
        assert!(!Progress::new("wrote", "files", 3, Audience::Programs).is_wanted);
    }
}
