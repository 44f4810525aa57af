//! Values of entries: raw numbers, physical values, enum names, strings, node-ID formulas.

use std::fmt::Display;

use crate::ast::Name;
use crate::check::codes as rule_codes;
use crate::diag::shorten;
use crate::diag::{Diagnostic, Diagnostics, Suggestions, codes};
use crate::model::{DataType, NamedType, Ratio, Real, SpecialValue, TypeKind, Unit, Value};
use crate::scalar::{self, NumberError};
use crate::source::Span;

/// What a value is read against.
#[derive(Clone, Copy)]
pub(crate) struct Expected<'a> {
    pub data_type: DataType,
    pub named: Option<&'a NamedType>,
    pub unit: Option<&'a Unit>,
    /// Values that are allowed in addition to those of an enum.
    pub special: &'a [SpecialValue],
}

/// Reads a value that is written at `span`.
pub(crate) fn read(
    text: &str,
    span: Span,
    expected: Expected<'_>,
    suggestions: &mut Suggestions,
) -> Result<Value, Box<Diagnostic>> {
    let refuse = |message: String, help: &str| {
        Err(Box::new(Diagnostic::new(codes::BAD_VALUE, span, message).help(help)))
    };
    let shown = || shorten(text);
    match expected.data_type {
        DataType::Boolean => match (scalar::yes_no(text), text) {
            (Some(value), _) => Ok(Value::Integer(i128::from(value))),
            (None, "0" | "1") => Ok(Value::Integer(i128::from(text == "1"))),
            _ => refuse(format!("found `{}`, expected a BOOLEAN", shown()), "write `yes`, `no`, `1` or `0`"),
        },
        DataType::Real32 | DataType::Real64 => match Real::read(text, expected.data_type) {
            Some(real) => Ok(Value::Real(real)),
            None => match split_physical(text).filter(|(_, symbol)| is_symbol(symbol)) {
                Some((number, symbol)) => real(number, symbol, span, expected).map(Value::Real),
                None => refuse(
                    format!("found `{}`, expected a finite number", shown()),
                    "write a decimal number such as `0.5`",
                ),
            },
        },
        DataType::VisibleString if text.bytes().all(|byte| (0x20..=0x7E).contains(&byte)) => {
            Ok(Value::Text(text.to_owned()))
        }
        DataType::VisibleString => refuse(
            "a VISIBLE_STRING holds printable ASCII characters only".to_owned(),
            "remove or replace the other characters, or take `unicode-string`",
        ),
        DataType::UnicodeString => Ok(Value::Text(text.to_owned())),
        DataType::OctetString => match octets(text) {
            Some(bytes) => Ok(Value::Bytes(bytes)),
            None => refuse(
                format!("found `{}`, expected bytes", shown()),
                "write pairs of hexadecimal digits: `01A1053C`",
            ),
        },
        DataType::TimeOfDay | DataType::TimeDifference | DataType::Domain => refuse(
            format!("an entry of type {} has no value that could be written here", expected.data_type),
            "leave the key out",
        ),
        _ => integer(text, span, expected, suggestions),
    }
}

/// `01 A1 05`, with or without spaces.
fn octets(text: &str) -> Option<Vec<u8>> {
    let digits: Vec<u32> =
        text.chars().filter(|c| *c != ' ').map(|c| c.to_digit(16)).collect::<Option<_>>()?;
    let (pairs, rest) = digits.as_chunks::<2>();
    if !rest.is_empty() {
        return None;
    }
    pairs.iter().map(|[high, low]| u8::try_from(high << 4 | low).ok()).collect()
}

