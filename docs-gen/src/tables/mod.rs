//! From the contents of a table to its columns and rows.

pub(crate) mod bits;
mod changes;
pub(crate) mod constraints;
pub(crate) mod errors;
mod flows;
mod hysteresis;
pub(crate) mod machines;
pub(crate) mod objects;
pub(crate) mod overview;
pub(crate) mod pdos;
pub(crate) mod texts;
mod timings;
pub(crate) mod variants;

use od_spec::model::{
    BitTable, Constraint, Content, Dictionary, Index, LadderTable, NamedType, TableContent, TableId, TypeKind,
};
use od_spec::order::Arrange as _;

use crate::language::Word;
use crate::source::Source;
use crate::source::outline::{figure_anchor, kind_of};
use crate::view::{Align, Cell, Column, FigureView, Grid, Mark, Row, Table};

/// Columns, each with what it holds, its title and its alignment.
pub(crate) struct Columns(Vec<Column>);

impl Columns {
    /// No columns yet.
    pub(crate) const fn new() -> Self {
        Self(Vec::new())
    }

    /// With a column of its own title after the others.
    pub(crate) fn with(mut self, key: &'static str, title: impl Into<String>, align: Align) -> Self {
        self.0.push(Column { key, title: title.into(), align });
        self
    }

    /// With a column of texts.
    pub(crate) fn left(self, source: &Source<'_>, key: &'static str, word: Word) -> Self {
        self.with(key, source.word(word), Align::Left)
    }

    /// With a column of numbers.
    pub(crate) fn right(self, source: &Source<'_>, key: &'static str, word: Word) -> Self {
        self.with(key, source.word(word), Align::Right)
    }

    /// With a column of marks.
    pub(crate) fn center(self, source: &Source<'_>, key: &'static str, word: Word) -> Self {
        self.with(key, source.word(word), Align::Center)
    }

    /// A grid of these columns without those that nothing fills, apart from those that are always there.
    pub(crate) fn grid(self, rows: Vec<Row>, always: &[&str]) -> Grid {
        let keep: Vec<bool> = self
            .0
            .iter()
            .enumerate()
            .map(|(at, column)| {
                always.contains(&column.key) || rows.iter().any(|row| !row.cells[at].is_empty())
            })
            .collect();
        let kept = |at: usize| keep.get(at).copied().unwrap_or(true);
        let columns: Vec<Column> =
            self.0.into_iter().enumerate().filter(|(at, _)| kept(*at)).map(|(_, column)| column).collect();
        let rows = rows.into_iter().map(|mut row| {
            let cells = row.cells.into_iter().enumerate().filter(|(at, _)| kept(*at)).map(|(_, cell)| cell);
            let mut cells: Vec<Cell> = cells.collect();
            cells.shrink_to_fit();
            for mark in &mut row.errata {
                if columns.iter().all(|column| column.key != mark.column) {
                    mark.column = "";
                }
            }
            Row { cells, ..row }
        });
        let rows = rows.collect();
        Grid { columns, rows, ..Grid::default() }
    }

    /// A grid of all columns.
    pub(crate) fn full(self, rows: Vec<Row>) -> Grid {
        Grid { columns: self.0, rows: rows.into_iter().collect(), ..Grid::default() }
    }
}

impl Row {
    /// A row without a place to link to.
    pub(crate) fn of(cells: Vec<Cell>) -> Self {
        Self { cells, ..Self::default() }
    }
}

impl Grid {
    /// Whether it has a picture.
    const fn is_drawn(&self) -> bool {
        let Self { object: _, columns: _, rows: _, bits, machine, timing, hysteresis, flow, axis } = self;
        bits.is_some()
            || machine.is_some()
            || timing.is_some()
            || hysteresis.is_some()
            || flow.is_some()
            || axis.is_some()
    }
}

impl Table {
    /// A table that the manual does not number.
    pub(crate) fn unnumbered(
        anchor: impl Into<String>,
        kind: &'static str,
        title: Cell,
        grids: Vec<Grid>,
    ) -> Self {
        Self {
            anchor: anchor.into(),
            number: None,
            title,
            figure: None,
            about: Cell::default(),
            kind,
            grids,
            ladder: None,
            errata: Vec::new(),
        }
    }
}

/// What is listed, in the order of these numbers; as it is where there are none. The language has each number once.
fn in_order<T: Clone>(list: &[T], order: &[i128], number: impl Fn(&T) -> i128) -> Vec<T> {
    let place = |one: &T| order.iter().position(|at| *at == number(one));
    let mut list = list.to_vec();
    list.arrange_by_key(place);
    list
}

