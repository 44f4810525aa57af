//! Diagnostics as text: for people, as one line each, or as JSON.

use std::fmt::Write as _;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::{Diagnostic, Diagnostics, Label, Severity};
use crate::source::{FileId, SourceMap};

/// Lines shown around a marked place that spans many.
const LONGEST_MARK: usize = 6;

/// How diagnostics are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Format {
    /// With the source lines and marks, as rustc does.
    #[default]
    Human,
    /// `file:line:column: error[OD0301]: message`.
    Short,
    /// One JSON object per line.
    Json,
}

/// All diagnostics in the given format, each ended by a line break.
pub fn render(diagnostics: &Diagnostics, sources: &SourceMap, format: Format, colour: bool) -> String {
    let mut out = String::new();
    for diagnostic in diagnostics {
        match format {
            Format::Human => {
                out.push_str(&human(diagnostic, sources, colour));
                out.push_str("\n\n");
            }
            Format::Short => {
                out.push_str(&short(diagnostic, sources));
                out.push('\n');
            }
            Format::Json => {
                out.push_str(&json(diagnostic, sources));
                out.push('\n');
            }
        }
    }
    out
}

/// `3 errors, 1 warning`; empty when there is nothing to count.
pub fn summary(diagnostics: &Diagnostics) -> String {
    let plural = |count: usize, word: &str| match count {
        0 => None,
        1 => Some(format!("1 {word}")),
        _ => Some(format!("{count} {word}s")),
    };
    let (errors, warnings) = diagnostics.count();
    [plural(errors, "error"), plural(warnings, "warning")]
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join(", ")
}

fn human(diagnostic: &Diagnostic, sources: &SourceMap, colour: bool) -> String {
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let level = match diagnostic.severity() {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let title = level.primary_title(diagnostic.message.as_str()).id(diagnostic.code.id);
    let mut files: Vec<FileId> = Vec::new();
    for label in &diagnostic.labels {
        if !files.contains(&label.span.file) {
            files.push(label.span.file);
        }
    }
    let snippets = files.iter().map(|file| snippet(*file, &diagnostic.labels, sources));
    let mut groups = vec![title.elements(snippets)];
    let notes = diagnostic.notes.iter().map(|note| Level::NOTE.secondary_title(note.as_str()));
    let help = diagnostic.help.iter().map(|help| Level::HELP.secondary_title(help.as_str()));
    groups.extend(help.chain(notes).map(Group::with_title));
    let text = renderer.render(&groups);
    let lines = text.trim_end().lines();
    // Without a place the renderer leaves an empty frame.
    let empty_frame = |line: &&str| diagnostic.labels.is_empty() && line.trim() == "|";
    lines.filter(|line| !empty_frame(line)).collect::<Vec<_>>().join("\n")
}

/// The lines that a file's labels mark, cut out of the file.
fn snippet<'a>(
    id: FileId,
    labels: &'a [Label],
    sources: &'a SourceMap,
) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let file = sources.file(id);
    let in_file = || labels.iter().enumerate().filter(move |(_, label)| label.span.file == id);
    let first = in_file().map(|(_, label)| file.line_index(label.span.start)).min().unwrap_or(0);
    let last = in_file().map(|(_, label)| file.line_index(shown_end(label, file))).max().unwrap_or(0);
    let (start, end) = file.lines(first, last);
    let text = &file.text()[start..end];
    let annotations = in_file().map(|(at, label)| {
        let clamp = |offset: u32| (offset as usize).saturating_sub(start).min(text.len());
        let range = clamp(label.span.start)..clamp(shown_end(label, file));
        let kind = if at == 0 { AnnotationKind::Primary } else { AnnotationKind::Context };
        let annotation = kind.span(range);
        if label.text.is_empty() { annotation } else { annotation.label(label.text.as_str()) }
    });
    Snippet::source(text).line_start(first + 1).path(file.name()).annotations(annotations)
}

/// The end of a mark; a mark over many lines is cut to its first line.
fn shown_end(label: &Label, file: &crate::source::SourceFile) -> u32 {
    let (first, last) = (file.line_index(label.span.start), file.line_index(label.span.end));
    if last - first < LONGEST_MARK {
        return label.span.end;
    }
    u32::try_from(file.lines(first, first).1).unwrap_or(label.span.end).max(label.span.start)
}

fn short(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let mut line = String::new();
    if let Some(label) = diagnostic.labels.first() {
        let _ = write!(line, "{}: ", sources.place(label.span));
    }
    let _ = write!(line, "{}[{}]: {}", diagnostic.severity().word(), diagnostic.code, diagnostic.message);
    if let Some(help) = &diagnostic.help {
        let _ = write!(line, " ({help})");
    }
    line.replace(['\n', '\r'], " ")
}

fn json(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let labels = diagnostic.labels.iter().map(|label| {
        let file = sources.file(label.span.file);
        let (start, end) = (file.line_col(label.span.start), file.line_col(label.span.end));
        format!(
            "{{\"file\":{},\"line\":{},\"column\":{},\"end-line\":{},\"end-column\":{},\"text\":{}}}",
            quote(file.name()),
            start.line,
            start.column,
            end.line,
            end.column,
            quote(&label.text)
        )
    });
    let notes = diagnostic.notes.iter().map(|note| quote(note));
    format!(
        "{{\"code\":{},\"severity\":{},\"message\":{},\"labels\":[{}],\"help\":{},\"notes\":[{}]}}",
        quote(diagnostic.code.id),
        quote(diagnostic.severity().word()),
        quote(&diagnostic.message),
        labels.collect::<Vec<_>>().join(","),
        diagnostic.help.as_ref().map_or("null".to_owned(), |help| quote(help)),
        notes.collect::<Vec<_>>().join(",")
    )
}

/// A JSON string.
fn quote(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            c if c < ' ' => {
                let _ = write!(out, "\\u{:04x}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
