//! The table as a workbook of Office Open XML (`.xlsx`), in which each cell says whether it is a text or a number: no spreadsheet
//! makes a date of `1.10`, and none a number of the machine `0017`.
//!
//! It is as little of the format as spreadsheets need: a sheet, its texts, and three styles.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use od_spec::plant::{Plant, Settled};

use super::rows::{COLUMNS, Cell, each};
use crate::zip::Archive;

/// Rows that a sheet has at most.
pub(super) const MOST_ROWS: usize = 1 << 20;
/// Sheets that a workbook has at most: an archive of this kind ends at 4 GB.
const MOST_SHEETS: usize = 4;
/// Letters that a cell has at most.
const MOST_LETTERS: usize = 32_767;
/// Whole numbers up to this one are exact in a spreadsheet, which counts in floating point; larger ones are texts.
const LARGEST: u128 = 1 << 53;

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n";
const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const PACKAGE: &str = "http://schemas.openxmlformats.org/package/2006";
const OFFICE: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
const SPREADSHEET: &str = "application/vnd.openxmlformats-officedocument.spreadsheetml";

/// How a cell looks: positions in the styles.
const PLAIN: usize = 0;
const TITLE: usize = 1;
const AS_TEXT: usize = 2;

/// The workbook, with at most so many rows on a sheet; nothing of a plant with more values than one can hold.
pub(super) fn write(plant: &Plant, settled: &[Settled], most_rows: usize) -> Option<Vec<u8>> {
    let mut book = Book::new(most_rows);
    each(plant, settled, |of_node, of_values| {
        for values in of_values {
            book.row(of_node.iter().chain(values));
        }
    });
    book.finish()
}

/// A workbook that is being written.
struct Book {
    most_rows: usize,
    /// The rows of each sheet, and how many there are.
    sheets: Vec<(String, usize)>,
    /// Each text with its number.
    texts: BTreeMap<String, usize>,
    /// The texts in the order of their numbers, as elements.
    elements: String,
    is_full: bool,
}

impl Book {
    fn new(most_rows: usize) -> Self {
        Self {
            most_rows,
            sheets: Vec::new(),
            texts: BTreeMap::new(),
            elements: String::new(),
            is_full: false,
        }
    }

    /// A row below those before it; the next sheet begins with the titles, too.
    fn row<'a>(&mut self, cells: impl Iterator<Item = &'a Cell>) {
        if self.sheets.last().is_none_or(|(_, rows)| *rows == self.most_rows) {
            self.is_full |= self.sheets.len() == MOST_SHEETS;
            self.sheets.push((String::new(), 0));
            let titles = COLUMNS.map(|title| Cell::Text(title.to_owned()));
            self.cells(titles.iter(), TITLE);
        }
        if !self.is_full {
            self.cells(cells, AS_TEXT);
        }
    }

    fn cells<'a>(&mut self, cells: impl Iterator<Item = &'a Cell>, style: usize) {
        let Some((mut text, rows)) = self.sheets.pop() else { return };
        let row = rows + 1;
        let _ = write!(text, "<row r=\"{row}\">");
        for (column, cell) in ('A'..='Z').zip(cells) {
            match cell {
                Cell::Text(words) if words.is_empty() => {}
                Cell::Number(number) if number.unsigned_abs() <= LARGEST => {
                    let _ = write!(text, "<c r=\"{column}{row}\" s=\"{PLAIN}\"><v>{number}</v></c>");
                }
                cell => {
                    let at = self.text(cell.text());
                    let _ = write!(text, "<c r=\"{column}{row}\" s=\"{style}\" t=\"s\"><v>{at}</v></c>");
                }
            }
        }
        text.push_str("</row>\n");
        self.sheets.push((text, row));
    }

    /// The number of a text.
    fn text(&mut self, text: String) -> usize {
        let next = self.texts.len();
        let (elements, texts) = (&mut self.elements, &mut self.texts);
        *texts.entry(text).or_insert_with_key(|text| {
            let _ = writeln!(elements, "<si><t xml:space=\"preserve\">{}</t></si>", escaped(text));
            next
        })
    }

    fn finish(mut self) -> Option<Vec<u8>> {
        if self.sheets.is_empty() {
            self.sheets.push((String::new(), 0));
            self.cells(COLUMNS.map(|title| Cell::Text(title.to_owned())).iter(), TITLE);
        }
        if self.is_full {
            return None;
        }
        let count = self.sheets.len();
        let mut archive = Archive::default();
        archive.add("[Content_Types].xml", content_types(count).as_bytes())?;
        archive.add(
            "_rels/.rels",
            relationships([(format!("{OFFICE}/officeDocument"), "xl/workbook.xml".to_owned())]).as_bytes(),
        )?;
        archive.add("xl/workbook.xml", workbook(count).as_bytes())?;
        archive.add("xl/_rels/workbook.xml.rels", parts(count).as_bytes())?;
        archive.add("xl/styles.xml", styles().as_bytes())?;
        let texts = self.texts.len();
        let strings =
            format!("{HEAD}<sst xmlns=\"{MAIN}\" uniqueCount=\"{texts}\">\n{}</sst>\n", self.elements);
        archive.add("xl/sharedStrings.xml", strings.as_bytes())?;
        for (number, (rows, count)) in (1..).zip(self.sheets) {
            archive.add(&format!("xl/{}", sheet_file(number)), sheet(&rows, count).as_bytes())?;
        }
        archive.finish()
    }
}

