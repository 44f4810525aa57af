//! The protocol itself: how a session begins, goes on and ends, whatever a client says.

use std::io::{BufReader, Read as _, Write as _};
use std::process::Stdio;

use serde_json::{Value, json};

use crate::client::{Client, Directory, command, frame, read, spawn};
use crate::{LAMP, short};

fn code(error: &Result<Value, Value>) -> i64 {
    error.as_ref().unwrap_err()["code"].as_i64().unwrap()
}

#[test]
fn a_session_begins_and_ends() {
    let (mut client, answer) = Client::with("session", &json!({}));
    assert_eq!(answer["serverInfo"]["name"], "odgen");
    assert_eq!(answer["capabilities"]["positionEncoding"], "utf-16");
    assert_eq!(answer["capabilities"]["textDocumentSync"]["change"], 2);
    client.open("lamp.od.yaml", LAMP);
    assert_eq!(client.diagnostics("lamp.od.yaml", 1), [Value::Null; 0]);
    assert_eq!(client.leave(), 0);
}

#[test]
fn requests_at_the_wrong_time_are_errors_and_nothing_else_happens() {
    let mut client = Client::silent("phases");
    client.notify("initialized", &json!({}));
    assert_eq!(code(&client.request("textDocument/hover", &json!({}))), -32002);
    assert_eq!(code(&client.request("initialize", &json!({"capabilities": 5}))), -32602);
    assert!(client.request("initialize", &json!({"capabilities": {}})).is_ok());
    assert_eq!(code(&client.request("initialize", &json!({"capabilities": {}}))), -32600);
    assert!(client.request("shutdown", &Value::Null).is_ok());
    assert_eq!(code(&client.request("shutdown", &Value::Null)), -32600);
    client.notify("exit", &Value::Null);
    assert_eq!(client.ended(), 0);
}

/// Of something that is no message, the length is named, and the end does not wait for more.
#[test]
fn a_length_that_is_none_ends_the_session_with_a_message() {
    for (header, found) in [
        ("Content-Length: -5", "-5"),
        ("Content-Length: many", "many"),
        ("Content-Length: 18446744073709551615", "18446744073709551615"),
        ("Content-Length: 99999999999999999999", "99999999999999999999"),
        ("Content-Type: x", "without a length"),
    ] {
        let directory = Directory::new("no-length");
        let mut server = command(&directory).stderr(Stdio::piped()).spawn().unwrap();
        // The input stays open.
        let mut input = server.stdin.take().unwrap();
        input.write_all(format!("{header}\r\n\r\n{{}}").as_bytes()).unwrap();
        input.flush().unwrap();
        let mut said = String::new();
        server.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert_eq!(server.wait().unwrap().code(), Some(1), "{header}");
        assert!(said.contains("OD0101") && said.contains(found), "{header}: {said}");
    }
}

#[test]
fn leaving_without_a_word_is_told_by_the_exit_code() {
    assert_eq!(Client::new("hang-up").hang_up(), 1);
    let mut client = Client::new("exit");
    client.notify("exit", &Value::Null);
    assert_eq!(client.ended(), 1);
    let mut client = Client::silent("exit-first");
    client.notify("exit", &Value::Null);
    assert_eq!(client.ended(), 1);
    // The line goes dead after `shutdown`.
    let mut client = Client::new("shutdown-only");
    assert!(client.request("shutdown", &Value::Null).is_ok());
    assert_eq!(client.hang_up(), 0);
}

#[test]
fn unknown_methods_and_bad_parameters_are_errors() {
    let mut client = Client::new("errors");
    assert_eq!(code(&client.request("textDocument/fly", &json!({}))), -32601);
    assert_eq!(code(&client.request("textDocument/foldingRange", &json!({"textDocument": 1}))), -32602);
    assert_eq!(code(&client.request("textDocument/foldingRange", &Value::Null)), -32602);
    // A document that is not open.
    let params = json!({"textDocument": {"uri": "file:///nowhere.od.yaml"}});
    let error = client.request("textDocument/documentSymbol", &params);
    assert_eq!(code(&error), -32602);
    assert_eq!(error.unwrap_err()["message"], "`file:///nowhere.od.yaml` is not open");
    // There is no answer to a notification; what is wrong with it is found in the log.
    for (method, params) in [
        ("textDocument/didOpen", json!({"textDocument": {}})),
        ("textDocument/didChange", json!([1])),
        (
            "textDocument/didChange",
            json!({"textDocument": {"uri": "file:///x", "version": 1}, "contentChanges": []}),
        ),
        ("textDocument/didClose", json!("x")),
        ("textDocument/didSave", Value::Null),
        ("workspace/didChangeWatchedFiles", json!({})),
    ] {
        client.notify(method, &params);
        let log = client.wait(|message| message["method"] == "window/logMessage");
        assert_eq!(log["params"]["type"], 1, "{log}");
    }
    client.notify("$/setTrace", &json!({"value": "off"}));
    client.notify("unknown/method", &json!({}));
    assert_eq!(client.leave(), 0);
}

