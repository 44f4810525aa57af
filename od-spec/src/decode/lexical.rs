//! Notations inside scalars: indices, entries, bits, dates, access, patterns.

use crate::ast::plant::MachineKey;
use crate::ast::{BaseDecl, BitRange, CodeRange, IndexRange, NumberRange, SubIndexRange};
use crate::file_name::is_device;
use crate::model::{
    Access, AccessRight, BitPattern, Date, DateTime, EntryId, Index, PatternBit, Ratio, SubIndex,
};
use crate::scalar;

/// An entry by index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NumberedEntry {
    pub index: Index,
    /// The sub-index, if one is written.
    pub sub: Option<SubIndex>,
}

impl NumberedEntry {
    /// The entry; without a sub-index, that at 0.
    pub(crate) fn id(self) -> EntryId {
        EntryId { index: self.index, sub: self.sub.unwrap_or(SubIndex(0)) }
    }
}

/// An index from 0001h to FFFFh, in hexadecimal as everyone writes it.
pub(crate) fn index(text: &str) -> Option<Index> {
    u16_in_hexadecimal(text).filter(|index| *index != 0).map(Index)
}

/// A number with `0x`: without it, four digits can be either number.
fn u16_in_hexadecimal(text: &str) -> Option<u16> {
    let value = scalar::integer(text).ok().filter(|_| text.starts_with("0x") || text.starts_with("0X"))?;
    u16::try_from(value).ok()
}

/// How indices, entries and error codes are written that lack their `0x`: `2001`, `2001h`, `2001.3`, `2001..2004`, and `24640`, whose
/// five digits are decimal. `None` for anything else.
pub(crate) fn with_0x(text: &str) -> Option<String> {
    if text.starts_with("0x") && !text.ends_with(['h', 'H']) {
        return None;
    }
    let one = |text: &str| {
        let (number, sub) =
            text.trim().split_once('.').map_or((text.trim(), None), |(number, sub)| (number, Some(sub)));
        let digits = number.strip_prefix("0x").unwrap_or(number);
        let digits = digits.strip_suffix(['h', 'H']).unwrap_or(digits);
        let number = match digits.len() {
            1..=4 => u16::from_str_radix(digits, 16).ok()?,
            _ => digits.parse().ok()?,
        };
        let sub = match sub {
            Some(sub) => format!(".{}", u8::try_from(scalar::integer(sub).ok()?).ok()?),
            None => String::new(),
        };
        (number != 0).then(|| format!("0x{number:04X}{sub}"))
    };
    match text.split_once("..") {
        Some((first, last)) => Some(format!("{}..{}", one(first)?, one(last)?)),
        None => one(text),
    }
}

/// `0x30FA.3`, or `0x6064`.
pub(crate) fn entry_by_index(text: &str) -> Option<NumberedEntry> {
    let (object, sub) = match text.split_once('.') {
        Some((object, sub)) => (object, Some(sub)),
        None => (text, None),
    };
    let index = index(object)?;
    let sub = match sub {
        Some(sub) => Some(SubIndex(u8::try_from(scalar::integer(sub).ok()?).ok()?)),
        None => None,
    };
    Some(NumberedEntry { index, sub })
}

/// Entries of one object, from the first sub-index to the last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NumberedRun {
    pub index: Index,
    pub subs: SubIndexRange,
}

/// `0x2021.1..4`.
pub(crate) fn run_by_index(text: &str) -> Option<NumberedRun> {
    let (object, subs) = text.split_once('.').filter(|(_, subs)| subs.contains(".."))?;
    Some(NumberedRun { index: index(object)?, subs: sub_indices(subs)? })
}

/// How a run of entries is written that is meant by `2021.1..4` or `0x2021.1..0x2021.4`.
pub(crate) fn run_with_0x(text: &str) -> Option<String> {
    let (first, last) = text.split_once("..")?;
    let (first, last) = (first.trim(), last.trim());
    let first = with_0x(first).unwrap_or_else(|| first.to_owned());
    let last = match last.split_once('.') {
        Some((object, last)) => {
            let object = with_0x(object).unwrap_or_else(|| object.to_owned());
            (index(&object) == entry_by_index(&first)?.index.into()).then_some(last)?
        }
        None => last,
    };
    let meant = format!("{first}..{last}");
    run_by_index(&meant).map(|_| meant)
}