fn sheet_file(number: usize) -> String {
    format!("worksheets/sheet{number}.xml")
}

/// The rows below a line of titles that stays in sight.
fn sheet(rows: &str, count: usize) -> String {
    let last = ('A'..='Z').nth(COLUMNS.len() - 1).unwrap_or('A');
    format!(
        "{HEAD}<worksheet xmlns=\"{MAIN}\"><sheetViews><sheetView workbookViewId=\"0\"><pane ySplit=\"1\" topLeftCell=\"A2\" activePane=\"bottomLeft\" state=\"frozen\"/></sheetView></sheetViews>\
         <sheetFormatPr defaultRowHeight=\"15\"/><cols><col min=\"1\" max=\"{}\" width=\"16\" customWidth=\"1\"/></cols>\n<sheetData>\n{rows}</sheetData>\n\
         <autoFilter ref=\"A1:{last}{count}\"/></worksheet>\n",
        COLUMNS.len()
    )
}

fn content_types(sheets: usize) -> String {
    let mut text = format!(
        "{HEAD}<Types xmlns=\"{PACKAGE}/content-types\"><Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\
         <Default Extension=\"xml\" ContentType=\"application/xml\"/>"
    );
    let mut part = |name: &str, kind: &str| {
        let _ = write!(text, "<Override PartName=\"/xl/{name}\" ContentType=\"{SPREADSHEET}.{kind}+xml\"/>");
    };
    part("workbook.xml", "sheet.main");
    part("styles.xml", "styles");
    part("sharedStrings.xml", "sharedStrings");
    for number in 1..=sheets {
        part(&sheet_file(number), "worksheet");
    }
    text.push_str("</Types>\n");
    text
}

fn relationships(parts: impl IntoIterator<Item = (String, String)>) -> String {
    let mut text = format!("{HEAD}<Relationships xmlns=\"{PACKAGE}/relationships\">");
    for (number, (kind, target)) in (1..).zip(parts) {
        let _ = write!(text, "<Relationship Id=\"rId{number}\" Type=\"{kind}\" Target=\"{target}\"/>");
    }
    text.push_str("</Relationships>\n");
    text
}

/// The sheets first, so that their numbers are those of their relationships.
fn parts(sheets: usize) -> String {
    let of_sheets = (1..=sheets).map(|number| (format!("{OFFICE}/worksheet"), sheet_file(number)));
    let others = ["styles", "sharedStrings"].map(|part| (format!("{OFFICE}/{part}"), format!("{part}.xml")));
    relationships(of_sheets.chain(others))
}

fn workbook(sheets: usize) -> String {
    let mut text = format!(
        "{HEAD}<workbook xmlns=\"{MAIN}\" xmlns:r=\"{OFFICE}\"><bookViews><workbookView/></bookViews><sheets>"
    );
    for number in 1..=sheets {
        let name = if number == 1 { "values".to_owned() } else { format!("values {number}") };
        let _ = write!(text, "<sheet name=\"{name}\" sheetId=\"{number}\" r:id=\"rId{number}\"/>");
    }
    text.push_str("</sheets></workbook>\n");
    text
}

