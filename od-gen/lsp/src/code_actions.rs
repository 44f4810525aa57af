//! What messages offer to change: quick fixes, and everything in an EDS that can be fixed without a decision.

use lsp_types::{
    CodeAction, CodeActionContext, CodeActionKind, CodeActionOrCommand, Range, TextEdit, Uri, WorkspaceEdit,
};
use od_spec::diag::{Diagnostic, Edit, codes};
use od_spec::fix;
use od_spec::source::Span;

use super::analysis::Kind;
use super::departures::left_to_library;
use super::diagnostics::translated;
use super::formatting::{between, edits};
use super::snapshot::Snapshot;

/// Fixes everything that needs no decision.
const FIX_ALL: CodeActionKind = CodeActionKind::SOURCE_FIX_ALL;

/// The kinds of actions that there are.
pub(super) fn kinds() -> Vec<CodeActionKind> {
    vec![CodeActionKind::QUICKFIX, FIX_ALL]
}

/// What can be done in a range of a document.
pub(super) fn actions(
    snapshot: &Snapshot,
    range: Range,
    context: &CodeActionContext,
) -> Vec<CodeActionOrCommand> {
    let Some(uri) = snapshot.uri() else { return Vec::new() };
    let is_wanted = |kind: &CodeActionKind| {
        context.only.as_ref().is_none_or(|only| only.iter().any(|wanted| includes(wanted, kind)))
    };
    let mut actions = Vec::new();
    if is_wanted(&CodeActionKind::QUICKFIX) {
        let (start, end) = (snapshot.offset(range.start), snapshot.offset(range.end));
        let touches = |span: Span| span.start as usize <= end && start <= span.end as usize;
        for diagnostic in snapshot.now.about(snapshot.file) {
            if diagnostic.labels.first().is_some_and(|label| touches(label.span)) {
                actions.extend(quick_fix(snapshot, uri, diagnostic));
                actions.extend(of_departures(snapshot, uri, diagnostic));
            }
        }
    }
    if is_wanted(&FIX_ALL) {
        actions.extend(fix_all(snapshot, uri));
    }
    actions.into_iter().map(CodeActionOrCommand::CodeAction).collect()
}

/// Whether a kind is one of those that another one includes: `source` includes `source.fixAll`.
fn includes(wanted: &CodeActionKind, kind: &CodeActionKind) -> bool {
    let rest = kind.as_str().strip_prefix(wanted.as_str());
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// The change that a message brings with it. One that guesses nothing is preferred to others at the same place.
fn quick_fix(snapshot: &Snapshot, uri: &Uri, diagnostic: &Diagnostic) -> Option<CodeAction> {
    let (edits, is_sure) = match &diagnostic.meant {
        Some(meant) => (std::slice::from_ref(&**meant), false),
        None => (diagnostic.edits.as_slice(), true),
    };
    let is_in_document = |edit: &Edit| edit.span.file == snapshot.file;
    if edits.is_empty() || !edits.iter().all(is_in_document) {
        return None;
    }
    let text_edit = |edit: &Edit| TextEdit { range: snapshot.range(edit.span), new_text: edit.text.clone() };
    Some(CodeAction {
        title: title(snapshot, diagnostic, edits),
        kind: Some(CodeActionKind::QUICKFIX),
        diagnostics: Some(vec![translated(&snapshot.now, diagnostic, snapshot.encoding)]),
        edit: Some(change(uri, edits.iter().map(text_edit).collect())),
        is_preferred: Some(is_sure),
        ..CodeAction::default()
    })
}

/// For an object that departs from its library, what leaves each fact to the library.
fn of_departures<'a>(
    snapshot: &'a Snapshot,
    uri: &'a Uri,
    diagnostic: &'a Diagnostic,
) -> impl Iterator<Item = CodeAction> + 'a {
    let place = diagnostic.labels.first().filter(|_| diagnostic.code == codes::DEPARTURE);
    let fixes = place.map(|label| left_to_library(snapshot, label.span)).unwrap_or_default();
    fixes.into_iter().map(|(title, edit)| CodeAction {
        title,
        kind: Some(CodeActionKind::QUICKFIX),
        diagnostics: Some(vec![translated(&snapshot.now, diagnostic, snapshot.encoding)]),
        edit: Some(change(uri, vec![TextEdit { range: snapshot.range(edit.span), new_text: edit.text }])),
        ..CodeAction::default()
    })
}

/// Longest text that a title shows.
const LONGEST: usize = 40;

fn title(snapshot: &Snapshot, diagnostic: &Diagnostic, edits: &[Edit]) -> String {
    let is_shown = |text: &str| text.chars().count() <= LONGEST && !text.contains(['\n', '\r', '`']);
    if let [edit] = edits {
        let old = snapshot.now.sources.text(edit.span);
        match (old.trim(), edit.text.trim()) {
            (old, "") if is_shown(old) => return format!("Remove `{old}`"),
            ("", new) if is_shown(new) => return format!("Insert `{new}`"),
            (old, new) if is_shown(old) && is_shown(new) => return format!("Change `{old}` to `{new}`"),
            (_, _) => {}
        }
    }
    format!("Fix: {}", diagnostic.code.title)
}

/// What `odgen fix` makes of an EDS.
fn fix_all(snapshot: &Snapshot, uri: &Uri) -> Option<CodeAction> {
    if snapshot.now.kind != Kind::Eds || snapshot.now.root != Some(snapshot.file) {
        return None;
    }
    let file = snapshot.now.sources.file(snapshot.file);
    let fixed = fix(file.name(), file.text().as_bytes()).ok()?;
    let changes = between(file.text(), fixed.text());
    (!changes.is_empty()).then(|| CodeAction {
        title: "Fix everything that needs no decision".to_owned(),
        kind: Some(FIX_ALL),
        edit: Some(change(uri, edits(snapshot, changes))),
        ..CodeAction::default()
    })
}

fn change(uri: &Uri, edits: Vec<TextEdit>) -> WorkspaceEdit {
    WorkspaceEdit { changes: Some([(uri.clone(), edits)].into()), ..WorkspaceEdit::default() }
}
