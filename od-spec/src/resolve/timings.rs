//! Sequences of events: what their signals are, and whether levels and causes fit.

use super::bit_values;
use super::figures::Figures;
use super::numbers::to_u8;
use super::types::words;
use super::values::{self, Expected};
use crate::ast::{Levels, Name, SignalDecl, TimingDecl, TimingStepDecl};
use crate::check::codes as rule_codes;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::limits::{TIMING_SIGNALS, TIMING_STEPS};
use crate::model::{
    BitField, Entry, EntryId, Level, NamedBits, Signal, SignalCarrier, Timing, TimingStep, TypeKind, Value,
};
use crate::scalar;
use crate::source::Spanned;
use crate::wording::{allowed, format_value};

/// What a signal is, with what its levels are read against.
enum Carrier<'a> {
    Bits { named_type: &'a Name, name: &'a str, field: &'a BitField },
    Entry { id: EntryId, entry: &'a Entry },
}

impl Figures<'_, '_> {
    /// The sequence, if all of it fits.
    pub(super) fn timing(&self, decl: &TimingDecl, diagnostics: &mut Diagnostics) -> Option<Timing> {
        if is_too_large(decl, diagnostics) {
            return None;
        }
        let signals: Vec<Option<Signal>> =
            decl.signals.iter().map(|signal| self.signal(signal, decl.steps.len(), diagnostics)).collect();
        let signals: Vec<Signal> = signals.into_iter().collect::<Option<_>>()?;
        let steps = decl.steps.iter().enumerate().map(|(before, step)| TimingStep {
            event: words(&step.value.event),
            cause: cause(&step.value, before + 1, &signals, diagnostics),
        });
        Some(Timing { steps: steps.collect(), signals })
    }

    fn signal(
        &self,
        decl: &Spanned<SignalDecl>,
        steps: usize,
        diagnostics: &mut Diagnostics,
    ) -> Option<Signal> {
        let carrier = self.carrier(decl, diagnostics);
        let Spanned { value: Levels(levels), span } = decl.value.levels.as_ref()?;
        if levels.len() != steps + 1 {
            let (found, behind) = (counted(levels.len(), "level"), counted(steps, "step"));
            let message = format!("found {found} with {behind}, expected one more level than steps");
            diagnostics.push(
                Diagnostic::new(rule_codes::COUNT_MISMATCH, *span, message)
                    .help("write the level before the first step, then that after each step"),
            );
            return None;
        }
        let carrier = carrier?;
        let levels: Vec<Option<Level>> =
            levels.iter().map(|level| read_level(level, &carrier, diagnostics)).collect();
        let carrier = match carrier {
            Carrier::Bits { named_type, name, field } => {
                SignalCarrier::Bits(named_bits(named_type, name, field))
            }
            Carrier::Entry { id, .. } => SignalCarrier::Entry(id),
        };
        Some(Signal { carrier, levels: levels.into_iter().collect::<Option<_>>()? })
    }

    fn carrier<'s>(
        &'s self,
        decl: &'s Spanned<SignalDecl>,
        diagnostics: &mut Diagnostics,
    ) -> Option<Carrier<'s>> {
        let SignalDecl { named_type, bit, entry, .. } = &decl.value;
        match (named_type, bit, entry) {
            (Some(named_type), Some(bit), None) => {
                let (name, field) = self.field(named_type, bit, diagnostics)?;
                Some(Carrier::Bits { named_type, name, field })
            }
            (None, None, Some(entry)) => {
                let (id, entry) = self.entry(entry, diagnostics)?;
                Some(Carrier::Entry { id, entry })
            }
            // Reported by the keys of a signal.
            _ => None,
        }
    }

    /// The bits that a type and a name or number mean.
    pub(super) fn named_bits(
        &self,
        named_type: &Name,
        bit: &Name,
        diagnostics: &mut Diagnostics,
    ) -> Option<NamedBits> {
        let (name, field) = self.field(named_type, bit, diagnostics)?;
        Some(named_bits(named_type, name, field))
    }

    /// What bits are called there, and the field that they are.
    fn field<'s>(
        &'s self,
        named_type: &Name,
        bit: &'s Name,
        diagnostics: &mut Diagnostics,
    ) -> Option<(&'s str, &'s BitField)> {
        self.bit_fields.check(named_type, diagnostics);
        let TypeKind::Bits(fields) = &self.system.types.get(&named_type.value)?.kind else { return None };
        let Ok(number) = scalar::integer(&bit.value) else {
            let field = bit_values::field(fields, bit, "the number of the bit", diagnostics)?;
            return Some((&bit.value, field));
        };
        let has_it = |field: &&BitField| (field.first..=field.last).any(|bit| i128::from(bit) == number);
        let Some(field) = fields.iter().find(has_it) else {
            diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_BIT, bit.span, format!("the type has no bit {number}"))
                    .help("write the name or the number of a bit"),
            );
            return None;
        };
        Some((&field.name, field))
    }
}

