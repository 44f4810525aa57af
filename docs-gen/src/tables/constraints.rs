//! Conditions between entries: a table each; those that were written as one for several numbers share theirs.

use od_spec::model::{Constraint, Devices};

use crate::language::Word;
use crate::source::Source;
use crate::source::series::{NUMBER, title};
use crate::tables::Columns;
use crate::view::{Align, Cell, PartKind, Row, Table};

/// Constraints that share a table, in order: those of one series, or one alone.
fn groups<'c>(constraints: impl Iterator<Item = &'c Constraint>) -> Vec<Vec<&'c Constraint>> {
    let mut groups: Vec<Vec<&Constraint>> = Vec::new();
    let series = |one: &Constraint| one.series.as_ref().map(|series| series.name.clone());
    for constraint in constraints {
        let own = series(constraint);
        let is_of_series = |one: &&Constraint| own.is_some() && series(one) == own;
        match groups.last_mut().filter(|group| group.iter().all(is_of_series)) {
            Some(group) => group.push(constraint),
            None => groups.push(vec![constraint]),
        }
    }
    groups
}

/// Numbers with runs drawn together: `0 … 11, 15`.
fn runs(numbers: &[u32]) -> String {
    let mut runs: Vec<(u32, u32)> = Vec::new();
    for number in numbers {
        match runs.last_mut() {
            Some((_, last)) if last.checked_add(1) == Some(*number) => *last = *number,
            Some(_) | None => runs.push((*number, *number)),
        }
    }
    let written = runs.into_iter().map(|(first, last)| match last - first {
        0 => first.to_string(),
        1 => format!("{first}, {last}"),
        _ => format!("{first} … {last}"),
    });
    written.collect::<Vec<_>>().join(", ")
}

/// The words and numbers of a text, and what is between them.
fn words(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_word = first.is_alphanumeric();
        let end = rest.find(|one: char| one.is_alphanumeric() != is_word).unwrap_or(rest.len());
        let (word, behind) = rest.split_at(end);
        words.push(word);
        rest = behind;
    }
    words
}

/// One text for several that differ in nothing but their numbers, each of which has its own; [`None`] where they differ otherwise.
fn one_text(texts: &[&str], numbers: &[u32]) -> Option<String> {
    let all: Vec<Vec<&str>> = texts.iter().map(|text| words(text)).collect();
    let (first, others) = all.split_first()?;
    if others.iter().any(|one| one.len() != first.len()) {
        return None;
    }
    let mut text = String::new();
    for (at, word) in first.iter().enumerate() {
        if others.iter().all(|one| one[at] == *word) {
            text.push_str(word);
        } else if all.iter().zip(numbers).all(|(one, number)| one[at] == number.to_string()) {
            text.push_str(NUMBER);
        } else {
            return None;
        }
    }
    Some(text)
}

/// One cell for several that differ in nothing but their numbers. A link that would lead to several places becomes text.
fn one_cell(cells: &[Cell], numbers: &[u32]) -> Option<Cell> {
    let all: Vec<Vec<_>> = cells.iter().map(|cell| cell.parts().collect()).collect();
    let (first, others) = all.split_first()?;
    let mut one = Cell::default();
    for (at, part) in first.iter().enumerate() {
        let same: Option<Vec<_>> = others.iter().map(|parts| parts.get(at)).collect();
        let same = same?;
        if same.iter().any(|other| other.kind != part.kind || other.language != part.language) {
            return None;
        }
        let texts: Vec<&str> =
            std::iter::once(part.text).chain(same.iter().map(|other| other.text)).collect();
        let text = one_text(&texts, numbers)?;
        let leads_to_one_place =
            same.iter().all(|other| (other.anchor, other.page) == (part.anchor, part.page));
        one = match part.kind {
            PartKind::Link if leads_to_one_place => {
                one.and(Cell::default().link(&text, part.anchor, part.page).all_in_language(part.language))
            }
            PartKind::Link | PartKind::Text => one.in_language(&text, part.language),
            PartKind::Strong => one.strong(text),
            PartKind::Code => one.code(text),
            PartKind::Break => one.line(),
        };
    }
    others.iter().all(|parts| parts.len() == first.len()).then_some(one)
}

