//! One JSON object each.

use od_spec::diag::readers::Reader;
use od_spec::diag::{Diagnostic, Diagnostics};
use od_spec::source::{SourceMap, Span};
use od_spec::visible::visible_json;
use serde::Serialize;

use super::{edits, written};

/// A message, in the order in which it is written.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Finding<'a> {
    code: &'a str,
    severity: &'a str,
    message: &'a str,
    labels: Vec<Marked<'a>>,
    help: Option<&'a str>,
    notes: &'a [String],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    edits: Vec<Marked<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    minded_by: Vec<&'a str>,
}

/// A place with a text: words about it, or what it is to become.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Marked<'a> {
    file: &'a str,
    line: usize,
    column: usize,
    end_line: usize,
    end_column: usize,
    text: &'a str,
}

/// One object for each message, in a line of its own.
pub fn json(diagnostics: &Diagnostics, sources: &SourceMap) -> String {
    written(diagnostics).map(|diagnostic| printed(&finding(&diagnostic, sources)) + "\n").collect()
}

fn finding<'a>(diagnostic: &'a Diagnostic, sources: &'a SourceMap) -> Finding<'a> {
    let labels = diagnostic.labels.iter().map(|label| marked(label.span, &label.text, sources));
    let edits = edits(diagnostic).iter().map(|edit| marked(edit.span, &edit.text, sources));
    Finding {
        code: diagnostic.code.id,
        severity: diagnostic.severity().word(),
        message: &diagnostic.message,
        labels: labels.collect(),
        help: diagnostic.help.as_deref(),
        notes: &diagnostic.notes,
        edits: edits.collect(),
        minded_by: diagnostic.minded_by.iter().map(Reader::name).collect(),
    }
}

fn marked<'a>(span: Span, text: &'a str, sources: &'a SourceMap) -> Marked<'a> {
    let file = sources.file(span.file);
    let (start, end) = (file.line_col(span.start), file.line_col(span.end));
    Marked {
        file: file.name(),
        line: start.line,
        column: start.column,
        end_line: end.line,
        end_column: end.column,
        text,
    }
}

/// A value as JSON, without the control characters that JSON allows and a terminal obeys.
pub(super) fn printed(value: &(impl Serialize + ?Sized)) -> String {
    // Plain values, into memory: this cannot fail.
    let text = serde_json::to_string(value).unwrap_or_default();
    visible_json(&text).into_owned()
}