/// A run of something, or one alone, which is the first and the last.
fn run<T: Copy + PartialOrd>(text: &str, one: impl Fn(&str) -> Option<T>) -> Option<(T, T)> {
    // Nearly all are alone.
    let Some(dots) = text.as_bytes().windows(2).position(|pair| pair == b"..") else {
        return one(text.trim()).map(|one| (one, one));
    };
    let (first, last) = (one(text[..dots].trim())?, one(text[dots + 2..].trim())?);
    (first <= last).then_some((first, last))
}

/// A name that may name folders and files on every system.
pub(crate) fn is_place(text: &str) -> bool {
    let mut letters = text.bytes();
    letters.next().is_some_and(|first| first.is_ascii_alphanumeric())
        && letters.all(|c| c.is_ascii_alphanumeric() || matches!(c, b'-' | b'_'))
        && text.len() <= 32
        && !is_device(text)
}

/// `crane-A`, `17`, or `1..200`: machines by name or number.
pub(crate) fn machines(text: &str) -> Option<MachineKey> {
    let number = |text: &str| {
        let number = scalar::integer(text).ok().and_then(|number| u32::try_from(number).ok())?;
        (number <= 65_535 && text.bytes().all(|c| c.is_ascii_digit())).then_some(number)
    };
    if let Some((first, last)) = run(text, number) {
        return Some(MachineKey::Numbers { first, last, is_run: text.contains("..") });
    }
    // `017` would be another name for 17.
    let is_name = is_place(text) && !text.bytes().all(|c| c.is_ascii_digit());
    is_name.then(|| MachineKey::Name(text.to_owned()))
}

/// `5`, or `1..4`: sub-indices of elements or members.
pub(crate) fn sub_indices(text: &str) -> Option<SubIndexRange> {
    let number = |text: &str| {
        let number = u8::try_from(scalar::integer(text).ok()?).ok()?;
        (1..=254).contains(&number).then_some(SubIndex(number))
    };
    run(text, number).map(|(first, last)| SubIndexRange { first, last })
}

/// The other way round, a run that ends before it begins: `1..4` of `4..1`.
pub(crate) fn turned(text: &str) -> Option<String> {
    let (first, last) = text.split_once("..")?;
    let (first, last) = (first.trim(), last.trim());
    match first.split_once('.') {
        Some((object, first)) => Some(format!("{object}.{last}..{first}")),
        None => Some(format!("{last}..{first}")),
    }
}

/// Whether a reference is meant as a number rather than as a name.
pub(crate) fn looks_like_index(text: &str) -> bool {
    let rest = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
    match rest {
        Some(_) => true,
        None => !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit() || b == b'.' || b == b'_'),
    }
}

/// `5` or `0..3`.
pub(crate) fn bits(text: &str) -> Option<BitRange> {
    let number = |text: &str| u8::try_from(scalar::integer(text).ok()?).ok().filter(|bit| *bit < 64);
    run(text, number).map(|(first, last)| BitRange { first, last })
}

/// `4`, or `0..11`.
pub(crate) fn numbers(text: &str) -> Option<NumberRange> {
    let number = |text: &str| u8::try_from(scalar::integer(text).ok()?).ok();
    run(text, number).map(|(first, last)| NumberRange { first, last })
}

/// `0x3280` or `0x3281..0x3288`.
pub(crate) fn error_codes(text: &str) -> Option<CodeRange> {
    run(text, u16_in_hexadecimal).map(|(first, last)| CodeRange { first, last })
}

/// `0x3280`; a code that lacks its `0x` was refused, and is that code all the same.
pub(super) fn error_code(text: &str) -> Option<i128> {
    let codes = error_codes(text).or_else(|| error_codes(&with_0x(text)?))?;
    (codes.first == codes.last).then(|| codes.first.into())
}

/// Whether a text can be the key of a device, which names its files: up to 32 lower-case letters, digits and hyphens, no hyphen
/// first.
pub fn is_device_key(text: &str) -> bool {
    let allowed = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    (1..=32).contains(&text.len()) && !text.starts_with('-') && text.chars().all(allowed)
}

/// `0x6040`, or `0x3511..0x3519`.
pub(crate) fn indices(text: &str) -> Option<IndexRange> {
    run(text, index).map(|(first, last)| IndexRange { first, last })
}

