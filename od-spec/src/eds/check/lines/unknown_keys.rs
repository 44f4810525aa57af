//! Keys that the standard does not have.

use std::collections::BTreeMap;

use super::super::keys;
use super::keys_are_one_word::is_word;
use crate::diag::{Code, Diagnostic, Diagnostics, shorten};
use crate::eds::names::Topic;
use crate::eds::view::Part;
use crate::order::Arrange as _;
use crate::source::Span;

/// Names that are said; a file that is no EDS has many.
const MOST: usize = 10;

/// A name that is not a key.
struct Unknown {
    place: Span,
    times: usize,
    /// The keys that it could have been meant for.
    known: keys::Keys,
}

/// One message for each name among the keys of some sections: a tool's own key is in many of them. `here` says
/// where the standard has no such key.
pub(super) fn report<'v, 'd: 'v>(
    code: &'static Code,
    sections: impl Iterator<Item = (Topic, &'v Part<'d>)>,
    here: &str,
    diagnostics: &mut Diagnostics,
) {
    let mut names: BTreeMap<&str, Unknown> = BTreeMap::new();
    for (topic, part) in sections {
        let Some(known) = keys::of(topic) else { continue };
        for entry in part.entries() {
            let name = entry.key.value;
            // What is not a word is said already.
            if known.is_standard(name) || !is_word(name) || known.spelling(name).is_some() {
                continue;
            }
            let first = || Unknown { place: entry.key.span, times: 0, known };
            let unknown = names.entry(name).or_insert_with(first);
            unknown.place = unknown.place.min(entry.key.span);
            unknown.times += 1;
        }
    }
    let mut names: Vec<_> = names.into_iter().collect();
    names.arrange_by_key(|(_, unknown)| unknown.place);
    for (name, Unknown { place, times, known }) in names.into_iter().take(MOST) {
        let times = if times > 1 { format!("; it is written {times} times") } else { String::new() };
        let message = format!("`{}` is not a key of the standard {here}{times}", shorten(name));
        let meant = diagnostics.suggestions.nearest(name, known.names());
        let otherwise = || {
            "nothing to do if the tools that read the file know it; otherwise make it a comment".to_owned()
        };
        diagnostics.push(Diagnostic::new(code, place, message).did_you_mean_or(meant, otherwise));
    }
}
