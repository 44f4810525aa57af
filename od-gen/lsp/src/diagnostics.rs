//! What is said about documents, in the words of the protocol.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use lsp_types::{
    CodeDescription, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag, Location,
    NumberOrString, PublishDiagnosticsParams, Uri,
};
use od_spec::diag::{self, Severity};
use od_spec::rule_codes;
use od_spec::source::{FileId, Span};

use super::analysis::{Analysis, Kind, LARGEST};
use super::copies;
use super::place::Place;
use super::position::Encoding;

/// What is said about a file of an analysis.
pub(super) fn of_file(analysis: &Analysis, file: FileId, encoding: Encoding) -> Vec<Diagnostic> {
    let of_text = analysis.about(file).map(|diagnostic| translated(analysis, diagnostic, encoding));
    of_text.chain(misread(analysis, file, encoding)).chain(unchecked(analysis, file)).collect()
}

/// That a document is not checked: without a message it would look right.
fn unchecked(analysis: &Analysis, file: FileId) -> Option<Diagnostic> {
    (analysis.kind == Kind::TooLarge && Some(file) == analysis.root).then(|| Diagnostic {
        severity: Some(DiagnosticSeverity::WARNING),
        source: Some(SOURCE.to_owned()),
        message: format!(
            "this file is not checked while it is edited: it has {} MiB, expected at most {} MiB\nhelp: save it and run \
             `odgen check`; a specification can be divided with `parts:`",
            analysis.sources.file(file).text().len().div_ceil(1 << 20),
            LARGEST >> 20,
        ),
        ..Diagnostic::default()
    })
}

/// That the editor has read the file in another encoding than that in which it is stored.
fn misread(analysis: &Analysis, file: FileId, encoding: Encoding) -> Option<Diagnostic> {
    let (stored, at) = analysis.misread.filter(|_| Some(file) == analysis.root)?;
    let start = u32::try_from(at).ok()?;
    let length = analysis.sources.file(file).text().get(at..)?.chars().next()?.len_utf8();
    let span = Span { file, start, end: start + u32::try_from(length).ok()? };
    Some(Diagnostic {
        range: analysis.range(span, encoding),
        severity: Some(DiagnosticSeverity::ERROR),
        source: Some(SOURCE.to_owned()),
        message: format!(
            "the editor shows other characters than the file has\nnote: the file is stored as {stored}\nhelp: open it \
             with the encoding {stored} before you save it; otherwise these characters are lost"
        ),
        ..Diagnostic::default()
    })
}

/// What editors show as the origin of a message.
const SOURCE: &str = "odgen";

/// One message: its help and its notes are below it, as in a terminal.
pub(super) fn translated(analysis: &Analysis, said: &diag::Diagnostic, encoding: Encoding) -> Diagnostic {
    let mut places = said.labels.iter();
    let first = places.next();
    let related: Vec<DiagnosticRelatedInformation> = places
        .filter_map(|label| {
            let location = Location {
                uri: analysis.uri(label.span.file)?.clone(),
                range: analysis.range(label.span, encoding),
            };
            Some(DiagnosticRelatedInformation { location, message: label.text.clone() })
        })
        .collect();
    Diagnostic {
        range: first.map(|label| analysis.range(label.span, encoding)).unwrap_or_default(),
        severity: Some(severity(said.severity)),
        code: Some(NumberOrString::String(said.code.id.to_owned())),
        code_description: copies::explained(said.code).map(|href| CodeDescription { href }),
        source: Some(SOURCE.to_owned()),
        message: message(said),
        related_information: (!related.is_empty()).then_some(related),
        tags: tag(said).map(|tag| vec![tag]),
        data: None,
    }
}

const fn severity(severity: Severity) -> DiagnosticSeverity {
    match severity {
        Severity::Error => DiagnosticSeverity::ERROR,
        Severity::Warning => DiagnosticSeverity::WARNING,
        Severity::Note => DiagnosticSeverity::HINT,
    }
}

fn message(said: &diag::Diagnostic) -> String {
    let mut text = said.message.clone();
    if let Some(label) = said.labels.first().filter(|label| !label.text.is_empty()) {
        let _ = write!(text, " ({})", label.text);
    }
    for note in said.all_notes() {
        let _ = write!(text, "\nnote: {note}");
    }
    if let Some(help) = &said.help {
        let _ = write!(text, "\nhelp: {help}");
    }
    text
}

/// What editors show in grey, or struck out.
fn tag(said: &diag::Diagnostic) -> Option<DiagnosticTag> {
    if said.code == rule_codes::UNUSED_DEFINITION { Some(DiagnosticTag::UNNECESSARY) } else { None }
}

/// What was said about documents, so that only what is new is sent.
#[derive(Debug, Default)]
pub(super) struct Published {
    sent: BTreeMap<String, Sent>,
}

/// What was sent about a document.
#[derive(Debug)]
struct Sent {
    uri: Uri,
    version: Option<i32>,
    diagnostics: Vec<Diagnostic>,
}

impl Published {
    /// What has to be sent so that a client knows what these analyses say, and no longer what earlier ones said. A file of several
    /// specifications has what each says about it, once.
    pub(super) fn update<'a>(
        &mut self,
        analyses: impl Iterator<Item = &'a Analysis>,
        version: impl Fn(&Place) -> Option<i32>,
        encoding: Encoding,
    ) -> Vec<PublishDiagnosticsParams> {
        let mut now: BTreeMap<String, Sent> = BTreeMap::new();
        for analysis in analyses {
            for file in analysis.files() {
                let (Some(uri), Some(place)) = (analysis.uri(file), analysis.place(file)) else { continue };
                let sent = now.entry(uri.as_str().to_owned()).or_insert_with(|| Sent {
                    uri: uri.clone(),
                    version: version(place),
                    diagnostics: Vec::new(),
                });
                let one_alone = sent.diagnostics.is_empty();
                for diagnostic in of_file(analysis, file, encoding) {
                    if one_alone || !sent.diagnostics.contains(&diagnostic) {
                        sent.diagnostics.push(diagnostic);
                    }
                }
            }
        }
        let is_new = |(uri, sent): &(&String, &Sent)| match self.sent.get(*uri) {
            Some(before) => before.version != sent.version || before.diagnostics != sent.diagnostics,
            // A client that hears nothing of a document it opened waits.
            None => sent.version.is_some() || !sent.diagnostics.is_empty(),
        };
        let news = now.iter().filter(is_new).map(|(_, sent)| PublishDiagnosticsParams {
            uri: sent.uri.clone(),
            version: sent.version,
            diagnostics: sent.diagnostics.clone(),
        });
        let gone = |(uri, sent): &(&String, &Sent)| {
            !now.contains_key(*uri) && (sent.version.is_some() || !sent.diagnostics.is_empty())
        };
        let gone = self.sent.iter().filter(gone).map(|(_, sent)| PublishDiagnosticsParams {
            uri: sent.uri.clone(),
            version: None,
            diagnostics: Vec::new(),
        });
        let news: Vec<PublishDiagnosticsParams> = gone.chain(news).collect();
        self.sent = now;
        news
    }
}
