//! What the user is asked: each cell that was not understood, with a message for those that are alike.

use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::source::{SourceMap, Span};

/// The questions to the user.
pub(crate) struct Asked<'s> {
    sources: &'s SourceMap,
    list: Vec<Question>,
    cells: usize,
}

/// What is asked, and where.
struct Question {
    message: String,
    label: String,
    help: &'static str,
    span: Span,
    /// At how many further places.
    more: usize,
}

impl<'s> Asked<'s> {
    pub(crate) const fn new(sources: &'s SourceMap) -> Self {
        Self { sources, list: Vec::new(), cells: 0 }
    }

    /// Asks what a cell means. Returns the comment for the specification, which names the place of each.
    pub(crate) fn cell(&mut self, span: Span, message: &str, help: &'static str) -> String {
        self.ask(span, message.to_owned(), "left out", help);
        format!("{}: {message}", self.place(span))
    }

    fn ask(&mut self, span: Span, message: String, label: &str, help: &'static str) {
        self.cells += 1;
        match self.list.iter_mut().find(|one| one.message == message) {
            Some(one) => one.more += 1,
            None => self.list.push(Question { message, label: label.to_owned(), help, span, more: 0 }),
        }
    }

    /// `table.csv:12`.
    pub(crate) fn place(&self, span: Span) -> String {
        let file = self.sources.file(span.file);
        let name = file.name().rsplit(['/', '\\']).next().unwrap_or_default();
        format!("{name}:{}", file.line_col(span.start).line)
    }

    /// How many cells were not understood.
    pub(crate) const fn cells(&self) -> usize {
        self.cells
    }

    /// The messages.
    pub(crate) fn into_diagnostics(self) -> Diagnostics {
        let mut diagnostics = Diagnostics::new();
        for Question { message, label, help, span, more } in self.list {
            let one = Diagnostic::new(codes::TABLE_CELL, span, message).label(label).help(help);
            diagnostics.push(match more {
                0 => one,
                1 => one.note("the same at another place; a comment in the specification names it"),
                _ => one.note(format!(
                    "the same at {more} other places; comments in the specification name them"
                )),
            });
        }
        diagnostics
    }
}

/// A text of a cell in a message.
pub(crate) fn quoted(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ").replace('`', "'");
    let short: String = line.chars().take(57).collect();
    if short.len() < line.len() { format!("`{short}...`") } else { format!("`{line}`") }
}
