//! Text for files that hold ASCII only (CiA 306 4.2).

use std::borrow::Cow;

use super::visible::turning;

/// Replaces every character outside printable ASCII by its usual transcription: `ä` → `ae`, `°` → `deg`, `²` → `2`.
/// What has none becomes `?`.
pub fn transliterate(text: &str) -> String {
    in_ascii(text).into_owned()
}

/// Whether a text is printable ASCII only.
pub fn is_printable(text: &str) -> bool {
    // Without an end in between, the compiler looks at many bytes at once.
    text.bytes().fold(true, |all, byte| all & matches!(byte, b' '..=b'~'))
}

/// [`transliterate`], without a copy of what is printable ASCII already.
pub fn in_ascii(text: &str) -> Cow<'_, str> {
    if is_printable(text) {
        return Cow::Borrowed(text);
    }
    Cow::Owned(text.chars().fold(String::with_capacity(text.len()), |mut out, c| {
        match c {
            ' '..='~' => out.push(c),
            _ if c.is_whitespace() => out.push(' '),
            _ => out.push_str(transcription(c)),
        }
        out
    }))
}

/// Whether characters of a text have no transcription, so that [`transliterate`] has a `?` in place of each.
///
/// Those that turn the text around them are refused for that.
pub fn has_lost(text: &str) -> bool {
    !is_printable(text)
        && in_ascii(text).matches('?').count() > text.matches('?').count() + turning(text).count()
}

/// Whether [`transliterate`] leaves nothing of a name but `?`.
pub fn has_no_form(name: &str) -> bool {
    has_lost(name) && in_ascii(name).chars().all(|c| matches!(c, '?' | ' '))
}

/// The name of an object or entry in ASCII; `otherwise` replaces one that has no form in it.
pub fn name_in_ascii(name: &str, otherwise: impl FnOnce() -> String) -> Cow<'_, str> {
    if has_no_form(name) { Cow::Owned(otherwise()) } else { in_ascii(name) }
}

/// What a name keeps where nothing but letters and digits counts, and no capital: two names that are equal in it are easily
/// taken for each other, and an identifier cannot tell them apart. Blanks and signs count between two letters and between two
/// digits: `word 1` is `word1`, and `1 0` is not `10`.
pub fn letters(name: &str) -> String {
    let ascii = in_ascii(name);
    let mut letters = String::with_capacity(ascii.len());
    for word in ascii.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()) {
        let ends_with_digit = letters.ends_with(|last: char| last.is_ascii_digit());
        let begins_with_digit = word.starts_with(|first: char| first.is_ascii_digit());
        if !letters.is_empty() && (ends_with_digit || !begins_with_digit) {
            letters.push(' ');
        }
        letters.extend(word.chars().map(|c| c.to_ascii_lowercase()));
    }
    letters
}

