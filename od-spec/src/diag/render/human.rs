//! For people: with the source lines and marks, as rustc does.

use std::borrow::Cow;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use crate::diag::{Diagnostic, Label, Severity};
use crate::source::{FileId, SourceFile, SourceMap};
use crate::visible::{is_hidden, stand_in, visible};

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
    let text = as_long(&file.text()[start..end]);
    let length = text.len();
    let annotations = in_file().map(|(at, label)| {
        let clamp = |offset: u32| (offset as usize).saturating_sub(start).min(length);
        let range = clamp(label.span.start)..clamp(shown_end(label, file));
        let kind = if at == 0 { AnnotationKind::Primary } else { AnnotationKind::Context };
        let annotation = kind.span(range);
        if label.text.is_empty() { annotation } else { annotation.label(label.text.as_str()) }
    });
    Snippet::source(text).line_start(first + 1).path(visible(file.name())).annotations(annotations)
}

/// A text without the hidden characters that the renderer does not replace, those outside ASCII. What represents them
/// is as long.
fn as_long(text: &str) -> Cow<'_, str> {
    let is_hidden = |c: char| !c.is_ascii() && is_hidden(c);
    if text.contains(is_hidden) {
        text.chars().map(|c| if is_hidden(c) { stand_in(c) } else { c }).collect::<String>().into()
    } else {
        text.into()
    }
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
    fn nothing_hidden_in_a_text_reaches_a_terminal() {
        const HOSTILE: &str = "\u{1b}[31m\u{7}\u{9b}2J\u{7f}\u{202e}\u{61c}\n::error::x\r\u{2028}";
        let mut sources = SourceMap::new();
        let name = format!("a{HOSTILE}.eds");
        let file = sources.add(name, "Na\u{85}me=\u{9b}31m\u{7f}\u{1b}\u{7}\u{202e}\u{200f}\n");
        let place = sources.whole(file).part(0, 6);
        let mut diagnostics = Diagnostics::new();
        let diagnostic = Diagnostic::new(codes::UNKNOWN_KEY, place, format!("found {HOSTILE}"));
        let diagnostic = diagnostic.label(HOSTILE).help(HOSTILE).note(HOSTILE).edit(place, HOSTILE);
        diagnostics.push(diagnostic.with(place, HOSTILE));
        for format in [Format::Human, Format::Short] {
            let text = render(&diagnostics, &sources, format, false);
            assert!(!text.contains(|c: char| is_hidden(c) && c != '\n'), "{format:?}: {text:?}");
            assert!(!text.lines().any(|line| line.trim_start().starts_with("::")), "{text}");
        }
        // The mark is as long as what it is under.
        let shown = human(diagnostics.iter().next().unwrap(), &sources, false);
        assert!(shown.contains("| ^^^^^\n"), "{shown}");
    }
}
