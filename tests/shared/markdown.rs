//! Markdown pages as a reader of Markdown sees them: anchors, links, and tables with their cells as text.

use std::collections::BTreeSet;

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

/// Columns that a table may lack.
const OPTIONAL: [&str; 14] = [
    "Active",
    "Clamp",
    "Code",
    "Device",
    "Error code",
    "Meaning",
    "Prio.",
    "Range",
    "Short",
    "Stored",
    "Supported",
    "Transition",
    "Unit",
    "Base unit",
];

/// One page.
#[derive(Debug, Default)]
pub(crate) struct Page {
    /// Anchors of the page.
    pub(crate) anchors: BTreeSet<String>,
    /// Targets of its links.
    pub(crate) links: Vec<String>,
    /// Its tables, in order.
    pub(crate) tables: Vec<Table>,
    /// Text outside tables.
    pub(crate) text: String,
}

/// A table with the anchors since the one before.
#[derive(Debug, Default, Clone)]
pub(crate) struct Table {
    pub(crate) anchors: Vec<String>,
    /// The paragraph above it.
    pub(crate) above: String,
    pub(crate) columns: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
}

impl Table {
    /// The cell of a row in the column of this title; empty where a column is left out that nothing fills.
    pub(crate) fn cell<'a>(&self, row: &'a [String], title: &str) -> &'a str {
        let column = self.columns.iter().position(|column| column == title);
        assert!(column.is_some() || OPTIONAL.contains(&title), "{title} is not one of {:?}", self.columns);
        column.map_or("", |at| &row[at])
    }
}

pub(crate) fn read(text: &str) -> Page {
    let mut page = Page::default();
    let mut table = Table::default();
    let (mut row, mut cell, mut inside, mut paragraph) = (Vec::new(), String::new(), false, String::new());
    for event in Parser::new_ext(text, Options::ENABLE_TABLES) {
        match event {
            Event::Start(Tag::Table(_)) => inside = true,
            Event::End(TagEnd::Table) => {
                inside = false;
                table.above = std::mem::take(&mut paragraph);
                page.tables.push(std::mem::take(&mut table));
            }
            Event::Start(Tag::TableCell) => cell.clear(),
            // What is assumed is marked.
            Event::End(TagEnd::TableCell) => {
                let text = std::mem::take(&mut cell);
                row.push(text.strip_suffix(" ?").map(str::to_owned).unwrap_or(text));
            }
            Event::End(TagEnd::TableHead) => table.columns = std::mem::take(&mut row),
            Event::End(TagEnd::TableRow) => table.rows.push(std::mem::take(&mut row)),
            Event::Start(Tag::Paragraph) => paragraph.clear(),
            Event::Start(Tag::Link { dest_url, .. }) => page.links.push(dest_url.to_string()),
            Event::Text(text) | Event::Code(text) if inside => cell.push_str(&text),
            Event::Text(text) | Event::Code(text) => {
                paragraph.push_str(&text);
                page.text.push_str(&text);
                page.text.push('\n');
            }
            Event::InlineHtml(html) | Event::Html(html) => {
                if html.starts_with("<br") {
                    cell.push('\n');
                }
                if let Some(anchor) = html.strip_prefix("<a id=\"").and_then(|rest| rest.split('"').next()) {
                    assert!(page.anchors.insert(anchor.to_owned()), "the anchor {anchor} is used twice");
                    if !inside {
                        table.anchors.push(anchor.to_owned());
                    }
                }
            }
            _ => {}
        }
    }
    page
}
