//! Texts that are in another language than the document, because the specification has them in no other.

use crate::view::{Appendix, Cell, Chapter, DeviceView, ObjectView, Table};

impl Cell {
    /// The language of the first of its parts that is not in that of the document.
    fn foreign(&self) -> Option<&str> {
        self.spans.iter().map(|span| &*span.language).find(|language| !language.is_empty())
    }
}

/// The first language of texts that is not that of the document.
fn first<'a>(cells: impl IntoIterator<Item = &'a Cell>) -> Option<&'a str> {
    cells.into_iter().find_map(Cell::foreign)
}

impl Table {
    fn foreign(&self) -> Option<&str> {
        let heads = self.grids.iter().filter_map(|grid| grid.object.as_ref());
        let rows = self.grids.iter().flat_map(|grid| grid.rows.iter());
        first([&self.title, &self.about])
            .or_else(|| first(self.figure.iter().map(|figure| &figure.title)))
            .or_else(|| first(heads.flat_map(|head| [&head.about, &head.warning])))
            .or_else(|| first(rows.flat_map(|row| &row.cells)))
    }
}

impl ObjectView {
    fn foreign(&self) -> Option<&str> {
        first([&self.about, &self.warning])
            .or_else(|| first(&self.notes))
            .or_else(|| self.table.foreign())
            .or_else(|| self.types.iter().find_map(Table::foreign))
            .or_else(|| first(self.used.iter().flat_map(|used| &used.lines)))
    }
}

impl Chapter {
    /// The other language that texts of the chapter are in.
    pub(crate) fn foreign(&self) -> Option<&str> {
        self.sections.iter().find_map(|section| {
            first([&section.title])
                .or_else(|| section.tables.iter().find_map(Table::foreign))
                .or_else(|| first(section.content.iter().flat_map(|part| &part.items)))
        })
    }
}

impl DeviceView {
    /// The other language that texts of the objects are in. What an erratum quotes is in that of the manual anyway.
    pub(crate) fn foreign(&self) -> Option<&str> {
        first([&self.about]).or_else(|| self.objects.iter().find_map(ObjectView::foreign))
    }
}

impl Appendix {
    /// The other language that texts of the appendix are in.
    pub(crate) fn foreign(&self) -> Option<&str> {
        self.tables.iter().find_map(Table::foreign)
    }
}
