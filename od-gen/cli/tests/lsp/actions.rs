//! Quick fixes: what is offered, and that it does what it says.

use serde_json::{Value, json};

use crate::LAMP;
use crate::client::Client;

/// The actions in a line.
fn actions(client: &mut Client, name: &str, line: u32) -> Vec<Value> {
    let params = json!({
        "textDocument": {"uri": client.uri(name)},
        "range": {"start": {"line": line, "character": 0}, "end": {"line": line, "character": 500}},
        "context": {"diagnostics": []},
    });
    client.request("textDocument/codeAction", &params).unwrap().as_array().unwrap().clone()
}

/// The one edit of an action.
fn edits(client: &Client, action: &Value, name: &str) -> Value {
    let changes = action["edit"]["changes"].as_object().unwrap();
    assert_eq!(changes.len(), 1);
    changes[&client.uri(name)].clone()
}

#[test]
fn helps_with_a_definite_word_are_quick_fixes() {
    let mut client = Client::new("actions");
    let cases = [
        ("{name: brightness, type", "{nmae: brightness, type", "Change `nmae` to `name`"),
        ("type: integer8", "type: int8", "Change `int8` to `integer8`"),
        ("unit: celsius", "unit: celsus", "Change `celsus` to `celsius`"),
        ("access: ro}", "access: r0}", "Change `r0` to `ro`"),
        ("  0x2001:", "  2001:", "Change `2001` to `0x2001`"),
        ("map: [brightness]", "map: [brigthness]", "Change `brigthness` to `brightness`"),
        (
            "features: [heartbeat producer]",
            "features: [hartbeat producer]",
            "Change `hartbeat producer` to `heartbeat producer`",
        ),
        ("{name: temperature °,", "{name: !str temperature °,", "Remove `!str`"),
        ("access: ro}", "access:ro}", "Change `access:ro` to `access: ro`"),
    ];
    client.open("lamp.od.yaml", LAMP);
    let mut version = 1;
    for (right, wrong, title) in cases {
        let text = LAMP.replacen(right, wrong, 1);
        let line = u32::try_from(text[..text.find(wrong).unwrap()].matches('\n').count()).unwrap();
        version += 1;
        client.replace("lamp.od.yaml", version, &text);
        assert!(!client.diagnostics("lamp.od.yaml", version).is_empty(), "{wrong}");
        let offered = actions(&mut client, "lamp.od.yaml", line);
        let action = offered.iter().find(|one| one["title"] == title);
        let action = action.unwrap_or_else(|| panic!("{wrong}: {offered:?}"));
        assert_eq!(action["kind"], "quickfix");
        assert!(action["diagnostics"][0]["code"].is_string());
        // The editor does what is offered.
        version += 1;
        let mut changes = edits(&client, action, "lamp.od.yaml");
        for change in changes.as_array_mut().unwrap() {
            change["text"] = change["newText"].take();
        }
        client.change("lamp.od.yaml", version, &changes);
        assert_eq!(client.diagnostics("lamp.od.yaml", version), [Value::Null; 0], "{wrong}");
    }
    // Elsewhere nothing is offered.
    assert_eq!(actions(&mut client, "lamp.od.yaml", 0), [Value::Null; 0]);
    assert_eq!(client.leave(), 0);
}

#[test]
fn what_needs_no_decision_in_an_eds_is_put_right_at_once() {
    let mut client = Client::new("fix-all");
    let eds = "# nothing to say\r\n[comments]\r\nLines = 1\r\n";
    client.open("a.eds", eds);
    client.diagnostics("a.eds", 1);
    let offered = actions(&mut client, "a.eds", 0);
    let all = offered.iter().find(|one| one["kind"] == "source.fixAll").unwrap();
    let mut changes = edits(&client, all, "a.eds");
    // From the end, as each change has its place in the text as it is.
    let list = changes.as_array_mut().unwrap();
    list.reverse();
    for change in list {
        change["text"] = change["newText"].take();
    }
    client.change("a.eds", 2, &changes);
    client.diagnostics("a.eds", 2);
    let left = actions(&mut client, "a.eds", 0);
    assert!(!left.iter().any(|one| one["kind"] == "source.fixAll"), "{left:?}");
    // Only what is wanted.
    let params = json!({
        "textDocument": {"uri": client.uri("a.eds")},
        "range": {"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}},
        "context": {"diagnostics": [], "only": ["refactor"]},
    });
    assert_eq!(client.request("textDocument/codeAction", &params).unwrap(), json!([]));
    assert_eq!(client.leave(), 0);
}

/// Whatever the drive says otherwise than its library can be left to the library, one by one.
#[test]
fn what_departs_from_a_library_can_be_left_to_it() {
    const DRIVE: &str = include_str!("../../../../od-spec/devices/fullmo-drive.od.yaml");
    let mut client = Client::new("departures");
    let parts = ["document", "errata"].map(|part| format!("fullmo-drive.{part}.od.yaml"));
    for part in &parts {
        let path = format!("{}/../../od-spec/devices/{part}", env!("CARGO_MANIFEST_DIR"));
        client.directory.write(part, &std::fs::read_to_string(path).unwrap());
    }
    client.open("fullmo-drive.od.yaml", DRIVE);
    let said = client.diagnostics("fullmo-drive.od.yaml", 1);
    let departing: Vec<&Value> = said.iter().filter(|one| one["code"] == "OD0811").collect();
    assert!(departing.len() > 15, "{said:?}");
    let (mut version, mut done) = (1, 0);
    for one in departing.iter().step_by(4) {
        let line = u32::try_from(one["range"]["start"]["line"].as_u64().unwrap()).unwrap();
        for action in actions(&mut client, "fullmo-drive.od.yaml", line) {
            let title = action["title"].as_str().unwrap();
            let Some(fact) = title.strip_prefix("Leave to cia402: ") else { continue };
            let mut changes = edits(&client, &action, "fullmo-drive.od.yaml");
            changes[0]["text"] = changes[0]["newText"].take();
            version += 1;
            client.change("fullmo-drive.od.yaml", version, &changes);
            let again = client.diagnostics("fullmo-drive.od.yaml", version);
            assert!(again.iter().all(|one| one["code"] != "OD0104"), "{title}: {again:?}");
            // The object says the same as its library, or the compiler reports what is missing.
            let is_right = again.iter().all(|one| one["severity"] != 1);
            let still = again.iter().any(|now| {
                let (now, then) = (now["message"].as_str().unwrap(), one["message"].as_str().unwrap());
                let departs =
                    |text: &str| text.split_once(" departs from ").map(|(object, _)| object.to_owned());
                departs(now) == departs(then)
                    && now.split_once(": ").is_some_and(|(_, facts)| facts.contains(fact))
            });
            assert!(!is_right || !still, "{title}: {again:?}");
            done += usize::from(is_right);
            version += 1;
            client.replace("fullmo-drive.od.yaml", version, DRIVE);
            client.diagnostics("fullmo-drive.od.yaml", version);
        }
    }
    assert!(done > 3, "{done}");
    assert_eq!(client.leave(), 0);
}
