//! `read-eds FILE`: one line for the file, then one line per entry, fields separated by tabs.
//! `read-eds --accepts`: a line of JSON for each file named on standard input: why it is refused, or null.

use std::io::BufRead;
use std::process::ExitCode;

use canopen_host::canopen_rs::datatypes::Value;
use canopen_host::eds::{Eds, ObjectDescription};

fn main() -> ExitCode {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("usage: read-eds FILE");
        return ExitCode::FAILURE;
    };
    if path == "--accepts" {
        return accepts();
    }
    match Eds::from_file(path) {
        Ok(eds) => {
            println!("node\t{}", eds.node_id.map_or(String::new(), |id| id.to_string()));
            eds.objects.iter().for_each(print_entry);
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn accepts() -> ExitCode {
    for file in std::io::stdin().lock().lines() {
        let Ok(file) = file else { return ExitCode::FAILURE };
        match Eds::from_file(file) {
            Ok(_) => println!("null"),
            Err(error) => println!("\"{}\"", json(&error.to_string())),
        }
    }
    ExitCode::SUCCESS
}

fn json(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '"' | '\\' => format!("\\{c}"),
            c if c.is_control() => format!("\\u{:04x}", u32::from(c)),
            c => c.to_string(),
        })
        .collect()
}

fn print_entry(entry: &ObjectDescription) {
    println!(
        "{}\t{}\t{}\t{:?}\t{}\t{}\t{}",
        entry.address.index,
        entry.address.subindex,
        entry.data_type.index(),
        entry.access,
        u8::from(entry.pdo_mappable),
        text(&entry.default_value),
        entry.parameter_name,
    );
}

fn text(value: &Value) -> String {
    match value {
        Value::Boolean(v) => u8::from(*v).to_string(),
        Value::Integer8(v) => v.to_string(),
        Value::Integer16(v) => v.to_string(),
        Value::Integer32(v) => v.to_string(),
        Value::Integer64(v) => v.to_string(),
        Value::Unsigned8(v) => v.to_string(),
        Value::Unsigned16(v) => v.to_string(),
        Value::Unsigned32(v) => v.to_string(),
        Value::Unsigned64(v) => v.to_string(),
        Value::Real32(v) => v.to_string(),
        Value::Real64(v) => v.to_string(),
        Value::VisibleString(v) | Value::OctetString(v) | Value::Domain(v) => {
            String::from_utf8_lossy(v.as_bytes()).into_owned()
        }
        other => format!("unknown value {other:?}"),
    }
}
