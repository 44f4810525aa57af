//! The table as CSV.
//!
//! Columns are divided by `;`: spreadsheets of the countries that write `0,5` expect it, and the others take it too. The text is
//! UTF-8 and begins with a byte order mark, without which Excel takes it for the code page of its country. A cell that would be taken
//! for a formula begins with `'`. What a cell is, every spreadsheet guesses anew; the workbook next to it states the
//! type.

use std::fmt::Write as _;

use od_spec::plant::{Plant, Settled};

use super::rows::{COLUMNS, Cell, each};

const BYTE_ORDER_MARK: char = '\u{FEFF}';

/// The table.
pub(super) fn write(plant: &Plant, settled: &[Settled]) -> String {
    let mut text = String::from(BYTE_ORDER_MARK);
    row(&mut text, &COLUMNS.map(str::to_owned));
    each(plant, settled, |of_node, of_values| {
        let mut prefix = String::new();
        cells(&mut prefix, &of_node.each_ref().map(Cell::text));
        for values in of_values {
            text.push_str(&prefix);
            text.push(';');
            row(&mut text, &values.each_ref().map(Cell::text));
        }
    });
    text
}

fn row(text: &mut String, of: &[String]) {
    cells(text, of);
    text.push_str("\r\n");
}

fn cells(text: &mut String, of: &[String]) {
    for (at, cell) in of.iter().enumerate() {
        if at > 0 {
            text.push(';');
        }
        let plain = cell.replace(['\r', '\n'], " ");
        let is_number = plain.parse::<i128>().is_ok();
        let guard = if !is_number && plain.starts_with(['=', '+', '-', '@', '\t']) { "'" } else { "" };
        if plain.contains([';', '"']) {
            let _ = write!(text, "\"{guard}{}\"", plain.replace('"', "\"\""));
        } else {
            let _ = write!(text, "{guard}{plain}");
        }
    }
}
