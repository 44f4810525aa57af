//! One JSON object each.

use std::fmt::Write as _;

use od_spec::diag::{Diagnostic, Diagnostics, Edit};
use od_spec::source::{SourceMap, Span};
use od_spec::visible::is_hidden;

/// One object for each message, in a line of its own.
pub fn json(diagnostics: &Diagnostics, sources: &SourceMap) -> String {
    diagnostics.iter().map(|diagnostic| object(diagnostic, sources) + "\n").collect()
}

/// A message as one object in one line.
fn object(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let labels = diagnostic.labels.iter().map(|label| marked(label.span, &label.text, sources));
    let notes = diagnostic.notes.iter().map(|note| quote(note));
    let edits = diagnostic.edits.iter().map(|Edit { span, text }| marked(*span, text, sources));
    let edits = edits.collect::<Vec<_>>().join(",");
    let readers =
        diagnostic.minded_by.iter().map(|reader| quote(reader.name())).collect::<Vec<_>>().join(",");
    format!(
        "{{\"code\":{},\"severity\":{},\"message\":{},\"labels\":[{}],\"help\":{},\"notes\":[{}]{}{}}}",
        quote(diagnostic.code.id),
        quote(diagnostic.severity().word()),
        quote(&diagnostic.message),
        labels.collect::<Vec<_>>().join(","),
        diagnostic.help.as_ref().map_or("null".to_owned(), |help| quote(help)),
        notes.collect::<Vec<_>>().join(","),
        if edits.is_empty() { String::new() } else { format!(",\"edits\":[{edits}]") },
        if readers.is_empty() { String::new() } else { format!(",\"minded-by\":[{readers}]") }
    )
}

/// A place with a text: words about it, or what is to stand there.
fn marked(span: Span, text: &str, sources: &SourceMap) -> String {
    let file = sources.file(span.file);
    let (start, end) = (file.line_col(span.start), file.line_col(span.end));
    format!(
        "{{\"file\":{},\"line\":{},\"column\":{},\"end-line\":{},\"end-column\":{},\"text\":{}}}",
        quote(file.name()),
        start.line,
        start.column,
        end.line,
        end.column,
        quote(text)
    )
}

/// A JSON string.
pub(super) fn quote(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            // Also the control characters that JSON would allow: a terminal obeys them.
            c if is_hidden(c) => {
                let _ = write!(out, "\\u{:04x}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
