//! Cells with their places.

use od_spec::source::Span;

/// The rows of one sheet, or of one text.
#[derive(Debug, Clone)]
pub(crate) struct Sheet {
    pub rows: Vec<Row>,
}

/// One cell.
#[derive(Debug, Clone)]
pub(crate) struct Cell {
    /// Its text, without spaces around it and without the signs of its notation.
    pub text: String,
    /// Where it is.
    pub span: Span,
}

/// What a row is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RowKind {
    /// Cells of a table.
    Table,
    /// A line of running text between tables, as a single cell.
    Text,
}

/// One row.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub kind: RowKind,
    pub cells: Vec<Cell>,
}

impl Row {
    /// The cells that have a text, with their columns.
    pub(crate) fn filled(&self) -> impl Iterator<Item = (usize, &Cell)> {
        self.cells.iter().enumerate().filter(|(_, cell)| !cell.text.is_empty())
    }

    /// The first cell that has a text.
    pub(crate) fn first(&self) -> Option<&Cell> {
        self.filled().next().map(|(_, cell)| cell)
    }

    /// The texts of its cells, as a comment quotes them.
    pub(crate) fn quoted(&self) -> String {
        let cells: Vec<&str> = self.filled().map(|(_, cell)| cell.text.as_str()).collect();
        cells.join(" | ")
    }
}