/// Plain, bold, and what stays a text when somebody types over it (format 49).
fn styles() -> String {
    format!(
        "{HEAD}<styleSheet xmlns=\"{MAIN}\"><fonts count=\"2\"><font><sz val=\"11\"/><name val=\"Calibri\"/></font><font><b/><sz val=\"11\"/><name val=\"Calibri\"/></font></fonts>\
         <fills count=\"2\"><fill><patternFill patternType=\"none\"/></fill><fill><patternFill patternType=\"gray125\"/></fill></fills>\
         <borders count=\"1\"><border><left/><right/><top/><bottom/><diagonal/></border></borders>\
         <cellStyleXfs count=\"1\"><xf numFmtId=\"0\" fontId=\"0\" fillId=\"0\" borderId=\"0\"/></cellStyleXfs>\
         <cellXfs count=\"3\"><xf numFmtId=\"0\" fontId=\"0\" fillId=\"0\" borderId=\"0\" xfId=\"0\"/>\
         <xf numFmtId=\"49\" fontId=\"1\" fillId=\"0\" borderId=\"0\" xfId=\"0\" applyNumberFormat=\"1\" applyFont=\"1\"/>\
         <xf numFmtId=\"49\" fontId=\"0\" fillId=\"0\" borderId=\"0\" xfId=\"0\" applyNumberFormat=\"1\"/></cellXfs>\
         <cellStyles count=\"1\"><cellStyle name=\"Normal\" xfId=\"0\" builtinId=\"0\"/></cellStyles></styleSheet>\n"
    )
}

/// A text as an element holds it. Line breaks and what XML cannot hold are blanks; a text that is longer than a cell ends with `…`.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    let is_too_long = text.encode_utf16().count() > MOST_LETTERS;
    let mut room = if is_too_long { MOST_LETTERS - 1 } else { MOST_LETTERS };
    let cut = if is_too_long { Some('…') } else { None };
    let kept = text.char_indices().take_while(|(_, c)| {
        let fits = c.len_utf16() <= room;
        room = room.saturating_sub(c.len_utf16());
        fits
    });
    for (at, c) in kept.chain(cut.map(|c| (text.len(), c))) {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            // `_x0041_` is another spelling of `A`, unless its first character is spelled so itself.
            '_' if text.get(at..).is_some_and(is_code) => out.push_str("_x005F_"),
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Whether a text begins with the code of a character, `_x0041_`.
fn is_code(text: &str) -> bool {
    let bytes = text.as_bytes();
    bytes.len() > 6
        && bytes.starts_with(b"_x")
        && bytes[2..6].iter().all(u8::is_ascii_hexdigit)
        && bytes[6] == b'_'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_what_a_cell_can_hold() {
        assert_eq!(escaped("a<b & \"c\"\n_x0041_ _x41_"), "a&lt;b &amp; \"c\" _x005F_x0041_ _x41_");
        let long = escaped(&"ä".repeat(MOST_LETTERS + 5));
        assert_eq!((long.chars().count(), long.ends_with("ä…")), (MOST_LETTERS, true));
        assert_eq!(escaped(&"ä".repeat(MOST_LETTERS)).chars().count(), MOST_LETTERS);
    }

    #[test]
    fn a_sheet_that_is_full_is_followed_by_another_until_the_workbook_is() {
        let cell = Cell::Number(7);
        let with = |rows: usize| {
            let mut book = Book::new(3);
            for _ in 0..rows {
                book.row([&cell].into_iter());
            }
            (book.sheets.iter().map(|(_, rows)| *rows).collect::<Vec<_>>(), book.finish().is_some())
        };
        assert_eq!(with(0), (vec![], true));
        assert_eq!(with(3), (vec![3, 2], true));
        assert_eq!(with(8), (vec![3; 4], true));
        assert!(!with(9).1);
    }

    #[test]
    fn numbers_that_a_spreadsheet_would_round_are_texts() {
        let largest = i128::try_from(LARGEST).unwrap();
        let mut book = Book::new(MOST_ROWS);
        book.row([&Cell::Number(largest), &Cell::Number(-largest), &Cell::Number(largest + 1)].into_iter());
        let rows = &book.sheets[0].0;
        assert!(rows.contains("<v>9007199254740992</v>") && rows.contains("<v>-9007199254740992</v>"));
        assert!(!rows.contains("9007199254740993") && book.elements.contains("9007199254740993"));
    }
}
