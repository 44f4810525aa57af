//! How tables spell indices, sub-indices, words and numbers.

use std::ops::RangeInclusive;

use od_spec::model::{Access, PdoMapping};
use od_spec::words;

/// A text in lower case without spaces and signs.
pub(crate) fn plain(text: &str) -> String {
    text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Whether a cell says that there is nothing.
pub(crate) fn is_nothing(text: &str) -> bool {
    matches!(text.trim(), "" | "-" | "–" | "—" | "--" | "---" | "n/a" | "N/A" | "n.a." | "/")
}

/// A hexadecimal number with a mark: `0x1A00`, `1A00h`, `1A00 h`, `16#1A00`, `$1A00`.
pub(crate) fn marked_hex(text: &str) -> Option<u64> {
    let before = ["0x", "0X", "16#", "$"].into_iter().find_map(|mark| text.strip_prefix(mark));
    let digits = before.or_else(|| {
        let digits = text.strip_suffix(['h', 'H'])?.trim_end();
        // `each` and `batch` are words.
        digits.bytes().any(|b| b.is_ascii_digit() || b.is_ascii_uppercase()).then_some(digits)
    })?;
    let groups: Vec<&str> = digits.split(['_', ' ']).collect();
    let is_grouped = groups.len() == 1 || digits.contains('_') || groups.iter().all(|group| group.len() == 4);
    hex(&groups.concat()).filter(|_| is_grouped)
}

fn hex(digits: &str) -> Option<u64> {
    let is_hex = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_hexdigit());
    is_hex.then(|| u64::from_str_radix(digits, 16).ok()).flatten()
}

fn decimal(digits: &str) -> Option<u64> {
    let is_decimal = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    is_decimal.then(|| digits.parse().ok()).flatten()
}

/// The language of a table, which its titles show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Language {
    English,
    German,
}

/// How numbers without a mark are read in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Base {
    Decimal,
    Hexadecimal,
}

/// An index: with a mark, or in the base of its column; in hexadecimal it has four digits.
fn one_index(text: &str, base: Base) -> Option<u16> {
    let text = text.trim();
    // `Face` and `Beach` are words.
    if !text.bytes().any(|b| b.is_ascii_digit()) {
        return None;
    }
    let bare = match base {
        Base::Hexadecimal => hex(text).filter(|_| text.len() == 4),
        Base::Decimal => decimal(text),
    };
    u16::try_from(marked_hex(text).or(bare)?).ok().filter(|index| *index > 0)
}

/// What divides the two ends of a range.
const TO: [&str; 11] = ["...", "..", "…", " to ", " bis ", "–", "—", " - ", "-", "÷", "~"];

/// The two ends of a range.
pub(crate) fn ends(text: &str) -> Option<(&str, &str)> {
    // A minus at the beginning is a sign.
    let after = text.char_indices().nth(1).map_or(text.len(), |(at, _)| at);
    TO.into_iter().find_map(|to| {
        let at = after + text[after..].find(to)?;
        Some((text[..at].trim(), text[at + to.len()..].trim()))
    })
}

/// What a cell of indices names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Indices {
    pub indices: RangeInclusive<u16>,
    /// A sub-index after a point or a colon.
    pub sub: Option<u8>,
}

/// The most objects that a cell may name.
const LONGEST_RUN: u16 = 512;

/// `6040h`, `1A00h–1A03h`, `0x6081.0`.
pub(crate) fn indices(text: &str, base: Base) -> Option<Indices> {
    if let Some(index) = one_index(text, base) {
        return Some(Indices { indices: index..=index, sub: None });
    }
    if let Some((first, last)) = ends(text) {
        let (first, last) = (one_index(first, base)?, one_index(last, base)?);
        return (first < last && last - first < LONGEST_RUN)
            .then_some(Indices { indices: first..=last, sub: None });
    }
    let (index, sub) = text.split_once(['.', ':', '/', ','])?;
    let (index, sub) = (one_index(index, base)?, sub_index(sub, Base::Decimal)?);
    Some(Indices { indices: index..=index, sub: Some(sub) })
}

/// An error code or a run of them, in hexadecimal with a mark or without.
pub(crate) fn error_codes(text: &str) -> Option<RangeInclusive<u16>> {
    let code = |text: &str| {
        let text = text.trim();
        let number = marked_hex(text).or_else(|| hex(text).filter(|_| text.len() == 4))?;
        u16::try_from(number).ok()
    };
    if let Some(code) = code(text) {
        return Some(code..=code);
    }
    let (first, last) = ends(text)?;
    let (first, last) = (code(first)?, code(last)?);
    (first < last && last - first < LONGEST_RUN).then_some(first..=last)
}

