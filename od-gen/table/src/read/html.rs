//! Tables of an HTML page.

use od_spec::source::Span;

use crate::sheet::{Cell, Row, RowKind};

/// Cells below and next to a cell that a page may fill with it.
const MOST_SPANNED: usize = 256;

/// The rows of all tables of a page, with an empty row after each table. What is outside of them is left out.
pub(super) fn rows(text: &str, whole: Span) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    // For each column the cell that reaches down, and how many rows it still has.
    let mut down: Vec<(usize, Cell)> = Vec::new();
    let mut open: Option<Open> = None;
    let mut row: Option<Vec<Cell>> = None;
    let mut at = 0;
    while let Some(found) = text[at..].find('<') {
        let begin = at + found;
        let Some(length) = text[begin..].find('>') else { break };
        let end = begin + length + 1;
        let tag = Tag::of(&text[begin + 1..end - 1]);
        at = if tag.name == "!--" { text[begin..].find("-->").map_or(end, |to| begin + to + 3) } else { end };
        let ends_cell =
            matches!(tag.name.as_str(), "td" | "th" | "/td" | "/th" | "tr" | "/tr" | "table" | "/table");
        if ends_cell && let (Some(cell), Some(cells)) = (open.take(), row.as_mut()) {
            cell.close(text, whole, begin, cells, &mut down);
        }
        match tag.name.as_str() {
            "td" | "th" => {
                let cells = row.get_or_insert_default();
                fill(cells, &mut down);
                open = Some(Open { start: end, rows: tag.number("rowspan"), columns: tag.number("colspan") });
            }
            "tr" | "/tr" | "table" | "/table" => {
                if let Some(mut cells) = row.take() {
                    fill(&mut cells, &mut down);
                    rows.push(Row { kind: RowKind::Table, cells });
                }
                if tag.name.ends_with("table") {
                    down.clear();
                    rows.push(Row { kind: RowKind::Text, cells: Vec::new() });
                }
            }
            _ => {}
        }
    }
    rows
}

/// A cell whose end is not reached.
struct Open {
    start: usize,
    rows: usize,
    columns: usize,
}

impl Open {
    /// Adds the cell to its row. Over several columns it is in the first one, over several rows in all of them.
    fn close(
        self,
        text: &str,
        whole: Span,
        end: usize,
        cells: &mut Vec<Cell>,
        down: &mut Vec<(usize, Cell)>,
    ) {
        let span = whole.part(self.start, end);
        let value = unmarked(&text[self.start..end]);
        let first = Cell { text: value.trim().to_owned(), span };
        for column in 0..self.columns {
            let cell = if column == 0 { first.clone() } else { Cell { text: String::new(), span } };
            let at = cells.len();
            if down.len() <= at {
                down.resize_with(at + 1, || (0, Cell { text: String::new(), span }));
            }
            down[at] = (self.rows - 1, cell.clone());
            cells.push(cell);
        }
    }
}

/// Adds the cells of rows above that reach into this one, up to the next free column.
fn fill(cells: &mut Vec<Cell>, down: &mut [(usize, Cell)]) {
    while let Some((left, cell)) = down.get_mut(cells.len()).filter(|(left, _)| *left > 0) {
        *left -= 1;
        cells.push(cell.clone());
    }
}

/// A tag with its attributes.
struct Tag<'t> {
    name: String,
    attributes: &'t str,
}

impl<'t> Tag<'t> {
    fn of(text: &'t str) -> Self {
        if text.starts_with("!--") {
            return Self { name: "!--".to_owned(), attributes: "" };
        }
        let end = text.find(char::is_whitespace).unwrap_or(text.len());
        let name = text[..end].trim_end_matches('/').to_ascii_lowercase();
        Self { name, attributes: &text[end..] }
    }

    /// An attribute that counts cells; 1 where it is not there.
    fn number(&self, attribute: &str) -> usize {
        let lower = self.attributes.to_ascii_lowercase();
        let value =
            lower.find(attribute).and_then(|at| lower[at + attribute.len()..].trim_start().strip_prefix('='));
        let digits: String = value
            .unwrap_or_default()
            .trim_start()
            .trim_start_matches(['"', '\''])
            .chars()
            .take_while(char::is_ascii_digit)
            .collect();
        digits.parse().unwrap_or(1).clamp(1, MOST_SPANNED)
    }
}

/// Names of characters that tables have.
const CHARACTERS: [(&str, &str); 22] = [
    ("nbsp", " "),
    ("lt", "<"),
    ("gt", ">"),
    ("amp", "&"),
    ("quot", "\""),
    ("apos", "'"),
    ("deg", "°"),
    ("micro", "µ"),
    ("ndash", "–"),
    ("mdash", "—"),
    ("minus", "−"),
    ("hellip", "…"),
    ("plusmn", "±"),
    ("times", "×"),
    ("Omega", "Ω"),
    ("ouml", "ö"),
    ("auml", "ä"),
    ("uuml", "ü"),
    ("Ouml", "Ö"),
    ("Auml", "Ä"),
    ("Uuml", "Ü"),
    ("szlig", "ß"),
];

/// A text without tags, and with the characters that it names.
pub(super) fn unmarked(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(['<', '&']) {
        plain.push_str(&rest[..at]);
        rest = &rest[at..];
        let (length, shown) = if rest.starts_with('<') { tag(rest) } else { character(rest) };
        plain.push_str(&shown);
        rest = &rest[length..];
    }
    plain.push_str(rest);
    plain
}

/// The length of a tag at the beginning of a text, and what it shows. A `<` that begins no tag is itself.
fn tag(text: &str) -> (usize, String) {
    let begins = text[1..].starts_with(|c: char| c.is_ascii_alphabetic() || matches!(c, '/' | '!'));
    let Some(end) = text.find('>').filter(|_| begins) else { return (1, "<".to_owned()) };
    let shown = match Tag::of(&text[1..end]).name.as_str() {
        "br" | "p" | "/p" | "li" => "\n",
        _ => "",
    };
    (end + 1, shown.to_owned())
}

/// The length of a named or numbered character at the beginning of a text, and the character.
fn character(text: &str) -> (usize, String) {
    let itself = (1, "&".to_owned());
    let Some(end) = text.find(';').filter(|end| *end <= 10) else { return itself };
    let name = &text[1..end];
    let numbered = name.strip_prefix('#').and_then(|number| {
        let code = match number.strip_prefix(['x', 'X']) {
            Some(digits) => u32::from_str_radix(digits, 16).ok()?,
            None => number.parse().ok()?,
        };
        char::from_u32(code).map(String::from)
    });
    let named = CHARACTERS.iter().find(|(known, _)| *known == name).map(|(_, shown)| (*shown).to_owned());
    numbered.or(named).map_or(itself, |shown| (end + 1, shown))
}