impl Source<'_> {
    /// The tables of the constraints that name a device shown.
    pub(crate) fn constraints(&self) -> Vec<Table> {
        groups(self.shown_constraints()).iter().filter_map(|group| self.constraint_table(group)).collect()
    }

    fn constraint_table(&self, group: &[&Constraint]) -> Option<Table> {
        let first = group.first()?;
        let numbers: Vec<u32> =
            group.iter().filter_map(|constraint| Some(constraint.series.as_ref()?.number)).collect();
        let conditions: Vec<Cell> =
            group.iter().map(|constraint| self.condition(&constraint.require, &constraint.devices)).collect();
        let reasons: Vec<Cell> = group.iter().map(|constraint| self.text(&constraint.about)).collect();
        let exceptions: Vec<Cell> = group
            .iter()
            .map(|constraint| {
                let when = constraint.when.as_ref();
                when.map_or_else(Cell::default, |when| self.condition(when, &constraint.devices))
            })
            .collect();
        let devices: Vec<Cell> = group.iter().map(|constraint| self.devices_in_words(constraint)).collect();
        let facts = [
            (Word::Condition, conditions),
            (Word::OnlyThere, exceptions),
            (Word::On, devices),
            (Word::Because, reasons),
        ];
        let mut rows: Vec<(String, Cell)> = Vec::new();
        if !numbers.is_empty() {
            rows.push((NUMBER.to_owned(), Cell::plain(runs(&numbers))));
        }
        for (word, cells) in facts {
            let word = self.word(word);
            match one_cell(&cells, &numbers) {
                Some(cell) => rows.push((word.to_owned(), cell)),
                // What is not alike is said for each number.
                None => rows.extend(
                    cells
                        .into_iter()
                        .zip(&numbers)
                        .map(|(cell, number)| (format!("{word} ({number})"), cell)),
                ),
            }
        }
        let rows = rows.into_iter().filter(|(_, cell)| !cell.is_empty());
        let rows = rows.map(|(word, cell)| Row::of(vec![Cell::plain(word), cell]));
        let grid = Columns::new()
            .left(self, "name", Word::Constraint)
            .with("value", title(first), Align::Left)
            .full(rows.collect());
        let ladder = if group.len() == 1 { self.ladder(first) } else { None };
        let anchor = self.constraint_anchor(first);
        Some(Table { ladder, ..Table::unnumbered(anchor, "constraint", Cell::default(), vec![grid]) })
    }

    /// The devices of a constraint, where there are several to choose from.
    fn devices_in_words(&self, constraint: &Constraint) -> Cell {
        if self.system.devices.len() < 2 {
            return Cell::default();
        }
        Cell::plain(match &constraint.devices {
            Devices::All => self.word(Word::All).to_owned(),
            Devices::Only(keys) => keys.iter().map(|key| key.to_uppercase()).collect::<Vec<_>>().join(", "),
        })
    }

    /// Where links to a constraint lead.
    pub(crate) fn constraint_anchor(&self, constraint: &Constraint) -> String {
        format!("constraint-{}", self.constraint_part(&title(constraint)))
    }
}

#[cfg(test)]
mod tests {
    use super::{one_cell, one_text, runs};
    use crate::view::Cell;

    #[test]
    fn numbers_are_drawn_together() {
        assert_eq!(runs(&[0, 1, 2, 3, 7, 9, 10]), "0 … 3, 7, 9, 10");
        assert_eq!(runs(&[u32::MAX]), "4294967295");
    }

    #[test]
    fn only_the_number_of_each_may_differ() {
        assert_eq!(one_text(&["1 + bit 1", "1 + bit 2"], &[1, 2]).as_deref(), Some("1 + bit n"));
        assert_eq!(one_text(&["11 + bit 1", "11 + bit 2"], &[1, 2]).as_deref(), Some("11 + bit n"));
        assert_eq!(one_text(&["bit 1 of left", "bit 2 of right"], &[1, 2]), None);
        assert_eq!(one_text(&["bit 5", "bit 6"], &[1, 2]), None);
        assert_eq!(one_text(&["bit 1", "bit 2 or 2"], &[1, 2]), None);
    }

    #[test]
    fn a_link_that_would_lead_to_two_places_is_text() {
        let cell = |number: &str| {
            let names = Cell::plain("bloc ").link(number, format!("3061.{number}"), "");
            names.text(" of ").link("3060h", "3060", "")
        };
        let one = one_cell(&[cell("1"), cell("2")], &[1, 2]).unwrap();
        assert_eq!(one.text, "bloc n of 3060h");
        let links: Vec<&str> =
            one.parts().map(|part| part.anchor).filter(|anchor| !anchor.is_empty()).collect();
        assert_eq!(links, ["3060"]);
    }
}
