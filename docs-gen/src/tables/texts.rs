//! Tables of text, abbreviations, issues; constraints as ladders.

use od_spec::expr::{Comparison, EntryRef, Term};
use od_spec::model::{Constraint, Devices, Dictionary, Document, EntryId, Issue, Ratio, Text};

use super::Columns;
use super::variants::device_keys;
use crate::language::Word;
use crate::source::Source;
use crate::source::conditions::relation;
use crate::view::cell::entry_anchor;
use crate::view::{Align, Cell, Grid, Ladder, Row, Rung};

impl Source<'_> {
    pub(crate) fn rows(&self, columns: &[Text], rows: &[Vec<Text>]) -> Grid {
        let mut titles = Columns::new();
        for title in columns {
            titles = titles.with("text", self.text(title).text, Align::Left);
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

    /// The issues of the manual. The last is the one that the specification holds, where only that says what changed in it.
    pub(crate) fn history(&self) -> Grid {
        let Document { history, revision, .. } = self.document();
        let is_listed = |revision: &Issue| history.iter().any(|issue| issue.number == revision.number);
        let latest = revision.iter().filter(|revision| !revision.about.is_empty() && !is_listed(revision));
        let rows = history.iter().chain(latest).map(|issue| {
            Row::of(vec![
                Cell::plain(&issue.number),
                Cell::plain(self.wording.language.date(issue.date)),
                self.quoted(&issue.about),
            ])
        });
        Columns::new()
            .left(self, "number", Word::Issue)
            .left(self, "date", Word::Date)
            .left(self, "description", Word::Description)
            .full(rows.collect())
    }

    /// The entries of an ordering constraint, from the lowest to the highest, with their defaults and what they are called there.
    pub(crate) fn ladder_rows(&self, constraint: &Constraint, labels: &[Text]) -> Grid {
        let (mut rows, mut labels) = (Vec::new(), labels.iter());
        let alternatives = constraint.require.alternatives.iter().enumerate();
        let comparisons = alternatives.flat_map(|(alternative, all)| {
            all.iter().enumerate().map(move |(at, comparison)| (alternative > 0 && at == 0, comparison))
        });
        for (is_alternative, comparison) in comparisons {
            if is_alternative {
                let mut cells = vec![Cell::plain(self.word(Word::Or))];
                cells.extend(vec![Cell::default(); 5]);
                rows.push(Row::of(cells));
            }
            for (relation, term) in steps(comparison) {
                let mut cells = vec![Cell::plain(relation)];
                if let Term::Entry(entry) = term {
                    cells.push(labels.next().map_or_else(Cell::default, |label| self.text(label)));
                    let devices = self.devices_of(constraint, entry);
                    let name = devices.first().and_then(|device| device.entry_name(entry.id));
                    cells.push(Cell::plain(self.defaults(&devices, entry.id)));
                    cells.push(Cell::plain(name.unwrap_or_default()));
                    let linked = Devices::Only(devices.iter().map(|device| device.key.clone()).collect());
                    cells.push(self.link_on(
                        &linked,
                        entry.id.index,
                        entry.id.to_string(),
                        entry_anchor(entry.id),
                    ));
                    let several = self.system.devices.len() > 1;
                    cells.push(Cell::plain(if several { device_keys(&devices) } else { String::new() }));
                } else {
                    let symbol = self.symbol_of(constraint, comparison);
                    cells.push(Cell::default());
                    cells.push(self.term(term, &constraint.devices, &symbol));
                    cells.extend(vec![Cell::default(); 3]);
                }
                rows.push(Row::of(cells));
            }
        }
        Columns::new()
            .center(self, "relation", Word::Relation)
            .left(self, "meaning", Word::Meaning)
            .right(self, "default", Word::Default)
            .left(self, "name", Word::Name)
            .left(self, "object", Word::Object)
            .left(self, "device", Word::Device)
            .grid(rows, &["default", "name", "object"])
    }

    /// The devices whose entry a constraint means: those that are shown, or else any.
    fn devices_of(&self, constraint: &Constraint, entry: &EntryRef) -> Vec<&Dictionary> {
        let is_named = |device: &&Dictionary| match &entry.device {
            Some(key) => device.key == *key,
            None => constraint.devices.includes(&device.key),
        };
        let has = |device: &&Dictionary| device.entry(entry.id).is_some();
        let shown: Vec<&Dictionary> = self.devices.iter().copied().filter(is_named).filter(has).collect();
        if shown.is_empty() {
            self.device_of(&constraint.devices, entry).into_iter().collect()
        } else {
            shown
        }
    }

    /// The default of an entry; of each device where they differ.
    fn defaults(&self, devices: &[&Dictionary], id: EntryId) -> String {
        let default_on = |device: &Dictionary| {
            device
                .entry(id)
                .and_then(|entry| Some(self.wording.value(Some(id.index), entry, entry.default.as_ref()?)))
                .unwrap_or_default()
        };
        let all: Vec<String> = devices.iter().map(|device| default_on(device)).collect();
        match all.as_slice() {
            [first, rest @ ..] if rest.iter().all(|value| value == first) => first.clone(),
            _ => {
                let pairs = all
                    .iter()
                    .zip(devices)
                    .map(|(value, device)| format!("{value} ({})", device_keys(&[*device])));
                pairs.collect::<Vec<_>>().join(", ")
            }
        }
    }

    /// The symbol in which a comparison is made.
    fn symbol_of(&self, constraint: &Constraint, comparison: &Comparison) -> String {
        let terms = std::iter::once(&comparison.first).chain(comparison.rest.iter().map(|(_, term)| term));
        terms.into_iter().find_map(|term| self.symbol(term, &constraint.devices)).unwrap_or_default()
    }

    /// The constraint as a picture: a chain of at least three entries of one unit that all have defaults.
    pub(crate) fn ladder(&self, constraint: &Constraint) -> Option<Ladder> {
        let [comparisons] = constraint.require.alternatives.as_slice() else { return None };
        let [comparison] = comparisons.as_slice() else { return None };
        let steps = steps(comparison);
        if steps.len() < 3 || steps.iter().any(|(relation, _)| !matches!(*relation, "" | "<" | "≤")) {
            return None;
        }
        let (mut symbol, mut rungs, mut values) = (None, Vec::new(), Vec::new());
        for (relation, term) in steps {
            let Term::Entry(entry) = term else { return None };
            let devices = self.devices_of(constraint, entry);
            let (device, others) = devices.split_first()?;
            let rung = device.entry(entry.id)?;
            // Devices with different defaults would have different ladders.
            let has_same = |device: &&Dictionary| {
                device.entry(entry.id).is_some_and(|entry| entry.default == rung.default)
            };
            if !others.iter().all(has_same) {
                return None;
            }
            let raw = rung.default.as_ref()?.integer()?;
            let unit = rung.unit.as_ref()?;
            if *symbol.get_or_insert_with(|| unit.base_symbol().to_owned()) != unit.base_symbol() {
                return None;
            }
            values.push(unit.quantity(raw)?);
            rungs.push(Rung {
                value: self.wording.physical(unit, raw),
                position: 0,
                relation,
                entry: entry.id.to_string(),
                anchor: entry_anchor(entry.id),
                name: device.entry_name(entry.id)?,
                target: self.entry_target(device, entry.id),
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
