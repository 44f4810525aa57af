//! The outline of a document: which page has which section, and where links to sections, tables and objects lead.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

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
    /// The section of the chapter that it is in.
    pub above: Option<usize>,
    /// Where those below it end.
    pub end: usize,
}

impl ChapterPlan {
    fn new(page: String, first: SectionPlan) -> Self {
        Self { page, sections: vec![first] }
    }

    /// Finds what each section is in, once all are there.
    fn nest(&mut self) {
        // The sections that the next one may be in, the innermost last.
        let mut open: Vec<usize> = Vec::new();
        for at in 0..self.sections.len() {
            while let Some(last) = open.pop_if(|last| self.sections[*last].level >= self.sections[at].level) {
                self.sections[last].end = at;
            }
            self.sections[at].above = open.last().copied();
            open.push(at);
        }
        for last in open {
            self.sections[last].end = self.sections.len();
        }
    }

    /// A section and those below it.
    pub(crate) fn below(&self, at: usize) -> &[SectionPlan] {
        &self.sections[at..self.sections[at].end]
    }

    /// The positions of its sections in the document, which follow each other.
    pub(crate) fn positions(&self) -> Range<usize> {
        let first = self.sections.first().map_or(0, |plan| plan.position);
        first..first + self.sections.len()
    }
}

/// The sections of a document by chapter, and where links to them lead.
#[derive(Debug, Clone)]
pub(crate) struct Outline {
    chapters: Vec<ChapterPlan>,
    /// The anchor of each section.
    anchors: Vec<String>,
    /// The chapter that each section is in.
    chapter_of: Vec<usize>,
}

impl Outline {
    /// The outline of a system's document.
    pub(crate) fn of(system: &System) -> Self {
        let mut chapters: Vec<ChapterPlan> = Vec::new();
        let mut chapter_of = Vec::new();
        let mut taken: BTreeSet<String> = PAGES.into_iter().map(str::to_owned).collect();
        taken.extend(system.devices.iter().map(|device| device.key.clone()));
        for ((position, section), level) in
            system.document.sections.iter().enumerate().zip(levels(&system.document))
        {
            let plan = SectionPlan { position, level, above: None, end: 0 };
            match chapters.last_mut() {
                Some(chapter) if level > 1 => chapter.sections.push(plan),
                _ => {
                    let title = section.title.get(system.language()).unwrap_or_default();
                    let page = short(&slug(&format!("{} {title}", section.number))).to_owned();
                    let page = if page.is_empty() || taken.contains(&page) {
                        format!("chapter-{}", position + 1)
                    } else {
                        page
                    };
                    taken.insert(page.clone());
                    chapters.push(ChapterPlan::new(page, plan));
                }
            }
            chapter_of.push(chapters.len() - 1);
        }
        chapters.iter_mut().for_each(ChapterPlan::nest);
        Self { chapters, anchors: section_anchors(&system.document), chapter_of }
    }

    /// The chapters, in order.
    pub(crate) fn chapters(&self) -> &[ChapterPlan] {
        &self.chapters
    }

    /// The page that has a section.
    pub(crate) fn page_of(&self, section: usize) -> &str {
        &self.chapters[self.chapter_of[section]].page
    }

    /// The anchor of a section: its number, or else its title and, where another has the same, its place.
    pub(crate) fn section_anchor(&self, section: usize) -> &str {
        &self.anchors[section]
    }

    /// The anchor of a table: its number, or that of the figure that it is, or else its section and what fills it.
    pub(crate) fn table_anchor(&self, document: &Document, id: TableId) -> String {
        let section = &document.sections[id.section];
        let table = &section.tables[id.table];
        match (table.number, table.as_figure()) {
            (Some(number), _) => format!("table-{number}"),
            (None, Some(figure)) => figure_anchor(figure),
            (None, None) => {
                let has_neither = |table: &&Table| table.number.is_none() && table.as_figure().is_none();
                let before = section.tables[..id.table].iter().filter(has_neither).count();
                let anchor = format!("{}-{}", self.section_anchor(id.section), kind_of(&table.content));
                if before == 0 { anchor } else { format!("{anchor}-{}", before + 1) }
            }
        }
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
        self.chapters.iter().flat_map(move |ChapterPlan { page, sections }| {
            let tables = sections.iter().flat_map(|plan| &document.sections[plan.position].tables);
            let lists = tables.filter_map(|table| match &table.content {
                TableContent::Objects(list) => Some(list),
                _ => None,
            });
            lists.flatten().map(|index| (*index, page.as_str()))
        })
    }
}

/// Depth of each section: the parts of its number. One without a number that is inside a chapter belongs to it.
fn levels(document: &Document) -> Vec<usize> {
    let parts = |section: &Section| section.number.split('.').filter(|part| !part.is_empty()).count();
    // Of a section without a number, whether the next one with a number is below a chapter: from the end.
    let (mut levels, mut is_below) = (Vec::new(), false);
    for section in document.sections.iter().rev() {
        levels.push(if section.number.is_empty() { usize::from(is_below) * 2 } else { parts(section) });
        if !section.number.is_empty() {
            is_below = parts(section) > 1;
        }
    }
    levels.reverse();
    let first = document.sections.iter().position(|section| !section.number.is_empty());
    for (at, level) in levels.iter_mut().enumerate() {
        // What comes before the first chapter is a chapter of its own.
        if *level == 0 || first.is_none_or(|first| at < first) {
            *level = 1;
        }
    }
    levels
}

/// The anchor of a figure.
pub(crate) fn figure_anchor(figure: &Figure) -> String {
    format!("figure-{}", figure.number)
}

/// The anchors of all sections.
fn section_anchors(document: &Document) -> Vec<String> {
    let name_of = |section: &Section| match section.number.as_str() {
        "" => slug(section.title.iter().next().map_or("", |(_, title)| title)),
        // Dots stay, so that the anchor of a number looks like it.
        number => number
            .trim_end_matches('.')
            .replace(|sign: char| !(sign.is_alphanumeric() || matches!(sign, '.' | '_')), "-"),
    };
    let mut before: BTreeSet<String> = BTreeSet::new();
    let anchor = |(at, section): (usize, &Section)| {
        let name = name_of(section);
        let is_new = before.insert(name.clone());
        if is_new && !name.is_empty() { format!("section-{name}") } else { format!("section-{name}-no-{at}") }
    };
    document.sections.iter().enumerate().map(anchor).collect()
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
