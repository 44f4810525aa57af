//! Values of bit fields that are written by the names of their bits.

use super::values;
use crate::ast::{DefaultDecl, Name};
use crate::check::codes as rule_codes;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::model::{BitField, DataType, Value};
use crate::scalar;
use crate::source::{Span, Spanned};

/// A field of a bit field with a value; 1 where none is written.
struct SetBits<'a> {
    name: Name,
    value: Option<&'a Spanned<DefaultDecl>>,
}

impl<'a> SetBits<'a> {
    /// `enable` or `{mode: homing}`.
    fn of(item: &'a Spanned<DefaultDecl>, diagnostics: &mut Diagnostics) -> Option<Self> {
        match &item.value {
            DefaultDecl::One(name) => Some(Self { name: Spanned::new(name.clone(), item.span), value: None }),
            DefaultDecl::ByDevice(pair) if let [(name, value)] = pair.as_slice() => {
                Some(Self { name: name.clone(), value: Some(value) })
            }
            DefaultDecl::Each(_) | DefaultDecl::ByDevice(_) => {
                diagnostics.push(not_a_bit(item.span));
                None
            }
        }
    }
}

fn not_a_bit(place: Span) -> Diagnostic {
    Diagnostic::new(codes::BAD_VALUE, place, "this is not a bit of a bit field")
        .help("write the name of a bit, or a run of bits with its value: `{mode: homing}`")
}

/// The raw value with these fields; all others are 0.
pub(crate) fn read(
    list: &[Spanned<DefaultDecl>],
    fields: &[BitField],
    data_type: DataType,
    diagnostics: &mut Diagnostics,
) -> Option<Value> {
    let mut taken: Vec<(u8, Name)> = Vec::new();
    let mut raw: i128 = 0;
    let before = diagnostics.errors_found();
    for item in list {
        let Some(SetBits { name, value }) = SetBits::of(item, diagnostics) else { continue };
        let Some(field) = field(fields, &name, BY_NUMBER, diagnostics) else { continue };
        if let Some((_, other)) = taken.iter().find(|(first, _)| *first == field.first) {
            diagnostics.push(
                Diagnostic::new(
                    codes::BAD_VALUE,
                    name.span,
                    format!("the value of `{}` is said twice", shorten(&name.value)),
                )
                .label("again here")
                .with(other.span, "first here")
                .help("leave one of the two out"),
            );
            continue;
        }
        taken.push((field.first, name.clone()));
        let of_field = match value {
            Some(Spanned { value: DefaultDecl::One(text), span }) => {
                value_of(field, &Spanned::new(text.clone(), *span), diagnostics)
            }
            Some(other) => {
                diagnostics.push(not_a_bit(other.span));
                None
            }
            None if field.first == field.last => Some(1),
            None => {
                diagnostics.push(without_value(field, &name));
                None
            }
        };
        raw |= of_field.unwrap_or_default() << field.first;
    }
    (diagnostics.errors_found() == before).then(|| Value::Integer(signed(raw, data_type)))
}

/// The number that the bits are in a type with a sign.
fn signed(raw: i128, data_type: DataType) -> i128 {
    match data_type.range() {
        Some((low, high)) if raw > high => raw + 2 * low,
        Some(_) | None => raw,
    }
}

/// What says the value of an entry without the names of its bits.
pub(super) const BY_NUMBER: &str = "the value as a number";

/// The field of a name, which may be one that it has in a mode of operation only. In its place, `instead` can be written.
pub(super) fn field<'a>(
    fields: &'a [BitField],
    name: &Name,
    instead: &str,
    diagnostics: &mut Diagnostics,
) -> Option<&'a BitField> {
    let names = |field: &'a BitField| {
        let in_modes = field.modes.iter().map(|mode| mode.name.as_str());
        std::iter::once(field.name.as_str()).chain(in_modes).filter(|name| !name.is_empty())
    };
    let found: Vec<&BitField> =
        fields.iter().filter(|field| names(field).any(|known| known == name.value)).collect();
    match found.as_slice() {
        [field] => Some(field),
        [_, ..] => {
            diagnostics.push(
                Diagnostic::new(
                    codes::UNKNOWN_BIT,
                    name.span,
                    format!("`{}` means several bits, each in a mode of operation", shorten(&name.value)),
                )
                .help(format!("write {instead}")),
            );
            None
        }
        [] => {
            let diagnostic = Diagnostic::new(
                codes::UNKNOWN_BIT,
                name.span,
                format!("the type has no bit `{}`", shorten(&name.value)),
            );
            let meant = diagnostics.suggestions.nearest(&name.value, fields.iter().flat_map(names));
            diagnostics.push(match meant {
                Some(word) => diagnostic.did_you_mean(word),
                None => diagnostic.help(format!("write the name of a bit, or {instead}")),
            });
            None
        }
    }
}

/// The largest value of a field.
const fn highest(field: &BitField) -> i128 {
    (1 << (field.last - field.first + 1)) - 1
}

/// `bit 3`, `bits 4 to 6`.
fn place(field: &BitField) -> String {
    let BitField { first, last, .. } = field;
    if first == last { format!("bit {first}") } else { format!("bits {first} to {last}") }
}

/// A run of bits has a value, which its name alone does not show.
fn without_value(field: &BitField, name: &Name) -> Diagnostic {
    let shown = shorten(&name.value);
    let example = field.values.last().map_or_else(|| highest(field).to_string(), |value| value.name.clone());
    Diagnostic::new(codes::BAD_VALUE, name.span, format!("`{shown}` is {}, and needs a value", place(field)))
        .help(format!("write a value of it, such as `{{{shown}: {}}}`", shorten(&example)))
}

/// A value of a field, by number or by name.
pub(super) fn value_of(field: &BitField, text: &Name, diagnostics: &mut Diagnostics) -> Option<i128> {
    let named = field.values.iter().find(|value| value.name == text.value).map(|value| value.value);
    let flag = scalar::yes_no(&text.value).filter(|_| field.first == field.last).map(i128::from);
    let number = scalar::integer(&text.value).ok();
    if let Some(value) = named.or(flag).or(number).filter(|value| (0..=highest(field)).contains(value)) {
        return Some(value);
    }
    let shown = shorten(&text.value);
    let names = || field.values.iter().map(|value| value.name.as_str());
    let meant = diagnostics.suggestions.nearest(&text.value, names());
    diagnostics.push(match (number, meant) {
        (Some(_), _) => Diagnostic::new(
            rule_codes::VALUE_DOES_NOT_FIT,
            text.span,
            format!("{shown} does not fit {}", place(field)),
        )
        .label(format!("allowed: 0 to {}", highest(field)))
        .help("correct the value"),
        (None, meant) => {
            let message = format!("`{shown}` is not a value of `{}`", shorten(&field.name));
            let diagnostic = Diagnostic::new(rule_codes::UNKNOWN_ENUM_VALUE, text.span, message);
            let number = format!("write a number, 0 to {}", highest(field));
            match meant {
                Some(word) => diagnostic.did_you_mean(word),
                None if field.values.is_empty() => diagnostic.help(number),
                None => diagnostic.help(format!("{number}, or one of {}", values::list(names()))),
            }
        }
    });
    None
}
