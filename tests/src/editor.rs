//! What an editor shows of a specification: a session with the language server, in this process.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use lsp_server::{Message, Notification, Request, RequestId};
use od_lsp::serve;
use serde_json::{Value, json};

use crate::Failure;

const URI: &str = "file:///valve.od.yaml";

/// The other end of the line.
struct Editor {
    messages: Sender<Message>,
    answers: Receiver<String>,
    asked: i32,
}

impl Editor {
    fn notify(&self, method: &str, params: Value) -> Result<(), Failure> {
        Ok(self.messages.send(Notification::new(method.to_owned(), params).into())?)
    }

    /// The result of a request.
    fn ask(&mut self, method: &str, params: Value) -> Result<Value, Failure> {
        self.asked += 1;
        self.messages.send(Request::new(RequestId::from(self.asked), method.to_owned(), params).into())?;
        loop {
            let mut answer = self.next()?;
            if answer["id"] == self.asked {
                return match answer["error"]["message"].as_str() {
                    Some(error) => Err(error.into()),
                    None => Ok(answer["result"].take()),
                };
            }
        }
    }

    /// The next message of the server.
    fn next(&self) -> Result<Value, Failure> {
        Ok(serde_json::from_str(&self.answers.recv()?)?)
    }

    /// What is said about the document next.
    fn said(&self) -> Result<Value, Failure> {
        loop {
            let mut said = self.next()?;
            if said["method"] == "textDocument/publishDiagnostics" {
                return Ok(said["params"]["diagnostics"].take());
            }
        }
    }
}

/// A text in which a word is mistyped: what is said about it, and what is offered.
///
/// # Errors
/// The server does not answer, or finds nothing.
pub fn mistyped(right: &str, word: &str, wrong: &str) -> Result<String, Failure> {
    let text = right.replacen(word, wrong, 1);
    session(&text, |editor| {
        let said = editor.said()?;
        let first = said.get(0).ok_or("nothing is said")?;
        let context = json!({"diagnostics": []});
        let params = json!({"textDocument": {"uri": URI}, "range": first["range"], "context": context});
        let offered = editor.ask("textDocument/codeAction", params)?;
        let place = &first["range"]["start"];
        let number = |key: &str| place[key].as_u64().unwrap_or_default() + 1;
        let message = first["message"].as_str().ok_or("no message")?;
        let title = offered[0]["title"].as_str().ok_or("nothing is offered")?;
        let code = first["code"].as_str().unwrap_or_default();
        Ok(format!("{}:{} {code}: {message}\nquick fix: {title}", number("line"), number("character")))
    })
}

/// What is shown over the last place of a word.
///
/// # Errors
/// The server does not answer, or has nothing to show.
pub fn hover(text: &str, word: &str) -> Result<String, Failure> {
    let at = text.rfind(word).ok_or("the word is not there")?;
    let line = text[..at].matches('\n').count();
    let start = text[..at].rfind('\n').map_or(0, |at| at + 1);
    let character = text[start..at].encode_utf16().count();
    session(text, |editor| {
        let position = json!({"line": line, "character": character});
        let params = json!({"textDocument": {"uri": URI}, "position": position});
        let shown = editor.ask("textDocument/hover", params)?;
        Ok(shown["contents"]["value"].as_str().ok_or("nothing is shown")?.trim_end().to_owned())
    })
}

/// A session about a text.
fn session(text: &str, act: impl FnOnce(&mut Editor) -> Result<String, Failure>) -> Result<String, Failure> {
    let ((messages, received), (sender, answers)) = (channel(), channel());
    let server = thread::spawn(move || serve(&received, sender));
    let mut editor = Editor { messages, answers, asked: 0 };
    editor.ask("initialize", json!({"capabilities": {}}))?;
    let document = json!({"uri": URI, "languageId": "yaml", "version": 1, "text": text});
    editor.notify("textDocument/didOpen", json!({"textDocument": document}))?;
    let result = act(&mut editor);
    editor.ask("shutdown", Value::Null)?;
    editor.notify("exit", Value::Null)?;
    server.join().map_err(|_| "the server failed")?;
    result
}
