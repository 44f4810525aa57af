//! Formatting: the layout of `odgen fmt`, in changes that are as small as they can be.

use serde_json::{Value, json};

use crate::LAMP;
use crate::client::Client;

const OPTIONS: &str = "options";

fn formatted(client: &mut Client, name: &str, range: Option<(u32, u32)>) -> Vec<Value> {
    let mut params =
        json!({"textDocument": {"uri": client.uri(name)}, OPTIONS: {"tabSize": 2, "insertSpaces": true}});
    let method = match range {
        Some((first, last)) => {
            params["range"] =
                json!({"start": {"line": first, "character": 0}, "end": {"line": last, "character": 0}});
            "textDocument/rangeFormatting"
        }
        None => "textDocument/formatting",
    };
    client.request(method, &params).unwrap().as_array().unwrap().clone()
}

/// Does what the server says, from the end.
fn apply(client: &mut Client, name: &str, version: i64, edits: &[Value]) {
    let mut changes: Vec<Value> = edits.to_vec();
    changes.reverse();
    for change in &mut changes {
        change["text"] = change["newText"].take();
    }
    client.change(name, version, &json!(changes));
}

#[test]
fn a_document_is_laid_out_in_small_changes() {
    let crooked = LAMP
        .replace("  0x200", "      0x200")
        .replace("access: ro}", "access: ro}      # the ° of the lamp 🌀")
        .replace("pdos:", "\n\n\npdos:");
    for ending in ["\n", "\r\n"] {
        let mut client = Client::new(if ending == "\n" { "fmt" } else { "fmt-crlf" });
        let crooked = crooked.replace('\n', ending);
        client.open("lamp.od.yaml", &crooked);
        let edits = formatted(&mut client, "lamp.od.yaml", None);
        let longest = edits.iter().map(|edit| edit["newText"].as_str().unwrap().len()).max();
        assert!(longest.unwrap() < 5, "{edits:?}");
        apply(&mut client, "lamp.od.yaml", 2, &edits);
        assert_eq!(client.diagnostics("lamp.od.yaml", 2), [Value::Null; 0]);
        assert_eq!(formatted(&mut client, "lamp.od.yaml", None), [Value::Null; 0]);
        // A part of it: what the last edit was about.
        client.replace("lamp.od.yaml", 3, &crooked);
        let last = u32::try_from(crooked.lines().count()).unwrap();
        let of_end = formatted(&mut client, "lamp.od.yaml", Some((10, last)));
        assert!(!of_end.is_empty() && of_end.len() < edits.len(), "{of_end:?}");
        assert!(of_end.iter().all(|edit| edit["range"]["start"]["line"].as_u64() >= Some(9)), "{of_end:?}");
        assert_eq!(client.leave(), 0);
    }
}

#[test]
fn what_cannot_be_laid_out_stays() {
    let mut client = Client::new("fmt-broken");
    client.open("lamp.od.yaml", &LAMP.replace("max: 100}", "max: [100"));
    assert_eq!(formatted(&mut client, "lamp.od.yaml", None), [Value::Null; 0]);
    client.open("a.eds", "[x]\na =  1\n");
    assert_eq!(formatted(&mut client, "a.eds", None), [Value::Null; 0]);
    assert_eq!(client.leave(), 0);
}

/// Lines of a range can be deeper than they should be because of lines before them.
#[test]
fn a_part_is_laid_out_only_if_the_text_says_the_same() {
    let mut client = Client::new("fmt-range");
    let deep = "od-spec: 1\ntitle: x\nunits:\n      volt:\n          symbol: V\n";
    client.open("x.od.yaml", deep);
    assert_eq!(formatted(&mut client, "x.od.yaml", Some((3, 3))).len(), 1);
    assert_eq!(formatted(&mut client, "x.od.yaml", Some((4, 4))), [Value::Null; 0]);
    assert_eq!(client.leave(), 0);
}
