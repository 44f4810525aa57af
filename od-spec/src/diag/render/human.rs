//! For people: with the source lines and marks, as rustc does.

use std::borrow::Cow;

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
    let text = visible(&file.text()[start..end]);
    let length = text.len();
    let annotations = in_file().map(|(at, label)| {
        let clamp = |offset: u32| (offset as usize).saturating_sub(start).min(length);
        let range = clamp(label.span.start)..clamp(shown_end(label, file));
        let kind = if at == 0 { AnnotationKind::Primary } else { AnnotationKind::Context };
        let annotation = kind.span(range);
        if label.text.is_empty() { annotation } else { annotation.label(label.text.as_str()) }
    });
    Snippet::source(text).line_start(first + 1).path(file.name()).annotations(annotations)
}

/// A text without the control characters that the renderer does not replace, U+0080 to U+009F: a terminal obeys them. What stands
/// for them is as long.
fn visible(text: &str) -> Cow<'_, str> {
    let is_control = |c: char| matches!(c, '\u{80}'..='\u{9F}');
    if text.contains(is_control) { text.replace(is_control, "·").into() } else { text.into() }
}

/// The end of a mark; a mark over many lines is cut to its first line.
fn shown_end(label: &Label, file: &SourceFile) -> u32 {
    let (first, last) = (file.line_index(label.span.start), file.line_index(label.span.end));
    if last - first < LONGEST_MARK {
        return label.span.end;
    }
    u32::try_from(file.lines(first, first).1).unwrap_or(label.span.end).max(label.span.start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Diagnostics;
    use crate::diag::codes;
    use crate::diag::render::{Format, render};

    #[test]
    fn no_control_character_of_a_text_reaches_a_terminal() {
        let mut sources = SourceMap::new();
        let file = sources.add("a.eds", "Na\u{85}me=\u{9b}31m\u{7f}\u{1b}\u{7}\n");
        let place = sources.whole(file).part(0, 6);
        let mut diagnostics = Diagnostics::new();
        diagnostics.push(Diagnostic::new(codes::UNKNOWN_KEY, place, "found").edit(place, "\u{85}"));
        for format in [Format::Human, Format::Short, Format::Json, Format::Github] {
            let text = render(&diagnostics, &sources, format, false);
            assert!(!text.contains(|c: char| c.is_control() && c != '\n'), "{format:?}: {text:?}");
        }
        // The mark is as long as what it is under.
        assert!(human(diagnostics.iter().next().unwrap(), &sources, false).ends_with("\n  | ^^^^^"));
    }
}
