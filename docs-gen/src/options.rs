//! What can be chosen about a document.

use std::collections::BTreeMap;

use od_spec::model::{Devices, EntryId, Index};
use od_spec::wording;
use serde::Serialize;

/// What a document shows.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// The devices.
    pub devices: Devices,
    /// Language of texts; that of the specification unless given.
    pub language: Option<String>,
    /// Language of fixed words; that of the texts unless given.
    pub words: Option<wording::Language>,
    /// Whether a printed manual shows where it differs from the issue that it takes the place of.
    pub errata: bool,
    /// Where a document says what the printed manual leaves open.
    pub gaps: Gaps,
    /// The maker's logo for the cover, as an address that has it in itself (`data:`); none where it is empty.
    pub logo: String,
    /// What generated code calls entries, by key of the device, then by entry.
    pub code_names: BTreeMap<String, BTreeMap<EntryId, CodeNames>>,
    /// The other documents that it is printed with.
    pub siblings: Siblings,
    /// What changed since an earlier specification, where that is asked for.
    pub since: Option<Since>,
    /// The file that the document is made from, if it shall say so.
    pub origin: Option<Origin>,
}

/// What changed since an earlier specification.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Since {
    /// What the earlier one is called, such as `valve-1.0.od.yaml`.
    pub name: String,
    /// The changes, in the order of a report.
    pub changes: Vec<Changed>,
}

/// A change, in English.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Changed {
    /// The key of the device; `None` for what all devices share.
    pub device: Option<String>,
    /// The object, where it is about one.
    pub index: Option<Index>,
    /// `+`, `-` or `~`.
    pub sign: char,
    /// What it is about: `3005h test status, bit 5`.
    pub place: String,
    /// The fact before and after: `type: unsigned8 → unsigned16`.
    pub values: String,
    /// What follows.
    pub consequences: String,
}

/// The other documents that a document is printed with, as its pages refer to them.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Siblings {
    /// The start page of all of them; empty where there is none.
    pub start_page: String,
    /// The same document in other languages.
    pub languages: Vec<InLanguage>,
}

/// A document in another language.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct InLanguage {
    /// The language's code.
    pub language: String,
    /// What the language calls itself.
    pub name: String,
    /// The folder of its pages, which have the same names.
    pub folder: String,
}

/// The file that a document is made from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Origin {
    /// Its name, without folders.
    pub file: String,
    /// CRC-32 of its text and those of its parts and libraries, in the order in which they are read: `CBF43926`.
    pub checksum: String,
}

/// What generated code calls an entry; a name is empty where the code has none.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CodeNames {
    /// The call of the accessor in Rust.
    pub rust: String,
    /// The constant with its index in C.
    pub c: String,
    /// The constant with its index in Structured Text.
    pub structured_text: String,
}

/// Where a document says what the printed manual leaves open (`gap:`).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Gaps {
    /// Where it is open.
    #[default]
    InPlace,
    /// Nowhere: it is the maker's own edition.
    LeftOut,
    /// In an appendix, for the maker.
    Gathered,
}
