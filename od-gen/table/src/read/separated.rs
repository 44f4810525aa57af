//! Cells between separators: CSV and TSV.

use od_spec::source::Span;

use crate::columns::most_titles;
use crate::sheet::{Cell, Row, RowKind};

/// What can divide the cells: a spreadsheet takes what the language of its user does not need in numbers.
const SEPARATORS: [char; 3] = ['\t', ',', ';'];

/// The rows of a text, with the separator that gives the most titles of a table; else the most cells.
pub(super) fn rows(text: &str, whole: Span) -> Vec<Row> {
    let readings = SEPARATORS.map(|separator| divided(text, whole, separator));
    let cells = |rows: &[Row]| rows.iter().map(|row| row.cells.len()).sum::<usize>();
    readings.into_iter().max_by_key(|rows| (most_titles(rows), cells(rows))).unwrap_or_default()
}

/// The rows of a text with this separator.
fn divided(text: &str, whole: Span, separator: char) -> Vec<Row> {
    let (mut rows, mut cells) = (Vec::new(), Vec::new());
    let (mut of_row, mut start, mut is_quoted, mut value) = (0, 0, false, String::new());
    let mut signs = text.char_indices().peekable();
    while let Some((at, sign)) = signs.next() {
        match sign {
            '"' if is_quoted && signs.peek().is_some_and(|(_, next)| *next == '"') => {
                signs.next();
                value.push('"');
            }
            '"' if is_quoted => is_quoted = false,
            '"' if value.trim().is_empty() => {
                value.clear();
                is_quoted = true;
            }
            _ if is_quoted => value.push(sign),
            _ if sign == separator || sign == '\n' => {
                cells.push(cell(&value, whole.part(start, at)));
                value.clear();
                start = at + sign.len_utf8();
                if sign == '\n' {
                    of_row = start;
                    rows.push(Row { kind: RowKind::Table, cells: std::mem::take(&mut cells) });
                }
            }
            _ => value.push(sign),
        }
    }
    if is_quoted {
        // Without its second quote, what is left is not a row.
        let rest = cell(&text[of_row..], whole.part(of_row, text.len()));
        rows.push(Row { kind: RowKind::Text, cells: vec![rest] });
    } else if !value.is_empty() || !cells.is_empty() {
        cells.push(cell(&value, whole.part(start, text.len())));
        rows.push(Row { kind: RowKind::Table, cells });
    }
    rows
}

/// A cell. A `'` in front of a sign keeps spreadsheets from taking the cell for a formula.
fn cell(text: &str, span: Span) -> Cell {
    let text = text.trim();
    let guarded = text.strip_prefix('\'').filter(|rest| rest.starts_with(['=', '+', '-', '@', '\t']));
    Cell { text: guarded.unwrap_or(text).replace("\r\n", "\n"), span }
}
