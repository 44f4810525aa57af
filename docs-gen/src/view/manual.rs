//! The title page, the chapters of the manual and the appendices.

use serde::Serialize;

use crate::view::{Cell, ObjectName, Table};

/// Title page.
#[derive(Debug, Clone, Serialize)]
pub struct SystemView {
    /// Title of the product or family.
    pub title: String,
    /// What the manual is about, below its title; may be empty.
    pub subtitle: Cell,
    /// Maker.
    pub vendor: String,
    /// The maker's address, in lines; may be empty.
    pub address: Vec<Cell>,
    /// The maker's logo, as an address that has it in itself (`data:`); may be empty.
    pub logo: String,
    /// Title and edition of the printed manual, or nothing.
    pub source: String,
    /// What the manual is.
    pub about: Cell,
    /// Issue that the specification holds, or nothing.
    pub revision: String,
    /// Its date, or nothing.
    pub date: String,
}

/// A chapter; it becomes a page of its own where pages are small.
#[derive(Debug, Clone, Serialize)]
pub struct Chapter {
    /// Number, as printed; may be empty.
    pub number: String,
    /// Heading.
    pub title: Cell,
    /// Name of its page.
    pub page: String,
    /// The chapter itself and the sections below it, in order.
    pub sections: Vec<Section>,
    /// That its texts are in another language, as a sentence; empty where all are in that of the document.
    pub untranslated: String,
}

/// A chapter or section.
#[derive(Debug, Clone, Serialize)]
pub struct Section {
    /// Number, as printed; may be empty.
    pub number: String,
    /// Heading.
    pub title: Cell,
    /// Where links lead.
    pub anchor: String,
    /// 1 for a chapter, 2 for `4.1`, and so on.
    pub level: usize,
    /// Tables in it.
    pub tables: Vec<Table>,
    /// What it contains, in order.
    pub content: Vec<Content>,
}

/// A table or a text of a section.
#[derive(Debug, Clone, Serialize)]
pub struct Content {
    /// `table`, `text`, `note`, `warning`, `steps`, `list`, `formula` or `gap`.
    pub kind: &'static str,
    /// Position of the table in the section's tables.
    pub table: Option<usize>,
    /// Paragraphs, formulas or the items of a list.
    pub items: Vec<Cell>,
    /// Where links to a warning lead; empty for anything else.
    pub anchor: String,
    /// The objects whose own warnings it says.
    pub objects: Vec<ObjectName>,
}

/// Tables over the whole system.
#[derive(Debug, Clone, Serialize)]
pub struct Appendix {
    /// `errors`, `aliases`, `units`, `storage`, `constraints`, `errata`, `tables`; also the name of its page.
    pub page: &'static str,
    /// Its letter, the same on every page.
    pub letter: String,
    /// Heading, with the letter.
    pub title: String,
    /// What it shows.
    pub intro: Cell,
    /// Its tables.
    pub tables: Vec<Table>,
    /// That its texts are in another language, as a sentence; empty where all are in that of the document.
    pub untranslated: String,
}

/// An erratum.
#[derive(Debug, Clone, Serialize)]
pub struct ErratumView {
    /// Its number, in the order of the specification.
    pub number: usize,
    /// What kind of fact.
    pub kind: String,
    /// Where the manual prints it.
    pub place: Cell,
    /// What it prints.
    pub prints: Cell,
    /// What the specification says.
    pub reads: Cell,
    /// Why.
    pub because: Cell,
}
