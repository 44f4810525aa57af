//! Tables as CSV, as spreadsheets of all languages open it: UTF-8 with a byte order mark, and semicolons.

use super::{Table, Value};

const BYTE_ORDER_MARK: char = '\u{FEFF}';

/// The tables, with an empty line between them.
pub(super) fn write(tables: &[Table]) -> String {
    let mut text = String::from(BYTE_ORDER_MARK);
    for (at, table) in tables.iter().enumerate() {
        if at > 0 {
            text.push_str("\r\n");
        }
        let titles: Vec<Value> = table.titles.iter().cloned().map(Value::Text).collect();
        for row in std::iter::once(&titles).chain(&table.rows) {
            let cells: Vec<String> = row.iter().map(cell).collect();
            text.push_str(&cells.join(";"));
            text.push_str("\r\n");
        }
    }
    text
}

/// A cell. A text that a spreadsheet would take for a formula begins with `'`.
fn cell(value: &Value) -> String {
    let text = match value {
        Value::Number(number) => return number.to_string(),
        Value::Text(text) => text,
    };
    let unguarded = text.strip_prefix('\'').unwrap_or(text);
    let guard = if unguarded.starts_with(['=', '+', '-', '@', '\t']) { "'" } else { "" };
    if text.contains([';', '"', '\n', '\r', '\t', ',']) {
        format!("\"{guard}{}\"", text.replace('"', "\"\""))
    } else {
        format!("{guard}{text}")
    }
}
