//! What is at a place: hover, definition, references, completion; the place is a `‸` in the text.

use serde_json::{Value, json};

use crate::client::Client;

/// Names with signs that UTF-8 and UTF-16 count differently, an array, a record, a type, a unit and a condition.
pub(crate) const HEATER: &str = "\
od-spec: 1
title: Heater 🌀
languages: [en]
uses: [cia301]
devices:
  heater: {name: Heater, bit-rates: [125], features: [heartbeat producer]}
units:
  tenth °C: {symbol: °C, scale: 1/10, about: \"🌀 of a degree\"}
types:
  mode: {base: unsigned8, values: {0: standby, 1: {name: heating, about: It heats.}}, about: What it does.}
objects:
  0x2000: {name: mode of operation, type: mode, access: rw, pdo: both, default: standby}
  0x2001: {name: temperature °, type: integer16, unit: tenth °C, access: ro, pdo: transmit}
  0x2002:
    name: limits
    record:
      1: {name: lowest, type: integer16, unit: tenth °C, access: rw, default: 10.0 °C, about: Below it heats.}
      2: {name: highest, type: integer16, unit: tenth °C, access: rw, default: 42.5 °C, max: 90.0 °C}
  0x2003: {name: switch, type: unsigned8, access: rw, default: 0, writable-when: \"mode of operation == heating\"}
pdos:
  heater:
    receive: {1: {map: [mode of operation]}}
    transmit: {1: {map: [0x2001, 0x2000]}}
constraints:
  in order: {require: limits.lowest < 0x2002.2, about: \"🌀: low below high\"}
";

/// A text without its mark, and the line and the unit of UTF-16 at which that was.
pub(crate) fn marked(text: &str) -> (String, (u32, u32)) {
    let at = text.find('‸').unwrap_or_else(|| panic!("no mark"));
    let line = text[..at].matches('\n').count();
    let start = text[..at].rfind('\n').map_or(0, |at| at + 1);
    let character = text[start..at].encode_utf16().count();
    let position = (u32::try_from(line).unwrap(), u32::try_from(character).unwrap());
    (text.replacen('‸', "", 1), position)
}

/// The specification with another piece, in which the mark is.
pub(crate) fn heater(from: &str, to: &str) -> (String, (u32, u32)) {
    assert!(HEATER.contains(from), "{from}");
    marked(&HEATER.replacen(from, to, 1))
}

/// The text that a range covers.
pub(crate) fn covered(text: &str, range: &Value) -> String {
    let offset = |position: &Value| {
        let line = usize::try_from(position["line"].as_u64().unwrap()).unwrap();
        let units = usize::try_from(position["character"].as_u64().unwrap()).unwrap();
        let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
        let rest: Vec<u16> = text[start..].encode_utf16().take(units).collect();
        start + String::from_utf16(&rest).unwrap().len()
    };
    text[offset(&range["start"])..offset(&range["end"])].to_owned()
}

/// A session about one text at a time.
struct Session {
    client: Client,
    number: i64,
}

impl Session {
    fn new(name: &str) -> Self {
        Self { client: Client::new(name), number: 0 }
    }

    /// The answer to a request at the mark, and the text.
    fn ask(&mut self, method: &str, from: &str, to: &str) -> (Value, String) {
        let (text, position) = heater(from, to);
        self.number += 1;
        let name = format!("heater{}.od.yaml", self.number);
        // The model of the text that is right comes first, as in an editor.
        self.client.open(&name, HEATER);
        let said = self.client.diagnostics(&name, 1);
        assert!(said.iter().all(|one| one["severity"] != 1), "{said:#?}");
        self.client.replace(&name, 2, &text);
        (self.client.request_at(&format!("textDocument/{method}"), &name, position), text)
    }

    fn hover(&mut self, from: &str, to: &str) -> (String, String) {
        let (answer, text) = self.ask("hover", from, to);
        let said = answer["contents"]["value"].as_str().unwrap_or_default().to_owned();
        let range = &answer["range"];
        (said, if range.is_null() { String::new() } else { covered(&text, range) })
    }

    fn places(&mut self, method: &str, from: &str, to: &str) -> Vec<String> {
        let (text, position) = heater(from, to);
        self.number += 1;
        let name = format!("heater{}.od.yaml", self.number);
        self.client.open(&name, &text);
        let params = json!({
            "textDocument": {"uri": self.client.uri(&name)},
            "position": {"line": position.0, "character": position.1},
            "context": {"includeDeclaration": true},
        });
        let answer = self.client.request(&format!("textDocument/{method}"), &params).unwrap();
        let place = |place: &Value| {
            let line = place["range"]["start"]["line"].as_u64().unwrap();
            format!("{line} {}", covered(&text, &place["range"]))
        };
        answer.as_array().unwrap().iter().map(place).collect()
    }

    /// The labels that are offered, and what the document is with the one of a label.
    fn complete(&mut self, from: &str, to: &str) -> (Vec<Value>, String) {
        let (answer, text) = self.ask("completion", from, to);
        (answer["items"].as_array().unwrap().clone(), text)
    }
}

#[test]
fn hover_tells_what_a_section_of_an_eds_says() {
    let mut client = Client::new("hover-eds");
    let eds = include_str!("../../../../generated/eds/pmc.eds");
    client.open("pmc.eds", eds);
    let mut hover = |header: &str, key: &str| {
        let lines = || eds.lines().enumerate();
        let (section, _) = lines().find(|(_, line)| *line == header).unwrap();
        let (line, text) = lines().skip(section).find(|(_, line)| line.starts_with(key)).unwrap();
        let position = (u32::try_from(line).unwrap(), 2);
        let answer = client.request_at("textDocument/hover", "pmc.eds", position);
        let covers = |end: &str| answer["range"][end].clone();
        if !answer.is_null() {
            assert_eq!(covers("start"), json!({"line": line, "character": 0}));
            assert_eq!(covers("end"), json!({"line": line, "character": text.len()}));
        }
        answer["contents"]["value"].as_str().unwrap_or_default().to_owned()
    };
    let vendor = "`1018h.1` **Identity object.Vendor-ID**\n- type: UNSIGNED32\n";
    for key in ["[1018sub1]", "ParameterName=", "DefaultValue="] {
        assert!(hover("[1018sub1]", key).starts_with(vendor), "{}", hover("[1018sub1]", key));
    }
    assert!(hover("[1000]", "AccessType=").starts_with("`1000h` **Device type**\n"));
    assert!(hover("[1018]", "[1018]").starts_with("`1018h` **Identity object."));
    assert_eq!(hover("[DeviceInfo]", "VendorName="), "");
    // A list names objects.
    assert!(hover("[MandatoryObjects]", "1=").starts_with("`1000h` **Device type**\n"));
}

#[test]
fn hover_tells_facts_meanings_and_raw_values() {
    let mut session = Session::new("hover");
    for (from, to, range, reported) in [
        ("limits.lowest <", "limits.low‸est <", "lowest", "`2002h.1` **limits.lowest**"),
        ("limits.lowest <", "limits.low‸est <", "lowest", "- default: 10.0 °C (100)"),
        ("limits.lowest <", "limits.low‸est <", "lowest", "- require: in order, `0x2002.1 < 0x2002.2`"),
        ("limits.lowest <", "limits.low‸est <", "lowest", "Below it heats."),
        ("map: [0x2001", "map: [0x20‸01", "0x2001", "- TPDO 1: byte 0, 16 bit, 180h + node-ID"),
        ("0x2003: {name", "0x20‸03: {name", "0x2003", "- writable-when: `0x2000 == 1`"),
        ("default: 42.5 °C", "default: 42.‸5 °C", "42.5 °C", "default: 42.5 °C (425)"),
        ("max: 90.0 °C", "max: ‸90.0 °C", "90.0 °C", "max: 90.0 °C (900)"),
        ("unit: tenth °C, access: rw", "unit: tenth °‸C, access: rw", "tenth °C", "0.1 °C"),
        ("type: integer16, unit", "type: inte‸ger16, unit", "integer16", "-32768 to 32767"),
        ("type: mode,", "type: mo‸de,", "mode", "  - 1: heating"),
        ("default: standby", "default: stand‸by", "standby", "type `mode`, 0"),
        (
            "[heartbeat producer]",
            "[heartbeat pro‸ducer]",
            "heartbeat producer",
            "feature **heartbeat producer**",
        ),
        ("pdo: transmit", "pd‸o: transmit", "pdo", "PDOs that it may be mapped into"),
        ("  in order:", "  in or‸der:", "in order", "`0x2002.1 < 0x2002.2`"),
        ("receive: {1:", "receive: {‸1:", "1", "RPDO 1, 200h + node-ID"),
    ] {
        let (said, covers) = session.hover(from, to);
        assert_eq!(covers, range, "{to}: {said}");
        assert!(said.contains(reported), "{to}: {said}");
    }
    // In a comment there is nothing to show.
    assert_eq!(session.hover("od-spec: 1", "od-spec: 1 # a na‸me").0, "");
}

#[test]
fn a_name_leads_to_its_definition_and_to_all_that_refer_to_it() {
    let mut session = Session::new("definition");
    for (from, to, expected) in [
        ("type: mode,", "type: mo‸de,", "9 mode"),
        ("map: [mode of", "map: [mo‸de of", "11 mode of operation"),
        ("[0x2001,", "[0x‸2001,", "12 temperature °"),
        ("limits.lowest <", "lim‸its.lowest <", "14 limits"),
        ("0x2002.2, about", "0x2002.‸2, about", "17 highest"),
        ("== heating", "== heat‸ing", "9 heating"),
        ("  heater:\n    receive", "  heat‸er:\n    receive", "5 heater"),
    ] {
        assert_eq!(session.places("definition", from, to), [expected], "{to}");
    }
    assert_eq!(
        session.places("references", "tenth °C: {", "ten‸th °C: {"),
        ["7 tenth °C", "12 tenth °C", "16 tenth °C", "17 tenth °C"]
    );
    assert_eq!(
        session.places("references", "name: mode of", "name: mo‸de of"),
        ["11 mode of operation", "18 mode of operation", "21 mode of operation", "22 0x2000"]
    );
    let marked = session.places("documentHighlight", "== heating", "== heat‸ing");
    assert_eq!(marked, ["9 heating", "18 heating"]);
    // A library is a file of its own, which cannot be written.
    let (answer, _) = session.ask("definition", "[heartbeat producer]", "[heartbeat pro‸ducer]");
    assert!(answer[0]["uri"].as_str().unwrap().ends_with("/cia301.od.yaml"), "{answer}");
}

#[test]
fn completion_offers_what_may_stand_there() {
    let mut session = Session::new("completion");
    for (from, to, offered, not_offered) in [
        (
            "unit: tenth °C, access: rw",
            "unit: ‸, access: rw",
            &["tenth °C", "millisecond"][..],
            &["volt"][..],
        ),
        ("unit: tenth °C, access: rw", "unit: te‸, access: rw", &["tenth °C"], &[]),
        ("  0x2003: {", "  0x2003: {‸, ", &["record", "min", "about"], &["name", "type", "access", "symbol"]),
        ("access: ro, pdo: transmit", "access: ‸, pdo: transmit", &["ro", "rw locked"], &["integer8"]),
        (
            "type: integer16, unit: tenth °C, access: ro",
            "type: ‸, unit: tenth °C, access: ro",
            &["integer16", "mode"],
            &["rw"],
        ),
        ("default: standby", "default: ‸", &["standby", "heating"], &["ro"]),
        ("map: [mode of operation]", "map: [‸]", &["0x2000", "unsigned8"], &["0x2001", "0x2003"]),
        ("map: [mode of operation]", "map: [mo‸]", &["mode of operation"], &["temperature °"]),
        (
            "features: [heartbeat producer]",
            "features: [heartbeat producer, ‸]",
            &["sdo server"],
            &["heartbeat producer"],
        ),
        ("limits.lowest < 0x2002.2", "limits.lowest < li‸", &["limits.highest", "bit("], &[]),
        ("\npdos:\n", "\n‸\npdos:\n", &["errors", "document"], &["units", "title"]),
        ("objects:\n", "objects:\n  ‸\n", &["0x1017", "0x1018"], &["0x2000"]),
        ("uses: [cia301]", "uses: [cia301, ‸]", &["cia402"], &["cia301"]),
        ("      1: {name: lowest, ", "      1: {‸, name: lowest, ", &[], &["name"]),
        ("pdos:\n  heater:", "pdos:\n  ‸\n  other:", &["heater"], &[]),
        // Broken after the cursor, and in it.
        ("access: rw, default: 0, writable", "access: r‸, default: [0, writable", &["rw", "ro"], &[]),
    ] {
        let (items, _) = session.complete(from, to);
        let labels: Vec<&str> = items.iter().map(|item| item["label"].as_str().unwrap()).collect();
        for label in offered {
            assert!(labels.contains(label), "{to}: no `{label}` in {labels:?}");
        }
        for label in not_offered {
            assert!(!labels.contains(label), "{to}: `{label}` in {labels:?}");
        }
    }
    // Types of one's own before data types, and these before what a library has for itself.
    let (mut items, _) =
        session.complete("type: integer16, unit: tenth °C, access: ro", "type: ‸, access: ro");
    items.sort_by_key(|item| item["sortText"].as_str().unwrap().to_owned());
    let at = |label: &str| items.iter().position(|item| item["label"] == label).unwrap();
    assert!(at("mode") < at("boolean") && at("visible-string") < at("PDO COB-ID"), "{items:?}");
    for nothing in ["title: Heater 🌀 ‸x", "title: Heater # ‸"] {
        assert!(session.complete("title: Heater 🌀", nothing).0.is_empty(), "{nothing}");
    }
}

#[test]
fn what_is_taken_stands_where_it_belongs() {
    let mut session = Session::new("edits");
    for (from, to, label, expected) in [
        (
            "symbol: °C, scale: 1/10, about: \"🌀 of",
            "symbol: °C, sc‸: 1/10, about: \"🌀 of",
            "scale",
            "symbol: °C, scale: 1/10, about: \"🌀 of",
        ),
        (
            "scale: 1/10, about: \"🌀 of a degree\"}",
            "about: \"🌀 of a degree\", sc‸}",
            "scale",
            "about: \"🌀 of a degree\", scale: }",
        ),
        (
            "unit: tenth °C, access: rw, default: 10",
            "unit: ten‸th x, access: rw, default: 10",
            "tenth °C",
            "unit: tenth °C, access: rw, default: 10",
        ),
        (
            "unit: tenth °C, access: rw, default: 10",
            "unit: \"te‸\", access: rw, default: 10",
            "tenth °C",
            "unit: \"tenth °C\", access: rw, default: 10",
        ),
        (
            "limits.lowest < 0x2002.2",
            "limits.lowest < lim‸",
            "limits.highest",
            "limits.lowest < limits.highest",
        ),
        ("objects:\n", "objects:\n  0x101‸\n", "0x1017", "objects:\n  0x1017: {from: cia301}\n"),
    ] {
        let (items, text) = session.complete(from, to);
        let item =
            items.iter().find(|item| item["label"] == label).unwrap_or_else(|| panic!("{to}: {items:?}"));
        let edit = &item["textEdit"];
        let old = covered(&text, &edit["range"]);
        let start = text.find(&to.replace('‸', "")).unwrap();
        let part = &text[start..];
        let at = part.find(&old).unwrap_or_else(|| panic!("{old}"));
        // The same text may be before it: the last one up to the cursor counts.
        let cursor = to.find('‸').unwrap();
        let at = part[..cursor].rfind(&old[..old.len().min(cursor)]).unwrap_or(at);
        let new = edit["newText"].as_str().unwrap();
        let changed = format!("{}{new}{}", &part[..at], &part[at + old.len()..]);
        let is_key = items.iter().all(|item| item["insertTextFormat"] == 1);
        assert!(changed.starts_with(expected) && is_key, "{to}: {changed:.80}");
    }
}

#[test]
fn a_rename_changes_every_place_or_says_why_not() {
    let mut session = Session::new("rename");
    let mut rename = |from: &str, to: &str, name: &str| -> Result<Vec<String>, String> {
        let (text, position) = heater(from, to);
        session.number += 1;
        let file = format!("heater{}.od.yaml", session.number);
        session.client.open(&file, &text);
        let at = json!({"line": position.0, "character": position.1});
        let document = json!({"uri": session.client.uri(&file)});
        let params = json!({"textDocument": document, "position": at, "newName": name});
        let refusal = |error: Value| error["message"].as_str().unwrap().to_owned();
        session.client.request("textDocument/prepareRename", &params).map_err(refusal)?;
        let answer = session.client.request("textDocument/rename", &params).map_err(refusal)?;
        let edits = answer["changes"].as_object().unwrap();
        assert_eq!(edits.len(), 1);
        let edits = edits.values().next().unwrap().as_array().unwrap();
        let change = |edit: &Value| {
            format!("{} -> {}", covered(&text, &edit["range"]), edit["newText"].as_str().unwrap())
        };
        Ok(edits.iter().map(change).collect())
    };
    let unit = rename("tenth °C: {", "ten‸th °C: {", "step: °C").unwrap();
    assert_eq!(unit, vec!["tenth °C -> \"step: °C\""; 4]);
    assert_eq!(
        rename("limits.lowest <", "limits.low‸est <", "cold").unwrap(),
        ["lowest -> cold", "limits.lowest < 0x2002.2 -> limits.cold < 0x2002.2"]
    );
    assert_eq!(
        rename("name: mode of", "name: mo‸de of", "state").unwrap(),
        [
            "mode of operation -> state",
            "\"mode of operation == heating\" -> \"state == heating\"",
            "mode of operation -> state"
        ]
    );
    for (from, to, name, reason) in [
        ("[heartbeat producer]", "[heartbeat pro‸ducer]", "x", "is a name of the library"),
        ("[0x2001,", "[0x‸2001,", "x", "this is a number"),
        (
            "type: integer16, unit: tenth °C, access: ro",
            "type: inte‸ger16, unit: tenth °C, access: ro",
            "x",
            "this word belongs to the language",
        ),
        ("tenth °C: {", "ten‸th °C: {", "millisecond", "already"),
        ("  mode: {base", "  mo‸de: {base", "unsigned8", "is a data type"),
        ("  heater: {name", "  hea‸ter: {name", "Heater 2", "cannot be the key of a device"),
        ("name: mode of", "name: mo‸de of", "a < b", "with this name"),
        ("name: mode of", "name: mo‸de of", " ", "cannot be empty"),
        ("name: mode of", "name: mo‸de of", "temperature °", "with this name"),
        ("title: Heater", "title: Hea‸ter", "x", "there is no name here"),
        ("access: rw, default: 0, writable", "acc‸ess: rw, default: [0, writable", "x", "is not valid YAML"),
    ] {
        let refused = rename(from, to, name).unwrap_err();
        assert!(refused.contains(reason), "{to} {name}: {refused}");
    }
}

#[test]
fn hints_show_raw_values_places_and_identifiers() {
    for (options, expected) in [
        (
            json!(null),
            &[
                "16 100",
                "17 425",
                "17 900",
                "21 200h + node-ID",
                "21 byte 0",
                "22 180h + node-ID",
                "22 byte 0",
                "22 byte 2",
            ][..],
        ),
        (json!({"inlayHints": ["raw-values"]}), &["16 100", "17 425", "17 900"]),
        (json!({"inlayHints": []}), &[]),
    ] {
        let mut client = Client::silent("hints");
        let params =
            json!({"processId": null, "rootUri": null, "capabilities": {}, "initializationOptions": options});
        client.request("initialize", &params).unwrap();
        client.notify("initialized", &json!({}));
        client.open("heater.od.yaml", HEATER);
        let range = json!({"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}});
        let params = json!({"textDocument": {"uri": client.uri("heater.od.yaml")}, "range": range});
        let hints = client.request("textDocument/inlayHint", &params).unwrap();
        let short =
            |hint: &Value| format!("{} {}", hint["position"]["line"], hint["label"].as_str().unwrap());
        let hints: Vec<String> = hints.as_array().unwrap().iter().map(short).collect();
        assert_eq!(hints, expected);
    }
}

#[test]
fn lines_may_end_as_on_windows() {
    let mut client = Client::new("crlf");
    let (text, position) = heater("limits.lowest <", "limits.low‸est <");
    client.open("heater.od.yaml", &text.replace('\n', "\r\n"));
    let answer = client.request_at("textDocument/hover", "heater.od.yaml", position);
    assert!(answer["contents"]["value"].as_str().unwrap().contains("limits.lowest"), "{answer}");
    assert_eq!(answer["range"]["start"]["line"], position.0);
}

#[test]
fn only_keys_that_check_takes_are_offered_and_the_usual_ones_first() {
    let mut session = Session::new("keys");
    let labels = |items: &[Value]| -> Vec<String> {
        let mut items: Vec<&Value> = items.iter().collect();
        items.sort_by_key(|item| item["sortText"].as_str().unwrap().to_owned());
        items.iter().map(|item| item["label"].as_str().unwrap().to_owned()).collect()
    };
    let (items, _) = session.complete("{name: switch,", "{name: switch, ‸,");
    let of_var = labels(&items);
    assert!(
        !of_var.iter().any(|key| ["outside", "rounding", "omit", "sub0"].contains(&key.as_str())),
        "{of_var:?}"
    );
    assert_eq!(of_var[..3], ["unit", "pdo", "min"], "{of_var:?}");
    let (items, _) = session.complete("    name: limits\n", "    name: limits\n    ‸\n");
    let of_record = labels(&items);
    let refused = ["array", "alias", "default", "min", "special", "capacity"];
    assert!(!of_record.iter().any(|key| refused.contains(&key.as_str())), "{of_record:?}");
    let (items, _) = session.complete("access: ro, pdo: transmit}", "access: ro, ‸}");
    assert!(!labels(&items).contains(&"writable-when".to_owned()));
    // A unit by its symbol, and after a number.
    let (items, _) = session.complete("unit: tenth °C, access: ro", "unit: °‸, access: ro");
    let unit = items.iter().find(|item| item["label"] == "tenth °C").unwrap();
    assert_eq!(unit["filterText"], "°C");
    let (items, _) = session.complete("default: 42.5 °C", "default: 42.5‸");
    assert_eq!(labels(&items), ["42.5 °C"]);
}

#[test]
fn texts_with_spaces_are_snippets_where_the_client_knows_them() {
    let capabilities = json!({"textDocument": {"completion": {"completionItem": {"snippetSupport": true}}}});
    let (mut client, _) = Client::with("snippets", &capabilities);
    let (text, position) = heater("map: [mode of operation]", "map: [‸]");
    client.open("heater.od.yaml", HEATER);
    client.replace("heater.od.yaml", 2, &text);
    let answer = client.request_at("textDocument/completion", "heater.od.yaml", position);
    let items = answer["items"].as_array().unwrap();
    let item = |label: &str| items.iter().find(|item| item["label"] == label).unwrap();
    assert_eq!(item("0x2000")["insertTextFormat"], 1);
    let (text, position) = heater("map: [mode of operation]", "map: [m‸]");
    client.replace("heater.od.yaml", 3, &text);
    let answer = client.request_at("textDocument/completion", "heater.od.yaml", position);
    let items = answer["items"].as_array().unwrap();
    let item = items.iter().find(|item| item["label"] == "mode of operation").unwrap();
    assert_eq!(
        (&item["insertTextFormat"], &item["textEdit"]["newText"]),
        (&json!(2), &json!("mode of operation"))
    );
}

#[test]
fn a_lens_counts_pdos_and_references() {
    let mut session = Session::new("lenses");
    session.client.open("heater.od.yaml", HEATER);
    session.client.diagnostics("heater.od.yaml", 1);
    let lenses = session.client.request_about("textDocument/codeLens", "heater.od.yaml");
    let titles: Vec<&str> =
        lenses.as_array().unwrap().iter().map(|lens| lens["command"]["title"].as_str().unwrap()).collect();
    assert_eq!(titles, ["RPDO 1 · TPDO 1 · 3 references", "TPDO 1 · 1 reference", "1 reference"]);
}
