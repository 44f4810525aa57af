//! Which characters the bytes of an EDS stand for. CiA 306 allows ASCII; the world has written everything.

use std::fmt;

/// How the characters of a text are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Nothing but ASCII, as CiA 306 4.2 wants it.
    Ascii,
    /// UTF-8.
    Utf8,
    /// UTF-8 behind a byte order mark.
    Utf8WithMark,
    /// UTF-16, low byte first, behind a byte order mark.
    Utf16Le,
    /// UTF-16, high byte first, behind a byte order mark.
    Utf16Be,
    /// Windows-1252, the Western code page of Windows.
    Windows1252,
    /// Code page 850, the Western one of DOS.
    Cp850,
    /// Code page 437, the first one of DOS.
    Cp437,
}

impl Encoding {
    /// The usual name.
    pub const fn name(self) -> &'static str {
        match self {
            Encoding::Ascii => "ASCII",
            Encoding::Utf8 => "UTF-8",
            Encoding::Utf8WithMark => "UTF-8 with a byte order mark",
            Encoding::Utf16Le => "UTF-16 LE",
            Encoding::Utf16Be => "UTF-16 BE",
            Encoding::Windows1252 => "Windows-1252",
            Encoding::Cp850 => "code page 850",
            Encoding::Cp437 => "code page 437",
        }
    }

    /// The characters of the bytes 80h to FFh.
    const fn upper_half(self) -> Option<&'static str> {
        match self {
            Encoding::Windows1252 => Some(WINDOWS_1252),
            Encoding::Cp850 => Some(CP850),
            Encoding::Cp437 => Some(CP437),
            Encoding::Ascii
            | Encoding::Utf8
            | Encoding::Utf8WithMark
            | Encoding::Utf16Le
            | Encoding::Utf16Be => None,
        }
    }
}

impl fmt::Display for Encoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The text that bytes stand for, and how they do. Every sequence of bytes stands for one, and [`encode`] gives it back.
///
/// What is neither UTF-8 nor marked as UTF-16 is read in the code page that fits best.
pub fn decode(bytes: Vec<u8>) -> (String, Encoding) {
    if let Some(text) = utf16(&bytes) {
        return text;
    }
    match String::from_utf8(bytes) {
        Ok(text) => match text.strip_prefix('\u{FEFF}') {
            Some(text) => (text.to_owned(), Encoding::Utf8WithMark),
            None if text.is_ascii() => (text, Encoding::Ascii),
            None => (text, Encoding::Utf8),
        },
        Err(error) => {
            let bytes = error.as_bytes();
            // The first of equals wins.
            let pages = [Encoding::Cp437, Encoding::Cp850, Encoding::Windows1252];
            let page = pages.into_iter().max_by_key(|page| fit(bytes, *page));
            let page = page.unwrap_or(Encoding::Windows1252);
            (in_code_page(bytes, page), page)
        }
    }
}

/// The bytes of a text in an encoding; the character that cannot be written in it.
///
/// # Errors
/// The first character that the encoding does not have.
pub fn encode(text: &str, encoding: Encoding) -> Result<Vec<u8>, char> {
    let utf16 = |mark: [u8; 2], bytes: fn(u16) -> [u8; 2]| {
        mark.into_iter().chain(text.encode_utf16().flat_map(bytes)).collect()
    };
    match encoding {
        Encoding::Utf8 => Ok(text.as_bytes().to_vec()),
        Encoding::Utf8WithMark => Ok(format!("\u{FEFF}{text}").into_bytes()),
        Encoding::Utf16Le => Ok(utf16([0xFF, 0xFE], u16::to_le_bytes)),
        Encoding::Utf16Be => Ok(utf16([0xFE, 0xFF], u16::to_be_bytes)),
        Encoding::Ascii | Encoding::Windows1252 | Encoding::Cp850 | Encoding::Cp437 => {
            let upper = encoding.upper_half().unwrap_or_default();
            let byte = |c: char| match u8::try_from(u32::from(c)) {
                Ok(byte) if byte < 0x80 => Ok(byte),
                _ => {
                    let at = upper.chars().position(|known| known == c).ok_or(c)?;
                    u8::try_from(0x80 + at).map_err(|_| c)
                }
            };
            text.chars().map(byte).collect()
        }
    }
}

/// UTF-16, if the bytes are marked as that and are nothing else.
fn utf16(bytes: &[u8]) -> Option<(String, Encoding)> {
    let (encoding, unit): (_, fn([u8; 2]) -> u16) = match bytes {
        [0xFF, 0xFE, ..] => (Encoding::Utf16Le, u16::from_le_bytes),
        [0xFE, 0xFF, ..] => (Encoding::Utf16Be, u16::from_be_bytes),
        _ => return None,
    };
    let (units, rest) = bytes.get(2..)?.as_chunks::<2>();
    let text =
        char::decode_utf16(units.iter().map(|pair| unit(*pair))).collect::<Result<String, _>>().ok()?;
    rest.is_empty().then_some((text, encoding))
}

