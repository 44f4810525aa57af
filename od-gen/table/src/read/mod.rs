//! Files as sheets of cells.

mod html;
mod markdown;
mod separated;
mod workbook;

use od_spec::diag::{Diagnostic, codes};
use od_spec::encoding;
use od_spec::source::{FileId, SourceMap, Span};

use crate::sheet::{Row, Sheet};

/// How a file holds its tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Notation {
    /// Comma, semicolon or tab between cells: `.csv`, `.tsv`.
    Separated,
    /// Rows between bars, and lines with tabs; every other line is running text: `.md`, `.txt`.
    Document,
    /// Tables of a page: `.html`.
    Html,
    /// The sheets of a workbook of Excel: `.xlsx`.
    Excel,
    /// The sheets of a workbook of LibreOffice: `.ods`.
    LibreOffice,
}

impl Notation {
    /// The notation of a file with this extension; `None` if it is not a table.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Some(match extension.to_ascii_lowercase().as_str() {
            "csv" | "tsv" => Self::Separated,
            "md" | "markdown" | "txt" => Self::Document,
            "html" | "htm" => Self::Html,
            "xlsx" | "xlsm" => Self::Excel,
            "ods" => Self::LibreOffice,
            _ => return None,
        })
    }
}

/// The sheets of a file, whose texts are added to `sources`.
pub(crate) fn sheets(
    sources: &mut SourceMap,
    name: &str,
    bytes: Vec<u8>,
    notation: Notation,
) -> Result<Vec<Sheet>, Box<Diagnostic>> {
    type Rows = fn(&str, Span) -> Vec<Row>;
    let rows: Rows = match notation {
        Notation::Excel => return workbook::of_excel(sources, name, bytes),
        Notation::LibreOffice => return workbook::of_libre_office(sources, name, bytes),
        Notation::Separated => separated::rows,
        Notation::Document => markdown::rows,
        Notation::Html => html::rows,
    };
    let file = text(sources, name, bytes)?;
    Ok(vec![Sheet { rows: rows(sources.file(file).text(), sources.whole(file)) }])
}

/// Adds a text in UTF-8, UTF-16 or the code page that fits best.
fn text(sources: &mut SourceMap, name: &str, bytes: Vec<u8>) -> Result<FileId, Box<Diagnostic>> {
    let (text, encoding) = encoding::decode(bytes).map_err(|page| {
        let message =
            format!("the texts of `{name}` are in {}, in which a character has two bytes", page.name());
        Box::new(Diagnostic::without_place(codes::NOT_UTF8, message).help("save it as UTF-8"))
    })?;
    Ok(sources.add_decoded(name, text, encoding))
}
