//! Messages on standard input and output.
//!
//! The frames are read here and not by the library of the protocol: that ends with the first message that is not JSON, and asks
//! for as much memory as a length says.

use std::io::{self, BufRead, Read as _, Write};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};

use lsp_server::{ErrorCode, Message};
use serde_json::{Value, json};

/// Longest message that is read: a document of the largest size, each byte of which is written as an escape.
const LONGEST: u64 = (64 << 20) * 6;
/// Longest line of a header.
const LONGEST_HEADER: u64 = 4096;

/// Why nothing more is read, where that is not the end of the input.
#[derive(Debug, Clone, Default)]
pub(super) struct Broken(Arc<Mutex<Option<io::Error>>>);

impl Broken {
    fn set(&self, error: io::Error) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
    }

    /// The error, if there was one; for the first who asks.
    pub(super) fn take(&self) -> Option<io::Error> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// Standard input and output.
pub(super) struct Stdio {
    /// What the client says.
    pub messages: Receiver<Message>,
    /// What it receives.
    pub answers: Sender<String>,
    /// What was wrong with the input.
    pub broken: Broken,
    /// The thread that writes. The one that reads ends with the process: nothing can wake it.
    pub writer: JoinHandle<io::Result<()>>,
}

/// Reads and writes standard input and output from now on.
pub(super) fn stdio() -> Stdio {
    let broken = Broken::default();
    let noted = broken.clone();
    let ((sender, messages), (answers, receiver)) = (channel(), channel::<String>());
    // Standard output is taken for one message at a time, as both threads write.
    let writer = thread::spawn(move || {
        receiver.into_iter().try_for_each(|text| write(&text, &mut io::stdout().lock()))
    });
    thread::spawn(move || {
        let mut input = io::stdin().lock();
        loop {
            match read(&mut input) {
                Ok(Frame::Message(message)) => {
                    if sender.send(*message).is_err() {
                        break;
                    }
                }
                Ok(Frame::Refused(refusal)) => {
                    if write(&refusal.to_string(), &mut io::stdout().lock()).is_err() {
                        break;
                    }
                }
                Ok(Frame::End) => break,
                // After something that is not a frame, the next one cannot be found.
                Err(error) => {
                    noted.set(error);
                    break;
                }
            }
        }
    });
    Stdio { messages, answers, broken, writer }
}

/// Waits until everything is written.
pub(super) fn finished(writer: JoinHandle<io::Result<()>>) -> io::Result<()> {
    writer.join().unwrap_or_else(|_| Err(io::Error::other("the thread that writes has failed")))
}

/// The content of a frame.
#[derive(Debug)]
enum Frame {
    /// A message.
    Message(Box<Message>),
    /// Something else, with what to say about it.
    Refused(Value),
    /// Nothing more comes.
    End,
}

fn read(input: &mut impl BufRead) -> io::Result<Frame> {
    let Some(length) = length(input)? else { return Ok(Frame::End) };
    if length > LONGEST {
        return Err(no_frame("a length", &length));
    }
    let mut bytes = Vec::new();
    if input.take(length).read_to_end(&mut bytes)? as u64 != length {
        return Ok(Frame::End);
    }
    let refused = |code: ErrorCode, id: &Value, message: String| {
        Frame::Refused(
            json!({"jsonrpc": "2.0", "id": id, "error": {"code": code as i32, "message": message}}),
        )
    };
    let value: Value = match serde_json::from_slice(&bytes) {
        Ok(value) => value,
        Err(error) => {
            return Ok(refused(ErrorCode::ParseError, &Value::Null, format!("this is not JSON: {error}")));
        }
    };
    let id = value.get("id").cloned().unwrap_or_default();
    let is_request = value.get("method").is_some() && !id.is_null();
    Ok(match serde_json::from_value(value) {
        // A request with an impossible number looks like a notification.
        Ok(Message::Notification(_)) if is_request => {
            refused(ErrorCode::InvalidRequest, &id, "expected a number or a text as `id`".to_owned())
        }
        Ok(message) => Frame::Message(Box::new(message)),
        Err(_) => refused(
            ErrorCode::InvalidRequest,
            &id,
            "this is not a request, a response or a notification".to_owned(),
        ),
    })
}

