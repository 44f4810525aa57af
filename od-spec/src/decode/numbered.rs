//! Maps whose keys are numbers: two spellings of one number are one key.

use std::collections::BTreeMap;

use super::read::Reader;
use crate::diag::{Code, Diagnostic, Diagnostics, codes};
use crate::scalar;
use crate::source::Spanned;

/// Reads numeric keys and reports two spellings of one number.
pub(super) fn numbered<'a, K: Ord + Copy>(
    entries: impl Iterator<Item = (Spanned<&'a str>, Reader<'a>)>,
    read: impl Fn(&str) -> Option<K>,
    diagnostics: &mut Diagnostics,
    code: &'static Code,
    show: impl Fn(K) -> String,
) -> Vec<(Spanned<K>, Reader<'a>)> {
    let mut first: BTreeMap<K, Spanned<&str>> = BTreeMap::new();
    let mut list = Vec::new();
    for (name, reader) in entries {
        let Some(number) = read(name.value) else { continue };
        if let Some(before) = first.get(&number) {
            diagnostics.push(twice(code, &show(number), name, *before));
            continue;
        }
        first.insert(number, name);
        list.push((Spanned::new(number, name.span), reader));
    }
    list
}

/// Reads integers as keys; `what` says in messages what they are the number of.
pub(super) fn by_integer<'a>(
    entries: impl Iterator<Item = (Spanned<&'a str>, Reader<'a>)>,
    what: &str,
    diagnostics: &mut Diagnostics,
) -> Vec<(Spanned<i128>, Reader<'a>)> {
    let integer = |text: &str| scalar::integer(text).ok();
    numbered(entries, integer, diagnostics, codes::DUPLICATE_VALUE, |number| format!("{what} {number}"))
}

/// Two keys mean one number.
pub(super) fn twice(
    code: &'static Code,
    number: &str,
    name: Spanned<&str>,
    before: Spanned<&str>,
) -> Diagnostic {
    Diagnostic::new(code, name.span, format!("{number} is defined twice"))
        .label(if before.value == name.value {
            "again here".to_owned()
        } else if name.value.contains("..") {
            format!("again here (`{}` has {number} in it)", name.value)
        } else {
            format!("again here (`{}` is {number})", name.value)
        })
        .with(before.span, "first here")
        .help("remove one of the two, or give it its own number")
}