fn named_bits(named_type: &Name, name: &str, field: &BitField) -> NamedBits {
    NamedBits {
        named_type: named_type.value.clone(),
        first: field.first,
        last: field.last,
        name: name.to_owned(),
    }
}

/// `1 step`, `2 steps`.
fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

fn is_too_large(decl: &TimingDecl, diagnostics: &mut Diagnostics) -> bool {
    let (steps, signals) = (decl.steps.len(), decl.signals.len());
    let beyond = decl.steps.get(TIMING_STEPS).map(|step| step.span);
    let beyond = beyond.or_else(|| decl.signals.get(TIMING_SIGNALS).map(|signal| signal.span));
    let Some(place) = beyond else { return false };
    let message = format!(
        "{} and {}; a sequence of events has at most {TIMING_STEPS} and {TIMING_SIGNALS}",
        counted(steps, "step"),
        counted(signals, "signal")
    );
    diagnostics.push(
        Diagnostic::new(codes::TOO_MUCH, place.part(0, 1), message)
            .help("describe several sequences, one after the other"),
    );
    true
}

fn read_level(text: &Name, carrier: &Carrier<'_>, diagnostics: &mut Diagnostics) -> Option<Level> {
    if text.value == "x" {
        return Some(Level::Any);
    }
    let letter = match text.value.as_bytes() {
        [letter @ b'A'..=b'Z'] => Some(Level::Letter(char::from(*letter))),
        _ => None,
    };
    match carrier {
        Carrier::Bits { field, .. } => {
            // One bit has no values that a letter could represent.
            let letter = letter.filter(|_| field.first != field.last);
            letter.or_else(|| {
                let value = bit_values::value_of(field, text, diagnostics)?;
                Some(Level::Value(Value::Integer(value)))
            })
        }
        Carrier::Entry { entry, .. } => letter.or_else(|| {
            let expected = Expected {
                data_type: entry.data_type,
                named: entry.named_type.as_deref(),
                unit: entry.unit.as_deref(),
                special: &entry.special,
            };
            let value = values::read_into(Some(text), expected, diagnostics)?;
            is_allowed(text, entry, &value, diagnostics).then_some(Level::Value(value))
        }),
    }
}

/// Whether an entry can have a value.
fn is_allowed(text: &Name, entry: &Entry, value: &Value, diagnostics: &mut Diagnostics) -> bool {
    let is_inside = match value {
        Value::Integer(raw) => entry.allows(*raw),
        Value::Real(real) => entry.real_limits.allow(real, entry.data_type),
        Value::NodeId(_) | Value::Text(_) | Value::Bytes(_) => true,
    };
    if !is_inside {
        let message = format!("{} is outside {}", shorten(&format_value(entry, value)), allowed(entry));
        diagnostics.push(
            Diagnostic::new(rule_codes::OUTSIDE_LIMITS, text.span, message)
                .help("write a value that the entry can have, or a letter for one of them"),
        );
    }
    is_inside
}

/// The step that a step answers.
fn cause(
    decl: &TimingStepDecl,
    step: usize,
    signals: &[Signal],
    diagnostics: &mut Diagnostics,
) -> Option<usize> {
    // A number that no step can have was refused as such.
    let written = decl.cause.filter(|cause| (1..=64).contains(&cause.value))?;
    let cause = usize::from(to_u8(written.value));
    let mut refuse = |message: String, help: &str| {
        diagnostics.push(Diagnostic::new(codes::WRONG_CAUSE, written.span, message).help(help));
    };
    if cause >= step {
        refuse(
            format!("step {step} cannot answer step {cause}"),
            "name an earlier step, or leave `cause` out",
        );
        return None;
    }
    let is_quiet = |step: &usize| !signals.iter().any(|signal| signal.changes_at(*step));
    if let Some(quiet) = [cause, step].into_iter().find(is_quiet) {
        refuse(
            format!("no signal changes at step {quiet}, so that no arrow can be drawn"),
            "correct the levels or the number, or leave `cause` out",
        );
        return None;
    }
    Some(cause)
}
