//! The loop: one message after the other.

use std::collections::{BTreeSet, VecDeque};
use std::sync::mpsc::{Receiver, Sender};

use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, ResponseError};
use lsp_types::notification::{
    DidChangeTextDocument, DidChangeWatchedFiles, DidCloseTextDocument, DidOpenTextDocument,
    DidSaveTextDocument, Exit as ExitNotification, Initialized, LogMessage, Notification as Method,
    PublishDiagnostics,
};
use lsp_types::request::{Initialize, RegisterCapability, Request as _, Shutdown};
use lsp_types::{
    DidChangeTextDocumentParams, DidChangeWatchedFilesRegistrationOptions, FileSystemWatcher, GlobPattern,
    InitializeParams, InitializeResult, LogMessageParams, MessageType, Registration, RegistrationParams,
};
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::capabilities;
use super::completion::Insertion;
use super::diagnostics::Published;
use super::inlay::Hint;
use super::outgoing::{self, answer, refusal};
use super::place::Place;
use super::position::Encoding;
use super::requests::{self, Context};
use super::workspace::Workspace;

/// How the work ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// The client said `shutdown` before it left.
    Agreed,
    /// The client left without it.
    Sudden,
}

/// How far client and server are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// Nothing was said yet.
    Strange,
    /// They work.
    Working,
    /// The client said `shutdown`.
    Leaving,
}

/// Serves a client until it leaves; `answers` takes the texts of messages. No file of a user is written; copies of libraries and
/// explanations go to the cache.
pub fn serve(messages: &Receiver<Message>, answers: Sender<String>) -> Exit {
    let mut server = Server {
        answers,
        phase: Phase::Strange,
        encoding: Encoding::default(),
        insertion: Insertion::default(),
        show_places: None,
        hints: BTreeSet::new(),
        workspace: Workspace::default(),
        published: Published::default(),
        is_news: false,
        client_watches: false,
    };
    let mut waiting = VecDeque::new();
    loop {
        // Everything that came: a later message may cancel an earlier one, or change what it is about.
        waiting.extend(messages.try_iter());
        let message = match waiting.pop_front() {
            Some(message) => message,
            None if server.look_at_one() => continue,
            None => match messages.recv() {
                Ok(message) => message,
                Err(_) => return server.exit(),
            },
        };
        match message {
            Message::Request(request) if is_cancelled(&request.id, &waiting) => {
                let message = "cancelled by the client".to_owned();
                server.send(answer::<()>(&request.id, Err(refusal(ErrorCode::RequestCanceled, message))));
            }
            Message::Request(request) => server.request(request),
            Message::Notification(notification) if notification.method == ExitNotification::METHOD => {
                return server.exit();
            }
            Message::Notification(notification) => server.notification(notification),
            // What was asked of the client needs no answer.
            Message::Response(_) => {}
        }
    }
}

/// Whether a request is cancelled by a later message.
fn is_cancelled(id: &RequestId, later: &VecDeque<Message>) -> bool {
    later.iter().any(|message| match message {
        Message::Notification(Notification { method, params }) if method == "$/cancelRequest" => {
            let cancelled = params.get("id").cloned().map(serde_json::from_value::<RequestId>);
            cancelled.is_some_and(|cancelled| cancelled.is_ok_and(|cancelled| cancelled == *id))
        }
        _ => false,
    })
}

struct Server {
    answers: Sender<String>,
    phase: Phase,
    encoding: Encoding,
    insertion: Insertion,
    show_places: Option<String>,
    hints: BTreeSet<Hint>,
    workspace: Workspace,
    published: Published,
    /// Whether something changed since diagnostics were published.
    is_news: bool,
    /// Whether the client reports files that change on the disk.
    client_watches: bool,
}

impl Server {
    const fn exit(&self) -> Exit {
        match self.phase {
            Phase::Leaving => Exit::Agreed,
            Phase::Strange | Phase::Working => Exit::Sudden,
        }
    }

    fn send(&self, message: String) {
        // A client that has gone will be noticed where the next message is read.
        let _ = self.answers.send(message);
    }

    fn notify<M: Method>(&self, params: M::Params) {
        if let Ok(message) = outgoing::notification::<M>(params) {
            self.send(message);
        }
    }

    fn request(&mut self, request: Request) {
        let id = request.id.clone();
        let refused = |code, message: &str| answer::<()>(&id, Err(refusal(code, message.to_owned())));
        let answer = match self.phase {
            Phase::Strange if request.method == Initialize::METHOD => {
                answer(&id, self.initialize(request.params))
            }
            Phase::Strange => {
                refused(ErrorCode::ServerNotInitialized, "expected `initialize` before any other request")
            }
            Phase::Working if request.method == Initialize::METHOD => {
                refused(ErrorCode::InvalidRequest, "`initialize` came a second time")
            }
            Phase::Working if request.method == Shutdown::METHOD => {
                self.phase = Phase::Leaving;
                answer(&id, Ok(()))
            }
            Phase::Working => {
                let mut context = Context {
                    workspace: &mut self.workspace,
                    encoding: self.encoding,
                    insertion: &self.insertion,
                    show_places: self.show_places.as_deref(),
                    hints: &self.hints,
                };
                requests::answered(request, &mut context)
            }
            Phase::Leaving => refused(ErrorCode::InvalidRequest, "expected `exit` after `shutdown`"),
        };
        self.send(answer);
    }

