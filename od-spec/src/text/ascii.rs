//! Text for files that hold ASCII only (CiA 306 4.2).

use std::borrow::Cow;

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
        'ç' => "c",
        'Ç' => "C",
        'ñ' => "n",
        'Ñ' => "N",
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
        _ => "?",
    }
}

#[cfg(test)]
mod tests {
    use super::transliterate;

    #[test]
    fn ascii_stays_and_the_rest_is_transcribed() {
        assert_eq!(transliterate("Größe: 50.0 °C…\t5 µs²"), "Groesse: 50.0 degC... 5 us2");
        assert_eq!(transliterate("日"), "?");
        assert!(transliterate("\u{0}\u{7f}ä").is_ascii());
    }
}
