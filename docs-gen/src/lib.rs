//! Reference documentation of CANopen object dictionaries.
//!
//! The work has two steps. First the model becomes a [`Context`]: chapters, tables, objects and pictures as data, in one
//! language, with nothing left to decide but looks. Then templates print it: Markdown and HTML come with this crate, and
//! a directory of a user's own templates can replace or join them.

mod diagrams;
mod language;
mod options;
mod pages;
pub mod portal;
mod printed;
mod source;
mod tables;
mod templates;
pub mod view;

use od_spec::model::System;

pub use options::{Changed, CodeNames, Gaps, InLanguage, Options, Origin, Siblings, Since};
pub use printed::{Difference, PrintedTable, TableIndex};
pub use templates::{Format, Page, TemplateError, Templates};
pub use view::Context;

/// A system of which several documents are made.
pub struct Documentation<'a> {
    source: source::Source<'a>,
    options: &'a Options,
}

impl<'a> Documentation<'a> {
    /// The documentation of a system, with what its documents share worked out.
    pub fn new(system: &'a System, options: &'a Options) -> Self {
        Self { source: source::Source::new(system, options), options }
    }

    /// Everything that templates see where a document says in this way what the printed manual leaves open.
    pub fn context(&self, gaps: Gaps) -> Context {
        let Self { source, options } = self;
        let source = source.with_gaps(gaps);
        let (system, document) = (source.system, source.document());
        let issue = document.revision.as_ref();
        let mut devices: Vec<view::DeviceView> =
            source.devices.iter().map(|device| source.only(device).device(device)).collect();
        let mut appendices = source.appendices();
        pages::appendix::letter(&mut appendices, &mut devices, source.word(language::Word::Appendix));
        let chapters = source.chapter_views();
        Context {
            format: view::FORMAT,
            language: source.language.code.to_owned(),
            words: source.language.words(),
            synonyms: source.language.synonyms(),
            errata: options.errata,
            siblings: options.siblings.clone(),
            origin: options.origin.clone(),
            version: env!("CARGO_PKG_VERSION"),
            system: view::SystemView {
                title: system.title.clone(),
                subtitle: source.text(&document.subtitle),
                vendor: system.vendor.name.clone(),
                address: source.lines(&document.address, &od_spec::model::Devices::All),
                logo: options.logo.clone(),
                source: document.source.clone().unwrap_or_default(),
                about: source.text(&document.about),
                revision: issue.map_or_else(String::new, |issue| issue.number.clone()),
                date: issue.map_or_else(String::new, |issue| source.wording.language.date(issue.date)),
            },
            devices,
            notation: source.notation(),
            warnings: source.warnings(&chapters),
            chapters,
            search: source.search_words_of_sections(),
            appendices,
            entries: source.devices.iter().map(|device| device.entries().count()).sum(),
        }
    }

    /// The index of the printed manual's tables, for programs.
    pub fn table_index(&self) -> TableIndex {
        self.source.table_index()
    }
}

/// Everything that templates see.
pub fn context(system: &System, options: &Options) -> Context {
    Documentation::new(system, options).context(options.gaps)
}

/// The README's examples compile and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