#[test]
fn what_is_no_message_is_refused_and_what_follows_is_read() {
    let mut client = Client::new("refused");
    client.send(&json!([]));
    let refused = client.wait(|message| message["error"]["code"] == -32600);
    assert_eq!(refused["id"], Value::Null);
    client.send(&json!({"jsonrpc": "2.0", "id": 1.5, "method": "shutdown"}));
    let refused = client.wait(|message| message["error"]["code"] == -32600);
    assert_eq!(refused["id"], 1.5);
    // An answer that is not waited for.
    client.send(&json!({"jsonrpc": "2.0", "id": 77, "result": null}));
    client.send(&json!({"jsonrpc": "2.0", "id": "a", "method": "fly"}));
    let answer = client.wait(|message| message["id"] == "a");
    assert_eq!(answer["error"]["code"], -32601);
    assert_eq!(client.leave(), 0);
}

#[test]
fn a_request_that_is_cancelled_is_not_answered_otherwise() {
    let mut client = Client::new("cancel");
    client.open("lamp.od.yaml", LAMP);
    let params = json!({"textDocument": {"uri": client.uri("lamp.od.yaml")}});
    // The two go out in one piece, so that the server has both before it looks at the first.
    let request =
        json!({"jsonrpc": "2.0", "id": 900, "method": "textDocument/documentSymbol", "params": params});
    let cancel = json!({"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": 900}});
    client.send_bytes(&[frame(&request), frame(&cancel)].concat());
    match client.answer(900) {
        Err(error) => assert_eq!(error["code"], -32800),
        // It was faster than the client.
        Ok(symbols) => assert!(symbols.is_array()),
    }
    // Cancelling what was answered long ago does nothing.
    client.notify("$/cancelRequest", &json!({"id": 900}));
    client.notify("$/cancelRequest", &json!({"id": {}}));
    assert!(client.request("textDocument/documentSymbol", &params).is_ok());
    assert_eq!(client.leave(), 0);
}

#[test]
fn edits_that_come_faster_than_answers_are_looked_at_once() {
    let mut client = Client::new("fast");
    client.open("lamp.od.yaml", LAMP);
    client.diagnostics("lamp.od.yaml", 1);
    // A name is typed letter by letter, in front of a wide character, and goes away again.
    let mut bytes = Vec::new();
    let uri = client.uri("lamp.od.yaml");
    let last = 401;
    for version in 2..=last {
        let typed = version % 2 == 0;
        let range = json!({"start": {"line": 9, "character": 17}, "end": {"line": 9, "character": if typed { 17 } else { 18 }}});
        let change = json!({"range": range, "text": if typed { "x" } else { "" }});
        let params = json!({"textDocument": {"uri": uri, "version": version}, "contentChanges": [change]});
        bytes.extend(frame(&json!({"jsonrpc": "2.0", "method": "textDocument/didChange", "params": params})));
    }
    let ask = json!({"jsonrpc": "2.0", "id": 901, "method": "textDocument/documentSymbol", "params": {"textDocument": {"uri": uri}}});
    bytes.extend(frame(&ask));
    client.send_bytes(&bytes);
    // The answer is about the newest text, and so is what is said last.
    let symbols = client.answer(901).unwrap().to_string();
    assert!(symbols.contains("0x2001 temperature °"), "{symbols}");
    assert_eq!(client.diagnostics("lamp.od.yaml", last), [Value::Null; 0]);
    let published = client.count(|message| message["method"] == "textDocument/publishDiagnostics");
    assert!(published < 400, "{published} versions were looked at");
    client.replace("lamp.od.yaml", last + 1, &LAMP.replace("unit: celsius", "unit: celsus"));
    let said = client.diagnostics("lamp.od.yaml", last + 1);
    assert!(said.iter().any(|one| short(one) == "OD0608 9:54-9:60"), "{said:?}");
    assert_eq!(client.leave(), 0);
}

/// Whatever a client had said when its line was cut, the server ends by itself and quietly.
#[test]
fn input_may_be_cut_at_every_byte() {
    let directory = Directory::new("cut");
    let initialize =
        json!({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}});
    let document = json!({"uri": directory.uri("a.od.yaml"), "languageId": "yaml", "version": 1, "text": "od-spec: 1\n"});
    let open =
        json!({"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {"textDocument": document}});
    let shutdown = json!({"jsonrpc": "2.0", "id": 2, "method": "shutdown"});
    let all = [frame(&initialize), frame(&open), frame(&shutdown)];
    let before_shutdown = all[0].len() + all[1].len();
    let bytes = all.concat();
    for end in (0..=bytes.len()).rev() {
        let mut child = spawn(&directory);
        child.stdin.take().unwrap().write_all(&bytes[..end]).unwrap();
        let mut output = BufReader::new(child.stdout.take().unwrap());
        // Whole messages come, or none.
        while read(&mut output).is_some() {}
        let code = child.wait().unwrap().code();
        let expected = i32::from(end < bytes.len());
        assert_eq!(code, Some(expected), "cut at {end}, of which {before_shutdown} come before `shutdown`");
    }
}
