//! Tables of text, abbreviations, issues; constraints as ladders.

use od_spec::expr::{Comparison, Term};
use od_spec::model::{Constraint, Ratio, Text};

use super::Columns;
use crate::cell::entry_anchor;
use crate::language::Word;
use crate::source::{Source, relation};
use crate::view::{Cell, Grid, Ladder, Row, Rung};

impl Source<'_> {
    pub(crate) fn rows(&self, columns: &[Text], rows: &[Vec<Text>]) -> Grid {
        let mut titles = Columns::new();
        for title in columns {
            titles = titles.with("text", self.text(title).text, "left");
        }
        titles
            .full(rows.iter().map(|row| Row::of(row.iter().map(|text| self.text(text)).collect())).collect())
    }

    pub(crate) fn glossary(&self) -> Grid {
        let rows = self.document().glossary.iter();
        let rows = rows.map(|(name, text)| Row::of(vec![Cell::plain(name), self.text(text)])).collect();
        Columns::new()
            .left(self, "abbreviation", Word::Abbreviation)
            .left(self, "meaning", Word::Meaning)
            .full(rows)
    }

    pub(crate) fn history(&self) -> Grid {
        let rows = self.document().history.iter().map(|issue| {
            Row::of(vec![
                Cell::plain(&issue.number),
                Cell::plain(self.language.date(issue.date)),
                self.text(&issue.about),
            ])
        });
        Columns::new()
            .left(self, "number", Word::Issue)
            .left(self, "date", Word::Date)
            .left(self, "description", Word::Description)
            .full(rows.collect())
    }

    /// The entries of an ordering constraint, from the lowest to the highest, with their defaults.
    pub(crate) fn ladder_rows(&self, constraint: &Constraint) -> Grid {
        let mut rows = Vec::new();
        for comparison in &constraint.require.comparisons {
            for (relation, term) in steps(comparison) {
                let mut cells = vec![Cell::plain(relation)];
                if let Term::Entry(entry) = term {
                    let device = self.device_of(&constraint.devices, entry);
                    let found = device.and_then(|device| Some((device, device.entry(entry.id)?)));
                    let default = found.and_then(|(_, one)| Some(self.value(one, one.default.as_ref()?)));
                    let name = device.and_then(|device| device.entry_name(entry.id));
                    cells.push(Cell::plain(default.unwrap_or_default()));
                    cells.push(Cell::plain(name.unwrap_or_default()));
                    cells.push(self.entry_link(entry.id));
                    cells.push(Cell::plain(
                        device.map_or_else(String::new, |device| device.key.to_uppercase()),
                    ));
                } else {
                    cells.push(Cell::plain(term.to_string()));
                    cells.extend(vec![Cell::default(); 3]);
                }
                rows.push(Row::of(cells));
            }
        }
        let always: &[&str] = if self.system.devices.len() > 1 {
            &["default", "name", "object", "device"]
        } else {
            &["default", "name", "object"]
        };
        let mut grid = Columns::new()
            .center(self, "relation", Word::Relation)
            .right(self, "default", Word::Default)
            .left(self, "name", Word::Name)
            .left(self, "object", Word::Object)
            .left(self, "device", Word::Device)
            .grid(rows, always);
        if self.system.devices.len() == 1
            && let Some(at) = grid.columns.iter().position(|column| column.key == "device")
        {
            grid.columns.remove(at);
            for row in &mut grid.rows {
                row.cells.remove(at);
            }
        }
        grid
    }

    /// The constraint as a picture: a chain of at least three entries of one unit that all have defaults.
    pub(crate) fn ladder(&self, constraint: &Constraint) -> Option<Ladder> {
        let [comparison] = constraint.require.comparisons.as_slice() else { return None };
        let steps = steps(comparison);
        if steps.len() < 3 || steps.iter().any(|(relation, _)| !matches!(*relation, "" | "<" | "≤")) {
            return None;
        }
        let (mut symbol, mut rungs, mut values) = (None, Vec::new(), Vec::new());
        for (relation, term) in steps {
            let Term::Entry(entry) = term else { return None };
            let device = self.device_of(&constraint.devices, entry)?;
            let one = device.entry(entry.id)?;
            let raw = one.default.as_ref()?.integer()?;
            let unit = one.unit.as_ref()?;
            if *symbol.get_or_insert_with(|| unit.base_symbol().to_owned()) != unit.base_symbol() {
                return None;
            }
            values.push(Ratio::whole(raw).checked_mul(unit.step()?)?);
            rungs.push(Rung {
                value: self.physical(unit, raw),
                position: 0,
                relation,
                entry: entry.id.to_string(),
                anchor: entry_anchor(entry.id),
                name: device.entry_name(entry.id)?,
            });
        }
        let (low, high) = (*values.first()?, *values.last()?);
        let height = high.checked_sub(low)?;
        for (rung, value) in rungs.iter_mut().zip(&values) {
            let share = value.checked_sub(low)?.checked_div(height)?.checked_mul(Ratio::whole(1000))?;
            rung.position = u32::try_from(share.floor()).ok()?;
        }
        Some(Ladder { unit: symbol?, rungs })
    }
}

/// The terms of a chain, each with how it relates to the one before. A chain that falls is turned round.
fn steps(comparison: &Comparison) -> Vec<(&'static str, &Term)> {
    use od_spec::expr::CompareOp as Op;
    let falls =
        comparison.rest.iter().all(|(operator, _)| matches!(operator, Op::Greater | Op::GreaterOrEqual));
    if !falls {
        let rest = comparison.rest.iter().map(|(operator, term)| (relation(*operator), term));
        return std::iter::once(("", &comparison.first)).chain(rest).collect();
    }
    let terms = std::iter::once(&comparison.first).chain(comparison.rest.iter().map(|(_, term)| term));
    let terms: Vec<&Term> = terms.collect();
    let turned =
        comparison.rest.iter().rev().map(|(operator, _)| if *operator == Op::Greater { "<" } else { "≤" });
    std::iter::once("").chain(turned).zip(terms.into_iter().rev()).collect()
}
