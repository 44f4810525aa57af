//! For people: with the source lines and marks, as rustc does.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use crate::diag::{Diagnostic, Label, Severity};
use crate::source::{FileId, SourceFile, SourceMap};

/// Lines shown around a marked place that spans many.
const LONGEST_MARK: usize = 6;

pub(super) fn human(diagnostic: &Diagnostic, sources: &SourceMap, colour: bool) -> String {
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
    let notes: Vec<String> = diagnostic.all_notes().collect();
    let notes = notes.iter().map(|note| Level::NOTE.secondary_title(note.as_str()));
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
fn shown_end(label: &Label, file: &SourceFile) -> u32 {
    let (first, last) = (file.line_index(label.span.start), file.line_index(label.span.end));
    if last - first < LONGEST_MARK {
        return label.span.end;
    }
    u32::try_from(file.lines(first, first).1).unwrap_or(label.span.end).max(label.span.start)
}
