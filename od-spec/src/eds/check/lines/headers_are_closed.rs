//! The name of a section stands between two brackets.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Severity, shorten};
use crate::eds::line::LineKind;
use crate::eds::names::{Topic, topic};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS105",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a section name without its bracket",
    explanation: "The line that begins a section has a bracket on both sides of the name. Where one is missing, readers stop, or \
        they take the line for nothing and the keys below it for keys of the section above. It is read as the section \
        that its name means.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments\nLines=0", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for line in view.document.lines() {
        let text = line.text();
        let place = edits::place(view, line);
        let (name, edit) = match (line.kind(), line.name_part()) {
            (LineKind::Header, Some(name)) if !text.contains(']') => {
                let rest = place.part(name.end as usize, text.len());
                (line.name().unwrap_or_default(), Edit { span: rest, text: "]".to_owned() })
            }
            (LineKind::Unreadable, _) => {
                let bare = text.trim_end().strip_suffix(']').unwrap_or_default();
                (
                    bare.trim_start(),
                    Edit { span: place.part(0, text.len() - text.trim_start().len()), text: "[".to_owned() },
                )
            }
            _ => continue,
        };
        let is_known = topic(name) != Topic::Unknown;
        if line.kind() == LineKind::Unreadable && !is_known {
            continue;
        }
        let message = format!("`{}` lacks a bracket, expected `[{}]`", shorten(text.trim()), shorten(name));
        let mut diagnostic = Diagnostic::new(CODE, place, message).help("put the name between brackets");
        if is_known {
            diagnostic.edits.push(edit);
        }
        diagnostics.push(diagnostic);
    }
}

/// Whether a line that nobody can read is the name of a section whose first bracket is missing.
pub(super) fn is_name_without_bracket(text: &str) -> bool {
    text.trim_end().strip_suffix(']').is_some_and(|name| topic(name.trim_start()) != Topic::Unknown)
}