fn sub_index(text: &str, base: Base) -> Option<u8> {
    let text = text.trim();
    let bare = match base {
        Base::Hexadecimal => hex(text),
        Base::Decimal => decimal(text),
    };
    marked_hex(text).or(bare).and_then(|number| u8::try_from(number).ok())
}

/// `3`, `0x03`, `1–8`; without a mark in the base of the column.
pub(crate) fn sub_indices(text: &str, base: Base) -> Option<RangeInclusive<u8>> {
    if let Some(sub) = sub_index(text, base) {
        return Some(sub..=sub);
    }
    let (first, last) = ends(text)?;
    let (first, last) = (sub_index(first, base)?, sub_index(last, base)?);
    (first < last).then_some(first..=last)
}

/// Whether a sub-index without a mark can only be hexadecimal.
pub(crate) fn is_hex_only(text: &str) -> bool {
    let text = text.trim();
    text.len() <= 2 && hex(text).is_some() && text.bytes().any(|b| b.is_ascii_alphabetic())
}

/// `3`, `4..7`, `7:4`: the bits of a table of bits, the lowest one first.
pub(crate) fn bits(text: &str) -> Option<RangeInclusive<u8>> {
    let bit = |text: &str| {
        let text = text.trim();
        let digits = ["Bit", "bit", "BIT", "B", "b"].into_iter().find_map(|word| text.strip_prefix(word));
        decimal(digits.unwrap_or(text).trim()).and_then(|bit| u8::try_from(bit).ok())
    };
    if let Some(bit) = bit(text) {
        return Some(bit..=bit);
    }
    let (one, other) = ends(text).or_else(|| text.split_once(':'))?;
    let (one, other) = (bit(one)?, bit(other)?);
    Some(one.min(other)..=one.max(other))
}

/// An access type, in the words of an EDS or a manual.
pub(crate) fn access(text: &str) -> Option<Access> {
    words::access(text).or_else(|| {
        Some(match plain(text).as_str() {
            "lesen" | "nurlesen" | "lesend" => Access::Ro,
            "schreiben" | "nurschreiben" | "schreibend" => Access::Wo,
            "lesenschreiben" | "lesenundschreiben" | "schreibenlesen" | "readandwrite" => Access::Rw,
            "konstant" | "konstante" => Access::Const,
            _ => return None,
        })
    })
}

/// A mapping: yes or no, or the direction. `Yes` is into those PDOs that the access allows.
pub(crate) fn mapping(text: &str, access: Option<Access>) -> Option<PdoMapping> {
    Some(match plain(text).as_str() {
        "n" | "no" | "nein" | "0" | "false" | "none" | "keine" | "not" | "nichtmapbar" => PdoMapping::None,
        "y" | "yes" | "j" | "ja" | "1" | "x" | "true" | "optional" | "opt" | "possible" | "mapbar"
        | "möglich" => match access? {
            Access::Const | Access::Ro | Access::Rwr => PdoMapping::Transmit,
            Access::Wo | Access::Rww => PdoMapping::Receive,
            Access::Rw => PdoMapping::Both,
        },
        "t" | "tx" | "tpdo" | "txpdo" | "transmit" | "senden" | "sendepdo" => PdoMapping::Transmit,
        "r" | "rx" | "rpdo" | "rxpdo" | "receive" | "empfang" | "empfangen" | "empfangspdo" => {
            PdoMapping::Receive
        }
        "rt" | "tr" | "rxtx" | "txrx" | "rpdotpdo" | "tpdorpdo" | "rxpdotxpdo" | "txpdorxpdo" | "both"
        | "beide" => PdoMapping::Both,
        "" if is_nothing(text) => PdoMapping::None,
        _ => return None,
    })
}

/// Yes or no in either language.
pub(crate) fn yes_no(text: &str) -> Option<bool> {
    Some(match plain(text).as_str() {
        "yes" | "true" | "1" | "ja" | "wahr" | "on" | "ein" => true,
        "no" | "false" | "0" | "nein" | "falsch" | "off" | "aus" => false,
        _ => return None,
    })
}

