//! What the server can do, and what client and server agree on.

use std::path::PathBuf;

use lsp_types::{
    CodeActionOptions, CodeActionProviderCapability, CodeLensOptions, Command, CompletionOptions,
    FoldingRangeProviderCapability, HoverProviderCapability, InitializeParams, InitializeResult, OneOf,
    RenameOptions, ServerCapabilities, ServerInfo, TextDocumentSyncCapability, TextDocumentSyncKind,
    TextDocumentSyncOptions, TextDocumentSyncSaveOptions, WorkDoneProgressOptions,
};

use od_gen::source::plain;
use serde_json::Value;

use super::code_actions;
use super::completion::Insertion;
use super::position::Encoding;
use super::uri::path_of;

/// The encoding of positions that a client and the server speak.
pub(super) fn encoding(client: &InitializeParams) -> Encoding {
    let general = client.capabilities.general.as_ref();
    let offered = general.and_then(|general| general.position_encodings.as_deref());
    Encoding::agreed(offered.unwrap_or_default())
}

/// Whether a client reports files that change on the disk if it is asked to.
pub(super) fn watches_files(client: &InitializeParams) -> bool {
    let workspace = client.capabilities.workspace.as_ref();
    let watched = workspace.and_then(|workspace| workspace.did_change_watched_files.as_ref());
    watched.and_then(|watched| watched.dynamic_registration).unwrap_or_default()
}

/// A text of the client's `initializationOptions`.
pub(super) fn option(client: &InitializeParams, name: &str) -> Option<String> {
    client.initialization_options.as_ref()?.get(name).and_then(Value::as_str).map(ToOwned::to_owned)
}

/// The folders that the client shows.
pub(super) fn folders(client: &InitializeParams) -> Vec<PathBuf> {
    let folders = client.workspace_folders.iter().flatten();
    folders.filter_map(|folder| path_of(folder.uri.as_str())).map(|path| plain(&path)).collect()
}

/// How a client wants completions: by its capabilities, and `suggestNext` of its `initializationOptions`, a command of its own.
pub(super) fn insertion(client: &InitializeParams) -> Insertion {
    let next = option(client, "suggestNext").map(|name| Command::new("suggest".to_owned(), name, None));
    let document = client.capabilities.text_document.as_ref();
    let item = document
        .and_then(|document| document.completion.as_ref())
        .and_then(|completion| completion.completion_item.as_ref());
    Insertion { snippets: item.and_then(|item| item.snippet_support).unwrap_or_default(), next }
}

/// What the server can do.
pub(super) fn answer(encoding: Encoding) -> InitializeResult {
    InitializeResult {
        capabilities: ServerCapabilities {
            position_encoding: Some(encoding.kind()),
            text_document_sync: Some(TextDocumentSyncCapability::Options(TextDocumentSyncOptions {
                open_close: Some(true),
                change: Some(TextDocumentSyncKind::INCREMENTAL),
                save: Some(TextDocumentSyncSaveOptions::Supported(true)),
                ..TextDocumentSyncOptions::default()
            })),
            completion_provider: Some(CompletionOptions {
                trigger_characters: Some([" ", "[", "{", ",", ".", "="].map(str::to_owned).to_vec()),
                ..CompletionOptions::default()
            }),
            code_lens_provider: Some(CodeLensOptions { resolve_provider: Some(false) }),
            hover_provider: Some(HoverProviderCapability::Simple(true)),
            definition_provider: Some(OneOf::Left(true)),
            references_provider: Some(OneOf::Left(true)),
            rename_provider: Some(OneOf::Right(RenameOptions {
                prepare_provider: Some(true),
                work_done_progress_options: WorkDoneProgressOptions::default(),
            })),
            document_highlight_provider: Some(OneOf::Left(true)),
            inlay_hint_provider: Some(OneOf::Left(true)),
            code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
                code_action_kinds: Some(code_actions::kinds()),
                ..CodeActionOptions::default()
            })),
            document_formatting_provider: Some(OneOf::Left(true)),
            document_range_formatting_provider: Some(OneOf::Left(true)),
            document_symbol_provider: Some(OneOf::Left(true)),
            workspace_symbol_provider: Some(OneOf::Left(true)),
            folding_range_provider: Some(FoldingRangeProviderCapability::Simple(true)),
            ..ServerCapabilities::default()
        },
        server_info: Some(ServerInfo {
            name: "odgen".to_owned(),
            version: Some(env!("CARGO_PKG_VERSION").to_owned()),
        }),
    }
}
