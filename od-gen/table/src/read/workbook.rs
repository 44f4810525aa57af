//! The sheets of a workbook of Excel or LibreOffice.

use std::fmt::Write as _;
use std::io::Cursor;

use calamine::{Data, Dimensions, Ods, Range, Reader, Xlsx};
use od_spec::diag::{Diagnostic, codes};
use od_spec::source::SourceMap;

use crate::sheet::{Cell, Row, RowKind, Sheet};

/// The most cells that a sheet may span: one with a single cell in its last corner has 17 thousand million.
const MOST_CELLS: usize = 4_000_000;

/// The sheets of a workbook of Excel.
pub(super) fn of_excel(
    sources: &mut SourceMap,
    name: &str,
    bytes: Vec<u8>,
) -> Result<Vec<Sheet>, Box<Diagnostic>> {
    let mut book = Xlsx::new(Cursor::new(bytes)).map_err(|error| refused(name, &error.to_string()))?;
    let merged = |book: &mut Xlsx<Cursor<Vec<u8>>>, sheet: &str| {
        book.merge_cells_by_sheet_name(sheet).unwrap_or_default()
    };
    sheets(sources, name, &mut book, merged)
}

/// The sheets of a workbook of LibreOffice; its reader does not say which cells are merged.
pub(super) fn of_libre_office(
    sources: &mut SourceMap,
    name: &str,
    bytes: Vec<u8>,
) -> Result<Vec<Sheet>, Box<Diagnostic>> {
    let mut book = Ods::new(Cursor::new(bytes)).map_err(|error| refused(name, &error.to_string()))?;
    sheets(sources, name, &mut book, |_, _| Vec::new())
}

fn refused(name: &str, problem: &str) -> Box<Diagnostic> {
    let message = format!("cannot read `{name}`: {problem}");
    Box::new(
        Diagnostic::without_place(codes::UNREADABLE, message)
            .help("save it again as a workbook (.xlsx), or as CSV"),
    )
}

/// The sheets, each with a text in `sources` that has a line for each of its rows.
fn sheets<B: Reader<Cursor<Vec<u8>>>>(
    sources: &mut SourceMap,
    name: &str,
    book: &mut B,
    merged: impl Fn(&mut B, &str) -> Vec<Dimensions>,
) -> Result<Vec<Sheet>, Box<Diagnostic>>
where
    B::Error: std::fmt::Display,
{
    let mut sheets = Vec::new();
    for sheet in book.sheet_names() {
        let range = book.worksheet_range(&sheet).map_err(|error| refused(name, &error.to_string()))?;
        let Some(mut texts) = texts(&range) else {
            return Err(refused(name, &format!("the sheet `{sheet}` spans more than {MOST_CELLS} cells")));
        };
        for Dimensions { start: (first, column), end: (last, _) } in merged(book, &sheet) {
            let (first, column) = (first as usize, column as usize);
            let Some(text) = texts.get(first).and_then(|row| row.get(column)).cloned() else { continue };
            for row in texts.iter_mut().take(last as usize + 1).skip(first + 1) {
                row[column].clone_from(&text);
            }
        }
        sheets.push(placed(sources, &format!("{name} ({sheet})"), texts));
    }
    Ok(sheets)
}

/// The texts of a sheet from its first cell on; `None` if there are too many.
fn texts(range: &Range<Data>) -> Option<Vec<Vec<String>>> {
    let (Some((top, left)), Some((bottom, right))) = (range.start(), range.end()) else {
        return Some(Vec::new());
    };
    let (rows, columns) = (bottom as usize + 1, right as usize + 1);
    if rows.checked_mul(columns)? > MOST_CELLS {
        return None;
    }
    let mut texts = vec![vec![String::new(); columns]; rows];
    for (row, column, value) in range.used_cells() {
        let row = texts.get_mut(row + top as usize);
        if let Some(text) = row.and_then(|row| row.get_mut(column + left as usize)) {
            *text = shown(value);
        }
    }
    Some(texts)
}

/// A value as a text. A spreadsheet makes a date of `1.10`: what was meant cannot be known.
fn shown(value: &Data) -> String {
    match value {
        Data::Bool(value) => if *value { "yes" } else { "no" }.to_owned(),
        Data::DateTime(date) => format!("the date {date}"),
        Data::DateTimeIso(date) | Data::DurationIso(date) => format!("the date {date}"),
        Data::Int(_) | Data::Float(_) | Data::String(_) | Data::Error(_) | Data::Empty => {
            value.to_string().trim().replace("\r\n", "\n")
        }
    }
}

/// A sheet whose text has a line for each row, with bars between the cells.
fn placed(sources: &mut SourceMap, name: &str, texts: Vec<Vec<String>>) -> Sheet {
    let (mut text, mut places) = (String::new(), Vec::new());
    for row in &texts {
        let mut of_row = Vec::new();
        for (column, cell) in row.iter().enumerate() {
            let start = text.len();
            let line = cell.replace(char::is_control, " ");
            let _ = write!(text, "{line}");
            of_row.push((start, text.len()));
            text.push_str(if column + 1 == row.len() { "\n" } else { " | " });
        }
        places.push(of_row);
    }
    let file = sources.add(name, text);
    let whole = sources.whole(file);
    let rows = texts.into_iter().zip(places).map(|(texts, places)| {
        let cells = texts.into_iter().zip(places);
        let cells = cells.map(|(text, (start, end))| Cell { text, span: whole.part(start, end) });
        Row { kind: RowKind::Table, cells: cells.collect() }
    });
    Sheet { rows: rows.collect() }
}
