//! Findings get their readers.

use std::collections::{BTreeMap, BTreeSet};

use super::refusal::{Cause, Refusal};
use super::table::stumbling;
use super::{Predicted, predicted};
use od_spec::diag::readers::{Evidence, Reader, Readers};
use od_spec::diag::{Diagnostic, Diagnostics};
use od_spec::source::{FileId, SourceFile, SourceMap, Span};

/// Names, at each finding about the EDS or DCF `file`, the readers that refuse the file because of it, and adds notes for what
/// they refuse and no finding is about.
///
/// ```
/// use od_readers::mark;
/// use od_spec::diag::readers::Reader;
/// use od_spec::source::SourceMap;
/// use od_spec::{NoFiles, compile};
///
/// let mut sources = SourceMap::new();
/// let text = "[2000]\nParameterName=level\nDataType=5\nAccessType=R\nPDOMapping=0\n";
/// let file = sources.add("lamp.eds", text);
/// let mut findings = compile(&mut sources, file, &mut NoFiles).diagnostics;
/// mark(&sources, file, &mut findings);
/// let access = findings.iter().find(|one| one.code.id == "EDS406").expect("`R` is not an access type");
/// assert!(access.minded_by.contains(Reader::CanopenHost));
/// assert!(!access.minded_by.contains(Reader::PythonCanopen));
/// ```
pub fn mark(sources: &SourceMap, file: FileId, diagnostics: &mut Diagnostics) {
    let source = sources.file(file);
    let mut by_line: BTreeMap<usize, Vec<&mut Diagnostic>> = BTreeMap::new();
    for diagnostic in diagnostics.as_mut_slice() {
        for reader in stumbling(diagnostic.code).iter().map(|one| one.reader) {
            if reader.evidence() == Evidence::Reported {
                diagnostic.minded_by.insert(reader);
            }
        }
        if let Some(label) = diagnostic.labels.first().filter(|label| label.span.file == file) {
            by_line.entry(source.line_index(label.span.start)).or_default().push(diagnostic);
        }
    }
    let Predicted { refusals: all, reported } = predicted(file, source);
    // A finding may be said once for many places, so what it says of a reader holds for all of them.
    let mut remarked: BTreeSet<(Reader, Cause, &str)> = BTreeSet::new();
    for refusal in &all {
        let line = source.line_index(refusal.place.start);
        for diagnostic in by_line.get_mut(&line).into_iter().flatten() {
            if stumbling(diagnostic.code).iter().any(|one| one.reader == refusal.reader) {
                diagnostic.minded_by.insert(refusal.reader);
                remarked.insert((refusal.reader, refusal.cause, refusal.what));
            }
        }
    }
    let unreported = all.into_iter().filter(|one| !remarked.contains(&(one.reader, one.cause, one.what)));
    diagnostics.as_mut_slice().iter_mut().for_each(Diagnostic::tell_readers);
    let reported = reported.map(|mut note| {
        note.tell_readers();
        note
    });
    // What is only about readers names them in its message.
    for note in notes(unreported, source).into_iter().chain(reported) {
        diagnostics.push(note);
    }
    diagnostics.sort();
}

/// One note for all places at which readers refuse the same.
fn notes(refusals: impl Iterator<Item = Refusal>, source: &SourceFile) -> Vec<Diagnostic> {
    let mut places: BTreeMap<(Cause, &'static str, Reader), BTreeSet<Span>> = BTreeMap::new();
    for refusal in refusals {
        places.entry((refusal.cause, refusal.what, refusal.reader)).or_default().insert(refusal.place);
    }
    // Readers that refuse the same at the same place are named together.
    let mut grouped: BTreeMap<(Cause, Option<Span>, usize), (&'static str, Readers)> = BTreeMap::new();
    for ((cause, what, reader), places) in &places {
        let (_, readers) =
            grouped.entry((*cause, places.first().copied(), places.len())).or_insert((what, Readers::NONE));
        readers.insert(*reader);
    }
    let note = |((cause, place, count), (what, readers)): (_, (&str, Readers))| {
        let (cause, place): (Cause, Span) = (cause, place?);
        let line = source.line_col(place.start).line;
        let more = match count {
            1 => String::new(),
            2 => format!("; 1 more place after line {line}"),
            _ => format!("; {} more places after line {line}", count - 1),
        };
        let mut note = Diagnostic::new(cause.code(), place, format!("{} {what}{more}", cause.verb(readers)));
        note.minded_by = readers;
        Some(note)
    };
    grouped.into_iter().filter_map(note).collect()
}
