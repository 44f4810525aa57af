//! Times of PDOs: numbers in the steps of their entries, or physical values.

use super::numbers::to_u16;
use super::values::{self, Expected};
use crate::ast::Name;
use crate::check::codes as rule_codes;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Base, DataType, Ratio, Statement, Text, Unit, Value};
use crate::source::Span;

/// What one raw step of a time is (CiA 301 7.5.2.35, 7.5.2.37).
#[derive(Clone, Copy)]
pub(super) enum Step {
    /// Of the inhibit time.
    HundredMicroseconds,
    /// Of the event timer.
    Millisecond,
}

impl Step {
    const fn name(self) -> &'static str {
        match self {
            Self::HundredMicroseconds => "100 microseconds",
            Self::Millisecond => "millisecond",
        }
    }

    const fn microseconds(self) -> i128 {
        match self {
            Self::HundredMicroseconds => 100,
            Self::Millisecond => 1000,
        }
    }

    /// Its unit, in microseconds where the text is.
    fn unit(self, text: &str, place: Span) -> Option<Unit> {
        let (symbol, per_second) = if text.ends_with("µs") {
            ("µs", 1_000_000)
        } else if text.ends_with("us") {
            ("us", 1_000_000)
        } else {
            ("ms", 1000)
        };
        Some(Unit {
            name: self.name().to_owned(),
            symbol: symbol.to_owned(),
            scale: Ratio::new(self.microseconds() * per_second, 1_000_000)?,
            offset: Ratio::ZERO,
            base: Some(Base { symbol: "s".to_owned(), factor: Ratio::new(1, per_second)? }),
            formula: None,
            about: Text::default(),
            stated: Statement::derived(place),
        })
    }
}

/// The raw value of a time, if one is written that the entry can have.
pub(super) fn read(text: Option<&Name>, step: Step, diagnostics: &mut Diagnostics) -> Option<u16> {
    let text = text?;
    let unit = step.unit(&text.value, text.span)?;
    let expected = Expected { data_type: DataType::Unsigned16, named: None, unit: Some(&unit), special: &[] };
    let read = values::read(&text.value, text.span, expected, &mut diagnostics.suggestions);
    diagnostics.push(match read {
        Ok(Value::Integer(raw)) => return Some(to_u16(raw)),
        Ok(Value::NodeId(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_)) => {
            Diagnostic::new(codes::BAD_VALUE, text.span, "a time cannot depend on the node-ID")
                .help("write a time such as `10 ms`")
        }
        Err(diagnostic) if diagnostic.code == rule_codes::VALUE_DOES_NOT_FIT => {
            let (shortest, longest) = (unit.show(0), unit.show(u16::MAX.into()));
            Diagnostic::new(
                rule_codes::VALUE_DOES_NOT_FIT,
                text.span,
                "the time is not one that its entry can have",
            )
            .label(format!("allowed: {shortest} to {longest}"))
            .help(format!("write a time up to {longest}"))
        }
        Err(diagnostic) => *diagnostic,
    });
    None
}
