//! Which function answers which request.

use std::collections::BTreeSet;

use lsp_server::{ErrorCode, Request, ResponseError};
use lsp_types::request::{
    CodeActionRequest, CodeLensRequest, Completion, DocumentHighlightRequest, DocumentSymbolRequest,
    FoldingRangeRequest, Formatting, GotoDefinition, HoverRequest, InlayHintRequest, PrepareRenameRequest,
    RangeFormatting, References, Rename, Request as Method, WorkspaceSymbolRequest,
};
use lsp_types::{
    CompletionList, CompletionResponse, DocumentSymbolResponse, GotoDefinitionResponse, Position,
    TextDocumentPositionParams, Uri, WorkspaceSymbolResponse,
};

use super::completion::{self, Insertion};
use super::inlay::Hint;
use super::lens;
use super::outgoing::{answer, refusal};
use super::position::Encoding;
use super::snapshot::Snapshot;
use super::symbols;
use super::workspace::Workspace;
use super::workspace_symbols;
use super::{code_actions, definition, folding, formatting, hover, inlay, rename};

/// What an answer is made from.
pub(super) struct Context<'a> {
    /// What is open.
    pub workspace: &'a mut Workspace,
    /// What positions are counted in.
    pub encoding: Encoding,
    /// How the client wants completions.
    pub insertion: &'a Insertion,
    /// The command of the client that shows places.
    pub show_places: Option<&'a str>,
    /// The hints that the client wants.
    pub hints: &'a BTreeSet<Hint>,
}

impl Context<'_> {
    /// What a request about a document is answered from.
    fn snapshot(&mut self, uri: &Uri) -> Result<Snapshot, ResponseError> {
        let snapshot = self.workspace.snapshot(uri, self.encoding);
        snapshot.ok_or_else(|| refusal(ErrorCode::InvalidParams, format!("`{}` is not open", uri.as_str())))
    }

    /// What a request at a position of a document is answered from.
    fn at(&mut self, at: &TextDocumentPositionParams) -> Result<(Snapshot, Position), ResponseError> {
        Ok((self.snapshot(&at.text_document.uri)?.about(at.position), at.position))
    }
}

/// What was asked for cannot be done.
fn failed(reason: String) -> ResponseError {
    refusal(ErrorCode::RequestFailed, reason)
}

/// The answer to a request.
pub(super) fn answered(request: Request, context: &mut Context<'_>) -> String {
    match request.method.as_str() {
        CodeActionRequest::METHOD => on::<CodeActionRequest>(request, |params| {
            let snapshot = context.snapshot(&params.text_document.uri)?;
            Ok(Some(code_actions::actions(&snapshot, params.range, &params.context)))
        }),
        DocumentSymbolRequest::METHOD => on::<DocumentSymbolRequest>(request, |params| {
            let snapshot = context.snapshot(&params.text_document.uri)?;
            Ok(Some(DocumentSymbolResponse::Nested(symbols::symbols(&snapshot))))
        }),
        Completion::METHOD => on::<Completion>(request, |params| {
            let (snapshot, position) = context.at(&params.text_document_position)?;
            let items = completion::completion(&snapshot, position, context.insertion);
            // What is offered depends on what has been written: an index or a name.
            Ok(Some(CompletionResponse::List(CompletionList { is_incomplete: true, items })))
        }),
        GotoDefinition::METHOD => on::<GotoDefinition>(request, |params| {
            let (snapshot, position) = context.at(&params.text_document_position_params)?;
            Ok(Some(GotoDefinitionResponse::Array(definition::definition(&snapshot, position))))
        }),
        PrepareRenameRequest::METHOD => on::<PrepareRenameRequest>(request, |params| {
            let (snapshot, position) = context.at(&params)?;
            rename::prepare(&snapshot, position).map(Some).map_err(failed)
        }),
        Rename::METHOD => on::<Rename>(request, |params| {
            let (snapshot, position) = context.at(&params.text_document_position)?;
            let renamed = rename::rename(&snapshot, position, &params.new_name, context.workspace);
            renamed.map(Some).map_err(failed)
        }),
        InlayHintRequest::METHOD => on::<InlayHintRequest>(request, |params| {
            let snapshot = context.snapshot(&params.text_document.uri)?;
            Ok(Some(inlay::hints(&snapshot, params.range, context.hints)))
        }),
        CodeLensRequest::METHOD => on::<CodeLensRequest>(request, |params| {
            let snapshot = context.snapshot(&params.text_document.uri)?;
            Ok(Some(lens::lenses(&snapshot, context.show_places)))
        }),
        HoverRequest::METHOD => on::<HoverRequest>(request, |params| {
            let (snapshot, position) = context.at(&params.text_document_position_params)?;
            Ok(hover::hover(&snapshot, position))
        }),
        References::METHOD => on::<References>(request, |params| {
            let (snapshot, position) = context.at(&params.text_document_position)?;
            let with_definition = params.context.include_declaration;
            Ok(Some(definition::references(&snapshot, position, with_definition)))
        }),
        DocumentHighlightRequest::METHOD => on::<DocumentHighlightRequest>(request, |params| {
            let (snapshot, position) = context.at(&params.text_document_position_params)?;
            Ok(Some(definition::highlights(&snapshot, position)))
        }),
        FoldingRangeRequest::METHOD => on::<FoldingRangeRequest>(request, |params| {
            Ok(Some(folding::ranges(&context.snapshot(&params.text_document.uri)?)))
        }),
        Formatting::METHOD => on::<Formatting>(request, |params| {
            Ok(Some(formatting::document(&context.snapshot(&params.text_document.uri)?)))
        }),
        RangeFormatting::METHOD => on::<RangeFormatting>(request, |params| {
            let snapshot = context.snapshot(&params.text_document.uri)?;
            Ok(Some(formatting::range(&snapshot, params.range)))
        }),
        WorkspaceSymbolRequest::METHOD => on::<WorkspaceSymbolRequest>(request, |params| {
            let found =
                workspace_symbols::find(&params.query, &context.workspace.snapshots(context.encoding));
            Ok(Some(WorkspaceSymbolResponse::Nested(found)))
        }),
        method => {
            let message = format!("there is no method `{method}`");
            answer::<()>(&request.id, Err(refusal(ErrorCode::MethodNotFound, message)))
        }
    }
}

/// Reads the parameters of a request, and writes down its answer.
fn on<M: Method>(
    Request { id, params, .. }: Request,
    result: impl FnOnce(M::Params) -> Result<M::Result, ResponseError>,
) -> String {
    let params = serde_json::from_value(params).map_err(|error| {
        refusal(ErrorCode::InvalidParams, format!("cannot read the parameters of `{}`: {error}", M::METHOD))
    });
    answer(&id, params.and_then(result))
}
