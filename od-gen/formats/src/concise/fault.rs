//! What is wrong with a concise DCF.

use od_spec::diag::{Diagnostic, codes};
use od_spec::model::EntryId;

/// What is wrong with a concise DCF; `offset` is the byte at which it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// The file ends within the number of records.
    NoNumber {
        /// Bytes of the file.
        length: usize,
    },
    /// The file ends within the head of a record.
    Head {
        /// Where the record begins.
        offset: usize,
        /// Bytes that are there.
        left: usize,
    },
    /// The file ends within a value.
    Value {
        /// Where the record begins.
        offset: usize,
        /// Its entry.
        id: EntryId,
        /// The size that it states.
        size: u32,
        /// Bytes that are there.
        left: usize,
    },
    /// The file has fewer records than it says.
    Missing {
        /// Where the next one would begin.
        offset: usize,
        /// How many it says it has.
        stated: u32,
        /// How many there are.
        found: u32,
    },
    /// The file goes on after its records.
    Rest {
        /// Where that begins.
        offset: usize,
        /// Bytes that follow.
        left: usize,
        /// As how many records they read, if they are nothing else.
        records: Option<usize>,
    },
}

impl Fault {
    /// The byte of the file at which it is.
    pub const fn offset(self) -> usize {
        match self {
            Fault::NoNumber { .. } => 0,
            Fault::Head { offset, .. }
            | Fault::Value { offset, .. }
            | Fault::Missing { offset, .. }
            | Fault::Rest { offset, .. } => offset,
        }
    }

    /// The message about it in a file.
    pub fn diagnostic(self, file: &str) -> Diagnostic {
        const AGAIN: &str = "make the file again; the records before are shown";
        let (code, what, help) = match self {
            Fault::NoNumber { length } => (
                codes::CONCISE_CUT_OFF,
                format!("found {}, expected the number of records in 4 bytes", bytes(length)),
                "is this the right file? a concise DCF is binary",
            ),
            Fault::Head { left, .. } => (
                codes::CONCISE_CUT_OFF,
                format!("found {}, expected a record, which has 7 bytes before its value", bytes(left)),
                AGAIN,
            ),
            Fault::Value { id, size, left, .. } => {
                let message =
                    format!("the value of {id} has {size} bytes by its size, and the file {left} more");
                (codes::CONCISE_CUT_OFF, message, AGAIN)
            }
            Fault::Missing { stated, found, .. } => (
                codes::CONCISE_CUT_OFF,
                format!("the file ends after {found} of the {stated} records that it says it has"),
                AGAIN,
            ),
            Fault::Rest { left, records: Some(records), .. } => (
                codes::CONCISE_TOO_LONG,
                format!("{} more after the last record, which read as {records} more records", bytes(left)),
                "the number of records at the beginning is too small: no master reads these",
            ),
            Fault::Rest { left, records: None, .. } => (
                codes::CONCISE_TOO_LONG,
                format!("{} more after the last record", bytes(left)),
                "is this the right file? a concise DCF ends with its last record",
            ),
        };
        Diagnostic::without_place(code, format!("`{file}`, byte 0x{:04X}: {what}", self.offset())).help(help)
    }
}

fn bytes(number: usize) -> String {
    if number == 1 { "1 byte".to_owned() } else { format!("{number} bytes") }
}