/// `2009-05-27`, a day that exists.
pub(crate) fn date(text: &str) -> Option<Date> {
    let mut parts = text.split('-');
    let mut part = |width: usize| {
        let digits = parts.next()?;
        (digits.len() == width && digits.bytes().all(|b| b.is_ascii_digit()))
            .then(|| digits.parse::<u16>().ok())?
    };
    let (year, month, day) = (part(4)?, part(2)?, part(2)?);
    Date::of(year, month, day).filter(|_| parts.next().is_none())
}

/// `2009-05-27 09:00`.
pub(crate) fn date_time(text: &str) -> Option<DateTime> {
    let (day, time) = text.split_once([' ', 'T'])?;
    let (hour, minute) = time.split_once(':')?;
    let number = |digits: &str, below: u8| {
        let two_digits = digits.len() == 2 && digits.bytes().all(|b| b.is_ascii_digit());
        digits.parse::<u8>().ok().filter(|value| two_digits && *value < below)
    };
    Some(DateTime { date: date(day)?, hour: number(hour, 24)?, minute: number(minute, 60)? })
}

/// `rw`, `rw locked`.
pub(crate) fn access(text: &str) -> Option<AccessRight> {
    let (word, locked) = match text.strip_suffix(" locked") {
        Some(word) => (word.trim_end(), true),
        None => (text, false),
    };
    Some(AccessRight { access: Access::from_word(word)?, locked })
}

/// `1/10`; positive.
pub(crate) fn positive_ratio(text: &str) -> Option<Ratio> {
    scalar::ratio(text).filter(|ratio| ratio.numerator() > 0)
}

/// `1/1000 V`.
pub(crate) fn base(text: &str) -> Option<BaseDecl> {
    let (ratio, symbol) = text.rsplit_once(' ')?;
    let factor = positive_ratio(ratio)?;
    let symbol = symbol.trim();
    (!symbol.is_empty()).then(|| BaseDecl { factor, symbol: symbol.to_owned() })
}

/// `xxxx xxxx x01x 0001`: 8, 16 or 32 bits, most significant first.
pub(crate) fn pattern(text: &str) -> Option<BitPattern> {
    let bits: Option<Vec<PatternBit>> = text
        .chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| match c {
            '0' => Some(PatternBit::Zero),
            '1' => Some(PatternBit::One),
            'x' => Some(PatternBit::Any),
            'r' => Some(PatternBit::Rising),
            'f' => Some(PatternBit::Falling),
            _ => None,
        })
        .collect();
    bits.filter(|bits| matches!(bits.len(), 8 | 16 | 32)).map(BitPattern)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notations() {
        assert_eq!(index("0x6040"), Some(Index(0x6040)));
        assert_eq!((index("0x0"), index("0x10000"), index("x"), index("4120")), (None, None, None, None));
        let meant = |text| with_0x(text).unwrap_or_default();
        assert_eq!(
            [meant("2001"), meant("2001h"), meant("0x2001h"), meant("3abc")],
            ["0x2001", "0x2001", "0x2001", "0x3ABC"]
        );
        assert_eq!(
            [meant("2001.3"), meant("2001..2004"), meant("24640")],
            ["0x2001.3", "0x2001..0x2004", "0x6040"]
        );
        assert_eq!([meant("0x2001"), meant("speed"), meant("99999"), meant("0")], [""; 4]);
        let entry = NumberedEntry { index: Index(0x30FA), sub: Some(SubIndex(10)) };
        assert_eq!(entry_by_index("0x30FA.10"), Some(entry));
        assert_eq!(entry_by_index("0x30FA.0x0A"), Some(entry));
        assert_eq!(entry_by_index("0x30FA").unwrap().id(), EntryId { sub: SubIndex(0), ..entry.id() });
        assert_eq!(entry_by_index("0x30FA."), None);
        assert_eq!(bits("0..3"), Some(BitRange { first: 0, last: 3 }));
        assert_eq!((bits("3..0"), bits("64")), (None, None));
        assert_eq!(date("2008-02-29"), Some(Date { year: 2008, month: 2, day: 29 }));
        assert_eq!((date("2009-02-29"), date("09-05-27"), date("2009-5-27")), (None, None, None));
        assert!(date_time("2009-05-27 09:00").is_some());
        assert!(date_time("2009-05-27 24:00").is_none());
        assert_eq!(access("rw locked"), Some(AccessRight { access: Access::Rw, locked: true }));
        assert_eq!(access("locked"), None);
        assert_eq!(pattern("xxxx xxxx x01x 0001").unwrap().mask_and_value(), (0b0110_1111, 0b0010_0001));
        assert_eq!(pattern("xxxx"), None);
    }
}
