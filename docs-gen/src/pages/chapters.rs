//! The manual's chapters, with the texts and tables that concern the devices shown.

use std::collections::BTreeSet;

use od_spec::model::{self, Devices, Index, Prose, ProseKind, TableId, Text};

use crate::options::Gaps;
use crate::source::Source;
use crate::source::outline::{ChapterPlan, section_anchor};
use crate::view::cell::object_anchor;
use crate::view::{Cell, Chapter, Content, ObjectName, Section, Table};

impl Source<'_> {
    /// Chapters that have something to show, or have sections that do.
    pub(crate) fn chapter_views(&self) -> Vec<Chapter> {
        let partial = self.devices.len() < self.system.devices.len();
        let mut chapters = Vec::new();
        for chapter in self.outline.chapters() {
            let tables: Vec<Vec<Option<Table>>> =
                chapter.sections.iter().map(|plan| self.tables_of(plan.position)).collect();
            let is_shown = |at: usize| !partial || concerns(chapter, &tables, at);
            let mut views: Vec<Section> = Vec::new();
            for (at, (plan, tables)) in chapter.sections.iter().zip(&tables).enumerate() {
                if !is_shown(at) {
                    continue;
                }
                let section = &self.document().sections[plan.position];
                views.push(Section {
                    number: section.number.clone(),
                    title: Cell::words(&section.title, self.language),
                    anchor: section_anchor(self.document(), plan.position),
                    level: plan.level,
                    content: self.content(plan.position, tables, &self.devices_of_section(chapter, at)),
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

    /// The tables of a section; `None` for each that the devices shown have nothing of.
    fn tables_of(&self, section: usize) -> Vec<Option<Table>> {
        let count = self.document().sections[section].tables.len();
        (0..count).map(|table| self.table(TableId { section, table })).collect()
    }

    /// The devices that the texts of a section describe: those with the objects of its tables, or of the tables around
    /// it.
    fn devices_of_section(&self, chapter: &ChapterPlan, at: usize) -> Devices {
        let mut around = at;
        loop {
            let sections = chapter.sections[below(chapter, around)].iter();
            let tables = sections.flat_map(|plan| &self.document().sections[plan.position].tables);
            let indices: BTreeSet<Index> =
                tables.flat_map(|table| table.content.objects()).copied().collect();
            let having = self.system.devices.iter();
            let mut having = having
                .filter(|device| indices.iter().any(|index| device.objects.contains_key(index)))
                .peekable();
            if having.peek().is_some() {
                return Devices::listed(having.map(|device| &device.key));
            }
            match above(chapter, around) {
                Some(parent) => around = parent,
                None => return Devices::All,
            }
        }
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
                let anchor = number
                    .map(|number| format!("{}-warning-{number}", section_anchor(self.document(), section)));
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
        let below = below(chapter, around);
        let mut all = tables[below].iter().flatten().peekable();
        if all.peek().is_some() {
            return all.any(Option::is_some);
        }
        match above(chapter, around) {
            Some(parent) => around = parent,
            // There is no table at all: it concerns everyone.
            None => return true,
        }
    }
}

/// A section and those below it.
fn below(chapter: &ChapterPlan, at: usize) -> std::ops::Range<usize> {
    let level = chapter.sections[at].level;
    let next = chapter.sections[at + 1..].iter().position(|plan| plan.level <= level);
    at..next.map_or(chapter.sections.len(), |next| at + 1 + next)
}

/// The section that a section is in.
fn above(chapter: &ChapterPlan, at: usize) -> Option<usize> {
    let level = chapter.sections[at].level;
    chapter.sections[..at].iter().rposition(|plan| plan.level < level)
}
