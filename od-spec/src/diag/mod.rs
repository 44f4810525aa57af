//! What the compiler has to say to the user: data only; [`render`] turns it into text.

mod about;
mod code;
pub mod codes;
mod commissioning;
mod edit;
mod nearest;
pub mod readers;
pub mod render;
mod repeated;

pub use about::About;
pub use code::{Code, Example, Language};
pub use edit::Edit;
pub(crate) use nearest::Suggestions;
pub use nearest::nearest;
pub(crate) use repeated::Repeated;

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};

use crate::order::Arrange as _;
use crate::source::Span;
use crate::visible::{is_hidden, visible};
use edit::stands_without_quotes;
use readers::Readers;

/// How serious a [`Diagnostic`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The result cannot be used.
    Error,
    /// The result can be used, but is probably not what was meant.
    Warning,
    /// Nothing is wrong; the reader may want to know.
    Note,
}

impl Severity {
    /// `error`, `warning` or `note`.
    pub const fn word(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        }
    }
}

/// A marked place with a few words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// What is to be seen there; may be empty.
    pub text: String,
}

/// One message to the user.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Diagnostic {
    /// Stable code, such as `OD0301`.
    pub code: &'static Code,
    /// What of a dictionary it is about; `None` for a file, a line, or a device as a whole.
    pub about: Option<About>,
    /// How serious it is here: what its code says, unless the text is held to another standard.
    pub severity: Severity,
    /// What is wrong, in one line.
    pub message: String,
    /// The places; the first is where the problem is. Empty when the problem has no place in a source text.
    pub labels: Vec<Label>,
    /// What to do about it.
    pub help: Option<String>,
    /// Facts that explain the rule.
    pub notes: Vec<String>,
    /// The changes that fix it, all together, without anything being guessed; none where a person has to decide.
    pub edits: Vec<Edit>,
    /// The change that a person may have meant: what the help asks about.
    pub meant: Option<Box<Edit>>,
    /// The readers of other people that refuse an EDS or DCF because of this, or are reported to stumble.
    pub minded_by: Readers,
    /// Whether it is said who stumbles over it; not where the message names them itself.
    pub(crate) tells_readers: bool,
}

/// Brings a text into a message: one line of at most 60 characters, without control characters and backticks.
pub(crate) fn shorten(text: &str) -> String {
    let text = text.trim_end_matches(['\n', '\r']);
    let keep = if text.chars().count() <= 60 { 60 } else { 57 };
    let one_line: String = text.chars().take(keep).map(|c| if c == '`' { '\'' } else { c }).collect();
    let rest = if keep == 60 { "" } else { "..." };
    self::one_line(one_line) + rest
}

thread_local! {
    static WORDS: Cell<fn(String) -> String> = const { Cell::new(std::convert::identity) };
}

/// Words all messages that this thread makes meanwhile otherwise. So a test sees that people read them, and no program.
#[doc(hidden)]
pub fn worded_otherwise<T>(words: fn(String) -> String, run: impl FnOnce() -> T) -> T {
    WORDS.set(words);
    let result = run();
    WORDS.set(std::convert::identity);
    result
}

/// A text of a message.
fn worded(text: impl Into<String>) -> String {
    WORDS.get()(one_line(text))
}

/// Names and values of a specification may hold anything; a message is one line.
fn one_line(text: impl Into<String>) -> String {
    let text = text.into();
    if !text.contains(is_hidden) {
        return text;
    }
    visible(&text.replace(['\n', '\r', '\t'], " ")).into_owned()
}

impl Diagnostic {
    /// A message about `span`.
    pub fn new(code: &'static Code, span: Span, message: impl Into<String>) -> Self {
        Self { labels: vec![Label { span, text: String::new() }], ..Self::without_place(code, message) }
    }

    /// A message that is about no place in a source text, such as a file that cannot be opened.
    pub fn without_place(code: &'static Code, message: impl Into<String>) -> Self {
        Self {
            code,
            about: None,
            severity: code.severity,
            message: worded(message),
            labels: Vec::new(),
            help: None,
            notes: Vec::new(),
            edits: Vec::new(),
            meant: None,
            minded_by: Readers::NONE,
            tells_readers: false,
        }
    }

    /// What of a dictionary it is about.
    #[must_use]
    pub(crate) fn about(self, about: impl Into<About>) -> Self {
        Self { about: Some(about.into()), ..self }
    }

