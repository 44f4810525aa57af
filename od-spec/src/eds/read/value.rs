//! Values: from the notations of EDS files to that of a specification.

use super::{made, without_place};
use crate::ast::Name;
use crate::diag::{Code, Diagnostic, Diagnostics, shorten};
use crate::eds::codes;
use crate::eds::number::{self, Deviation, Number};
use crate::model::{DataType, Family};
use crate::source::Spanned;

/// A default or a parameter value, as a specification would write it; `None` for one that cannot be read.
pub(super) fn value(text: Spanned<&str>, data_type: DataType, diagnostics: &mut Diagnostics) -> Option<Name> {
    let read = match data_type.family() {
        Family::Boolean | Family::Signed | Family::Unsigned => integer(text, data_type, diagnostics)?,
        Family::Real => real(text, data_type, diagnostics)?,
        Family::VisibleString => visible(text, diagnostics)?,
        Family::OctetString => octets(text, diagnostics)?,
        Family::UnicodeString => text.value.to_owned(),
        Family::Time | Family::Domain => {
            let message = format!("the value of a {data_type} is left out");
            diagnostics.push(without_place(codes::NO_PLACE, text.span, message));
            return None;
        }
    };
    Some(made(read, text.span))
}

/// A limit, as a specification would write it; `None` where the type has none.
pub(super) fn limit(text: Spanned<&str>, data_type: DataType, diagnostics: &mut Diagnostics) -> Option<Name> {
    let (code, message) = match data_type.family() {
        Family::Signed | Family::Unsigned if is_formula(text.value) => {
            (codes::NO_PLACE, "a limit that depends on the node-ID is left out".to_owned())
        }
        Family::Signed | Family::Unsigned => {
            let read = integer(text, data_type, diagnostics)?;
            return Some(made(read, text.span));
        }
        Family::Real => {
            let read = real(text, data_type, diagnostics)?;
            return Some(made(read, text.span));
        }
        // The whole range of a BOOLEAN is no limit.
        Family::Boolean if matches!(number::lenient_integer(text.value), Some(0 | 1)) => return None,
        Family::Boolean
        | Family::VisibleString
        | Family::OctetString
        | Family::UnicodeString
        | Family::Time
        | Family::Domain => (codes::LIMIT_ON_TYPE, format!("a {data_type} has no limits")),
    };
    diagnostics.push(if code == codes::LIMIT_ON_TYPE {
        Diagnostic::new(code, text.span, message).help("remove the limit")
    } else {
        without_place(code, text.span, message)
    });
    None
}

fn is_formula(text: &str) -> bool {
    text.contains('$')
}

fn integer(text: Spanned<&str>, data_type: DataType, diagnostics: &mut Diagnostics) -> Option<String> {
    if is_formula(text.value) {
        return formula(text, diagnostics);
    }
    let Some(Number { value, deviations }) = number::integer(text.value) else {
        diagnostics.push(unreadable(text, &data_type.to_string()));
        return None;
    };
    // As a bit pattern, a value has the digits of one.
    let is_pattern = text.value.get(..2).is_some_and(|prefix| prefix.eq_ignore_ascii_case("0x"));
    let value = match data_type.range().filter(|_| data_type.is_signed() && is_pattern) {
        Some((_, high)) if value > high && value <= 2 * high + 1 => {
            let signed = value - 2 * (high + 1);
            let message = format!("`{}` as {data_type} is {signed}", shorten(text.value));
            diagnostics.push(
                Diagnostic::new(codes::BIT_PATTERN, text.span, message)
                    .help("write signed values in decimal")
                    .edit(text.span, signed.to_string()),
            );
            return Some(signed.to_string());
        }
        _ => value,
    };
    for deviation in &deviations {
        diagnostics.push(deviates(text, deviation, value));
    }
    Some(value.to_string())
}

fn formula(text: Spanned<&str>, diagnostics: &mut Diagnostics) -> Option<String> {
    let shown = shorten(text.value);
    let Some(formula) = number::formula(text.value) else {
        let added = text.value.rsplit_once('+').map_or("", |(_, added)| added.trim());
        diagnostics.push(
            Diagnostic::new(codes::BAD_FORMULA, text.span, format!("found `{shown}`, expected a formula"))
                .help(number::help(added, "write `$NODEID`, or `$NODEID+0x180`")),
        );
        return None;
    };
    let standard = match formula.offset {
        0 => "$NODEID".to_owned(),
        offset => format!("$NODEID+0x{offset:X}"),
    };
    if !formula.is_standard {
        diagnostics.push(
            Diagnostic::new(
                codes::FORMULA_SPELLING,
                text.span,
                format!("found `{shown}`, expected `{standard}`"),
            )
            .help("begin with `$NODEID` in upper case, and leave out spaces")
            .edit(text.span, standard.clone()),
        );
    }
    Some(standard)
}

fn real(text: Spanned<&str>, data_type: DataType, diagnostics: &mut Diagnostics) -> Option<String> {
    let mut deviations = Vec::new();
    let bare = number::bare(text.value, &mut deviations);
    let read = match bare.strip_prefix("0x").or_else(|| bare.strip_prefix("0X")) {
        Some(digits) => from_bits(digits, data_type).inspect(|number| {
            let message = format!("`{}` is read as the bits of {number}", shorten(text.value));
            let help = "readers disagree about REAL; write the number in the notation that yours take";
            diagnostics.push(Diagnostic::new(codes::REAL_AS_BITS, text.span, message).help(help));
        }),
        None => decimal(bare.strip_suffix(['f', 'F']).unwrap_or(bare), data_type),
    };
    let Some(read) = read else {
        diagnostics.push(unreadable(text, &data_type.to_string()));
        return None;
    };
    for deviation in &deviations {
        diagnostics.push(without(text, deviation, bare));
    }
    Some(read)
}

