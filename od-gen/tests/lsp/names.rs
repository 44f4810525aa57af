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

/// A text without its mark, and the line and the unit of UTF-16 at which that stood.
pub(crate) fn marked(text: &str) -> (String, (u32, u32)) {
    let at = text.find('‸').unwrap_or_else(|| panic!("no mark"));
    let line = text[..at].matches('\n').count();
    let start = text[..at].rfind('\n').map_or(0, |at| at + 1);
    let character = text[start..at].encode_utf16().count();
    let position = (u32::try_from(line).unwrap(), u32::try_from(character).unwrap());
    (text.replacen('‸', "", 1), position)
}

/// The specification with another piece, in which the mark stands.
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
fn an_entry_is_told_with_its_facts() {
    let mut session = Session::new("hover");
    let (said, range) = session.hover("limits.lowest <", "limits.low‸est <");
    assert_eq!(range, "lowest");
    println!("{said}");
    let (said, range) = session.hover("map: [0x2001", "map: [0x20‸01");
    println!("{said}\n{range}");
    let (said, range) = session.hover("default: 42.5 °C", "default: 42.‸5 °C");
    println!("{said}\n{range}");
    let (said, range) =
        session.hover("unit: tenth °C, access: rw, default: 10", "unit: tenth °‸C, access: rw, default: 10");
    println!("{said}\n{range}");
    let (said, range) = session.hover("pdo: transmit", "pd‸o: transmit");
    println!("{said}\n{range}");
    let (said, range) = session.hover("type: mode,", "type: mo‸de,");
    println!("{said}\n{range}");
    let (items, _) =
        session.complete("unit: tenth °C, access: rw, default: 10", "unit: ‸, access: rw, default: 10");
    println!("{:#?}", items);
    let (items, _) = session.complete("  0x2003: {", "  0x2003: {‸");
    println!("{:?}", items.iter().map(|i| i["label"].as_str().unwrap()).collect::<Vec<_>>());
    panic!();
}