    /// The same about a place.
    #[must_use]
    pub(crate) fn at(mut self, span: Span) -> Self {
        self.labels.insert(0, Label { span, text: String::new() });
        self
    }

    /// Words at the primary place.
    #[must_use]
    pub fn label(mut self, text: impl Into<String>) -> Self {
        if let Some(first) = self.labels.first_mut() {
            first.text = worded(text);
        }
        self
    }

    /// A further place.
    #[must_use]
    pub fn with(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: worded(text) });
        self
    }

    /// What to do.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(worded(text));
        self
    }

    /// An explaining fact.
    #[must_use]
    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.notes.push(worded(text));
        self
    }

    /// A change that fixes it, or one of several that do together.
    #[must_use]
    pub fn edit(mut self, span: Span, text: impl Into<String>) -> Self {
        self.edits.push(Edit { span, text: text.into() });
        self
    }

    /// Asks whether a word was meant at the primary place.
    #[must_use]
    pub(crate) fn did_you_mean(self, word: &str) -> Self {
        self.help(format!("did you mean `{word}`?")).meant(word)
    }

    /// Asks whether a word was meant at the primary place, or helps in another way if there is no such word.
    #[must_use]
    pub(crate) fn did_you_mean_or(self, word: Option<&str>, otherwise: impl FnOnce() -> String) -> Self {
        match word {
            Some(word) => self.did_you_mean(word),
            None => self.help(otherwise()),
        }
    }

    /// Shows what to write at the primary place, as far as what was meant is clear.
    #[must_use]
    pub(crate) fn write(self, text: &str) -> Self {
        self.help(format!("write `{}`", shorten(text))).meant(text)
    }

    /// What may have been meant at the primary place. What needs quotes is not a change: the place may be inside of
    /// some, or not.
    #[must_use]
    pub(crate) fn meant(mut self, text: &str) -> Self {
        if let Some(first) = self.labels.first().filter(|_| stands_without_quotes(text)) {
            self.meant = Some(Box::new(Edit { span: first.span, text: text.to_owned() }));
        }
        self
    }

    /// The notes, and who stumbles over it.
    pub fn all_notes(&self) -> impl Iterator<Item = String> {
        let readers = if self.tells_readers { self.minded_by.sentences() } else { Vec::new() };
        self.notes.iter().cloned().chain(readers)
    }

    /// Says in words who stumbles over it.
    pub fn tell_readers(&mut self) {
        self.tells_readers = true;
    }

    /// Takes it as serious as it is in an EDS that was written by others and is only read.
    pub(crate) fn soften(&mut self) {
        self.severity = self.code.foreign;
    }

    /// How serious it is.
    pub const fn severity(&self) -> Severity {
        self.severity
    }
}

/// Two messages are the same where the user reads the same: a mistake in what represents many things is one.
impl PartialEq for Diagnostic {
    fn eq(&self, other: &Self) -> bool {
        let Self {
            about: _,
            code,
            severity,
            message,
            labels,
            help,
            notes,
            edits,
            meant,
            minded_by,
            tells_readers,
        } = self;
        *code == other.code
            && *severity == other.severity
            && *message == other.message
            && *labels == other.labels
            && *help == other.help
            && *notes == other.notes
            && *edits == other.edits
            && *meant == other.meant
            && *minded_by == other.minded_by
            && *tells_readers == other.tells_readers
    }
}

impl Eq for Diagnostic {}

/// The messages of one run.
#[derive(Debug, Clone, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    /// What the messages that come are about, where they do not say it themselves.
    about: Option<About>,
    /// Errors that were added or said again.
    errors: usize,
    /// What was said of a place that represents many things.
    said: BTreeSet<(&'static Code, Span)>,
    /// What is left for suggestions.
    pub(crate) suggestions: Suggestions,
}

impl Diagnostics {
    /// No messages.
    pub const fn new() -> Self {
        Self {
            list: Vec::new(),
            about: None,
            errors: 0,
            said: BTreeSet::new(),
            suggestions: Suggestions::new(),
        }
    }

    /// Adds a message, unless it was said just now: what represents many things, such as a run of objects, is wrong for
    /// each of them.
    pub fn push(&mut self, mut diagnostic: Diagnostic) {
        /// So many mistakes of one thing are remembered.
        const REMEMBERED: usize = 4;
        self.errors += usize::from(diagnostic.severity == Severity::Error);
        diagnostic.about = diagnostic.about.or(self.about);
        if !self.list.iter().rev().take(REMEMBERED).any(|said| *said == diagnostic) {
            self.list.push(diagnostic);
        }
    }

