//! Rows between bars, and lines with tabs, in a document.

use od_spec::source::Span;

use super::html::unmarked;
use crate::sheet::{Cell, Row, RowKind};

/// The rows and the lines of a document.
pub(super) fn rows(text: &str, whole: Span) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let text = line.trim_end();
        let is_bars = text.trim_start().starts_with('|');
        let separator = if is_bars { '|' } else { '\t' };
        let (mut cells, mut from, mut before) = (Vec::new(), 0, ' ');
        for (at, sign) in text.char_indices() {
            if sign == separator && !(is_bars && before == '\\') {
                cells.push(cell(&text[from..at], whole.part(start + from, start + at)));
                from = at + 1;
            }
            before = sign;
        }
        let last = cell(&text[from..], whole.part(start + from, start + text.len()));
        if is_bars {
            // A row begins and ends with a bar.
            cells.remove(0);
        }
        if !is_bars || !last.text.is_empty() {
            cells.push(last);
        }
        start += line.len();
        let is_rule = is_bars && text.chars().all(|sign| matches!(sign, '|' | '-' | ':' | ' '));
        if !is_rule {
            let kind = if is_bars || cells.len() > 1 { RowKind::Table } else { RowKind::Text };
            rows.push(Row { kind, cells });
        }
    }
    rows
}

/// A cell without the marks of Markdown and HTML.
fn cell(text: &str, span: Span) -> Cell {
    let text = unmarked(&text.replace("\\_", "_").replace("\\|", "|"));
    Cell { text: text.trim().trim_matches(['*', '`']).trim().to_owned(), span }
}
