//! Parameter files and plants: the names of their specifications.

use serde_json::{Value, json};

use crate::client::Client;
use crate::names::marked;

const VALVE: &str = include_str!("../../../../tests/editors/files/valve.od.yaml");
const NODE: &str = include_str!("../../../../tests/editors/files/node5.yaml");
const PLANT: &str = include_str!("../../../../tests/editors/files/press.yaml");

fn client(name: &str) -> Client {
    let client = Client::new(name);
    client.directory.write("valve.od.yaml", VALVE);
    client.directory.write("node5.yaml", NODE);
    client.directory.write("press.yaml", PLANT);
    client
}

/// The lines of messages.
fn lines(said: &[Value]) -> Vec<u64> {
    said.iter().map(|one| one["range"]["start"]["line"].as_u64().unwrap()).collect()
}

/// The labels offered at the mark, which is put into the text.
fn offered(client: &mut Client, name: &str, right: &str, from: &str, to: &str) -> Vec<String> {
    assert!(right.contains(from), "{from}");
    client.open(name, right);
    // An answer about it: it was read.
    client.request_about("textDocument/documentSymbol", name);
    let (text, position) = marked(&right.replacen(from, to, 1));
    client.replace(name, 2, &text);
    let answer = client.request_at("textDocument/completion", name, position);
    client.close(name);
    let items = answer["items"].as_array().unwrap();
    items.iter().map(|item| item["label"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn a_parameter_file_is_checked_with_its_specification() {
    let mut client = client("parameters");
    client.open("node5.yaml", NODE);
    assert_eq!(client.diagnostics("node5.yaml", 1), Vec::<Value>::new());
    client.replace("node5.yaml", 2, &NODE.replace("6.0 bar", "60.0 bar"));
    let said = client.diagnostics("node5.yaml", 2);
    assert_eq!(lines(&said), [7], "{said:?}");
    // A name that is nearly right has a quick fix, as in a specification.
    client.replace("node5.yaml", 3, &NODE.replace("set pressure", "set pressur"));
    assert_eq!(client.diagnostics("node5.yaml", 3).len(), 1);
    let params = json!({
        "textDocument": {"uri": client.uri("node5.yaml")},
        "range": {"start": {"line": 7, "character": 3}, "end": {"line": 7, "character": 3}},
        "context": {"diagnostics": []},
    });
    let actions = client.request("textDocument/codeAction", &params).unwrap();
    assert_eq!(actions[0]["title"], "Change `set pressur` to `set pressure`");
    // A change of the specification is seen at once.
    client.replace("node5.yaml", 4, NODE);
    assert_eq!(client.diagnostics("node5.yaml", 4), Vec::<Value>::new());
    client.open("valve.od.yaml", &VALVE.replace("max: 16.0 bar", "max: 5.0 bar"));
    assert_eq!(client.diagnostics("node5.yaml", 4).len(), 1);
    client.replace("node5.yaml", 5, &NODE.replace("spec: valve.od.yaml", "spec: none.od.yaml"));
    let said = client.diagnostics("node5.yaml", 5);
    assert!(said[0]["message"].as_str().unwrap().starts_with("cannot read `none.od.yaml`"), "{said:?}");
}

#[test]
fn parameter_files_and_plants_offer_what_can_be_set() {
    let mut client = client("settings");
    let keys = offered(&mut client, "node5.yaml", NODE, "  set pressure: 6.0 bar", "  ‸");
    assert!(keys.contains(&"set pressure".to_owned()) && keys.contains(&"delay".to_owned()), "{keys:?}");
    assert!(!keys.contains(&"actual pressure".to_owned()), "{keys:?}");
    let units = offered(&mut client, "node5.yaml", NODE, "6.0 bar", "6.0 ‸");
    assert_eq!(units, ["6.0 bar"]);
    let top = offered(&mut client, "node5.yaml", NODE, "bit-rate: 500", "b‸");
    assert!(top.contains(&"bit-rate".to_owned()) && !top.contains(&"node".to_owned()), "{top:?}");
    let device = offered(&mut client, "node5.yaml", NODE, "device: valve", "device: ‸");
    assert_eq!(device, ["valve"]);
    let in_plant = offered(&mut client, "press.yaml", PLANT, "{set pressure: 5.8 bar}", "{‸}");
    assert!(in_plant.contains(&"set pressure".to_owned()), "{in_plant:?}");
    let devices = offered(&mut client, "press.yaml", PLANT, "left: {valve: 1}", "left: {‸}");
    assert_eq!(devices, ["valve"]);
    let types = offered(&mut client, "press.yaml", PLANT, "type: press", "type: ‸");
    assert_eq!(types, ["press"]);
    let positions = offered(
        &mut client,
        "press.yaml",
        PLANT,
        "          right: {valve: {parameters",
        "          ‸: {valve: {parameters",
    );
    assert_eq!(positions, ["left", "right"]);
}

#[test]
fn parameter_files_and_plants_lead_to_the_specification() {
    let mut client = client("leads");
    for (name, text, needle) in
        [("node5.yaml", NODE, "set pressure: 6.0"), ("press.yaml", PLANT, "set pressure: 5.8")]
    {
        client.open(name, text);
        let at = text.find(needle).unwrap() + 2;
        let line = u32::try_from(text[..at].matches('\n').count()).unwrap();
        let character = u32::try_from(at - text[..at].rfind('\n').unwrap() - 1).unwrap();
        let hover = client.request_at("textDocument/hover", name, (line, character));
        let said = hover["contents"]["value"].as_str().unwrap();
        assert!(said.starts_with("`2000h` **set pressure**"), "{said}");
        let places = client.request_at("textDocument/definition", name, (line, character));
        assert_eq!(places[0]["uri"], client.uri("valve.od.yaml"));
        assert_eq!(places[0]["range"]["start"]["line"], 10, "{places}");
    }
    // The file itself.
    let places = client.request_at("textDocument/definition", "node5.yaml", (2, 8));
    assert_eq!(places[0]["uri"], client.uri("valve.od.yaml"));
}

#[test]
fn a_rename_reaches_parameter_files_and_plants_or_is_refused() {
    let mut client = client("rename-nodes");
    client.open("valve.od.yaml", VALVE);
    let position = |needle: &str| {
        let at = VALVE.find(needle).unwrap();
        let line = VALVE[..at].matches('\n').count();
        json!({"line": line, "character": at - VALVE[..at].rfind('\n').unwrap()})
    };
    let mut rename = |needle: &str, name: &str| {
        let document = json!({"uri": client.uri("valve.od.yaml")});
        let params = json!({"textDocument": document, "position": position(needle), "newName": name});
        (client.request("textDocument/rename", &params), client.uri("node5.yaml"), client.uri("press.yaml"))
    };
    let (answer, node, plant) = rename("set pressure, type", "target pressure");
    let changes = answer.unwrap()["changes"].clone();
    // Files that are not open, too.
    assert_eq!(changes[&node].as_array().unwrap().len(), 1, "{changes}");
    assert_eq!(changes[&node][0]["newText"], "target pressure");
    assert_eq!(changes[&plant].as_array().unwrap().len(), 2, "{changes}");
    let (answer, ..) = rename("valve: {name", "tap");
    let changes = answer.unwrap()["changes"].clone();
    assert_eq!(changes[&node][0]["newText"], "tap", "{changes}");
    // A name that is understood, and not the same, would be lost.
    client.directory.write("odd.yaml", &NODE.replace("set pressure", "Set Pressure"));
    let document = json!({"uri": client.uri("valve.od.yaml")});
    let place = position("set pressure, type");
    let params = json!({"textDocument": document, "position": place, "newName": "target pressure"});
    let refused = client.request("textDocument/rename", &params).unwrap_err()["message"].to_string();
    assert!(refused.contains("odd.yaml"), "{refused}");
    // In the parameter file, a name of the specification stays.
    client.open("node5.yaml", NODE);
    let params =
        json!({"textDocument": {"uri": client.uri("node5.yaml")}, "position": {"line": 7, "character": 4}});
    let refused = client.request("textDocument/prepareRename", &params).unwrap_err();
    assert!(refused["message"].as_str().unwrap().contains("rename it there"), "{refused}");
}

/// Errors hide what a parameter file or a plant refers to: a rename would leave the old name in it.
#[test]
fn a_rename_is_refused_while_references_are_unknown() {
    let mut client = client("rename-unknown");
    let broken = VALVE.replace("unit: minute", "unit: minut");
    client.open("valve.od.yaml", &broken);
    let line = VALVE.lines().position(|line| line.contains("name: set pressure")).unwrap();
    let rename = |client: &mut Client| {
        let document = json!({"uri": client.uri("valve.od.yaml")});
        let place = json!({"line": line, "character": 20});
        let params = json!({"textDocument": document, "position": place, "newName": "target pressure"});
        client.request("textDocument/rename", &params)
    };
    let refused = rename(&mut client).unwrap_err()["message"].to_string();
    assert!(refused.contains("node5.yaml first; until then"), "{refused}");
    // The plant alone.
    client.directory.write("node5.yaml", "od-parameters: 1\n");
    let refused = rename(&mut client).unwrap_err()["message"].to_string();
    assert!(refused.contains("press.yaml first; until then"), "{refused}");
    // A plant that is not valid YAML.
    client.replace("valve.od.yaml", 2, VALVE);
    client.directory.write("press.yaml", &PLANT.replace("{valve: 2}", "{valve: 2"));
    let refused = rename(&mut client).unwrap_err()["message"].to_string();
    assert!(refused.contains("press.yaml first; until then"), "{refused}");
    // Another one is of no interest.
    client.directory.write("press.yaml", "od-plant: 1\ndevices: {valve: other.od.yaml\n");
    assert!(rename(&mut client).is_ok());
}
