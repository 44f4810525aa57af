//! What is sent to the client, as the text that goes over the line: a large answer is written down once, and nothing else is made
//! of it.

use lsp_server::{ErrorCode, RequestId, ResponseError};
use lsp_types::notification::Notification;
use lsp_types::request::Request;
use serde::Serialize;
use serde_json::json;

const JSONRPC: &str = "2.0";

/// The answer to a request.
#[derive(Serialize)]
struct Answer<'a, R> {
    jsonrpc: &'static str,
    id: &'a RequestId,
    result: R,
}

/// A request or a notification.
#[derive(Serialize)]
struct Call<P> {
    jsonrpc: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<RequestId>,
    method: &'static str,
    params: P,
}

/// An error as an answer.
pub(super) fn refusal(code: ErrorCode, message: String) -> ResponseError {
    ResponseError { code: code as i32, message, data: None }
}

/// The answer to a request.
pub(super) fn answer<R: Serialize>(id: &RequestId, result: Result<R, ResponseError>) -> String {
    let written = result.and_then(|result| {
        serde_json::to_string(&Answer { jsonrpc: JSONRPC, id, result })
            .map_err(|error| refusal(ErrorCode::InternalError, format!("cannot write the answer: {error}")))
    });
    written.unwrap_or_else(|error| json!({"jsonrpc": JSONRPC, "id": id, "error": error}).to_string())
}

/// A request to the client.
pub(super) fn request<M: Request>(id: RequestId, params: M::Params) -> serde_json::Result<String> {
    serde_json::to_string(&Call { jsonrpc: JSONRPC, id: Some(id), method: M::METHOD, params })
}

/// A message that the client did not ask for.
pub(super) fn notification<M: Notification>(params: M::Params) -> serde_json::Result<String> {
    serde_json::to_string(&Call { jsonrpc: JSONRPC, id: None, method: M::METHOD, params })
}