/// A number in the notation of a specification, and what follows it: `64h`, `-2,5 °C`, `16#64`.
///
/// A decimal number that begins with 0 is octal for some readers. A comma before three digits may divide thousands, and
/// in German so may a point. None of them is understood.
pub(crate) fn number(text: &str, language: Language) -> Option<(String, &str)> {
    let text = text.trim();
    if let Some(number) = marked_hex(text) {
        return Some((format!("0x{number:X}"), ""));
    }
    let (sign, rest) = match text.strip_prefix(['-', '−']) {
        Some(rest) => ("-", rest.trim_start()),
        None => ("", text.strip_prefix('+').unwrap_or(text)),
    };
    let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.' && c != ',').unwrap_or(rest.len());
    let (digits, symbol) = (&rest[..end], rest[end..].trim());
    let (whole, places) = match digits.split_once(['.', ',']) {
        Some((whole, places)) => (whole, Some(places)),
        None => (digits, None),
    };
    let is_whole = decimal(whole).is_some() && (whole.len() == 1 || !whole.starts_with('0'));
    let may_divide = digits.contains(',') || language == Language::German;
    let is_divided = may_divide && whole != "0" && places.is_some_and(|places| places.len() == 3);
    let is_fraction = places.is_none_or(|places| decimal(places).is_some());
    if !is_whole || is_divided || !is_fraction {
        return None;
    }
    Some((format!("{sign}{}", digits.replace(',', ".")), symbol))
}

/// `$NODEID+200h`, `200h + Node-ID`: the offset.
pub(crate) fn of_node_id(text: &str) -> Option<u64> {
    let (one, other) = text.split_once('+').map_or((text, "0"), |(one, other)| (one.trim(), other.trim()));
    let is_node_id = |text: &str| matches!(plain(text).as_str(), "nodeid" | "knotennummer" | "knotenid");
    let offset = match (is_node_id(one), is_node_id(other)) {
        (true, false) => other,
        (false, true) => one,
        (true, true) | (false, false) => return None,
    };
    marked_hex(offset).or_else(|| decimal(offset))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_index_is_hexadecimal_in_every_spelling() {
        let one = |text| indices(text, Base::Hexadecimal);
        for text in ["6040h", "6040 h", "0x6040", "0X6040", "16#6040", "$6040", "6040"] {
            assert_eq!(one(text), Some(Indices { indices: 0x6040..=0x6040, sub: None }), "{text}");
        }
        assert_eq!(one("0x6081.1"), Some(Indices { indices: 0x6081..=0x6081, sub: Some(1) }));
        for text in ["1A00h–1A03h", "1A00h..1A03h", "1A00 to 1A03", "0x1A00-0x1A03"] {
            assert_eq!(one(text).unwrap().indices, 0x1A00..=0x1A03, "{text}");
        }
        for text in ["", "24640", "604", "0x0", "velocity", "1A03h–1A00h", "Face", "Beach", "Each"] {
            assert_eq!(one(text), None, "{text}");
        }
        assert_eq!(indices("24640", Base::Decimal).unwrap().indices, 0x6040..=0x6040);
    }

    #[test]
    fn sub_indices_are_decimal_unless_marked() {
        assert_eq!(sub_indices("10", Base::Decimal), Some(10..=10));
        assert_eq!(sub_indices("10", Base::Hexadecimal), Some(16..=16));
        assert_eq!(sub_indices("0Ah", Base::Decimal), Some(10..=10));
        assert_eq!(sub_indices("1–8", Base::Decimal), Some(1..=8));
        assert_eq!(sub_indices("0A", Base::Decimal), None);
        assert!(is_hex_only("0A") && !is_hex_only("10"));
        assert_eq!([bits("7:4"), bits("Bit 3"), bits("0-2")], [Some(4..=7), Some(3..=3), Some(0..=2)]);
    }

    #[test]
    fn a_number_that_can_be_read_in_two_ways_is_not_one() {
        for (text, read) in [
            ("-5", "-5"),
            ("A1h", "0xA1"),
            ("0x0002_0192", "0x20192"),
            ("0002 0192h", "0x20192"),
            ("0", "0"),
            ("2,5 bar", "2.5 bar"),
            ("2.5bar", "2.5 bar"),
            ("−40 °C", "-40 °C"),
            ("1.000", "1.000"),
            ("60 1/min", "60 1/min"),
        ] {
            let found = number(text, Language::English)
                .map(|(number, symbol)| format!("{number} {symbol}").trim().to_owned());
            assert_eq!(found.as_deref(), Some(read), "{text}");
        }
        for text in ["010", "1,000", "A1", "", "-", "1.2.3", "bar", "00.5"] {
            assert_eq!(number(text, Language::English), None, "{text}");
        }
        assert_eq!(number("1.000", Language::German), None);
        assert_eq!(number("0,125 V", Language::German), Some(("0.125".to_owned(), "V")));
        assert_eq!(of_node_id("$NODEID+200h"), Some(0x200));
        assert_eq!(
            [of_node_id("180h + Node-ID"), of_node_id("$NODEID"), of_node_id("5")],
            [Some(0x180), Some(0), None]
        );
    }
}
