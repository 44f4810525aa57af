//! Words where the standard has a number or another word: they are taken as what they say, and reported.

use crate::diag::{Code, Diagnostic, Diagnostics, shorten};
use crate::eds::number::{self, Number};
use crate::eds::read::value;
use crate::eds::{coded, codes};
use crate::model::{Access, DataType};
use crate::source::Spanned;

/// A data type, by its number or its name; `None` for what is neither.
pub(super) fn data_type(text: Spanned<&str>, diagnostics: &mut Diagnostics) -> Option<DataType> {
    let known = coded::data_type(text.value)?;
    match number::integer(text.value) {
        Some(number) => report(text, &number, diagnostics),
        None => {
            let code = format!("0x{:04X}", known.code());
            let found = instead(codes::UNKNOWN_DATA_TYPE, text, "the number of the data type", &code);
            diagnostics.push(found);
        }
    }
    Some(known)
}

/// Reports an object type of which the name is written.
pub(super) fn object_type(text: Spanned<&str>, code: i128, diagnostics: &mut Diagnostics) {
    if number::integer(text.value).is_none() {
        let code = format!("{code:#X}").replacen("0X", "0x", 1);
        diagnostics.push(instead(codes::BAD_OBJECT_TYPE, text, "the number of the object type", &code));
    }
}

/// An access type; `None` for anything else.
pub(super) fn access(text: Spanned<&str>, diagnostics: &mut Diagnostics) -> Option<Access> {
    let access = coded::access(text.value)?;
    let word = access.word();
    let mut deviations = Vec::new();
    let bare = number::bare(text.value, &mut deviations);
    if bare == word && deviations.is_empty() {
        return Some(access);
    }
    let message = format!("found `{}`, expected `{word}`", shorten(text.value));
    let (code, help) = if !bare.eq_ignore_ascii_case(word) {
        (codes::UNKNOWN_ACCESS, "write the word of the standard")
    } else if deviations.is_empty() {
        (codes::ACCESS_SPELLING, "write it in small letters")
    } else {
        (codes::REMARK_IN_VALUE, "put the remark on a line of its own above the section")
    };
    diagnostics.push(Diagnostic::new(code, text.span, message).help(help).edit(text.span, word));
    Some(access)
}

/// Says how a number differs from what the standard has.
pub(super) fn report(text: Spanned<&str>, number: &Number, diagnostics: &mut Diagnostics) {
    for deviation in &number.deviations {
        diagnostics.push(value::deviates(text, deviation, number.value));
    }
}

/// A word where something else is due, which the word leaves no doubt about.
fn instead(code: &'static Code, text: Spanned<&str>, what: &str, expected: &str) -> Diagnostic {
    let message = format!("found `{}`, expected {what}: `{expected}`", shorten(text.value));
    Diagnostic::new(code, text.span, message).help(format!("write `{expected}`")).edit(text.span, expected)
}
