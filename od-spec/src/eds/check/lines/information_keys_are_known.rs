//! Every key of a section about file, device, list or node is one of the standard.

use super::super::keys;
use super::super::rule::FormatRule;
use super::keys_are_one_word::is_word;
use crate::decode::nearest;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::view::View;
use crate::source::Span;
use std::collections::BTreeMap;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS117",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "an unknown key about file or device",
    explanation: "The standard has no key of this name in a section about the file, the device, a list or the node. Most readers \
        pass over it; lely's dcfchk refuses the file. Where the name is a misspelling, what the standard's key would say \
        is missing. Bit rates that CiA 301 does not have, such as `BaudRate_100`, are unknown keys, too.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments]\nLines=0\nAuthor=me", "; Author: me\n[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    // One message for each name: a key of somebody's own stands in many sections.
    let mut names: BTreeMap<&str, (Span, usize, Option<&str>)> = BTreeMap::new();
    let topics = view.topics().filter(|(topic, _)| !keys::is_of_object(*topic));
    for (topic, part) in topics {
        let Some(known) = keys::of(topic) else { continue };
        for entry in part.entries() {
            let name = entry.key.value;
            // What is no word is said already.
            if known.is_standard(name) || !is_word(name) || known.spelling(name).is_some() {
                continue;
            }
            let meant = || nearest(name, known.names());
            let found = names.entry(name).or_insert_with(|| (entry.key.span, 0, meant()));
            found.0 = found.0.min(entry.key.span);
            found.1 += 1;
        }
    }
    let mut names: Vec<_> = names.into_iter().collect();
    names.sort_by_key(|(_, (place, ..))| *place);
    for (name, (place, count, meant)) in names.into_iter().take(MOST) {
        let times = if count > 1 { format!("; it stands {count} times") } else { String::new() };
        let message = format!("`{}` is no key of the standard in this section{times}", shorten(name));
        diagnostics.push(
            Diagnostic::new(CODE, place, message).help(match meant {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => "nothing to do if the tools that read the file know it; otherwise make it a comment"
                    .to_owned(),
            }),
        );
    }
}

/// Names that are said; a file that is no EDS has many.
const MOST: usize = 10;
