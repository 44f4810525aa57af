//! Filters for Markdown: text, cells and tables that read well as they are and on a forge.

use std::fmt::Write as _;

use minijinja::{Error, Value};
use od_spec::markdown::{escape, paragraph as paragraph_of};

/// Columns are filled up to this width, so that a table has straight columns as plain text, too.
const WIDEST: usize = 32;

/// A cell as a paragraph of its own: what would begin a heading, a list or a quotation is escaped.
pub(crate) fn paragraph(contents: &Value, page: &str) -> Result<String, Error> {
    let text = cell(contents, page)?.replace("<br>", "\\\n");
    Ok(paragraph_of(text))
}

/// A cell on a page: links to the same page are short.
pub(crate) fn cell(cell: &Value, page: &str) -> Result<String, Error> {
    let mut text = String::new();
    let stated = cell.get_attr("stated")?.to_string();
    // What the maker does not say is in italics; a line break ends them.
    let italics = if stated == "manual" { "" } else { "*" };
    for part in cell.get_attr("parts")?.try_iter()? {
        let words = part.get_attr("text")?.to_string();
        match part.get_attr("kind")?.as_str() {
            Some("break") => text.push_str("<br>"),
            Some("strong") => {
                let _ = write!(text, "**{}**", escape(&words));
            }
            Some("code") => {
                // Inside of code nothing can be escaped.
                if words.contains(['`', '|', '\n', '\r']) {
                    text.push_str(&escape(&words));
                } else {
                    let _ = write!(text, "`{words}`");
                }
            }
            Some("link") => {
                let target = part.get_attr("page")?.to_string();
                let file =
                    if target == page || target.is_empty() { String::new() } else { format!("{target}.md") };
                let anchor = part.get_attr("anchor")?.to_string();
                let words = escape(&words).replace('\n', " ");
                let _ = write!(text, "[{italics}{words}{italics}]({file}#{})", heading(&anchor));
            }
            _ => {
                let words = escape(&words).replace('\n', " ");
                let inner = words.trim();
                if italics.is_empty() || inner.is_empty() {
                    text.push_str(&words);
                } else {
                    text.push_str(&words.replace(inner, &format!("{italics}{inner}{italics}")));
                }
            }
        }
    }
    if stated == "assumed" {
        text.push_str(" *?*");
    }
    Ok(text)
}

/// Rows of a table have no anchors of their own in Markdown: a link to the entry `3020.5` leads to its object.
fn heading(anchor: &str) -> &str {
    match anchor.split_once('.') {
        Some((object, _)) if object.len() == 4 && object.bytes().all(|digit| digit.is_ascii_hexdigit()) => {
            object
        }
        _ => anchor,
    }
}

/// A grid as a table with a heading line.
pub(crate) fn table(grid: &Value, page: &str) -> Result<String, Error> {
    let (mut titles, mut aligns) = (Vec::new(), Vec::new());
    for column in grid.get_attr("columns")?.try_iter()? {
        titles.push(escape(&column.get_attr("title")?.to_string()).replace('\n', " "));
        aligns.push(column.get_attr("align")?.to_string());
    }
    let mut rows: Vec<Vec<String>> = vec![titles];
    for row in grid.get_attr("rows")?.try_iter()? {
        let mut cells: Vec<String> = row
            .get_attr("cells")?
            .try_iter()?
            .map(|contents| cell(&contents, page))
            .collect::<Result<_, _>>()?;
        let anchor = row.get_attr("anchor")?.to_string();
        // Anchors of entries are above the table, and those below them not at all; others, such as `erratum-17`, lead
        // to their row.
        if let Some(first) = cells.first_mut()
            && anchor.contains('-')
            && heading(&anchor) == anchor
        {
            first.insert_str(0, &format!("<a id=\"{anchor}\"></a>"));
        }
        rows.push(cells);
    }
    let last = aligns.len().saturating_sub(1);
    let widths: Vec<usize> = (0..aligns.len())
        .map(|at| {
            let widest = rows.iter().filter_map(|row| row.get(at)).map(|cell| cell.chars().count());
            if at == last { 3 } else { widest.filter(|width| *width <= WIDEST).max().unwrap_or(3).max(3) }
        })
        .collect();
    let mut text = String::new();
    for (number, row) in rows.iter().enumerate() {
        for ((cell, align), width) in row.iter().zip(&aligns).zip(&widths) {
            let fill = " ".repeat(width.saturating_sub(cell.chars().count()));
            let _ = if align == "right" {
                write!(text, "| {fill}{cell} ")
            } else {
                write!(text, "| {cell}{fill} ")
            };
        }
        text.push_str("|\n");
        if number == 0 {
            for (align, width) in aligns.iter().zip(&widths) {
                let _ = match align.as_str() {
                    "right" => write!(text, "| {}: ", "-".repeat(width - 1)),
                    "center" => write!(text, "| :{}: ", "-".repeat(width - 2)),
                    _ => write!(text, "| {} ", "-".repeat(*width)),
                };
            }
            text.push_str("|\n");
        }
    }
    Ok(text)
}
