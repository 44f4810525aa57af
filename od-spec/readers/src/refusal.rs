//! What a reader refuses a file for.

use od_spec::diag::Code;
use od_spec::diag::readers::{Reader, Readers, codes};
use od_spec::source::{FileId, Span};

/// A place of a text at which a reader gives up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Refusal {
    pub reader: Reader,
    pub cause: Cause,
    /// What the reader does not take, in a few words that say what is there.
    pub what: &'static str,
    pub place: Span,
}

/// Why a reader gives up, where this is not a fault, or not its own fault, by the standard.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Cause {
    /// It divides the text into lines, keys and values in another way.
    Text,
    /// It cannot read a number.
    Number,
    /// It needs something.
    Missing,
    /// It does not know something.
    Unknown,
    /// It does not take a value, or a key together with another.
    Value,
    /// It wants another order.
    Order,
    /// It follows a reference and finds nothing.
    Reference,
}

impl Cause {
    pub(super) const fn code(self) -> &'static Code {
        match self {
            Cause::Text => codes::TEXT,
            Cause::Number => codes::NUMBER,
            Cause::Missing => codes::MISSING,
            Cause::Unknown => codes::UNKNOWN,
            Cause::Value => codes::VALUE,
            Cause::Order => codes::ORDER,
            Cause::Reference => codes::REFERENCE,
        }
    }

    /// Who does what: `dcfchk does not know`.
    pub(super) fn verb(self, readers: Readers) -> String {
        match self {
            Cause::Missing => readers.with_verb("needs", "need"),
            Cause::Unknown => readers.with_verb("does not know", "do not know"),
            Cause::Number => readers.with_verb("cannot read", "cannot read"),
            Cause::Text | Cause::Value | Cause::Order | Cause::Reference => {
                readers.with_verb("refuses", "refuse")
            }
        }
    }
}

/// What one reader refuses in a text, as it is found.
#[derive(Debug)]
pub(super) struct Refusals {
    reader: Reader,
    file: FileId,
    pub list: Vec<Refusal>,
}

/// Bytes of the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Place {
    pub start: usize,
    pub end: usize,
}

impl Refusals {
    pub(super) fn new(reader: Reader, file: FileId) -> Self {
        Self { reader, file, list: Vec::new() }
    }

    pub(super) fn add(&mut self, place: Place, cause: Cause, what: &'static str) {
        let at = |offset| u32::try_from(offset).unwrap_or(u32::MAX);
        let place = Span { file: self.file, start: at(place.start), end: at(place.end) };
        self.list.push(Refusal { reader: self.reader, cause, what, place });
    }

    /// The value, or a refusal.
    pub(super) fn wants<T>(
        &mut self,
        found: Option<T>,
        place: Place,
        cause: Cause,
        what: &'static str,
    ) -> Option<T> {
        if found.is_none() {
            self.add(place, cause, what);
        }
        found
    }
}