#[expect(clippy::too_many_lines, reason = "a table with a row for each letter")]
const fn transcription(c: char) -> &'static str {
    match c {
        'ä' => "ae",
        'ö' => "oe",
        'ü' => "ue",
        'Ä' => "Ae",
        'Ö' => "Oe",
        'Ü' => "Ue",
        'ß' => "ss",
        'à' | 'á' | 'â' | 'ã' | 'å' => "a",
        'À' | 'Á' | 'Â' | 'Ã' | 'Å' => "A",
        'è' | 'é' | 'ê' | 'ë' => "e",
        'È' | 'É' | 'Ê' | 'Ë' => "E",
        'ì' | 'í' | 'î' | 'ï' => "i",
        'Ì' | 'Í' | 'Î' | 'Ï' => "I",
        'ò' | 'ó' | 'ô' | 'õ' | 'ø' => "o",
        'Ò' | 'Ó' | 'Ô' | 'Õ' | 'Ø' => "O",
        'ù' | 'ú' | 'û' => "u",
        'Ù' | 'Ú' | 'Û' => "U",
        'ý' | 'ÿ' => "y",
        'Ý' | 'Ÿ' => "Y",
        'ç' | 'č' | 'ć' => "c",
        'Ç' | 'Č' | 'Ć' => "C",
        'ñ' | 'ň' | 'ń' => "n",
        'Ñ' | 'Ň' | 'Ń' => "N",
        'ą' | 'ă' => "a",
        'Ą' | 'Ă' => "A",
        'ď' | 'đ' => "d",
        'Ď' | 'Đ' => "D",
        'ě' | 'ę' | 'ė' => "e",
        'Ě' | 'Ę' | 'Ė' => "E",
        'ğ' => "g",
        'Ğ' => "G",
        'ı' => "i",
        'İ' => "I",
        'ł' | 'ľ' | 'ĺ' => "l",
        'Ł' | 'Ľ' | 'Ĺ' => "L",
        'ő' => "o",
        'Ő' => "O",
        'ř' | 'ŕ' => "r",
        'Ř' | 'Ŕ' => "R",
        'š' | 'ś' | 'ş' | 'ș' => "s",
        'Š' | 'Ś' | 'Ş' | 'Ș' => "S",
        'ť' | 'ţ' | 'ț' => "t",
        'Ť' | 'Ţ' | 'Ț' => "T",
        'ů' | 'ű' => "u",
        'Ů' | 'Ű' => "U",
        'ž' | 'ź' | 'ż' => "z",
        'Ž' | 'Ź' | 'Ż' => "Z",
        'æ' => "ae",
        'Æ' => "Ae",
        'œ' => "oe",
        'Œ' => "Oe",
        '°' => "deg",
        '\u{b5}' | '\u{3bc}' => "u",
        '\u{3a9}' | '\u{2126}' => "Ohm",
        '²' => "2",
        '³' => "3",
        '·' | '×' | '⋅' => "*",
        '±' => "+-",
        '≤' => "<=",
        '≥' => ">=",
        '≠' => "<>",
        '→' => "->",
        '←' => "<-",
        '…' => "...",
        '–' | '—' | '−' | '‐' | '‑' => "-",
        '‘' | '’' | '‚' => "'",
        '“' | '”' | '„' | '«' | '»' => "\"",
        '½' => "1/2",
        '¼' => "1/4",
        '¾' => "3/4",
        '‰' => "per mille",
        '€' => "EUR",
        'а' => "a",
        'А' => "A",
        'б' => "b",
        'Б' => "B",
        'в' => "v",
        'В' => "V",
        'г' => "g",
        'Г' => "G",
        'д' => "d",
        'Д' => "D",
        'е' | 'ё' | 'э' => "e",
        'Е' | 'Ё' | 'Э' => "E",
        'ж' => "zh",
        'Ж' => "Zh",
        'з' => "z",
        'З' => "Z",
        'и' => "i",
        'И' => "I",
        'й' | 'ы' => "y",
        'Й' | 'Ы' => "Y",
        'к' => "k",
        'К' => "K",
        'л' => "l",
        'Л' => "L",
        'м' => "m",
        'М' => "M",
        'н' => "n",
        'Н' => "N",
        'о' => "o",
        'О' => "O",
        'п' => "p",
        'П' => "P",
        'р' => "r",
        'Р' => "R",
        'с' => "s",
        'С' => "S",
        'т' => "t",
        'Т' => "T",
        'у' => "u",
        'У' => "U",
        'ф' => "f",
        'Ф' => "F",
        'х' => "kh",
        'Х' => "Kh",
        'ц' => "ts",
        'Ц' => "Ts",
        'ч' => "ch",
        'Ч' => "Ch",
        'ш' => "sh",
        'Ш' => "Sh",
        'щ' => "shch",
        'Щ' => "Shch",
        'ъ' | 'Ъ' | 'ь' | 'Ь' => "",
        'ю' => "yu",
        'Ю' => "Yu",
        'я' => "ya",
        'Я' => "Ya",
        _ => "?",
    }
}

#[cfg(test)]
mod tests {
    use super::{has_lost, letters, name_in_ascii, transliterate};

    #[test]
    fn what_has_no_form_has_a_name_all_the_same() {
        let name = |name| name_in_ascii(name, || "object 2000h".to_owned()).into_owned();
        assert_eq!(
            ["温 度", "speed?", "?", "温度 1", ""].map(name),
            ["object 2000h", "speed?", "?", "?? 1", ""]
        );
        assert_eq!(["温度 1", "speed?", "Größe"].map(has_lost), [true, false, false]);
    }

    #[test]
    fn letters_and_digits_of_a_name_are_left() {
        let same = |one: &str, other: &str| letters(one) == letters(other);
        assert!(
            same("On!", "ON")
                && same("word 1", "Word1")
                && same("Größe (µs)", "groesse us")
                && same("+", "-")
        );
        assert!(!same("on line", "online") && !same("1 0", "10") && !same("phase 1 a", "phase 1a"));
    }

    #[test]
    fn ascii_stays_and_the_rest_is_transcribed() {
        assert_eq!(transliterate("Größe: 50.0 °C…\t5 µs²"), "Groesse: 50.0 degC... 5 us2");
        assert_eq!(transliterate("Příliš żółty Đ"), "Prilis zolty D");
        assert_eq!(transliterate("Скорость, Ёж"), "Skorost, Ezh");
        assert_eq!(transliterate("日"), "?");
        assert!(transliterate("\u{0}\u{7f}ä").is_ascii());
    }
}