    /// Whether a place is reported for the first time to break a rule: a name in a run of objects is looked up for each
    /// of them, and wrong once.
    pub(crate) fn is_new(&mut self, code: &'static Code, span: Span) -> bool {
        let is_new = self.said.insert((code, span));
        self.errors += usize::from(!is_new && code.severity == Severity::Error);
        is_new
    }

    /// Whether [`is_new`](Self::is_new) was asked about a place.
    pub(crate) fn was_said(&self, code: &'static Code, span: Span) -> bool {
        self.said.contains(&(code, span))
    }

    /// Makes an error of the warning of a rule that has this place among its own; `false` where there is none. So a
    /// user who cannot go on with what the rule warns of need not say it again.
    pub fn harden(&mut self, code: &'static Code, span: Span) -> bool {
        let has_place = |said: &&mut Diagnostic| said.labels.iter().any(|label| label.span == span);
        let said = self.list.iter_mut().filter(|said| said.code == code).find(has_place);
        let Some(said) = said else { return false };
        self.errors += 1;
        said.severity = Severity::Error;
        true
    }

    /// Sorts by file, place and code, and drops repetitions.
    pub fn sort(&mut self) {
        self.list.arrange_by(|a, b| {
            let key =
                |d: &Diagnostic| (d.labels.first().map(|label| (label.span.file, label.span.start)), d.code);
            key(a).cmp(&key(b)).then_with(|| a.message.cmp(&b.message))
        });
        self.list.dedup();
    }

    /// Whether an error is among the messages.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|d| d.severity() == Severity::Error)
    }

    /// How many errors were found so far, those that were said before among them.
    pub const fn errors_found(&self) -> usize {
        self.errors
    }

    /// Number of errors and of warnings.
    pub fn count(&self) -> (usize, usize) {
        let of = |severity| self.list.iter().filter(|d| d.severity() == severity).count();
        (of(Severity::Error), of(Severity::Warning))
    }

    /// Those after which something has to be done. A build with a file does not need the notes about it.
    #[must_use]
    pub fn without_notes(mut self) -> Self {
        self.list.retain(|diagnostic| diagnostic.severity() != Severity::Note);
        self
    }

    /// What the messages that come are about, where they do not say it themselves.
    pub(crate) const fn now_about(&mut self, about: Option<About>) {
        self.about = about;
    }

    /// Takes the changes away: they are in another notation than the file.
    #[cfg(feature = "xdd")]
    pub(crate) fn without_edits(&mut self) {
        for diagnostic in &mut self.list {
            diagnostic.edits.clear();
            diagnostic.meant = None;
        }
    }

    /// Takes each message as serious as it is in an EDS that was written by others and is only read.
    pub fn soften(&mut self) {
        for diagnostic in &mut self.list {
            diagnostic.soften();
        }
    }

    /// The messages, in order, to be changed.
    pub fn as_mut_slice(&mut self) -> &mut [Diagnostic] {
        &mut self.list
    }

    /// The messages, in order.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// The first messages of each code, at most so many of one, in order; and how many more a code has.
    pub fn first_of_each_code(&self, most: usize) -> (Vec<&Diagnostic>, Vec<(&'static Code, usize)>) {
        let mut seen: BTreeMap<&'static Code, usize> = BTreeMap::new();
        let mut is_shown = |diagnostic: &&Diagnostic| {
            let of_code = seen.entry(diagnostic.code).or_default();
            *of_code += 1;
            *of_code <= most
        };
        let shown = self.list.iter().filter(|one| is_shown(one)).collect();
        let more = seen.into_iter().filter(|(_, count)| *count > most);
        (shown, more.map(|(code, count)| (code, count - most)).collect())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Takes the messages of another run.
    pub fn append(&mut self, more: Diagnostics) {
        self.errors += more.errors;
        self.list.extend(more.list);
    }
}

/// Two runs are alike when they have the same messages.
impl PartialEq for Diagnostics {
    fn eq(&self, other: &Self) -> bool {
        self.list == other.list
    }
}

impl Eq for Diagnostics {}

impl<'a> IntoIterator for &'a Diagnostics {
    type Item = &'a Diagnostic;
    type IntoIter = std::slice::Iter<'a, Diagnostic>;
    fn into_iter(self) -> Self::IntoIter {
        self.list.iter()
    }
}
