//! What a document is made of: symbols, folding.

use serde_json::{Value, json};

use crate::client::Client;
use crate::{LAMP, PITCH};

/// The names of symbols, each with its depth.
fn outline(symbols: &Value) -> Vec<String> {
    fn walk(symbols: &Value, depth: usize, lines: &mut Vec<String>) {
        for symbol in symbols.as_array().into_iter().flatten() {
            lines.push(format!("{}{}", "  ".repeat(depth), symbol["name"].as_str().unwrap()));
            let (range, selection) = (&symbol["range"], &symbol["selectionRange"]);
            let at = |position: &Value| {
                (position["line"].as_u64().unwrap(), position["character"].as_u64().unwrap())
            };
            assert!(at(&range["start"]) <= at(&selection["start"]), "{symbol}");
            assert!(at(&selection["end"]) <= at(&range["end"]), "{symbol}");
            walk(&symbol["children"], depth + 1, lines);
        }
    }
    let mut lines = Vec::new();
    walk(symbols, 0, &mut lines);
    lines
}

const LAMP_OUTLINE: [&str; 11] = [
    "uses",
    "devices",
    "  lamp",
    "units",
    "  celsius",
    "objects",
    "  0x2000 brightness",
    "  0x2001 temperature °",
    "pdos",
    "  lamp",
    "    RPDO1",
];

#[test]
fn a_specification_is_a_tree_of_what_it_defines() {
    let mut client = Client::new("symbols");
    client.open("lamp.od.yaml", LAMP);
    let symbols = client.request_about("textDocument/documentSymbol", "lamp.od.yaml");
    assert_eq!(outline(&symbols), LAMP_OUTLINE);
    // The wide characters before and in a name count as the protocol counts them.
    let temperature = &symbols[3]["children"][1];
    assert_eq!(temperature["selectionRange"]["start"], json!({"line": 9, "character": 2}));
    assert_eq!(temperature["range"]["end"], json!({"line": 9, "character": 74}));
    assert_eq!(client.leave(), 0);
}

#[test]
fn a_text_that_is_broken_in_the_middle_keeps_its_tree() {
    let mut client = Client::new("broken");
    client.open("lamp.od.yaml", LAMP);
    client.diagnostics("lamp.od.yaml", 1);
    let broken = LAMP.replace("max: 100}", "max: [100\n  }");
    client.replace("lamp.od.yaml", 2, &broken);
    let said = client.diagnostics("lamp.od.yaml", 2);
    assert!(said[0]["message"].as_str().unwrap().starts_with("this is not YAML"), "{said:?}");
    let symbols = client.request_about("textDocument/documentSymbol", "lamp.od.yaml");
    assert_eq!(outline(&symbols), LAMP_OUTLINE);
    let pdos = &symbols[4]["selectionRange"]["start"];
    assert_eq!(*pdos, json!({"line": 11, "character": 0}), "what follows has moved");
    assert_eq!(client.leave(), 0);
}

#[test]
fn sections_of_an_eds_are_symbols_and_fold() {
    let eds = "[FileInfo]\r\nFileName=a.eds\r\n\r\n[1000]\r\nParameterName=Device type\r\n\r\n[1018]\r\nParameterName=Identity\r\n\r\n[1018sub1]\r\nParameterName=Vendor\r\n";
    let mut client = Client::new("eds-symbols");
    client.open("a.eds", eds);
    let symbols = client.request_about("textDocument/documentSymbol", "a.eds");
    assert_eq!(outline(&symbols), ["FileInfo", "1000", "1018", "  1018sub1"]);
    assert_eq!(symbols[1]["detail"], "Device type");
    let folds = client.request_about("textDocument/foldingRange", "a.eds");
    let lines: Vec<(u64, u64)> = folds
        .as_array()
        .unwrap()
        .iter()
        .map(|fold| (fold["startLine"].as_u64().unwrap(), fold["endLine"].as_u64().unwrap()))
        .collect();
    assert_eq!(lines, [(0, 1), (3, 4), (6, 7), (9, 10)]);
    assert_eq!(client.leave(), 0);
}

#[test]
fn types_of_a_plant_are_no_enums() {
    let mut client = Client::new("plant-symbols");
    client.open("house.yaml", "od-plant: 1\ntitle: House\ndevices: {lamp: lamp.od.yaml}\ntypes:\n  hall: {bit-rate: 125}\nsites:\n  north: {title: North, machines: {}}\n");
    let symbols = client.request_about("textDocument/documentSymbol", "house.yaml");
    assert_eq!(outline(&symbols), ["devices", "  lamp", "types", "  hall", "sites", "  north"]);
    let kind = |at: usize| symbols[at]["children"][0]["kind"].as_u64();
    assert_eq!((kind(0), kind(1)), (Some(2), Some(7)), "a module and a property");
    assert_eq!(symbols[0]["children"][0]["detail"], "lamp.od.yaml");
    assert_eq!(client.leave(), 0);
}

#[test]
fn everything_that_is_open_is_found_by_number_and_name() {
    let mut client = Client::new("workspace");
    client.open("lamp.od.yaml", LAMP);
    client.open("pitch.od.yaml", &PITCH.replace("parts: [", "# parts: ["));
    let mut names = |query: &str| -> Vec<String> {
        let found = client.request("workspace/symbol", &json!({"query": query})).unwrap();
        let name = |symbol: &Value| symbol["name"].as_str().unwrap().to_owned();
        found.as_array().unwrap().iter().map(name).collect()
    };
    for number in ["6041", "0x6041", "6041h"] {
        assert_eq!(names(number), ["0x6041 Statusword"], "{number}");
    }
    assert_eq!(names("brightness"), ["0x2000 brightness"]);
    assert!(names("celsius").contains(&"decicelsius".to_owned()));
    assert_eq!(names("no such name"), [""; 0]);
    assert_eq!(client.leave(), 0);
}