impl Source<'_> {
    /// A table of the manual; `None` when the devices shown have nothing of it.
    pub(crate) fn table(&self, id: TableId) -> Option<Table> {
        let table = &self.document().sections[id.section].tables[id.table];
        let (mut ladder, mut about) = (None, Cell::default());
        let grids = match &table.content {
            TableContent::Overview(list) => vec![self.overview(list)],
            TableContent::Objects(list) => {
                let warned = self.warned_in(id.section);
                self.details(list, |index| self.details_first(id, index), &warned)
            }
            TableContent::Bits(BitTable { named_type, masks }) => {
                let named = self.shown_type(named_type)?;
                about = self.text(&named.about);
                let TypeKind::Bits(fields) = &named.kind else { return None };
                let fields = in_order(fields, &table.order, |field| field.first.into());
                vec![self.bits(named, &fields, *masks)]
            }
            TableContent::Values(name) => {
                let named = self.shown_type(name)?;
                about = self.text(&named.about);
                let TypeKind::Enum(values) = &named.kind else { return None };
                let values = in_order(values, &table.order, |value| value.value);
                vec![self.values(named, &values)]
            }
            TableContent::Errors(codes) => vec![self.errors(codes)],
            TableContent::Reactions(codes) => vec![self.reactions(codes)],
            TableContent::States(name) => vec![self.states(self.machine(name)?)],
            TableContent::Transitions(name) => vec![self.transitions(self.machine(name)?)],
            TableContent::Commands(name) => {
                let machine = self.machine(name)?;
                about = self.about_commands(machine);
                vec![self.commands(machine)]
            }
            TableContent::Ladder(LadderTable { constraint: name, labels }) => {
                let constraint =
                    self.system.constraints.iter().find(|constraint| &constraint.name == name)?;
                ladder = self.ladder(constraint);
                about = self.text(&constraint.about);
                vec![self.ladder_rows(constraint, labels)]
            }
            TableContent::Flow(flow) => vec![self.flow(flow)?],
            TableContent::Axis(axis) => vec![self.axis(axis)?],
            TableContent::Hysteresis(switches) => vec![self.hysteresis(switches)?],
            TableContent::Timing(timing) => vec![self.timing(timing)?],
            TableContent::Pdos(pdos) => {
                let device = self.devices.iter().find(|device| device.key == pdos.device)?;
                vec![self.pdo_rows(device, pdos.direction)]
            }
            TableContent::Rows { columns, rows } => vec![self.rows(columns, rows)],
            TableContent::Glossary => vec![self.glossary()],
            TableContent::History => vec![self.history()],
        };
        let grids: Vec<Grid> = grids.into_iter().filter(|grid| !grid.rows.is_empty()).collect();
        if grids.is_empty() {
            return None;
        }
        // Devices that differ may leave nothing to be drawn.
        let is_drawn = ladder.is_some() || grids.iter().any(Grid::is_drawn);
        let figure = table.figure.as_ref().filter(|_| is_drawn).map(|figure| FigureView {
            number: figure.number,
            anchor: figure_anchor(figure),
            title: self.text(&figure.title),
        });
        Some(Table {
            anchor: self.outline.table_anchor(self.document(), id),
            number: table.number,
            title: self.text(&table.title),
            figure,
            about,
            kind: kind_of(&table.content),
            grids,
            ladder,
            errata: self.errata_of_table(id),
        })
    }

    /// The objects whose warnings the texts of a section say.
    fn warned_in(&self, section: usize) -> Vec<Index> {
        let prose = self.document().sections[section].content.iter().filter_map(|part| match part {
            Content::Prose(prose) => Some(prose),
            Content::Table(_) => None,
        });
        prose.flat_map(|prose| prose.warns_for.iter().copied()).collect()
    }

    /// A named type that a device shown has.
    fn shown_type(&self, name: &str) -> Option<&NamedType> {
        self.system.types.get(name).filter(|_| self.shows_type(name)).map(|named| &**named)
    }

    /// Whether a device shown has an entry of the type, or no device at all.
    fn shows_type(&self, name: &str) -> bool {
        let has = |device: &Dictionary| {
            device
                .entries()
                .any(|(.., entry)| entry.named_type.as_ref().is_some_and(|named| named.name == name))
        };
        self.devices.iter().any(|device| has(device)) || !self.system.devices.iter().any(has)
    }

    /// The constraints that name a device shown.
    pub(crate) fn shown_constraints(&self) -> impl Iterator<Item = &Constraint> {
        self.system.constraints.iter().filter(|constraint| self.shows_any(&constraint.devices))
    }

    /// Marks of the errata whose place names the table.
    pub(crate) fn errata_of_table(&self, id: TableId) -> Vec<Mark> {
        self.errata_naming(id).iter().map(|at| self.mark(*at, "")).collect()
    }

    /// The mark of an erratum in a column.
    pub(crate) fn mark(&self, at: usize, column: &'static str) -> Mark {
        Mark { number: at + 1, kind: self.wording.erratum_kind(self.system.errata[at].kind), column }
    }

    /// A state machine, if a device shown has it.
    pub(crate) fn machine(&self, name: &str) -> Option<&od_spec::model::StateMachine> {
        self.system.machines.get(name).filter(|machine| self.shows_any(&machine.devices))
    }
}
