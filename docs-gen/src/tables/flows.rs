//! Block diagrams and axes: a row for each block, mark and span.

use od_spec::model::{Axis, AxisReach, Block, Dictionary, EntryId, Flow, NamedBits};

use super::Columns;
use crate::diagrams::axis::{self, DrawnMark, DrawnSpan};
use crate::diagrams::flow;
use crate::diagrams::flow::graph::DrawnBlock;
use crate::diagrams::label::DrawnLine;
use crate::language::Word;
use crate::source::Source;
use crate::view::{Cell, Grid, Row};

impl Source<'_> {
    /// The blocks as a table with their picture; nothing where no device shown has their entries.
    pub(crate) fn flow(&self, flow: &Flow) -> Option<Grid> {
        let device = self.having_all(flow.entries())?;
        let rows = flow.blocks.iter().map(|block| {
            let mut from = Cell::default();
            for (at, inflow) in block.from.iter().enumerate() {
                from = if at == 0 { from } else { from.line() };
                from = from.and(self.text(&flow.blocks[inflow.block].name));
                let carries = self.text(&inflow.carries);
                if !carries.is_empty() {
                    from = from.text(" (").and(carries).text(")");
                }
            }
            Row::of(vec![
                self.text(&block.name),
                from,
                self.acting(device, &block.entries, block.bits.as_ref()),
                self.text(&block.does),
            ])
        });
        let grid = Columns::new()
            .left(self, "block", Word::Block)
            .left(self, "from", Word::TakesFrom)
            .left(self, "entries", Word::ElementsOf)
            .left(self, "does", Word::Does)
            .grid(rows.collect(), &["block", "from"]);
        let blocks: Vec<DrawnBlock> = flow
            .blocks
            .iter()
            .map(|block| DrawnBlock {
                name: self.text(&block.name).text,
                lines: self.drawn_lines(device, &block.entries, block.bits.as_ref()),
                from: self.inflows(block),
            })
            .collect();
        Some(Grid { flow: Some(flow::picture(&blocks)), ..grid })
    }

    fn inflows(&self, block: &Block) -> Vec<(usize, String)> {
        block.from.iter().map(|inflow| (inflow.block, self.text(&inflow.carries).text)).collect()
    }

    /// The marks and spans as a table with their picture; nothing where no device shown has their entries.
    pub(crate) fn axis(&self, axis: &Axis) -> Option<Grid> {
        let device = self.having_all(axis.entries())?;
        let mark = |at: usize| self.text(&axis.marks[at].name);
        let marks = axis.marks.iter().map(|mark| {
            Row::of(vec![
                Cell::plain(self.word(Word::Mark)),
                self.text(&mark.name),
                Cell::default(),
                Cell::default(),
                self.acting(device, &mark.entries, None),
                Cell::default(),
            ])
        });
        let spans = axis.spans.iter().map(|span| {
            let open = || Cell::plain("…");
            let (from, to) = match span.reach {
                AxisReach::Between(from, to) => (mark(from), mark(to)),
                AxisReach::Above(from) => (mark(from), open()),
                AxisReach::Below(to) => (open(), mark(to)),
            };
            let entries = self.acting(device, &span.entries, None);
            Row::of(vec![
                Cell::plain(self.word(Word::Span)),
                self.text(&span.name),
                from,
                to,
                entries,
                self.text(&span.does),
            ])
        });
        let grid = Columns::new()
            .left(self, "kind", Word::Kind)
            .left(self, "name", Word::Name)
            .left(self, "from", Word::From)
            .left(self, "to", Word::To)
            .left(self, "entries", Word::ElementsOf)
            .left(self, "does", Word::Meaning)
            .grid(marks.chain(spans).collect(), &["kind", "name"]);
        let marks = axis.marks.iter().map(|mark| DrawnMark {
            name: self.text(&mark.name).text,
            lines: self.drawn_lines(device, &mark.entries, None),
        });
        let spans = axis.spans.iter().map(|span| DrawnSpan {
            name: self.text(&span.name).text,
            lines: self.drawn_lines(device, &span.entries, None),
            reach: span.reach,
        });
        let (marks, spans): (Vec<_>, Vec<_>) = (marks.collect(), spans.collect());
        Some(Grid { axis: Some(axis::picture(&marks, &spans)), ..grid })
    }

    /// A device shown that has all of these entries.
    fn having_all(&self, entries: impl Iterator<Item = EntryId>) -> Option<&Dictionary> {
        let entries: Vec<EntryId> = entries.collect();
        let has_all = |device: &&Dictionary| entries.iter().all(|id| device.entry(*id).is_some());
        self.devices.iter().copied().find(has_all)
    }

    /// Entries and bits, one below the other.
    fn acting(&self, device: &Dictionary, entries: &[EntryId], bits: Option<&NamedBits>) -> Cell {
        let entries = entries.iter().map(|id| self.whole_entry(device, *id));
        let bits = bits.map(|bits| Cell::plain(self.bits_line(bits)));
        let mut cells = entries.chain(bits);
        let first = cells.next().unwrap_or_default();
        cells.fold(first, |all, cell| all.line().and(cell))
    }

    fn drawn_lines(
        &self,
        device: &Dictionary,
        entries: &[EntryId],
        bits: Option<&NamedBits>,
    ) -> Vec<DrawnLine> {
        let lines = entries.iter().map(|id| DrawnLine {
            // There is no room for the name of the object before that of its entry.
            text: format!("{} {}", self.entry_link_on(device, *id).text, own_name(device, *id)),
            target: self.entry_target(device, *id),
        });
        let bits = bits.map(|bits| DrawnLine { text: self.bits_line(bits), target: self.bits_target(bits) });
        lines.chain(bits).collect()
    }

    fn bits_line(&self, bits: &NamedBits) -> String {
        let place = self.place_of_bits(bits);
        if bits.name.is_empty() { place } else { format!("{place}: {}", bits.name) }
    }

    /// A link to an entry with its name; sub-index 0 of an object with several entries is the object as a whole.
    fn whole_entry(&self, device: &Dictionary, id: EntryId) -> Cell {
        if id.sub.0 == 0 {
            return self.entry_link_on(device, id).text(format!(" {}", own_name(device, id)));
        }
        self.named_entry(device, id)
    }
}

/// The name of an entry in its object, or that of the object.
fn own_name(device: &Dictionary, id: EntryId) -> &str {
    let object = device.objects.get(&id.index);
    match (id.sub.0, object.and_then(|object| object.entry(id.sub))) {
        (1.., Some(entry)) => &entry.name,
        _ => object.map_or("", |object| &object.name),
    }
}