/// How well a code page fits: letters stand beside letters, and degrees, squares and per mille behind a number or a blank.
fn fit(bytes: &[u8], page: Encoding) -> usize {
    let upper: Vec<char> = page.upper_half().unwrap_or_default().chars().collect();
    let points = |at: usize, byte: u8| {
        let Some(c) = usize::from(byte).checked_sub(0x80).and_then(|at| upper.get(at)) else { return 0 };
        let before = at.checked_sub(1).and_then(|at| bytes.get(at));
        let is_letter = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_alphabetic);
        match c {
            '°' | '²' | '³' | 'µ' | '‰' | '€' if before.is_some() => 2,
            c if c.is_alphabetic() => usize::from(is_letter(before) || is_letter(bytes.get(at + 1))),
            _ => 0,
        }
    };
    bytes.iter().enumerate().map(|(at, byte)| points(at, *byte)).sum()
}

fn in_code_page(bytes: &[u8], page: Encoding) -> String {
    let upper: Vec<char> = page.upper_half().unwrap_or_default().chars().collect();
    let decoded = |byte: &u8| match usize::from(*byte).checked_sub(0x80) {
        Some(at) => upper.get(at).copied().unwrap_or(char::REPLACEMENT_CHARACTER),
        None => char::from(*byte),
    };
    bytes.iter().map(decoded).collect()
}

/// The five bytes without a character are the control characters of their numbers.
const WINDOWS_1252: &str = "€\u{81}‚ƒ„…†‡ˆ‰Š‹Œ\u{8D}Ž\u{8F}\u{90}‘’“”•–—˜™š›œ\u{9D}žŸ\
    \u{A0}¡¢£¤¥¦§¨©ª«¬\u{AD}®¯°±²³´µ¶·¸¹º»¼½¾¿\
    ÀÁÂÃÄÅÆÇÈÉÊËÌÍÎÏÐÑÒÓÔÕÖ×ØÙÚÛÜÝÞßàáâãäåæçèéêëìíîïðñòóôõö÷øùúûüýþÿ";
const CP850: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜø£Ø×ƒáíóúñÑªº¿®¬½¼¡«»░▒▓│┤ÁÂÀ©╣║╗╝¢¥┐\
    └┴┬├─┼ãÃ╚╔╩╦╠═╬¤ðÐÊËÈıÍÎÏ┘┌█▄¦Ì▀ÓßÔÒõÕµþÞÚÛÙýÝ¯´\u{AD}±‗¾¶§÷¸°¨·¹³²■\u{A0}";
const CP437: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜ¢£¥₧ƒáíóúñÑªº¿⌐¬½¼¡«»░▒▓│┤╡╢╖╕╣║╗╝╜╛┐\
    └┴┬├─┼╞╟╚╔╩╦╠═╬╧╨╤╥╙╘╒╓╫╪┘┌█▄▌▐▀αßΓπΣσµτΦΘΩδ∞φε∩≡±≥≤⌠⌡÷≈°∙·√ⁿ²■\u{A0}";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_page_gives_each_byte_a_character_of_its_own() {
        for page in [Encoding::Windows1252, Encoding::Cp850, Encoding::Cp437] {
            let all: Vec<u8> = (0..=255).collect();
            let text = in_code_page(&all, page);
            assert_eq!(text.chars().count(), 256, "{page}");
            assert_eq!(encode(&text, page).as_deref(), Ok(all.as_slice()), "{page}");
        }
    }

    #[test]
    fn the_encoding_is_the_one_that_gives_words() {
        for (bytes, text, encoding) in [
            (&b"plain"[..], "plain", Encoding::Ascii),
            ("Schönaich".as_bytes(), "Schönaich", Encoding::Utf8),
            (b"\xEF\xBB\xBFabc", "abc", Encoding::Utf8WithMark),
            (b"\xFF\xFEa\0\xE4\0", "aä", Encoding::Utf16Le),
            (b"\xFE\xFF\0a\0\xE4", "aä", Encoding::Utf16Be),
            (b"Sch\xF6naich", "Schönaich", Encoding::Windows1252),
            (b"Sch\x94naich, Stra\xE1e", "Schönaich, Straße", Encoding::Cp850),
            (b"25 \xB0C, m/s\xB2", "25 °C, m/s²", Encoding::Windows1252),
            (b"25 \xF8C", "25 °C", Encoding::Cp850),
        ] {
            let decoded = decode(bytes.to_vec());
            assert_eq!(decoded, (text.to_owned(), encoding));
            assert_eq!(encode(text, encoding).as_deref(), Ok(bytes));
        }
    }

    #[test]
    fn what_is_marked_but_broken_is_read_byte_by_byte() {
        for bytes in [&b"\xFF\xFEa"[..], b"\xFF\xFE\0\xD8", b"\xFF\xFE", b"\xEF\xBB", b"\x80"] {
            let (text, encoding) = decode(bytes.to_vec());
            assert_eq!(encode(&text, encoding).as_deref(), Ok(bytes), "{bytes:?}");
        }
        assert_eq!(encode("Ω", Encoding::Windows1252), Err('Ω'));
    }
}
