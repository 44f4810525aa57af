//! A concise DCF as a list: for people, for programs, and as settings for a DCF.

use std::fmt::Write as _;

use od_spec::model::{Dictionary, Value};
use serde_json::{Value as Json, json};

use super::{Concise, Reading, Record, reading};
use crate::hexadecimal;

/// Version of the JSON format; raised when a consumer would have to change.
const FORMAT: u32 = 1;
/// So many bytes of a value are shown to people.
const SHOWN: usize = 16;

/// A concise DCF together with the dictionary of the device that gets it.
#[derive(Debug)]
pub struct Listing<'a> {
    /// What the file is called.
    file: &'a str,
    concise: &'a Concise<'a>,
    device: &'a Dictionary,
    node: Option<u8>,
    rows: Vec<(&'a Record<'a>, Reading)>,
}

impl<'a> Listing<'a> {
    /// Reads each record; with a node-ID, defaults that depend on it are known.
    pub fn new(file: &'a str, concise: &'a Concise<'a>, device: &'a Dictionary, node: Option<u8>) -> Self {
        let rows = concise.records.iter().map(|record| (record, reading(device, node, record))).collect();
        Self { file, concise, device, node, rows }
    }

    /// How many records the device refuses, or may refuse.
    pub fn refused(&self) -> usize {
        self.rows.iter().filter(|(_, reading)| !reading.remarks.is_empty()).count()
    }

    /// For people: a line for each record, in the order of the file, and one for each remark.
    pub fn human(&self) -> String {
        let rows: Vec<[String; 5]> = self.rows.iter().map(|(record, reading)| row(record, reading)).collect();
        let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
        let widths = [0, 1, 2, 3, 4].map(width);
        let mut text = self.head();
        for (row, (_, reading)) in rows.iter().zip(&self.rows) {
            let mut line = String::from(" ");
            for (cell, width) in row.iter().zip(widths) {
                let _ = write!(line, " {cell:<width$} ");
            }
            text.push_str(line.trim_end());
            text.push('\n');
            for remark in &reading.remarks {
                let _ = writeln!(text, "  {:>at$} {remark}", "!", at = widths[0] + 2);
            }
        }
        match self.refused() {
            0 => {}
            1 => text.push_str("1 record with a remark: the device refuses it\n"),
            more => {
                let _ = writeln!(text, "{more} records with remarks: the device refuses them");
            }
        }
        text
    }

    fn head(&self) -> String {
        let number = self.rows.len();
        let plural = if number == 1 { "" } else { "s" };
        let of_node = self.node.map_or_else(String::new, |node| format!(", node {node}"));
        let name = &self.device.name;
        format!("{}: {number} record{plural} for {} ({name}){of_node}\n", self.file, self.device.key)
    }

    /// For programs; the format is described in `docs/book/formats/json.md`.
    pub fn json(&self) -> String {
        let records: Vec<Json> =
            self.rows.iter().map(|(record, reading)| record_json(record, reading)).collect();
        let fault = self.concise.fault.map(|fault| {
            let diagnostic = fault.diagnostic(self.file);
            json!({"offset": fault.offset(), "code": diagnostic.code.id, "message": diagnostic.message})
        });
        let whole = json!({
            "od-concise": FORMAT,
            "file": self.file,
            "device": self.device.key,
            "node": self.node,
            "stated": self.concise.stated,
            "records": records,
            "fault": fault,
        });
        format!("{whole:#}\n")
    }

    /// The values that the records leave in the node, as settings for `odgen dcf --set-file`; what is not a value of
    /// the device is in comments.
    pub fn settings(&self) -> String {
        let mut text = format!("# {}", self.head());
        for (at, (record, reading)) in self.rows.iter().enumerate() {
            // The last one counts.
            if self.rows[at + 1..].iter().any(|(later, _)| later.id == record.id) {
                continue;
            }
            let id = record.id;
            let entry = match id.sub.0 {
                0 => format!("{:04X}", id.index.0),
                sub => format!("{:04X}.{sub}", id.index.0),
            };
            let value = reading.value.as_ref().and_then(setting);
            let sign = if value.is_some() && reading.remarks.is_empty() { "" } else { "# " };
            let value = value.unwrap_or_else(|| hexadecimal_bytes(record.bytes, ""));
            let words = [reading.name.as_str(), reading.text.as_str()];
            let words: Vec<&str> = words.into_iter().filter(|words| !words.is_empty()).collect();
            if !words.is_empty() {
                let _ = writeln!(text, "# {}", one_line(&words.join(": ")));
            }
            for remark in &reading.remarks {
                let _ = writeln!(text, "# {}", one_line(&remark.to_string()));
            }
            let _ = writeln!(text, "{sign}{entry}={value}");
        }
        text
    }
}

/// A value as a setting has it; a text with a line break has no such form.
fn setting(value: &Value) -> Option<String> {
    match value {
        Value::Integer(raw) => Some(raw.to_string()),
        Value::NodeId(_) => None,
        Value::Real(real) => Some(format!("{:?}", real.number())),
        Value::Text(text) => (!text.contains(char::is_control)).then(|| text.clone()),
        Value::Bytes(bytes) => Some(hexadecimal_bytes(bytes, " ")),
    }
}

fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

/// Offset, entry, name, bytes and value of a record.
fn row(record: &Record<'_>, reading: &Reading) -> [String; 5] {
    let mut offset = String::from("0x");
    hexadecimal::push(&mut offset, u64::try_from(record.offset).unwrap_or(u64::MAX), 4);
    let shown = record.bytes.get(..SHOWN).unwrap_or(record.bytes);
    let mut bytes = hexadecimal_bytes(shown, " ");
    if shown.len() < record.bytes.len() {
        let _ = write!(bytes, " … ({} bytes)", record.bytes.len());
    }
    let mut value = one_line(&reading.text);
    if reading.is_default {
        value.push_str("  (default)");
    }
    [offset, record.id.to_string(), one_line(&reading.name), bytes, value]
}

fn record_json(record: &Record<'_>, reading: &Reading) -> Json {
    let remarks: Vec<Json> = reading
        .remarks
        .iter()
        .map(|remark| json!({"kind": remark.word(), "message": remark.to_string()}))
        .collect();
    json!({
        "offset": record.offset,
        "index": record.id.index.notation(),
        "sub": record.id.sub.0,
        "name": reading.name,
        "bytes": hexadecimal_bytes(record.bytes, ""),
        "raw": reading.value.as_ref().map(raw),
        "text": reading.text,
        "default": reading.is_default,
        "remarks": remarks,
    })
}

/// A number as one, and anything else as the text that it is.
fn raw(value: &Value) -> Json {
    match value {
        Value::Integer(raw) => match (u64::try_from(*raw), i64::try_from(*raw)) {
            (Ok(raw), _) => json!(raw),
            (Err(_), Ok(raw)) => json!(raw),
            (Err(_), Err(_)) => json!(raw.to_string()),
        },
        Value::NodeId(offset) => json!(offset),
        Value::Real(real) => json!(real.number()),
        Value::Text(text) => json!(text),
        Value::Bytes(bytes) => json!(hexadecimal_bytes(bytes, "")),
    }
}

fn hexadecimal_bytes(bytes: &[u8], between: &str) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(between)
}
