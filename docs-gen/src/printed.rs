//! The index of printed tables: what takes the place of each, and which of its facts differ on purpose.

use od_spec::eds::MARK;
use od_spec::model::{ErratumKind, ErratumPlace, TableContent};
use serde::Serialize;

use crate::source::Source;
use crate::source::outline::kind_of;
use crate::tables::objects::column_of_entry;
use crate::view::{Cell, FigureView, Table};

/// Index of the manual's tables, for programs.
#[derive(Debug, Clone, Serialize)]
pub struct TableIndex {
    /// Version of this format: 1.
    pub format: u32,
    /// Who made the file.
    pub made: &'static str,
    /// Title and edition of the printed manual.
    pub source: String,
    /// Its tables, in order.
    pub tables: Vec<PrintedTable>,
}

/// A printed table and its counterpart.
#[derive(Debug, Clone, Serialize)]
pub struct PrintedTable {
    /// Number, as printed; none for a table without one.
    pub number: Option<u16>,
    /// Caption.
    #[serde(serialize_with = "text_only")]
    pub title: Cell,
    /// Its picture, where the manual numbers it.
    pub figure: Option<PrintedFigure>,
    /// Number of the section that it is in.
    pub section: String,
    /// What fills it.
    pub kind: &'static str,
    /// Anchor of the table that takes its place.
    pub anchor: String,
    /// Page that has the anchor, where pages are small.
    pub page: String,
    /// Rows of the table that takes its place.
    pub rows: usize,
    /// Keys of its columns here.
    pub columns: Vec<&'static str>,
    /// Those that the printed table does not have; empty where the specification does not state which it has.
    pub added: Vec<&'static str>,
    /// Numbers of the errata about it.
    pub errata: Vec<usize>,
    /// Its facts that differ on purpose.
    pub differs: Vec<Difference>,
}

/// A printed figure and its counterpart.
#[derive(Debug, Clone, Serialize)]
pub struct PrintedFigure {
    /// Number, as printed.
    pub number: u16,
    /// Caption.
    #[serde(serialize_with = "text_only")]
    pub title: Cell,
    /// Anchor of the picture that takes its place.
    pub anchor: String,
}

/// A fact of a printed table that differs on purpose.
#[derive(Debug, Clone, Serialize)]
pub struct Difference {
    /// Number of the erratum that says why.
    pub erratum: usize,
    /// Kind of fact.
    pub kind: &'static str,
    /// Objects or entries whose rows are concerned: `3020h.5`.
    pub entries: Vec<String>,
    /// Column of these rows, where the fact is in one.
    pub column: Option<&'static str>,
    /// What the manual prints.
    pub prints: String,
    /// What is printed here.
    pub reads: String,
}

fn text_only<S: serde::Serializer>(cell: &Cell, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&cell.text)
}

/// The column in which a fact is.
const fn column(kind: ErratumKind, content: &TableContent) -> Option<&'static str> {
    match (content, kind) {
        (TableContent::Objects(_), kind) => column_of_entry(kind),
        (TableContent::Overview(_), ErratumKind::ObjectType) => Some("object"),
        (TableContent::Overview(_), ErratumKind::Stored) => Some("mem"),
        (
            TableContent::Overview(_),
            ErratumKind::Index
            | ErratumKind::Name
            | ErratumKind::Type
            | ErratumKind::Sign
            | ErratumKind::Access,
        ) => column_of_entry(kind),
        _ => None,
    }
}

/// The keys of the columns of a table, each once.
fn columns(table: &Table) -> Vec<&'static str> {
    let mut keys = Vec::new();
    for column in table.grids.iter().flat_map(|grid| &grid.columns) {
        if !keys.contains(&column.key) {
            keys.push(column.key);
        }
    }
    keys
}

impl Source<'_> {
    /// Every table that the document lists and the devices shown have.
    pub(crate) fn printed(&self) -> Vec<PrintedTable> {
        let mut list = Vec::new();
        for chapter in self.outline.chapters() {
            for plan in &chapter.sections {
                let section = &self.document().sections[plan.position];
                let shown = &self.manual_tables()[plan.position];
                for (printed, table) in section.tables.iter().zip(shown) {
                    let Some(table) = table else { continue };
                    let columns = columns(table);
                    let is_added = |key: &&&str| !printed.columns.iter().any(|column| column == *key);
                    let is_stated = !printed.columns.is_empty();
                    let added = columns.iter().filter(|_| is_stated).filter(is_added).copied().collect();
                    list.push(PrintedTable {
                        number: printed.number,
                        title: table.title.clone(),
                        figure: table.figure.clone().map(|FigureView { number, anchor, title }| {
                            PrintedFigure { number, title, anchor }
                        }),
                        section: section.number.clone(),
                        kind: kind_of(&printed.content),
                        anchor: table.anchor.clone(),
                        page: chapter.page.clone(),
                        rows: table.grids.iter().map(|grid| grid.rows.len()).sum(),
                        differs: table
                            .errata
                            .iter()
                            .map(|mark| self.difference(mark.number, &printed.content))
                            .collect(),
                        errata: table.errata.iter().map(|mark| mark.number).collect(),
                        columns,
                        added,
                    });
                }
            }
        }
        list
    }

    /// The index of tables, for programs.
    pub(crate) fn table_index(&self) -> TableIndex {
        TableIndex {
            format: 1,
            made: MARK,
            source: self.document().source.clone().unwrap_or_default(),
            tables: self.printed(),
        }
    }

    fn difference(&self, number: usize, content: &TableContent) -> Difference {
        let erratum = &self.system.errata[number - 1];
        let entries = erratum.at.iter().filter(|place| match content {
            TableContent::Overview(list) | TableContent::Objects(list) => list.contains(&place.index()),
            _ => true,
        });
        Difference {
            erratum: number,
            kind: erratum.kind.word(),
            entries: entries.map(ErratumPlace::to_string).collect(),
            column: column(erratum.kind, content),
            prints: self.quoted(&erratum.prints).text,
            reads: self.quoted(&erratum.reads).text,
        }
    }
}
