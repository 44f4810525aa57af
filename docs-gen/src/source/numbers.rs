//! Where the numbered tables, figures and sections of the manual are in a document, and links to them in running text.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

use od_spec::model::TableId;
use od_spec::running_text::{Numbered, mentions};

use crate::source::Source;
use crate::view::{Cell, Target};

/// Where each number is in a document; filled when the first text names one.
pub(crate) type Numbers = OnceCell<BTreeMap<(Numbered, String), Target>>;

impl Source<'_> {
    /// The numbers in a text that the document has, each as a link.
    pub(crate) fn links_to_numbers(&self, text: &str) -> impl Iterator<Item = (Range<usize>, Cell)> {
        mentions(text).into_iter().filter_map(|mention| {
            let numbers = self.numbers.get_or_init(|| self.numbers_shown());
            let Target { anchor, page } = numbers.get(&(mention.kind, mention.number.to_owned()))?.clone();
            Some((mention.range.clone(), Cell::default().link(&text[mention.range], anchor, page)))
        })
    }

    /// What the chapters show of the devices that have a page. One number may be there twice: the first counts.
    fn numbers_shown(&self) -> BTreeMap<(Numbered, String), Target> {
        let (all, mut numbers) = (self.of_all_pages(), BTreeMap::new());
        for chapter in all.outline.chapters() {
            let mut add = |kind, number: &str, anchor: String| {
                let number = number.trim_end_matches('.').to_owned();
                let page = chapter.page.clone();
                numbers.entry((kind, number)).or_insert(Target { anchor, page });
            };
            for (_, plan) in all.sections_shown(chapter) {
                let section = &all.document().sections[plan.position];
                let anchor = all.outline.section_anchor(plan.position).to_owned();
                add(Numbered::Section, &section.number, anchor);
                for (at, table) in section.tables.iter().enumerate() {
                    if table.number.is_none() && table.figure.is_none() {
                        continue;
                    }
                    let Some(table) = all.table(TableId { section: plan.position, table: at }) else {
                        continue;
                    };
                    if let Some(number) = table.number {
                        add(Numbered::Table, &number.to_string(), table.anchor);
                    }
                    if let Some(figure) = table.figure {
                        add(Numbered::Figure, &figure.number.to_string(), figure.anchor);
                    }
                }
            }
        }
        numbers
    }

    /// The same for the whole document, in whose texts no number is a link: what is shown does not depend on links.
    fn of_all_pages(&self) -> Self {
        let mut all = self.clone();
        all.devices.clone_from(&self.with_page);
        all.numbers = Rc::new(OnceCell::from(BTreeMap::new()));
        all.tables = Rc::default();
        all
    }
}
