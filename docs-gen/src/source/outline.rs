//! The outline of a document: which page has which section, and where links to sections, tables and objects lead.

use std::collections::BTreeMap;

use od_spec::model::{Dictionary, Document, Figure, Index, Section, System, Table, TableContent, TableId};

use crate::view::cell::slug;

/// Names of pages that chapters leave to others.
const PAGES: [&str; 11] = [
    "readme",
    "index",
    "errors",
    "aliases",
    "units",
    "storage",
    "constraints",
    "machines",
    "errata",
    "questions",
    "tables",
];

/// Longest name of a page. File systems take 255 bytes, and some of them whole paths of 260.
const LONGEST_PAGE: usize = 80;

/// A chapter and the page that it becomes where pages are small.
#[derive(Debug, Clone)]
pub(crate) struct ChapterPlan {
    /// Name of the page.
    pub page: String,
    /// The chapter itself and the sections below it, in order.
    pub sections: Vec<SectionPlan>,
}

/// A section of a [`ChapterPlan`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct SectionPlan {
    /// Its position in the document.
    pub position: usize,
    /// 1 for a chapter, 2 for `4.1`, and so on.
    pub level: usize,
}

/// The sections of a document by chapter.
#[derive(Debug, Clone, Default)]
pub(crate) struct Outline(Vec<ChapterPlan>);

impl Outline {
    /// The outline of a system's document.
    pub(crate) fn of(system: &System) -> Self {
        let mut chapters: Vec<ChapterPlan> = Vec::new();
        for (position, section) in system.document.sections.iter().enumerate() {
            let level = level(&system.document, position);
            match chapters.last_mut() {
                Some(chapter) if level > 1 => chapter.sections.push(SectionPlan { position, level }),
                _ => {
                    let title = section.title.get(system.language()).unwrap_or_default();
                    let page = short(&slug(&format!("{} {title}", section.number))).to_owned();
                    let is_taken = |name: &str| {
                        PAGES.contains(&name)
                            || system.device(name).is_some()
                            || chapters.iter().any(|chapter| chapter.page == name)
                    };
                    let page = if page.is_empty() || is_taken(&page) {
                        format!("chapter-{}", position + 1)
                    } else {
                        page
                    };
                    chapters.push(ChapterPlan { page, sections: vec![SectionPlan { position, level }] });
                }
            }
        }
        Self(chapters)
    }

    /// The chapters, in order.
    pub(crate) fn chapters(&self) -> &[ChapterPlan] {
        &self.0
    }

    /// The page that has a section.
    pub(crate) fn page_of(&self, section: usize) -> String {
        let has = |chapter: &&ChapterPlan| chapter.sections.iter().any(|plan| plan.position == section);
        self.0.iter().find(has).map_or_else(String::new, |chapter| chapter.page.clone())
    }

    /// The page, where pages are small, that shows each object in detail: that of the chapter that does so first, or else
    /// that of a device.
    pub(crate) fn homes(&self, document: &Document, devices: &[&Dictionary]) -> BTreeMap<Index, String> {
        let mut homes = BTreeMap::new();
        for (index, page) in self.detailed(document) {
            homes.entry(index).or_insert_with(|| page.to_owned());
        }
        for device in devices {
            for index in device.objects.keys() {
                homes.entry(*index).or_insert_with(|| device.key.clone());
            }
        }
        homes
    }

    /// The objects that chapters show in detail, in their order, with the page of the chapter.
    pub(crate) fn detailed(&self, document: &Document) -> impl Iterator<Item = (Index, &str)> {
        self.0.iter().flat_map(move |ChapterPlan { page, sections }| {
            let tables = sections.iter().flat_map(|plan| &document.sections[plan.position].tables);
            let lists = tables.filter_map(|table| match &table.content {
                TableContent::Objects(list) => Some(list),
                _ => None,
            });
            lists.flatten().map(|index| (*index, page.as_str()))
        })
    }
}

/// Depth of a section: the parts of its number. One without a number that is inside a chapter belongs to it.
fn level(document: &Document, position: usize) -> usize {
    let sections = &document.sections;
    let parts = |number: &str| number.split('.').filter(|part| !part.is_empty()).count();
    let has_numbers = |sections: &[Section]| sections.iter().any(|section| !section.number.is_empty());
    let next = sections[position..].iter().find(|section| !section.number.is_empty());
    match parts(&sections[position].number) {
        0 if has_numbers(&sections[..position]) && next.is_some_and(|next| parts(&next.number) > 1) => 2,
        0 => 1,
        parts => parts,
    }
}

/// The anchor of a table: its number, or that of the figure that it is, or else its section and what fills it.
pub(crate) fn table_anchor(document: &Document, id: TableId) -> String {
    let section = &document.sections[id.section];
    let table = &section.tables[id.table];
    match (table.number, table.as_figure()) {
        (Some(number), _) => format!("table-{number}"),
        (None, Some(figure)) => figure_anchor(figure),
        (None, None) => {
            let has_neither = |table: &&Table| table.number.is_none() && table.as_figure().is_none();
            let before = section.tables[..id.table].iter().filter(has_neither).count();
            let anchor = format!("{}-{}", section_anchor(document, id.section), kind_of(&table.content));
            if before == 0 { anchor } else { format!("{anchor}-{}", before + 1) }
        }
    }
}

/// The anchor of a figure.
pub(crate) fn figure_anchor(figure: &Figure) -> String {
    format!("figure-{}", figure.number)
}

/// The anchor of a section: its number, or else its title and, where another has the same, its place.
pub(crate) fn section_anchor(document: &Document, section: usize) -> String {
    let name_of = |section: &Section| match section.number.as_str() {
        "" => slug(section.title.iter().next().map_or("", |(_, title)| title)),
        // Dots stay, so that the anchor of a number looks like it.
        number => number
            .trim_end_matches('.')
            .replace(|sign: char| !(sign.is_alphanumeric() || matches!(sign, '.' | '_')), "-"),
    };
    let name = name_of(&document.sections[section]);
    let before = document.sections[..section].iter().filter(|earlier| name_of(earlier) == name).count();
    if before == 0 && !name.is_empty() {
        format!("section-{name}")
    } else {
        format!("section-{name}-no-{section}")
    }
}

/// What fills a table, as the specification's key says it.
pub(crate) const fn kind_of(content: &TableContent) -> &'static str {
    match content {
        TableContent::Overview(_) => "overview",
        TableContent::Objects(_) => "objects",
        TableContent::Bits(_) => "bits",
        TableContent::Values(_) => "values",
        TableContent::Errors(_) => "errors",
        TableContent::Reactions(_) => "reactions",
        TableContent::States(_) => "states",
        TableContent::Transitions(_) => "transitions",
        TableContent::Commands(_) => "commands",
        TableContent::Ladder(_) => "ladder",
        TableContent::Timing(_) => "timing",
        TableContent::Hysteresis(_) => "hysteresis",
        TableContent::Flow(_) => "flow",
        TableContent::Axis(_) => "axis",
        TableContent::Pdos(_) => "pdos",
        TableContent::Rows { .. } => "rows",
        TableContent::Glossary => "glossary",
        TableContent::History => "history",
    }
}

/// A name of a page, which is ASCII, as file systems take it: whole words, if it has several.
fn short(page: &str) -> &str {
    let Some(cut) = page.get(..=LONGEST_PAGE) else { return page };
    cut.rsplit_once('-').map_or(&cut[..LONGEST_PAGE], |(words, _)| words)
}
