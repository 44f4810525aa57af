//! An editor as `odgen lsp` meets it: messages on its standard input and output, read by a thread of their own.

use std::collections::VecDeque;
use std::fs;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};

/// A longer wait for an answer would not end.
const PATIENCE: Duration = Duration::from_secs(120);

/// An editor, its server and a directory with files.
pub(crate) struct Client {
    child: Child,
    input: Option<ChildStdin>,
    output: Receiver<Value>,
    /// What came and was not asked for yet.
    kept: VecDeque<Value>,
    next_id: i64,
    pub directory: Directory,
}

/// A directory that is removed with its owner.
pub(crate) struct Directory(pub PathBuf);

impl Directory {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("odgen-lsp-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path.canonicalize().unwrap())
    }

    /// The URI of a file of the directory.
    pub(crate) fn uri(&self, name: &str) -> String {
        format!("file://{}/{name}", self.0.display())
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Runs `odgen lsp`, in which the cache lies in a directory.
pub(crate) fn spawn(directory: &Directory) -> Child {
    command(directory).stderr(Stdio::inherit()).spawn().unwrap()
}

/// The same, not yet running.
pub(crate) fn command(directory: &Directory) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_odgen"));
    command
        .arg("lsp")
        .env("XDG_CACHE_HOME", directory.0.join("cache"))
        .current_dir(&directory.0)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped());
    command
}

/// A message as it goes over the line.
pub(crate) fn frame(message: &Value) -> Vec<u8> {
    let text = message.to_string();
    format!("Content-Length: {}\r\n\r\n{text}", text.len()).into_bytes()
}

/// The next message of an output; `None` at its end.
pub(crate) fn read(output: &mut BufReader<ChildStdout>) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if output.read_line(&mut line).unwrap() == 0 {
            return None;
        }
        match line.trim_end().split_once(": ") {
            Some(("Content-Length", value)) => length = value.parse().unwrap(),
            Some(_) => {}
            None => break,
        }
    }
    let mut bytes = vec![0; length];
    output.read_exact(&mut bytes).unwrap();
    Some(serde_json::from_slice(&bytes).unwrap())
}

impl Client {
    /// A server and a client that speaks UTF-16.
    pub(crate) fn new(name: &str) -> Self {
        Self::with(name, &json!({})).0
    }

    /// A server and a client with capabilities, and what the server said about itself.
    pub(crate) fn with(name: &str, capabilities: &Value) -> (Self, Value) {
        let mut client = Self::silent(name);
        let answer = client.request(
            "initialize",
            &json!({"processId": null, "rootUri": null, "capabilities": capabilities}),
        );
        client.notify("initialized", &json!({}));
        (client, answer.unwrap())
    }

    /// A server to which nothing was said yet.
    pub(crate) fn silent(name: &str) -> Self {
        let directory = Directory::new(name);
        let mut child = spawn(&directory);
        let (input, output) = (child.stdin.take(), child.stdout.take().unwrap());
        let (sender, receiver) = channel();
        thread::spawn(move || {
            let mut output = BufReader::new(output);
            while let Some(message) = read(&mut output) {
                if sender.send(message).is_err() {
                    break;
                }
            }
        });
        Self { child, input, output: receiver, kept: VecDeque::new(), next_id: 1, directory }
    }

    pub(crate) fn send(&mut self, message: &Value) {
        self.input.as_mut().unwrap().write_all(&frame(message)).unwrap();
    }

    /// Sends several messages in one piece.
    pub(crate) fn send_bytes(&mut self, bytes: &[u8]) {
        self.input.as_mut().unwrap().write_all(bytes).unwrap();
    }

