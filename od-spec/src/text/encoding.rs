//! Which characters the bytes of an EDS represent. CiA 306 allows ASCII; the world has written everything.

use std::fmt;

use super::fit::fit;

/// How the characters of a text are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Nothing but ASCII, as CiA 306 4.2 wants it.
    Ascii,
    /// UTF-8.
    Utf8,
    /// UTF-8 after a byte order mark.
    Utf8WithMark,
    /// UTF-16, low byte first, after a byte order mark.
    Utf16Le,
    /// UTF-16, high byte first, after a byte order mark.
    Utf16Be,
    /// UTF-16, low byte first, without a byte order mark.
    Utf16LeUnmarked,
    /// UTF-16, high byte first, without a byte order mark.
    Utf16BeUnmarked,
    /// Windows-1252, the Western code page of Windows.
    Windows1252,
    /// Windows-1251, the Cyrillic code page of Windows.
    Windows1251,
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
            Encoding::Utf16LeUnmarked => "UTF-16 LE without a byte order mark",
            Encoding::Utf16BeUnmarked => "UTF-16 BE without a byte order mark",
            Encoding::Windows1252 => "Windows-1252",
            Encoding::Windows1251 => "Windows-1251",
            Encoding::Cp850 => "code page 850",
            Encoding::Cp437 => "code page 437",
        }
    }

    /// The characters of the bytes 80h to FFh.
    const fn upper_half(self) -> Option<&'static str> {
        match self {
            Encoding::Windows1252 => Some(WINDOWS_1252),
            Encoding::Windows1251 => Some(WINDOWS_1251),
            Encoding::Cp850 => Some(CP850),
            Encoding::Cp437 => Some(CP437),
            Encoding::Ascii
            | Encoding::Utf8
            | Encoding::Utf8WithMark
            | Encoding::Utf16Le
            | Encoding::Utf16Be
            | Encoding::Utf16LeUnmarked
            | Encoding::Utf16BeUnmarked => None,
        }
    }

    /// The characters of bytes in a code page.
    fn characters(self, bytes: &[u8]) -> Vec<char> {
        let upper: Vec<char> = self.upper_half().unwrap_or_default().chars().collect();
        let character = |byte: &u8| match byte.checked_sub(0x80) {
            Some(at) => upper.get(usize::from(at)).copied().unwrap_or(char::REPLACEMENT_CHARACTER),
            None => char::from(*byte),
        };
        bytes.iter().map(character).collect()
    }
}

impl fmt::Display for Encoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Code pages that are recognised and not read: a character has two bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unread {
    /// GBK of Chinese systems, or one that looks the same: EUC-KR, EUC-JP.
    Gbk,
    /// Shift-JIS of Japanese systems.
    ShiftJis,
}

impl Unread {
    /// The usual name.
    pub const fn name(self) -> &'static str {
        match self {
            Unread::Gbk => "GBK",
            Unread::ShiftJis => "Shift-JIS",
        }
    }
}

/// Code pages of Western languages. The first of those that fit equally well is taken.
const WESTERN: [Encoding; 3] = [Encoding::Windows1252, Encoding::Cp850, Encoding::Cp437];

/// The text that bytes represent, and how; [`encode`] gives the same bytes back.
///
/// What is neither UTF-8 nor UTF-16 is read in the code page that fits best.
///
/// # Errors
/// The bytes are of a code page that is not read.
pub fn decode(bytes: Vec<u8>) -> Result<(String, Encoding), Unread> {
    if let Some(text) = utf16(&bytes) {
        return Ok(text);
    }
    let bytes = match String::from_utf8(bytes) {
        Ok(text) => {
            return Ok(match text.strip_prefix('\u{FEFF}') {
                Some(text) => (text.to_owned(), Encoding::Utf8WithMark),
                None if text.is_ascii() => (text, Encoding::Ascii),
                None => (text, Encoding::Utf8),
            });
        }
        Err(error) => error.into_bytes(),
    };
    let page = if is_cyrillic(&bytes) { Encoding::Windows1251 } else { western(&bytes)? };
    Ok((page.characters(&bytes).into_iter().collect(), page))
}

/// The Western code page that fits best.
///
/// # Errors
/// Hardly anything makes a word in it, and everything is a character of two bytes in another.
fn western(bytes: &[u8]) -> Result<Encoding, Unread> {
    let [first, rest @ ..] = WESTERN;
    let mut best = (fit(&first.characters(bytes)), first);
    for page in rest {
        let points = fit(&page.characters(bytes));
        if points > best.0 {
            best = (points, page);
        }
    }
    let (points, page) = best;
    let letters = i64::try_from(bytes.iter().filter(|byte| !byte.is_ascii()).count()).unwrap_or(i64::MAX);
    // A letter within a word makes 3 or 4, a sign of a unit 5.
    if i64::from(points) >= letters * 3 {
        return Ok(page);
    }
    in_pairs(bytes).map_or(Ok(page), Err)
}

