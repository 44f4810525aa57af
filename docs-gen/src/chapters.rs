//! The manual's chapters, with the tables that the devices shown have something of.

use od_spec::model::TableId;

use crate::outline::section_anchor;
use crate::source::Source;
use crate::view::{Chapter, Section, Table};

impl Source<'_> {
    /// Chapters that have something to show, or have sections that do.
    pub(crate) fn chapter_views(&self) -> Vec<Chapter> {
        let partial = self.devices.len() < self.system.devices.len();
        let mut chapters = Vec::new();
        for chapter in self.outline.chapters() {
            let mut views: Vec<Section> = Vec::new();
            for plan in &chapter.sections {
                let section = &self.document().sections[plan.position];
                let ids = (0..section.tables.len()).map(|table| TableId { section: plan.position, table });
                let tables: Vec<Table> = ids.filter_map(|id| self.table(id)).collect();
                if partial && tables.is_empty() && !section.tables.is_empty() {
                    continue;
                }
                views.push(Section {
                    number: section.number.clone(),
                    title: self.text(&section.title),
                    anchor: section_anchor(self.document(), plan.position),
                    level: plan.level,
                    tables,
                });
            }
            if partial {
                remove_empty(&mut views);
            }
            let Some(first) = views.first() else { continue };
            chapters.push(Chapter {
                number: first.number.clone(),
                title: first.title.clone(),
                page: chapter.page.clone(),
                sections: views,
            });
        }
        chapters
    }
}

/// Removes headings below which nothing is left.
fn remove_empty(sections: &mut Vec<Section>) {
    let mut at = sections.len();
    while at > 0 {
        at -= 1;
        let below = sections.get(at + 1).is_some_and(|next| next.level > sections[at].level);
        if sections[at].tables.is_empty() && !below {
            sections.remove(at);
        }
    }
}