/// The length that the header of a frame states; `None` where the input ends.
fn length(input: &mut impl BufRead) -> io::Result<Option<u64>> {
    let mut length = None;
    loop {
        let mut line = Vec::new();
        input.take(LONGEST_HEADER).read_until(b'\n', &mut line)?;
        let Some(line) = line.strip_suffix(b"\n") else {
            return if line.len() as u64 == LONGEST_HEADER {
                Err(no_frame("a line of", &LONGEST_HEADER))
            } else {
                Ok(None)
            };
        };
        let line = String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(line)).into_owned();
        if line.is_empty() {
            return length.map(Some).ok_or_else(|| no_frame("a header", &"without a length"));
        }
        let Some((name, value)) = line.split_once(':') else { return Err(no_frame("the line", &line)) };
        if name.eq_ignore_ascii_case("Content-Length") {
            length = Some(value.trim().parse().map_err(|_| no_frame("the length", &value))?);
        }
    }
}

fn no_frame(what: &str, found: &dyn std::fmt::Display) -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidData,
        format!("found {what} {found}, expected a header with `Content-Length`"),
    )
}

fn write(text: &str, output: &mut impl Write) -> io::Result<()> {
    write!(output, "Content-Length: {}\r\n\r\n{text}", text.len())?;
    output.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(input: &[u8]) -> Vec<String> {
        let mut input = input;
        let mut found = Vec::new();
        loop {
            found.push(match read(&mut input) {
                Ok(Frame::Message(message)) => match *message {
                    Message::Request(request) => format!("request {}", request.method),
                    Message::Response(response) => format!("response {}", response.id),
                    Message::Notification(notification) => format!("notification {}", notification.method),
                },
                Ok(Frame::Refused(refusal)) => format!("{} for {}", refusal["error"]["code"], refusal["id"]),
                Ok(Frame::End) => return found,
                Err(error) => {
                    found.push(error.to_string());
                    return found;
                }
            });
        }
    }

    fn frame(text: &str) -> String {
        format!("Content-Length: {}\r\n\r\n{text}", text.len())
    }

    #[test]
    fn messages_follow_each_other_and_refused_ones_stop_nothing() {
        let input = [
            frame(r#"{"jsonrpc":"2.0","id":1,"method":"shutdown"}"#),
            frame("{"),
            frame(r#"{"jsonrpc":"2.0","id":5000000000,"method":"shutdown"}"#),
            frame("[]"),
            frame(r#"{"id":7,"result":null}"#),
            "content-type: x\r\ncontent-length:19\n\r\n{\"method\":\"°exit\"}".to_owned(),
        ];
        let found = frames(input.concat().as_bytes());
        let expected = [
            "request shutdown",
            "-32700 for null",
            "-32600 for 5000000000",
            "-32600 for null",
            "response 7",
            "notification °exit",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn input_that_ends_anywhere_ends_quietly() {
        let input = frame(r#"{"method":"exit"}"#);
        for end in 0..input.len() {
            assert_eq!(frames(&input.as_bytes()[..end]), [""; 0], "cut at {end}");
        }
    }

    #[test]
    fn what_is_no_header_is_told_and_nothing_is_asked_of_the_memory() {
        for input in [
            "Content-Length: 18446744073709551615\r\n\r\n",
            "Content-Length: x\r\n\r\n",
            "x\n\n",
            "a: b\r\n\r\n",
        ] {
            let found = frames(input.as_bytes());
            assert!(found.concat().starts_with("found "), "{found:?}");
        }
        assert!(frames("x".repeat(5000).as_bytes()).concat().starts_with("found a line of 4096"));
    }
}