fn integer(
    text: &str,
    span: Span,
    expected: Expected<'_>,
    suggestions: &mut Suggestions,
) -> Result<Value, Box<Diagnostic>> {
    let shown = || shorten(text);
    let listed = match expected.named.map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => Some(values),
        Some(TypeKind::Bits(_)) | None => None,
    };
    if let Some(value) = listed.and_then(|values| values.named(text)) {
        return Ok(Value::Integer(value.value));
    }
    if text.starts_with('$') || text.contains("$NODEID") {
        let offset = match text.strip_prefix("$NODEID").unwrap_or("?").trim() {
            "" => Some(0),
            rest => rest.strip_prefix('+').and_then(|digits| scalar::integer(digits.trim()).ok()),
        };
        let Some(offset) = offset.and_then(|offset| u64::try_from(offset).ok()) else {
            return Err(Box::new(
                Diagnostic::new(codes::BAD_FORMULA, span, format!("cannot read the formula `{}`", shown()))
                    .help("write `$NODEID`, or `$NODEID + 0x180`")
                    .note("CiA 306 4.3: a formula is $NODEID and at most one added number"),
            ));
        };
        fits(i128::from(offset) + 127, span, expected.data_type, format_args!("`{}` for node 127", shown()))?;
        return Ok(Value::NodeId(offset));
    }
    let values = listed.map_or(&[][..], |values| values);
    let raw = match scalar::integer(text) {
        Ok(raw) => raw,
        Err(NumberError::NotANumber) => match split_physical(text).filter(|_| values.is_empty()) {
            Some((number, symbol)) => physical(number, symbol, span, expected.unit)?,
            None if !values.is_empty() => {
                let names = values.iter().map(|value| value.name.as_str());
                let diagnostic = Diagnostic::new(
                    rule_codes::UNKNOWN_ENUM_VALUE,
                    span,
                    format!("`{}` is not a value of this enum", shown()),
                );
                return Err(Box::new(match suggestions.nearest(text, names.clone()) {
                    Some(word) => diagnostic.did_you_mean(word),
                    None => diagnostic.help(format!("its values are {}", list(names))),
                }));
            }
            None => {
                return Err(Box::new(
                    Diagnostic::new(
                        codes::BAD_VALUE,
                        span,
                        format!("found `{}`, expected a value of type {}", shown(), expected.data_type),
                    )
                    .help(match expected.unit {
                        _ if is_bit(text, expected.named) => {
                            format!("write the bits that are 1 as a list: `[{}]`", shown())
                        }
                        Some(unit) => {
                            format!("write a raw number, or a physical value such as `{}`", unit.show(10))
                        }
                        None => NumberError::NotANumber.help().to_owned(),
                    }),
                ));
            }
        },
        Err(error) => {
            return Err(Box::new(
                Diagnostic::new(codes::BAD_NUMBER, span, format!("found `{}`, expected an integer", shown()))
                    .help(error.help()),
            ));
        }
    };
    fits(raw, span, expected.data_type, raw)?;
    let is_special = expected.special.iter().any(|special| special.value == raw);
    if !values.is_empty() && !is_special && listed.is_none_or(|values| values.of(raw).is_none()) {
        return Err(Box::new(
            Diagnostic::new(
                rule_codes::UNKNOWN_ENUM_VALUE,
                span,
                format!("{raw} is not a value of this enum"),
            )
            .help(format!("its values are {}", list(values.iter().map(|value| value.name.as_str())))),
        ));
    }
    Ok(Value::Integer(raw))
}

/// Whether a text is the name of a bit.
fn is_bit(text: &str, named: Option<&NamedType>) -> bool {
    match named.map(|named| &named.kind) {
        Some(TypeKind::Bits(fields)) => fields.iter().any(|field| field.name == text),
        Some(TypeKind::Enum(_)) | None => false,
    }
}

/// The first names of an enum, in backticks.
pub(super) fn list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    const MOST: usize = 10;
    let mut names: Vec<String> = names.take(MOST + 1).map(|name| format!("`{}`", shorten(name))).collect();
    if names.len() > MOST {
        names.truncate(MOST - 1);
        names.push("…".to_owned());
    }
    names.join(", ")
}

/// Checks that a raw value fits the data type.
pub(crate) fn fits(
    raw: i128,
    span: Span,
    data_type: DataType,
    what: impl Display,
) -> Result<(), Box<Diagnostic>> {
    let (low, high) = data_type.range().unwrap_or((i128::MIN, i128::MAX));
    if (low..=high).contains(&raw) {
        return Ok(());
    }
    let note = (data_type.is_signed() && raw > high && raw <= 2 * high + 1).then(|| {
        format!("as a bit pattern this would be {}; write signed values in decimal", raw - 2 * high - 2)
    });
    let diagnostic =
        Diagnostic::new(rule_codes::VALUE_DOES_NOT_FIT, span, format!("{what} does not fit {data_type}"))
            .label(format!("allowed: {low} to {high}"))
            .help("correct the value or the type");
    Err(Box::new(match note {
        Some(note) => diagnostic.note(note),
        None => diagnostic,
    }))
}

/// `50.0 °C` → number and symbol.
fn split_physical(text: &str) -> Option<(Ratio, &str)> {
    let end = text.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))?;
    if matches!(text.get(..2), Some("0x" | "0X" | "0b" | "0B" | "0o" | "0O")) {
        return None;
    }
    let number = scalar::decimal(&text[..end])?;
    Some((number, text[end..].trim())).filter(|(_, symbol)| !symbol.is_empty())
}

/// Whether what follows a number is neither its exponent, `e400`, nor a divisor.
fn is_symbol(text: &str) -> bool {
    let digits = text.strip_prefix(['e', 'E']).map(|rest| rest.strip_prefix(['+', '-']).unwrap_or(rest));
    let is_exponent = digits.is_some_and(|digits| digits.starts_with(|first: char| first.is_ascii_digit()));
    !is_exponent && !text.starts_with('/')
}

