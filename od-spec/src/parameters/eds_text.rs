//! Texts that a line of a DCF can hold.

use std::ops::ControlFlow;

use crate::diag::{Diagnostic, codes};
use crate::model::{Entry, EntryId, Value};
use crate::source::Span;

/// Longest text behind `ParameterValue=` in a line of 255 characters (CiA 306 4.2).
const LONGEST: usize = 255 - "ParameterValue=".len();

/// Why a line with room for `longest` characters cannot hold a text: `has 250 characters, a line holds 246`.
pub fn problem(text: &str, longest: usize) -> Option<String> {
    let written = crate::ascii::transliterate(text);
    // Some characters are transcribed with others that readers misread: `≤` as `<=`.
    let unfit = text.chars().chain(written.chars()).try_for_each(|c| {
        if c.is_control() {
            ControlFlow::Break("a control character".to_owned())
        } else if matches!(c, ';' | '#' | '=') {
            ControlFlow::Break(format!("`{c}`"))
        } else {
            ControlFlow::Continue(())
        }
    });
    if let ControlFlow::Break(unfit) = unfit {
        return Some(format!("holds {unfit}, which readers misread"));
    }
    if written.len() > longest {
        return Some(format!("has {} characters, a line holds {longest}", written.len()));
    }
    (text.trim() != text).then(|| "has blanks at its ends, which are lost".to_owned())
}

/// A text or octet string that is written into a DCF.
pub(super) fn check(id: EntryId, entry: &Entry, value: &Value, span: Span) -> Result<(), Box<Diagnostic>> {
    let problem = match value {
        Value::Text(text) if text.is_empty() => Some("is empty, which reads as no value".to_owned()),
        Value::Text(text) => problem(text, LONGEST)
            .or_else(|| (!text.is_ascii()).then(|| "has characters that a DCF cannot hold".to_owned())),
        Value::Bytes(bytes) if bytes.is_empty() => Some("is empty, which reads as no value".to_owned()),
        Value::Bytes(bytes) if 2 * bytes.len() > LONGEST => {
            Some(format!("has {} bytes, a line holds {}", bytes.len(), LONGEST / 2))
        }
        _ => None,
    };
    match problem {
        None => Ok(()),
        Some(problem) => Err(Box::new(
            Diagnostic::new(codes::NOT_FOR_EDS, span, format!("{id} ({}): the value {problem}", entry.name))
                .help("choose another value, or write it over the bus"),
        )),
    }
}