fn from_bits(digits: &str, data_type: DataType) -> Option<String> {
    let bits = u64::from_str_radix(digits, 16).ok()?;
    if data_type == DataType::Real32 {
        let number = f32::from_bits(u32::try_from(bits).ok()?);
        number.is_finite().then(|| number.to_string())
    } else {
        let number = f64::from_bits(bits);
        number.is_finite().then(|| number.to_string())
    }
}

fn decimal(text: &str, data_type: DataType) -> Option<String> {
    let is_number =
        text.starts_with(|first: char| first.is_ascii_digit() || matches!(first, '-' | '+' | '.'));
    let fits = match data_type {
        DataType::Real32 => text.parse::<f32>().ok()?.is_finite(),
        _ => text.parse::<f64>().ok()?.is_finite(),
    };
    (is_number && fits).then(|| text.trim_start_matches('+').to_owned())
}

fn visible(text: Spanned<&str>, diagnostics: &mut Diagnostics) -> Option<String> {
    if text.value.bytes().all(|byte| (0x20..=0x7E).contains(&byte)) {
        return Some(text.value.to_owned());
    }
    diagnostics.push(
        Diagnostic::new(
            codes::TEXT_NOT_ASCII,
            text.span,
            "the value is left out: it has characters beyond ASCII",
        )
        .help("write printable ASCII characters only"),
    );
    None
}

fn octets(text: Spanned<&str>, diagnostics: &mut Diagnostics) -> Option<String> {
    let digits =
        text.value.strip_prefix("0x").or_else(|| text.value.strip_prefix("0X")).unwrap_or(text.value);
    let digits = digits.replace([' ', '\t'], "");
    if !digits.len().is_multiple_of(2) || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        diagnostics.push(unreadable(text, "OCTET_STRING"));
        return None;
    }
    if digits != text.value {
        let message = format!("found `{}`, expected `{}`", shorten(text.value), shorten(&digits));
        diagnostics.push(
            Diagnostic::new(codes::BYTES_NOTATION, text.span, message)
                .help("write pairs of hexadecimal digits without anything between them")
                .edit(text.span, digits.clone()),
        );
    }
    Some(digits)
}

/// A value that its type does not have.
fn unreadable(text: Spanned<&str>, expected: &str) -> Diagnostic {
    let message = format!("found `{}`, expected a value of type {expected}", shorten(text.value));
    let digits = text.value.trim_end_matches(['h', 'H']);
    let is_hex = digits.len() < text.value.len() && u64::from_str_radix(digits, 16).is_ok();
    let help = match expected {
        _ if is_hex => format!("write `0x{digits}` if that is a hexadecimal number"),
        "OCTET_STRING" => "write pairs of hexadecimal digits, such as `01A1053C`".to_owned(),
        _ => number::help(text.value, "write a number, in decimal or with `0x`"),
    };
    Diagnostic::new(codes::BAD_NUMBER, text.span, message).help(help)
}

/// A number that is understood, but not written as the standard has it.
pub(super) fn deviates(text: Spanned<&str>, deviation: &Deviation, value: i128) -> Diagnostic {
    let shown = shorten(text.value);
    let bare = number::bare(text.value, &mut Vec::new());
    match deviation {
        Deviation::Octal => {
            Diagnostic::new(codes::OCTAL, text.span, format!("`{shown}` is octal and means {value}"))
                .help(format!("write `{value}` if that is meant, or the decimal number without its zeros"))
        }
        Deviation::Word => {
            Diagnostic::new(codes::BOOLEAN_WORD, text.span, format!("found `{shown}`, expected `{value}`"))
                .help("write 0 or 1")
                .edit(text.span, value.to_string())
        }
        Deviation::NegativeHex | Deviation::PlusSign | Deviation::Fraction => {
            without(text, deviation, &value.to_string())
        }
        Deviation::Suffix(suffix) => without(text, deviation, bare.get(..suffix.start).unwrap_or(bare)),
        Deviation::Remark(remark) => {
            without(text, deviation, text.value.get(..remark.start).unwrap_or(text.value))
        }
        Deviation::Quoted => without(text, deviation, bare),
    }
}

/// A text of which only a part is the value.
fn without(text: Spanned<&str>, deviation: &Deviation, bare: &str) -> Diagnostic {
    let (code, help): (&'static Code, _) = match deviation {
        Deviation::Remark(_) => {
            (codes::REMARK_IN_VALUE, "put the remark on a line of its own above the section")
        }
        Deviation::Octal
        | Deviation::NegativeHex
        | Deviation::PlusSign
        | Deviation::Suffix(_)
        | Deviation::Fraction
        | Deviation::Word
        | Deviation::Quoted => (codes::NUMBER_NOTATION, "write the number alone"),
    };
    let message = format!("found `{}`, expected `{}`", shorten(text.value), shorten(bare));
    Diagnostic::new(code, text.span, message).help(help).edit(text.span, bare)
}
