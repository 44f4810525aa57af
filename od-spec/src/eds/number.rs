//! Numbers as an EDS writes them (CiA 306 4.3), and as the world does.

use std::ops::Range;

/// A number that was read, and in which respects it is not written as the standard has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Number {
    pub value: i128,
    pub deviations: Vec<Deviation>,
}

/// How a number, or a text around it, differs from what CiA 306 allows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Deviation {
    /// `010`, which CiA 306 reads as octal and people as decimal.
    Octal,
    /// `-0x10`: the standard has no sign before hexadecimal digits.
    NegativeHex,
    /// `+5`.
    PlusSign,
    /// `0x12ULL`, as in a C program; the part that is too much, in bytes of the text.
    Suffix(Range<usize>),
    /// `5.0` where an integer is expected.
    Fraction,
    /// `true` or `false` for 1 and 0.
    Word,
    /// A remark after the value, `0x3ED ; homing`; in bytes of the text, with the spaces in front of it.
    Remark(Range<usize>),
    /// Quotation marks around the value.
    Quoted,
}

/// Reads an integer: decimal, hexadecimal or octal, with everything that is seen around one.
pub(crate) fn integer(text: &str) -> Option<Number> {
    let mut deviations = Vec::new();
    let text = bare(text, &mut deviations);
    if let Some(word) = boolean_word(text) {
        deviations.push(Deviation::Word);
        return Some(Number { value: i128::from(word), deviations });
    }
    let (negative, unsigned) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    if text.starts_with('+') {
        deviations.push(Deviation::PlusSign);
    }
    let sign = text.len() - unsigned.len();
    let (radix, digits) = match unsigned.get(..2) {
        Some("0x" | "0X") => (16, &unsigned[2..]),
        _ if unsigned.len() > 1 && unsigned.starts_with('0') => (8, &unsigned[1..]),
        _ => (10, unsigned),
    };
    let end = digits.bytes().position(|byte| !char::from(byte).is_digit(radix)).unwrap_or(digits.len());
    let (digits, rest) = digits.split_at(end);
    let magnitude = match (digits, radix, rest) {
        // `0.0` begins like an octal number, but is not one.
        (_, 8 | 10, rest) if rest.starts_with(['.', '8', '9']) => whole_fraction(unsigned)?,
        ("", ..) => return None,
        _ => i128::from_str_radix(digits, radix).ok()?,
    };
    let is_fraction = matches!(radix, 8 | 10) && rest.starts_with('.');
    if is_fraction {
        deviations.push(Deviation::Fraction);
    } else if !rest.is_empty() {
        if !["u", "l", "ul", "ll", "ull", "lu", "llu"].contains(&rest.to_ascii_lowercase().as_str()) {
            return None;
        }
        let start = sign + unsigned.len() - rest.len();
        deviations.push(Deviation::Suffix(start..start + rest.len()));
    }
    if radix == 8 && !is_fraction {
        deviations.push(Deviation::Octal);
    }
    if negative && radix == 16 {
        deviations.push(Deviation::NegativeHex);
    }
    Some(Number { value: if negative { -magnitude } else { magnitude }, deviations })
}

/// What to do about a text that is not a number: `otherwise`, unless zeros in front of a decimal number are the reason.
pub(crate) fn help(text: &str, otherwise: &str) -> String {
    let bare = bare(text, &mut Vec::new()).trim_start_matches('+');
    let digits = bare.strip_prefix('-').unwrap_or(bare);
    let is_number = digits.starts_with('0') && digits.bytes().all(|byte| byte.is_ascii_digit());
    match (digits.chars().find(|digit| matches!(digit, '8' | '9')), bare.parse::<i128>()) {
        (Some(digit), Ok(number)) if is_number => format!(
            "write `{number}`; a leading 0 makes a number octal in CiA 306, and {digit} is not an octal digit"
        ),
        _ => otherwise.to_owned(),
    }
}

/// An integer as it is in the sections about the file and the device, whatever it is spelled like.
pub(crate) fn lenient_integer(text: &str) -> Option<i128> {
    integer(text).map(|number| number.value)
}

/// `0`, `5.0`, `0.000f`: a number with nothing after its point.
fn whole_fraction(text: &str) -> Option<i128> {
    let text = text.strip_suffix(['f', 'F']).unwrap_or(text);
    let (whole, fraction) = text.split_once('.')?;
    let is_zero = fraction.bytes().all(|byte| byte == b'0');
    whole.parse().ok().filter(|_| is_zero)
}

fn boolean_word(text: &str) -> Option<bool> {
    match text {
        _ if text.eq_ignore_ascii_case("true") => Some(true),
        _ if text.eq_ignore_ascii_case("false") => Some(false),
        _ => None,
    }
}

