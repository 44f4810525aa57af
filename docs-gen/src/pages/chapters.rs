//! The manual's chapters, with the texts and tables that concern the devices shown.

use std::collections::BTreeSet;

use od_spec::model::{self, Devices, Index, Prose, ProseKind, TableId, Text};

use crate::options::Gaps;
use crate::source::Source;
use crate::source::outline::{ChapterPlan, SectionPlan};
use crate::view::cell::object_anchor;
use crate::view::{Cell, Chapter, Content, ObjectName, SearchWords, Section, Table};

impl Source<'_> {
    /// Chapters that have something to show, or have sections that do.
    pub(crate) fn chapter_views(&self) -> Vec<Chapter> {
        let mut chapters = Vec::new();
        for chapter in self.outline.chapters() {
            let devices = self.devices_of_sections(chapter);
            let mut views: Vec<Section> = Vec::new();
            for (at, plan) in self.sections_shown(chapter) {
                let section = &self.document().sections[plan.position];
                let tables = &self.manual_tables()[plan.position];
                views.push(Section {
                    number: section.number.clone(),
                    title: Cell::words(&section.title, self.language),
                    anchor: self.outline.section_anchor(plan.position).to_owned(),
                    level: plan.level,
                    content: self.content(plan.position, tables, &devices[at]),
                    tables: tables.iter().flatten().cloned().collect(),
                });
            }
            let Some(first) = views.first() else { continue };
            let mut chapter = Chapter {
                number: first.number.clone(),
                title: first.title.clone(),
                page: chapter.page.clone(),
                sections: views,
                untranslated: String::new(),
            };
            chapter.untranslated = self.untranslated(chapter.foreign());
            chapters.push(chapter);
        }
        chapters
    }

    /// The sections of a chapter that concern the devices shown, each with its place in the chapter.
    pub(crate) fn sections_shown<'c>(
        &'c self,
        chapter: &'c ChapterPlan,
    ) -> impl Iterator<Item = (usize, &'c SectionPlan)> {
        let partial = self.devices.len() < self.system.devices.len();
        let is_shown =
            move |at: usize| !partial || concerns(chapter, &self.manual_tables()[chapter.positions()], at);
        chapter.sections.iter().enumerate().filter(move |(at, _)| is_shown(*at))
    }

    /// The words by which readers look for sections that are shown.
    pub(crate) fn search_words_of_sections(&self) -> Vec<SearchWords> {
        let plans = self
            .outline
            .chapters()
            .iter()
            .flat_map(|chapter| self.sections_shown(chapter).map(|(_, plan)| plan));
        let searched = plans.filter_map(|plan| {
            let phrases: Vec<String> =
                self.document().sections[plan.position].search.all().cloned().collect();
            let anchor = self.outline.section_anchor(plan.position).to_owned();
            (!phrases.is_empty()).then_some(SearchWords { anchor, phrases })
        });
        searched.collect()
    }

    /// The tables of each section of the manual, worked out once; `None` for each that the devices shown have nothing of.
    pub(crate) fn manual_tables(&self) -> &[Vec<Option<Table>>] {
        let of_section = |(section, one): (usize, &model::Section)| {
            (0..one.tables.len()).map(|table| self.table(TableId { section, table })).collect()
        };
        self.tables.get_or_init(|| self.document().sections.iter().enumerate().map(of_section).collect())
    }

    /// The devices that the texts of each section of a chapter describe: those with the objects of its tables, or of the
    /// tables around it.
    fn devices_of_sections(&self, chapter: &ChapterPlan) -> Vec<Devices> {
        let having = |plans: &[SectionPlan]| {
            let tables = plans.iter().flat_map(|plan| &self.document().sections[plan.position].tables);
            let indices: BTreeSet<Index> =
                tables.flat_map(|table| table.content.objects()).copied().collect();
            let mut having = self
                .system
                .devices
                .iter()
                .filter(|device| indices.iter().any(|index| device.objects.contains_key(index)))
                .peekable();
            having.peek().is_some().then(|| Devices::listed(having.map(|device| &device.key)))
        };
        let mut devices: Vec<Devices> = Vec::new();
        for (at, plan) in chapter.sections.iter().enumerate() {
            let around = || plan.above.map_or(Devices::All, |above| devices[above].clone());
            let own = having(chapter.below(at)).unwrap_or_else(around);
            devices.push(own);
        }
        devices
    }

    /// What is in a section, without the tables that are not shown.
    fn content(&self, section: usize, tables: &[Option<Table>], devices: &Devices) -> Vec<Content> {
        let mut warnings = 1..;
        let mut shown = 0..;
        let positions: Vec<Option<usize>> =
            tables.iter().map(|table| table.is_some().then(|| shown.next()).flatten()).collect();
        let mut of_part = |part: &model::Content| match part {
            model::Content::Table(table) => {
                let position = positions.get(*table).copied().flatten()?;
                let anchor = String::new();
                let (items, objects) = (Vec::new(), Vec::new());
                Some(Content { kind: "table", table: Some(position), items, anchor, objects })
            }
            model::Content::Prose(prose) if prose.kind == ProseKind::Gap && self.gaps != Gaps::InPlace => {
                None
            }
            model::Content::Prose(prose) => {
                let number = (prose.kind == ProseKind::Warning).then(|| warnings.next()).flatten();
                let anchor =
                    number.map(|number| format!("{}-warning-{number}", self.outline.section_anchor(section)));
                Some(Content { anchor: anchor.unwrap_or_default(), ..self.prose(prose, devices) })
            }
        };
        self.document().sections[section].content.iter().filter_map(&mut of_part).collect()
    }

    fn prose(&self, prose: &Prose, devices: &Devices) -> Content {
        let items = prose.items.iter();
        let items = match prose.kind {
            ProseKind::Steps | ProseKind::List => items.map(|item| self.text_on(devices, item)).collect(),
            ProseKind::Text | ProseKind::Note | ProseKind::Warning | ProseKind::Formula | ProseKind::Gap => {
                items.flat_map(|text| self.lines(text, devices)).collect()
            }
        };
        let objects = prose.warns_for.iter().filter_map(|index| {
            let object = self.devices.iter().find_map(|device| device.objects.get(index))?;
            Some(ObjectName {
                index: index.to_string(),
                anchor: object_anchor(*index),
                name: object.name.clone(),
            })
        });
        Content {
            kind: prose.kind.word(),
            table: None,
            items,
            anchor: String::new(),
            objects: objects.collect(),
        }
    }

    /// The lines of a text in the language of the document, or else in its first one.
    pub(crate) fn lines(&self, text: &Text, devices: &Devices) -> Vec<Cell> {
        let is_ours = |(code, _): &(&str, &str)| *code == self.language.code;
        let Some((code, words)) = text.iter().find(is_ours).or_else(|| text.iter().next()) else {
            return Vec::new();
        };
        let lines = words.lines().map(str::trim).filter(|line| !line.is_empty());
        lines.map(|line| self.text_on(devices, &Text::new([(code, line)]))).collect()
    }
}

/// Whether a section of a chapter concerns the devices shown, where others are not: it has a table of theirs, or one is
/// below it. A section of texts concerns whom the tables around it do.
fn concerns(chapter: &ChapterPlan, tables: &[Vec<Option<Table>>], at: usize) -> bool {
    let mut around = at;
    loop {
        let mut all = tables[around..chapter.sections[around].end].iter().flatten().peekable();
        if all.peek().is_some() {
            return all.any(Option::is_some);
        }
        match chapter.sections[around].above {
            Some(parent) => around = parent,
            // There is no table at all: it concerns everyone.
            None => return true,
        }
    }
}
