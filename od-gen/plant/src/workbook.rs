//! The table as a workbook of Office Open XML (`.xlsx`), in which each cell says whether it is a text
//! or a number: no spreadsheet makes a date of `1.10`, and none a number of the machine `0017`.

use od_spec::plant::{Plant, Settled};
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, Worksheet};

use super::rows::{COLUMNS, Cell, each};

/// The most rows that a sheet has.
pub(super) const MOST_ROWS: u32 = 1 << 20;
/// The most sheets that a workbook gets: with more values, it would be too large to open.
const MOST_SHEETS: usize = 4;
/// The most code units of UTF-16 that a cell holds.
const MOST_UNITS: usize = 32_767;
/// Whole numbers up to this one are exact in a spreadsheet, which counts in floating point.
const LARGEST: u128 = 1 << 53;
/// The width of a column, in digits.
const WIDTH: u32 = 16;

/// The workbook, with at most so many rows on a sheet; `None` for a plant with more values than it
/// has room for.
pub(super) fn write(plant: &Plant, settled: &[Settled], most_rows: u32) -> Option<Vec<u8>> {
    let mut book = Book::new(most_rows);
    each(plant, settled, |of_node, of_values| {
        for values in of_values {
            if let Some(open) = &mut book
                && open.row(of_node.iter().chain(values)).is_none()
            {
                book = None;
            }
        }
    });
    book?.finish()
}

/// A workbook that is being written.
struct Book {
    most_rows: u32,
    sheets: Vec<Worksheet>,
    /// The rows of the last sheet.
    rows: u32,
    /// Bold.
    title: Format,
    /// What stays a text when a user types over it.
    text: Format,
}

impl Book {
    fn new(most_rows: u32) -> Option<Self> {
        let text = Format::new().set_num_format("@");
        let mut book = Self { most_rows, sheets: Vec::new(), rows: 0, title: text.clone().set_bold(), text };
        book.next_sheet()?;
        Some(book)
    }

    /// A sheet with the titles, which stay in sight.
    fn next_sheet(&mut self) -> Option<()> {
        self.close_sheet()?;
        let mut sheet = Worksheet::new();
        match self.sheets.len() {
            0 => sheet.set_name("values").ok()?,
            MOST_SHEETS => return None,
            before => sheet.set_name(format!("values {}", before + 1)).ok()?,
        };
        sheet.set_freeze_panes(1, 0).ok()?;
        for (column, title) in (0..).zip(COLUMNS) {
            sheet.set_column_width(column, WIDTH).ok()?;
            sheet.write_string_with_format(0, column, title, &self.title).ok()?;
        }
        self.sheets.push(sheet);
        self.rows = 1;
        Some(())
    }

    fn close_sheet(&mut self) -> Option<()> {
        let last_column = u16::try_from(COLUMNS.len() - 1).ok()?;
        if let Some(sheet) = self.sheets.last_mut() {
            sheet.autofilter(0, 0, self.rows - 1, last_column).ok()?;
        }
        Some(())
    }

    /// Adds a row; `None` where the workbook is full.
    fn row<'a>(&mut self, cells: impl Iterator<Item = &'a Cell>) -> Option<()> {
        if self.rows == self.most_rows {
            self.next_sheet()?;
        }
        let sheet = self.sheets.last_mut()?;
        for (column, cell) in (0..).zip(cells) {
            if let Some(number) = exact(cell) {
                sheet.write(self.rows, column, number).ok()?;
            } else {
                let text = cell_text(&cell.text());
                if !text.is_empty() {
                    sheet.write_string_with_format(self.rows, column, text, &self.text).ok()?;
                }
            }
        }
        self.rows += 1;
        Some(())
    }

    fn finish(mut self) -> Option<Vec<u8>> {
        self.close_sheet()?;
        let mut workbook = Workbook::new();
        // Without a date of its own, a workbook has that of the clock.
        let created = ExcelDateTime::from_ymd(2000, 1, 1).ok()?;
        workbook.set_properties(&DocProperties::new().set_creation_datetime(&created));
        for sheet in self.sheets {
            workbook.push_worksheet(sheet);
        }
        workbook.save_to_buffer().ok()
    }
}

/// The number of a cell, if a spreadsheet does not round it.
fn exact(cell: &Cell) -> Option<i64> {
    match cell {
        Cell::Number(number) if number.unsigned_abs() <= LARGEST => i64::try_from(*number).ok(),
        Cell::Number(_) | Cell::Text(_) => None,
    }
}

/// A text as a cell holds it. Line breaks and what XML cannot hold are spaces; a text that is longer
/// than a cell ends with `…`.
fn cell_text(text: &str) -> String {
    let is_blank = |c: char| c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}');
    let text = text.replace(is_blank, " ");
    if text.encode_utf16().count() <= MOST_UNITS {
        return text;
    }
    let mut room = MOST_UNITS - 1;
    let kept = text.chars().take_while(|c| {
        let fits = c.len_utf16() <= room;
        room = room.saturating_sub(c.len_utf16());
        fits
    });
    kept.chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_what_a_cell_can_hold() {
        assert_eq!(cell_text("a<b\n\u{1}\u{FFFF}_x0041_"), "a<b   _x0041_");
        let long = cell_text(&"ä".repeat(MOST_UNITS + 5));
        assert_eq!((long.chars().count(), long.ends_with("ä…")), (MOST_UNITS, true));
        assert_eq!(cell_text(&"ä".repeat(MOST_UNITS)).chars().count(), MOST_UNITS);
    }

    #[test]
    fn a_sheet_that_is_full_is_followed_by_another_until_the_workbook_is() {
        let with = |rows: usize| {
            let mut book = Book::new(3)?;
            (0..rows).try_for_each(|_| book.row([Cell::Number(7)].iter()))?;
            let sheets = book.sheets.len();
            book.finish().map(|_| (sheets, rows))
        };
        for (rows, sheets) in [(0, 1), (2, 1), (3, 2), (8, 4)] {
            assert_eq!(with(rows), Some((sheets, rows)));
        }
        assert_eq!(with(9), None);
    }

    #[test]
    fn numbers_that_a_spreadsheet_would_round_are_texts() {
        let largest = i128::try_from(LARGEST).unwrap();
        assert_eq!(exact(&Cell::Number(largest)), Some(1 << 53));
        assert_eq!(exact(&Cell::Number(-largest)), Some(-(1 << 53)));
        assert_eq!(exact(&Cell::Number(largest + 1)), None);
        assert_eq!(exact(&Cell::Text("7".to_owned())), None);
    }

    /// Times in the format have a resolution of two seconds.
    #[test]
    fn a_workbook_does_not_depend_on_the_clock() {
        let book = || {
            let mut book = Book::new(MOST_ROWS).unwrap();
            book.row([Cell::Number(7), Cell::Text("seven".to_owned())].iter()).unwrap();
            book.finish().unwrap()
        };
        let first = book();
        std::thread::sleep(std::time::Duration::from_millis(2100));
        assert!(first == book());
    }
}