    fn initialize(&mut self, params: Value) -> Result<InitializeResult, ResponseError> {
        let client: InitializeParams = serde_json::from_value(params).map_err(|error| {
            refusal(ErrorCode::InvalidParams, format!("cannot read the parameters of `initialize`: {error}"))
        })?;
        self.encoding = capabilities::encoding(&client);
        self.insertion = capabilities::insertion(&client);
        self.show_places = capabilities::option(&client, "showPlaces");
        self.workspace.folders = capabilities::folders(&client);
        self.hints = Hint::wanted(client.initialization_options.as_ref());
        self.phase = Phase::Working;
        self.client_watches = capabilities::watches_files(&client);
        Ok(capabilities::answer(self.encoding))
    }

    /// Asks the client to report when a library or a part changes on the disk.
    fn watch_files(&self) {
        let watcher = FileSystemWatcher {
            glob_pattern: GlobPattern::String("**/*.{yaml,yml,eds,dcf,xdd,xdc}".to_owned()),
            kind: None,
        };
        let options = DidChangeWatchedFilesRegistrationOptions { watchers: vec![watcher] };
        let registration = Registration {
            id: "files".to_owned(),
            method: DidChangeWatchedFiles::METHOD.to_owned(),
            register_options: serde_json::to_value(options).ok(),
        };
        let params = RegistrationParams { registrations: vec![registration] };
        if let Ok(message) = outgoing::request::<RegisterCapability>(RequestId::from(0), params) {
            self.send(message);
        }
    }

    fn notification(&mut self, notification: Notification) {
        if self.phase != Phase::Working {
            return;
        }
        let Notification { method, params } = notification;
        self.is_news |= method.starts_with("textDocument/") || method == DidChangeWatchedFiles::METHOD;
        match method.as_str() {
            Initialized::METHOD if self.client_watches => self.watch_files(),
            DidOpenTextDocument::METHOD => {
                if let Some(opened) = self.read::<<DidOpenTextDocument as Method>::Params>(&method, params) {
                    self.workspace.open(opened.text_document);
                }
            }
            DidChangeTextDocument::METHOD => {
                let Some(changed) = self.read::<DidChangeTextDocumentParams>(&method, params) else { return };
                let document = changed.text_document;
                let known = self.workspace.change(
                    &document.uri,
                    document.version,
                    changed.content_changes,
                    self.encoding,
                );
                if !known {
                    self.complain(format!("`{}` changed, and is not open", document.uri.as_str()));
                }
            }
            DidCloseTextDocument::METHOD => {
                if let Some(closed) = self.read::<<DidCloseTextDocument as Method>::Params>(&method, params) {
                    self.workspace.close(&closed.text_document.uri);
                }
            }
            DidSaveTextDocument::METHOD => {
                if let Some(saved) = self.read::<<DidSaveTextDocument as Method>::Params>(&method, params) {
                    self.workspace.saved(&Place::of_uri(&saved.text_document.uri));
                }
            }
            DidChangeWatchedFiles::METHOD => {
                if let Some(changed) = self.read::<<DidChangeWatchedFiles as Method>::Params>(&method, params)
                {
                    for change in changed.changes {
                        self.workspace.changed(&Place::of_uri(&change.uri));
                    }
                }
            }
            // What is not known needs no answer.
            _ => {}
        }
    }

    /// The parameters of a notification; what cannot be read is reported in the client's log, because there is no answer.
    fn read<P: DeserializeOwned>(&self, method: &str, params: Value) -> Option<P> {
        match serde_json::from_value(params) {
            Ok(params) => Some(params),
            Err(error) => {
                self.complain(format!("cannot read the parameters of `{method}`: {error}"));
                None
            }
        }
    }

    fn complain(&self, message: String) {
        self.notify::<LogMessage>(LogMessageParams { typ: MessageType::ERROR, message });
    }

    /// While no request waits: analyses one specification that has changed, and reports what is new once nothing is stale.
    /// Whether there was something to do.
    fn look_at_one(&mut self) -> bool {
        if let Some(stale) = self.workspace.stale() {
            self.workspace.analysed(&stale);
            return true;
        }
        let is_news = std::mem::take(&mut self.is_news);
        if is_news {
            self.publish();
        }
        is_news
    }

    fn publish(&mut self) {
        let Self { workspace, published, encoding, .. } = self;
        let analyses = workspace.analyses();
        let news =
            published.update(analyses.iter().map(AsRef::as_ref), |place| workspace.version(place), *encoding);
        for params in news {
            self.notify::<PublishDiagnostics>(params);
        }
    }
}