/// The number of a REAL that a physical value is.
fn real(number: Ratio, symbol: &str, span: Span, expected: Expected<'_>) -> Result<Real, Box<Diagnostic>> {
    let Steps { count, .. } = steps(number, symbol, span, expected.unit)?;
    Real::of_ratio(count, expected.data_type).ok_or_else(|| Box::new(too_large(span)))
}

fn too_large(span: Span) -> Diagnostic {
    Diagnostic::new(rule_codes::VALUE_DOES_NOT_FIT, span, "the value is too large to be computed exactly")
        .help("correct the value")
}

/// The whole number of raw steps that a physical value is.
fn physical(number: Ratio, symbol: &str, span: Span, unit: Option<&Unit>) -> Result<i128, Box<Diagnostic>> {
    let Steps { unit, step, offset, count } = steps(number, symbol, span, unit)?;
    count.to_whole().ok_or_else(|| {
        let below = count.floor();
        Box::new(
            Diagnostic::new(codes::INEXACT_VALUE, span, "the value does not fit the unit's scale")
                .label(if offset == Ratio::ZERO {
                    format!("{count} steps of {step} {symbol}")
                } else {
                    format!("{count} steps of {step} {symbol} from {offset} {symbol}")
                })
                .help(format!(
                    "write {} (raw {below}) or {} (raw {}), or a raw value",
                    unit.show(below),
                    unit.show(below + 1),
                    below + 1
                )),
        )
    })
}

/// A physical value in raw steps.
struct Steps<'a> {
    unit: &'a Unit,
    /// One step, and where they count from, in the symbol of the value.
    step: Ratio,
    offset: Ratio,
    /// How many, which need not be a whole number.
    count: Ratio,
}

fn steps<'a>(
    number: Ratio,
    symbol: &str,
    span: Span,
    unit: Option<&'a Unit>,
) -> Result<Steps<'a>, Box<Diagnostic>> {
    let Some(unit) = unit else {
        return Err(Box::new(
            Diagnostic::new(
                codes::WRONG_SYMBOL,
                span,
                format!("`{}` has no meaning here: the entry has no unit", shorten(symbol)),
            )
            .help("add `unit:` to the entry, or write a raw number"),
        ));
    };
    if let Some(decimals) = symbol.strip_prefix(',') {
        let with_dot = format!("{number}.{decimals}");
        return Err(Box::new(Diagnostic::new(codes::BAD_VALUE, span, "a decimal comma").write(&with_dot)));
    }
    let (Some(step), Some(offset)) = (unit.step_in(symbol), unit.offset_in(symbol)) else {
        let base = unit.base_symbol();
        let known = if base == unit.symbol { String::new() } else { format!(" or `{base}`") };
        let unknown = Diagnostic::new(
            codes::WRONG_SYMBOL,
            span,
            format!("`{}` is not the symbol of unit `{}`", shorten(symbol), unit.name),
        );
        let help = match [unit.symbol.as_str(), base].into_iter().find_map(|own| look_alike(symbol, own)) {
            Some((found, own)) => {
                format!("write U+{:04X} (`{own}`) instead of U+{:04X}", u32::from(own), u32::from(found))
            }
            None => format!("write the value in `{}`{known}", unit.symbol),
        };
        return Err(Box::new(unknown.help(help)));
    };
    match unit.steps(number, symbol) {
        Some(count) => Ok(Steps { unit, step, offset, count }),
        None => Err(Box::new(too_large(span))),
    }
}

/// The first characters of two symbols that differ, where the symbols look the same.
fn look_alike(one: &str, other: &str) -> Option<(char, char)> {
    // Micro sign, ohm sign and Ångström sign are there twice, and so are degree sign and ordinal indicator by their looks.
    let shown = |c: char| match c {
        '\u{B5}' => '\u{3BC}',
        '\u{2126}' => '\u{3A9}',
        '\u{212B}' => '\u{C5}',
        '\u{BA}' => '\u{B0}',
        c => c,
    };
    let looks_the_same = one.chars().map(shown).eq(other.chars().map(shown));
    one.chars().zip(other.chars()).find(|(one, other)| looks_the_same && one != other)
}

/// Reads a value and sends what is wrong to `diagnostics`.
pub(super) fn read_into(
    text: Option<&Name>,
    expected: Expected<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Value> {
    let text = text?;
    match read(&text.value, text.span, expected, &mut diagnostics.suggestions) {
        Ok(value) => Some(value),
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            None
        }
    }
}
