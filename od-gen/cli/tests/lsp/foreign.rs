//! EDS and XDD files: completion, where mapping values lead, encodings, outline.

use serde_json::{Value, json};

use crate::client::Client;

const EDS: &str = include_str!("../../../../generated/eds/pmc.eds");
const FULLMO: &str = include_str!("../../../../generated/eds/fullmo.eds");
const XDD: &str = include_str!("../cli/eds/tank.xdd");

/// Line and column of a text after the first place of another.
fn place(text: &str, after: &str, needle: &str) -> (u32, u32) {
    let start = text.find(after).unwrap();
    let at = start + text[start..].find(needle).unwrap();
    let line = text[..at].matches('\n').count();
    let column = at - text[..at].rfind('\n').map_or(0, |at| at + 1);
    (u32::try_from(line).unwrap(), u32::try_from(column).unwrap())
}

fn labels(answer: &Value) -> Vec<&str> {
    let mut items: Vec<&Value> = answer["items"].as_array().unwrap().iter().collect();
    items.sort_by_key(|item| item["sortText"].as_str().unwrap());
    items.iter().map(|item| item["label"].as_str().unwrap()).collect()
}

#[test]
fn an_eds_offers_keys_types_and_access() {
    let mut client = Client::new("eds-completion");
    let text =
        "[DeviceInfo]\r\nVendorName=x\r\n\r\n[2000]\r\nParameterName=a\r\nDataType=\r\nAccessType=\r\n\r\n";
    client.open("a.eds", text);
    let mut ask =
        |line: u32, character: u32| client.request_at("textDocument/completion", "a.eds", (line, character));
    let keys = ask(7, 0);
    let keys = labels(&keys);
    assert!(
        keys.contains(&"DefaultValue") && !keys.contains(&"DataType") && !keys.contains(&"VendorName"),
        "{keys:?}"
    );
    let types = ask(5, 9);
    assert!(labels(&types).contains(&"0x0006"), "{types}");
    // A number says nothing: its name is in each line of the list.
    assert_eq!(types["items"][0]["labelDetails"], json!({"description": "BOOLEAN"}), "{types}");
    assert_eq!(labels(&ask(6, 11)), ["ro", "wo", "rw", "rwr", "rww", "const"]);
    // A section without keys of its own, and a comment.
    assert_eq!(labels(&ask(0, 3)), Vec::<&str>::new());
}

#[test]
fn a_mapping_value_has_a_name_and_leads_to_its_object() {
    let mut client = Client::new("eds-mapping");
    client.open("pmc.eds", EDS);
    client.diagnostics("pmc.eds", 1);
    let (line, column) = place(EDS, "[1A00sub1]", "DefaultValue=");
    let places = client.request_at("textDocument/definition", "pmc.eds", (line, column + 15));
    let target = places[0]["range"]["start"]["line"].as_u64().unwrap();
    let header = EDS.lines().nth(usize::try_from(target).unwrap()).unwrap();
    let value = EDS.lines().nth(line as usize).unwrap().split_once("=0x").unwrap().1.to_lowercase();
    assert!(header.to_lowercase().starts_with(&format!("[{}", &value[..4])), "{header} {value}");
    let range = json!({"start": {"line": line, "character": 0}, "end": {"line": line, "character": 99}});
    let params = json!({"textDocument": {"uri": client.uri("pmc.eds")}, "range": range});
    let hints = client.request("textDocument/inlayHint", &params).unwrap();
    assert!(hints[0]["label"].as_str().is_some_and(|label| label.len() > 3), "{hints}");
}

#[test]
fn the_nearest_key_of_an_eds_is_a_quick_fix() {
    let mut client = Client::new("eds-fix");
    let wrong = EDS.replacen("AccessType=", "AccesType=", 1);
    client.open("pmc.eds", &wrong);
    let (line, column) = place(&wrong, "AccesType", "AccesType");
    let params = json!({
        "textDocument": {"uri": client.uri("pmc.eds")},
        "range": {"start": {"line": line, "character": column}, "end": {"line": line, "character": column}},
        "context": {"diagnostics": [], "only": ["quickfix"]},
    });
    let actions = client.request("textDocument/codeAction", &params).unwrap();
    let titles: Vec<&Value> = actions.as_array().unwrap().iter().map(|action| &action["title"]).collect();
    assert!(titles.iter().any(|title| **title == "Change `AccesType` to `AccessType`"), "{titles:?}");
}

#[test]
fn a_file_that_the_editor_has_read_in_another_encoding_is_reported() {
    let mut client = Client::new("misread");
    let text = EDS.replacen("VendorName=", "VendorName=Müller für große ", 1);
    let bytes: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap_or(b'?')).collect();
    std::fs::write(client.directory.0.join("a.eds"), &bytes).unwrap();
    let is_reported = |said: &[Value]| {
        said.iter().any(|one| one["message"].as_str().unwrap().contains("stored as Windows-1252"))
    };
    // As UTF-8, as code page 850, and as it is.
    let lossy = String::from_utf8_lossy(&bytes).into_owned();
    let other = text.replace('ü', "³").replace('ß', "▀");
    for (shown, expected) in [(&lossy, true), (&other, true), (&text, false)] {
        let name = "a.eds";
        client.open(name, shown);
        assert_eq!(is_reported(&client.diagnostics(name, 1)), expected);
        // Opened again in the right encoding, the message goes.
        client.replace(name, 2, &text);
        assert!(!is_reported(&client.diagnostics(name, 2)));
        client.close(name);
        client.diagnostics_of_file(name);
    }
    // What the editor has saved is what the file has.
    client.open("a.eds", &lossy);
    assert!(is_reported(&client.diagnostics("a.eds", 1)));
    let saved = lossy.replace('\u{FFFD}', "é");
    client.replace("a.eds", 2, &saved);
    assert!(is_reported(&client.diagnostics("a.eds", 2)));
    std::fs::write(client.directory.0.join("a.eds"), &saved).unwrap();
    client.notify("textDocument/didSave", &json!({"textDocument": {"uri": client.uri("a.eds")}}));
    client.replace("a.eds", 3, &saved);
    assert!(!is_reported(&client.diagnostics("a.eds", 3)));
}

#[test]
fn an_xdd_has_an_outline_and_hover() {
    let mut client = Client::new("xdd");
    client.open("tank.xdd", XDD);
    client.diagnostics("tank.xdd", 1);
    let symbols = client.request_about("textDocument/documentSymbol", "tank.xdd");
    let names: Vec<&str> =
        symbols.as_array().unwrap().iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert!(names.iter().any(|name| name.starts_with("1018h")), "{names:?}");
    let at = place(XDD, "<CANopenObject ", "<CANopenObject ");
    let hover = client.request_at("textDocument/hover", "tank.xdd", (at.0, at.1 + 3));
    assert!(hover["contents"]["value"].as_str().is_some_and(|text| text.starts_with('`')), "{hover}");
}

/// A unit that only a comment of an EDS names has no other name.
#[test]
fn the_unit_of_an_eds_is_said_once() {
    let mut client = Client::new("eds-unit");
    client.open("fullmo.eds", FULLMO);
    let line = FULLMO.lines().position(|line| line == "; unit 0.1 %").unwrap() + 1;
    let position = (u32::try_from(line).unwrap(), 2);
    let hover = client.request_at("textDocument/hover", "fullmo.eds", position);
    let text = hover["contents"]["value"].as_str().unwrap();
    assert!(text.lines().any(|line| line == "- unit: 0.1 %"), "{text}");
}
