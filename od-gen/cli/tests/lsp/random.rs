//! Whatever is typed, and whatever is asked meanwhile, the server goes on.

use serde_json::{Value, json};

use crate::LAMP;
use crate::client::Client;
use crate::names::HEATER;

/// Texts that are typed into.
const SESSIONS: u64 = 24;
/// Edits of each.
const EDITS: i64 = 12;
/// What is typed.
const TYPED: [&str; 24] = [
    "", "", "", "{", "}", "[", "]", ": ", "\n", "\n  ", "°", "🌀", "\t", "'", "\"", "#", "- ", "&a ", "*a",
    "!x ", "\r\n", "\u{202e}", "\0", "--- ",
];
const METHODS: [&str; 12] = [
    "codeAction",
    "completion",
    "definition",
    "documentHighlight",
    "documentSymbol",
    "foldingRange",
    "formatting",
    "hover",
    "inlayHint",
    "prepareRename",
    "rangeFormatting",
    "references",
];

/// Numbers that are the same in every run (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % end
    }
}

#[test]
fn whatever_is_typed_and_asked_the_server_goes_on() {
    let mut client = Client::new("random");
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let eds = "[FileInfo]\nFileName=a.eds\n\n[1000]\nParameterName=Device type\nObjectType=7\nDataType=7\nAccessType=ro\n";
    let mut answers = 0;
    for session in 0..SESSIONS {
        let (name, text) = match session % 4 {
            0 => (format!("{session}.eds"), eds),
            1 => (format!("{session}.od.yaml"), LAMP),
            _ => (format!("{session}.od.yaml"), HEATER),
        };
        client.open(&name, text);
        let lines = u64::try_from(text.lines().count()).unwrap() + 2;
        for version in 2..EDITS + 2 {
            let (line, character) = (random.below(lines), random.below(60));
            let (end_line, end) =
                (line + random.below(4) / 3, character + random.below(5) / 4 * random.below(9));
            let range = json!({"start": {"line": line, "character": character}, "end": {"line": end_line, "character": end}});
            let typed = TYPED[usize::try_from(random.below(24)).unwrap()];
            client.change(&name, version, &json!([{"range": range, "text": typed}]));
            for _ in 0..4 {
                let method = METHODS[usize::try_from(random.below(12)).unwrap()];
                let params = json!({
                    "textDocument": {"uri": client.uri(&name)},
                    "position": {"line": line + random.below(3), "character": random.below(80)},
                    "range": {"start": {"line": line.saturating_sub(3), "character": 0}, "end": {"line": line + 9, "character": 3}},
                    "context": {"diagnostics": [], "includeDeclaration": true, "triggerKind": 1},
                    "options": {"tabSize": 2, "insertSpaces": true},
                });
                match client.request(&format!("textDocument/{method}"), &params) {
                    Ok(_) => answers += 1,
                    // What cannot be renamed is refused with the reason.
                    Err(error) => assert_eq!(error["code"], -32803, "{method}: {error}"),
                }
            }
        }
        client.diagnostics(&name, EDITS + 1);
        client.close(&name);
    }
    assert!(answers > 800, "{answers}");
    assert_eq!(client.request("workspace/symbol", &json!({"query": "lamp"})), Ok(Value::Array(Vec::new())));
    assert_eq!(client.leave(), 0);
}