/// A formula over the node-ID.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Formula {
    /// What is added to the node-ID.
    pub offset: u64,
    /// Whether it is spelled as the standard has it: `$NODEID+0x180`.
    pub is_standard: bool,
}

/// Reads `$NODEID+0x180`, also the other way round, with spaces and in upper or lower case.
pub(crate) fn formula(text: &str) -> Option<Formula> {
    let mut deviations = Vec::new();
    let bare = bare(text, &mut deviations);
    let is_node = |part: &str| part.trim().eq_ignore_ascii_case("$NODEID");
    let offset = match bare.split_once('+') {
        None if is_node(bare) => 0,
        None => return None,
        Some((front, back)) if is_node(front) => offset(back)?,
        Some((front, back)) if is_node(back) => offset(front)?,
        Some(_) => return None,
    };
    let is_standard = match bare.strip_prefix("$NODEID") {
        Some("") => true,
        Some(rest) => rest.strip_prefix('+').is_some_and(|digits| digits.trim() == digits),
        None => false,
    };
    Some(Formula { offset, is_standard: is_standard && deviations.is_empty() })
}

fn offset(text: &str) -> Option<u64> {
    let number = integer(text.trim())?;
    u64::try_from(number.value).ok().filter(|_| number.deviations.is_empty())
}

/// A value without the remark after it and the quotation marks around it.
pub(crate) fn bare<'t>(text: &'t str, deviations: &mut Vec<Deviation>) -> &'t str {
    let remark = text
        .char_indices()
        .skip(1)
        .find(|(at, sign)| matches!(sign, ';' | '#') && text[..*at].ends_with([' ', '\t']));
    let mut bare = text;
    if let Some((at, _)) = remark {
        bare = text[..at].trim_end();
        deviations.push(Deviation::Remark(bare.len()..text.len()));
    }
    if let Some(quoted) = bare.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
        deviations.push(Deviation::Quoted);
        bare = quoted.trim();
    }
    bare
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<(i128, Vec<Deviation>)> {
        integer(text).map(|number| (number.value, number.deviations))
    }

    #[test]
    fn numbers_of_the_standard_are_read_as_it_says() {
        for (text, value) in [
            ("0", 0),
            ("10", 10),
            ("-123", -123),
            ("0xA", 10),
            ("0X0a", 10),
            ("0xFFFFFFFFFFFFFFFF", i128::from(u64::MAX)),
        ] {
            assert_eq!(read(text), Some((value, vec![])), "{text}");
        }
    }

    #[test]
    fn what_the_world_writes_is_read_and_said() {
        for (text, value, deviation) in [
            ("012", 10, Deviation::Octal),
            ("-0x10", -16, Deviation::NegativeHex),
            ("+7", 7, Deviation::PlusSign),
            ("0x1234567890ABCDEFLL", 0x1234_5678_90AB_CDEF, Deviation::Suffix(18..20)),
            ("7u", 7, Deviation::Suffix(1..2)),
            ("0.0", 0, Deviation::Fraction),
            ("12.000", 12, Deviation::Fraction),
            ("0.0f", 0, Deviation::Fraction),
            ("False", 0, Deviation::Word),
            ("0x3ED ; prevent homing", 0x3ED, Deviation::Remark(5..22)),
            ("0x0007 # UNSIGNED32", 7, Deviation::Remark(6..19)),
            ("\"5\"", 5, Deviation::Quoted),
        ] {
            assert_eq!(read(text), Some((value, vec![deviation])), "{text}");
        }
        for text in
            ["", "-", "0x", "08", "1X", "4x0", "0x1G", "1 2", "10h", "$1F", "1.5", "é", "1,5", "NV", "0x-1"]
        {
            assert_eq!(read(text), None, "{text}");
        }
    }

    #[test]
    fn formulas_are_read_in_every_spelling() {
        for (text, offset, is_standard) in [
            ("$NODEID+0x180", 0x180, true),
            ("$NODEID+384", 384, true),
            ("$NODEID", 0, true),
            ("$NodeID + 0x200", 0x200, false),
            ("0x600+$NODEID", 0x600, false),
            ("$NODEID +0x80", 0x80, false),
            ("$NODEID+0x201    ; RPDO1", 0x201, false),
        ] {
            assert_eq!(formula(text), Some(Formula { offset, is_standard }), "{text}");
        }
        for text in
            ["$MY_NODE_ID+0x200", "\\+384", "$NODEID-1", "$NODEID*2", "$NODEID+1+2", "0x180", "$NODEID+-1"]
        {
            assert_eq!(formula(text), None, "{text}");
        }
    }
}
