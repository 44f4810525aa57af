//! Conditions between entries, in words.

use od_spec::expr::{ArithmeticOp, CompareOp, EntryRef, Expr, Term};
use od_spec::model::{Devices, Dictionary, Ratio, TypeKind};

use crate::language::Word;
use crate::source::Source;
use crate::view::Cell;
use crate::view::cell::entry_anchor;

impl<'a> Source<'a> {
    /// The device of an entry that a condition names: the one it says, or else one that is shown.
    pub(crate) fn device_of(&self, devices: &Devices, entry: &EntryRef) -> Option<&'a Dictionary> {
        let is_named = |device: &&Dictionary| match &entry.device {
            Some(key) => &device.key == key,
            None => devices.includes(&device.key) && device.entry(entry.id).is_some(),
        };
        self.devices.iter().copied().find(is_named).or_else(|| self.system.devices.iter().find(is_named))
    }

    /// A condition in words: names with links instead of bare indices, numbers with the unit they are compared in.
    pub(crate) fn condition(&self, condition: &Expr, devices: &Devices) -> Cell {
        let mut cell = Cell::default();
        let numbered = condition.alternatives.iter().enumerate();
        let numbered = numbered.flat_map(|(alternative, all)| {
            all.iter().enumerate().map(move |(at, comparison)| (alternative, at, comparison))
        });
        for (alternative, at, comparison) in numbered {
            if at > 0 {
                cell = cell.text(format!(" {} ", self.word(Word::And)));
            } else if alternative > 0 {
                cell = cell.text(format!(" {} ", self.word(Word::Or)));
            }
            let rest = comparison.rest.iter().map(|(_, term)| term);
            let terms = std::iter::once(&comparison.first).chain(rest);
            let symbol = terms.into_iter().find_map(|term| self.symbol(term, devices)).unwrap_or_default();
            let printer = TermPrinter { source: self, devices, symbol: &symbol };
            cell = printer.term(cell, &comparison.first);
            let mut left = &comparison.first;
            for (operator, term) in &comparison.rest {
                cell = cell.text(format!(" {} ", relation(*operator)));
                cell = printer.term(cell, term);
                if let Some(name) = self.value_name(left, term, devices) {
                    cell = cell.text(format!(" ({name})"));
                }
                left = term;
            }
        }
        cell
    }

    /// The symbol in which a term is compared: that of its unit's base.
    pub(crate) fn symbol(&self, term: &Term, devices: &Devices) -> Option<String> {
        match term {
            Term::Number(_) | Term::Bit(..) => None,
            Term::Entry(entry) => {
                let unit = self.device_of(devices, entry)?.entry(entry.id)?.unit.as_ref()?;
                Some(unit.base_symbol().to_owned())
            }
            Term::Binary(left, ArithmeticOp::Add | ArithmeticOp::Subtract, right) => {
                self.symbol(left, devices).or_else(|| self.symbol(right, devices))
            }
            Term::Binary(left, ArithmeticOp::Multiply, right) => {
                match (self.symbol(left, devices), self.symbol(right, devices)) {
                    (Some(symbol), None) | (None, Some(symbol)) => Some(symbol),
                    _ => None,
                }
            }
            Term::Binary(left, ArithmeticOp::Divide, right) => {
                self.symbol(left, devices).filter(|_| self.symbol(right, devices).is_none())
            }
        }
    }

    /// The name of the number that an enum is compared with.
    fn value_name(&self, left: &Term, right: &Term, devices: &Devices) -> Option<&'a str> {
        let (Term::Entry(entry), Term::Number(number)) = (left, right) else { return None };
        let named = self.device_of(devices, entry)?.entry(entry.id)?.named_type.as_ref()?;
        let TypeKind::Enum(values) = &named.kind else { return None };
        let value = values.iter().find(|value| Some(value.value) == number.to_whole())?;
        Some(&value.name)
    }

    /// A term by itself; a number in it is in the unit of `symbol`.
    pub(crate) fn term(&self, term: &Term, devices: &Devices, symbol: &str) -> Cell {
        TermPrinter { source: self, devices, symbol }.term(Cell::default(), term)
    }
}

/// How strongly operators bind, from the weakest: what binds less than its surroundings needs brackets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Nothing,
    Sum,
    Product,
    Sign,
}

/// Prints the terms of one comparison.
struct TermPrinter<'s, 'a> {
    source: &'s Source<'a>,
    /// Devices that entries without a device of their own belong to.
    devices: &'s Devices,
    /// The unit in which numbers are compared or added; may be empty.
    symbol: &'s str,
}

impl TermPrinter<'_, '_> {
    fn term(&self, cell: Cell, term: &Term) -> Cell {
        self.inside(cell, term, Binding::Nothing)
    }

    /// A term inside an operation that binds so.
    fn inside(&self, cell: Cell, term: &Term, around: Binding) -> Cell {
        match term {
            Term::Number(number) => {
                let number = self.source.wording.decimal(&number.to_string());
                cell.text(self.source.wording.quantity(&number, self.symbol))
            }
            Term::Entry(entry) => self.operand(cell, entry),
            Term::Bit(entry, bit) => {
                let words = self.source.sentence(Word::BitOf, &bit.to_string());
                self.operand(cell.text(format!("{words} ")), entry)
            }
            Term::Binary(left, ArithmeticOp::Subtract, right) if **left == Term::Number(Ratio::whole(0)) => {
                self.inside(cell.text("−"), right, Binding::Sign)
            }
            Term::Binary(left, operator, right) => {
                // A factor is a bare number. The right side of `-` and `/` needs brackets at its own level, too.
                let (sign, binding, on_the_right, symbol) = match operator {
                    ArithmeticOp::Add => ("+", Binding::Sum, Binding::Sum, self.symbol),
                    ArithmeticOp::Subtract => ("−", Binding::Sum, Binding::Product, self.symbol),
                    ArithmeticOp::Multiply => ("×", Binding::Product, Binding::Product, ""),
                    ArithmeticOp::Divide => ("/", Binding::Product, Binding::Sign, ""),
                };
                let operands = TermPrinter { symbol, ..*self };
                let needs_brackets = binding < around;
                let cell = if needs_brackets { cell.text("(") } else { cell };
                let cell = operands.inside(cell, left, binding).text(format!(" {sign} "));
                let cell = operands.inside(cell, right, on_the_right);
                if needs_brackets { cell.text(")") } else { cell }
            }
        }
    }

    /// An entry: its name and its id, with the device where the condition names one.
    fn operand(&self, cell: Cell, entry: &EntryRef) -> Cell {
        let device = self.source.device_of(self.devices, entry);
        let name = device.and_then(|device| device.entry_name(entry.id)).unwrap_or_default();
        let shown_device = entry.device.as_ref().filter(|_| self.source.system.devices.len() > 1);
        let text = match shown_device {
            Some(key) => format!("{} {}", key.to_uppercase(), entry.id),
            None => entry.id.to_string(),
        };
        let said = entry.device.as_ref().map(Devices::one);
        let devices = said.as_ref().unwrap_or(self.devices);
        let link = self.source.link_on(devices, entry.id.index, text, entry_anchor(entry.id));
        cell.text(format!("{name} (")).and(link).text(")")
    }
}

/// An operator as it is printed.
pub(crate) const fn relation(operator: CompareOp) -> &'static str {
    match operator {
        CompareOp::Less => "<",
        CompareOp::LessOrEqual => "≤",
        CompareOp::Equal => "=",
        CompareOp::NotEqual => "≠",
        CompareOp::GreaterOrEqual => "≥",
        CompareOp::Greater => ">",
    }
}