/// Another code page that as much speaks for as for the one in which a text is stored.
pub fn as_likely(text: &str, encoding: Encoding) -> Option<Encoding> {
    if !WESTERN.contains(&encoding) {
        return None;
    }
    let bytes = encode(text, encoding).ok()?;
    let points = fit(&encoding.characters(&bytes));
    let differs = |page: &Encoding| !page.characters(&bytes).into_iter().eq(text.chars());
    WESTERN.into_iter().find(|page| fit(&page.characters(&bytes)) == points && differs(page))
}

/// Whether the bytes that are not ASCII are Russian words: runs of letters of which most are small.
fn is_cyrillic(bytes: &[u8]) -> bool {
    let is_letter = |byte: u8| matches!(byte, 0xC0..=0xFF | 0xA8 | 0xB8);
    let (mut letters, mut small, mut in_runs) = (0_usize, 0_usize, 0_usize);
    for run in bytes.split(u8::is_ascii).filter(|run| !run.is_empty()) {
        if !run.iter().all(|byte| is_letter(*byte)) {
            return false;
        }
        letters += run.len();
        small += run.iter().filter(|byte| **byte >= 0xE0).count();
        in_runs += if run.len() >= 3 { run.len() } else { 0 };
    }
    letters > 0 && in_runs * 4 >= letters * 3 && small * 2 > letters
}

/// Whether two bytes make a character.
type IsPair = fn(u8, u8) -> bool;

/// The code page in which two bytes make a character, if the text has words of it: characters side by side.
fn in_pairs(bytes: &[u8]) -> Option<Unread> {
    // Each ends where it is not of the code page; a Western text does so soon, or has each pair alone between ASCII.
    let are_words = |is_pair: IsPair| {
        let (mut pairs, mut side_by_side, mut at) = (0_usize, 0_usize, 0);
        let mut before = false;
        while let Some(first) = bytes.get(at) {
            if first.is_ascii() {
                before = false;
                at += 1;
                continue;
            }
            let after = bytes.get(at + 2).is_some_and(|next| !next.is_ascii());
            if !bytes.get(at + 1).is_some_and(|second| is_pair(*first, *second)) {
                return false;
            }
            pairs += 1;
            side_by_side += usize::from(before || after);
            before = true;
            at += 2;
        }
        pairs >= 2 && side_by_side * 5 >= pairs * 4
    };
    let gb2312 = |first, second| matches!(first, 0xA1..=0xF7) && matches!(second, 0xA1..=0xFE);
    let shift_jis = |first, second| {
        matches!(first, 0x81..=0x9F | 0xE0..=0xEF) && matches!(second, 0x40..=0x7E | 0x80..=0xFC)
    };
    let gbk = |first, second| matches!(first, 0x81..=0xFE) && matches!(second, 0x40..=0x7E | 0x80..=0xFE);
    let pages: [(IsPair, Unread); 3] =
        [(gb2312, Unread::Gbk), (shift_jis, Unread::ShiftJis), (gbk, Unread::Gbk)];
    pages.into_iter().find(|(is_pair, _)| are_words(*is_pair)).map(|(_, page)| page)
}