    pub(crate) fn notify(&mut self, method: &str, params: &Value) {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}));
    }

    /// Sends a request, and gives its id.
    pub(crate) fn ask(&mut self, method: &str, params: &Value) -> i64 {
        let id = self.next_id;
        self.next_id += 1;
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}));
        id
    }

    /// The result of a request, or its error.
    pub(crate) fn answer(&mut self, id: i64) -> Result<Value, Value> {
        let mut answer = self.wait(|message| message["id"] == id && message.get("method").is_none());
        match answer.get_mut("error") {
            Some(error) => Err(error.take()),
            None => Ok(answer["result"].take()),
        }
    }

    pub(crate) fn request(&mut self, method: &str, params: &Value) -> Result<Value, Value> {
        let id = self.ask(method, params);
        self.answer(id)
    }

    /// The next message that is looked for; others are kept.
    pub(crate) fn wait(&mut self, is_it: impl Fn(&Value) -> bool) -> Value {
        if let Some(at) = self.kept.iter().position(&is_it) {
            return self.kept.remove(at).unwrap();
        }
        loop {
            let message = self.output.recv_timeout(PATIENCE).expect("the server answers");
            if is_it(&message) {
                return message;
            }
            self.kept.push_back(message);
        }
    }

    /// How many of some messages came before the answer to the next request, and were not waited for.
    pub(crate) fn count(&mut self, is_it: impl Fn(&Value) -> bool) -> usize {
        let _ = self.request("there is no such method", &Value::Null);
        self.kept.iter().filter(|message| is_it(message)).count()
    }

    pub(crate) fn uri(&self, name: &str) -> String {
        self.directory.uri(name)
    }

    pub(crate) fn open(&mut self, name: &str, text: &str) {
        let document = json!({"uri": self.uri(name), "languageId": "yaml", "version": 1, "text": text});
        self.notify("textDocument/didOpen", &json!({"textDocument": document}));
    }

    /// Gives a document a new text as a whole.
    pub(crate) fn replace(&mut self, name: &str, version: i64, text: &str) {
        self.change(name, version, &json!([{"text": text}]));
    }

    pub(crate) fn change(&mut self, name: &str, version: i64, changes: &Value) {
        let document = json!({"uri": self.uri(name), "version": version});
        self.notify("textDocument/didChange", &json!({"textDocument": document, "contentChanges": changes}));
    }

    pub(crate) fn close(&mut self, name: &str) {
        let uri = self.uri(name);
        self.notify("textDocument/didClose", &json!({"textDocument": {"uri": uri}}));
    }

    /// What is said about a version of an open document.
    pub(crate) fn diagnostics(&mut self, name: &str, version: i64) -> Vec<Value> {
        let uri = self.uri(name);
        self.published(&uri, &Value::from(version))
    }

    /// What is said about a document that is not open.
    pub(crate) fn diagnostics_of_file(&mut self, name: &str) -> Vec<Value> {
        let uri = self.uri(name);
        self.published(&uri, &Value::Null)
    }

    fn published(&mut self, uri: &str, version: &Value) -> Vec<Value> {
        let mut message = self.wait(|message| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri
                && message["params"]["version"] == *version
        });
        let Value::Array(diagnostics) = message["params"]["diagnostics"].take() else {
            panic!("no list: {message}")
        };
        diagnostics
    }

    /// A request about a document, at a place in it.
    pub(crate) fn request_at(&mut self, method: &str, name: &str, (line, character): (u32, u32)) -> Value {
        let params = json!({
            "textDocument": {"uri": self.uri(name)},
            "position": {"line": line, "character": character},
        });
        self.request(method, &params).unwrap()
    }

    /// A request about a document.
    pub(crate) fn request_about(&mut self, method: &str, name: &str) -> Value {
        let params = json!({"textDocument": {"uri": self.uri(name)}});
        self.request(method, &params).unwrap()
    }

    /// Leaves as a client should.
    pub(crate) fn leave(mut self) -> i32 {
        assert_eq!(self.request("shutdown", &Value::Null), Ok(Value::Null));
        self.notify("exit", &Value::Null);
        self.ended()
    }

    /// Closes the line; the exit code of the server.
    pub(crate) fn hang_up(mut self) -> i32 {
        self.input = None;
        self.ended()
    }

    /// The exit code of a server that ends.
    pub(crate) fn ended(&mut self) -> i32 {
        self.child.wait().unwrap().code().unwrap()
    }

    /// The memory of the server that is in use, in kB.
    #[cfg(target_os = "linux")]
    pub(crate) fn resident(&self) -> u64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.child.id())).unwrap();
        let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
        line.split_whitespace().nth(1).unwrap().parse().unwrap()
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