/// The bytes of a text in an encoding; the character that cannot be written in it.
///
/// # Errors
/// The first character that the encoding does not have.
pub fn encode(text: &str, encoding: Encoding) -> Result<Vec<u8>, char> {
    let utf16 = |mark: &[u8], bytes: fn(u16) -> [u8; 2]| {
        mark.iter().copied().chain(text.encode_utf16().flat_map(bytes)).collect()
    };
    match encoding {
        Encoding::Utf8 => Ok(text.as_bytes().to_vec()),
        Encoding::Utf8WithMark => Ok(format!("\u{FEFF}{text}").into_bytes()),
        Encoding::Utf16Le => Ok(utf16(&[0xFF, 0xFE], u16::to_le_bytes)),
        Encoding::Utf16Be => Ok(utf16(&[0xFE, 0xFF], u16::to_be_bytes)),
        Encoding::Utf16LeUnmarked => Ok(utf16(&[], u16::to_le_bytes)),
        Encoding::Utf16BeUnmarked => Ok(utf16(&[], u16::to_be_bytes)),
        Encoding::Ascii
        | Encoding::Windows1252
        | Encoding::Windows1251
        | Encoding::Cp850
        | Encoding::Cp437 => {
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

/// UTF-16, if the bytes are marked as that and are nothing else, or are ASCII in every second byte for the most part.
fn utf16(bytes: &[u8]) -> Option<(String, Encoding)> {
    let little: fn([u8; 2]) -> u16 = u16::from_le_bytes;
    let big: fn([u8; 2]) -> u16 = u16::from_be_bytes;
    let (encoding, unit, rest) = match bytes {
        [0xFF, 0xFE, rest @ ..] => (Encoding::Utf16Le, little, rest),
        [0xFE, 0xFF, rest @ ..] => (Encoding::Utf16Be, big, rest),
        _ => {
            let zeros = |from: usize| bytes.iter().skip(from).step_by(2).filter(|byte| **byte == 0).count();
            let most = bytes.len() / 2;
            match (zeros(0), zeros(1)) {
                (0, low) if low * 2 > most => (Encoding::Utf16LeUnmarked, little, bytes),
                (high, 0) if high * 2 > most => (Encoding::Utf16BeUnmarked, big, bytes),
                _ => return None,
            }
        }
    };
    let (units, rest) = rest.as_chunks::<2>();
    let text =
        char::decode_utf16(units.iter().map(|pair| unit(*pair))).collect::<Result<String, _>>().ok()?;
    rest.is_empty().then_some((text, encoding))
}

/// The five bytes without a character are the control characters of their numbers.
const WINDOWS_1252: &str = "€\u{81}‚ƒ„…†‡ˆ‰Š‹Œ\u{8D}Ž\u{8F}\u{90}‘’“”•–—˜™š›œ\u{9D}žŸ\
    \u{A0}¡¢£¤¥¦§¨©ª«¬\u{AD}®¯°±²³´µ¶·¸¹º»¼½¾¿\
    ÀÁÂÃÄÅÆÇÈÉÊËÌÍÎÏÐÑÒÓÔÕÖ×ØÙÚÛÜÝÞßàáâãäåæçèéêëìíîïðñòóôõö÷øùúûüýþÿ";
const WINDOWS_1251: &str = "ЂЃ‚ѓ„…†‡€‰Љ‹ЊЌЋЏђ‘’“”•–—\u{98}™љ›њќћџ\
    \u{A0}ЎўЈ¤Ґ¦§Ё©Є«¬\u{AD}®Ї°±Ііґµ¶·ё№є»јЅѕї\
    АБВГДЕЖЗИЙКЛМНОПРСТУФХЦЧШЩЪЫЬЭЮЯабвгдежзийклмнопрстуфхцчшщъыьэюя";
const CP850: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜø£Ø×ƒáíóúñÑªº¿®¬½¼¡«»░▒▓│┤ÁÂÀ©╣║╗╝¢¥┐\
    └┴┬├─┼ãÃ╚╔╩╦╠═╬¤ðÐÊËÈıÍÎÏ┘┌█▄¦Ì▀ÓßÔÒõÕµþÞÚÛÙýÝ¯´\u{AD}±‗¾¶§÷¸°¨·¹³²■\u{A0}";
const CP437: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜ¢£¥₧ƒáíóúñÑªº¿⌐¬½¼¡«»░▒▓│┤╡╢╖╕╣║╗╝╜╛┐\
    └┴┬├─┼╞╟╚╔╩╦╠═╬╧╨╤╥╙╘╒╓╫╪┘┌█▄▌▐▀αßΓπΣσµτΦΘΩδ∞φε∩≡±≥≤⌠⌡÷≈°∙·√ⁿ²■\u{A0}";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_page_gives_each_byte_a_character_of_its_own() {
        for page in WESTERN.into_iter().chain([Encoding::Windows1251]) {
            let all: Vec<u8> = (0..=255).collect();
            let text: String = page.characters(&all).into_iter().collect();
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
            (b"a\0\xE4\0b\0", "aäb", Encoding::Utf16LeUnmarked),
            (b"\0a\0\xE4\0b", "aäb", Encoding::Utf16BeUnmarked),
            (b"\xD1\xEA\xEE\xF0\xEE\xF1\xF2\xFC", "Скорость", Encoding::Windows1251),
        ] {
            let decoded = decode(bytes.to_vec());
            assert_eq!(decoded, Ok((text.to_owned(), encoding)));
            assert_eq!(encode(text, encoding).as_deref(), Ok(bytes));
        }
    }

    #[test]
    fn what_is_marked_but_broken_is_read_byte_by_byte() {
        for bytes in [&b"\xFF\xFEa"[..], b"\xFF\xFE\0\xD8", b"\xFF\xFE", b"\xEF\xBB", b"\x80"] {
            let (text, encoding) = decode(bytes.to_vec()).unwrap();
            assert_eq!(encode(&text, encoding).as_deref(), Ok(bytes), "{bytes:?}");
        }
        assert_eq!(encode("Ω", Encoding::Windows1252), Err('Ω'));
    }
}
