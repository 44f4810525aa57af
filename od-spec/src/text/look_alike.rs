//! Characters that cannot be told from others by eye: letters of other scripts inside a Latin word, and those without any width.

/// A character in a text that is not what it looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Disguise {
    /// A Cyrillic or Greek letter that looks like this Latin one.
    Latin(char),
    /// It has no width.
    Invisible,
}

/// A word in which a person would read something else.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Disguised<'t> {
    /// Where it begins.
    pub start: usize,
    /// The word.
    pub word: &'t str,
    /// The first of its characters that are not what they look like.
    pub character: char,
    /// What that one looks like.
    pub disguise: Disguise,
}

impl Disguised<'_> {
    /// The word as it is read.
    pub(crate) fn plain(&self) -> String {
        let read = |c| match disguise(c) {
            Some(Disguise::Latin(letter)) => Some(letter),
            Some(Disguise::Invisible) => None,
            None => Some(c),
        };
        self.word.chars().filter_map(read).collect()
    }
}

/// The words of a text that hold Latin letters and, of everything else, only look-alikes. A word in one script, a unit such as
/// `μm`, or a Russian word behind a Latin abbreviation is none of these.
pub(crate) fn disguised(text: &str) -> Vec<Disguised<'_>> {
    let is_of_word = |c: char| c.is_alphanumeric() || is_invisible(c);
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(next) = text.as_bytes()[at..].iter().position(|byte| !byte.is_ascii()) {
        let here = at + next;
        let start = at + text[at..here].trim_end_matches(is_of_word).len();
        let length = text[here..].trim_start_matches(is_of_word).len();
        let end = text.len() - length;
        at = end.max(here + text[here..].chars().next().map_or(0, char::len_utf8));
        let word = &text[start..end];
        let mut others = word.chars().filter(|c| !c.is_ascii());
        let first = others.next().and_then(|c| Some((c, disguise(c)?)));
        if let Some((character, disguised)) = first
            && others.all(|c| disguise(c).is_some())
            && word.contains(|c: char| c.is_ascii_alphabetic())
        {
            found.push(Disguised { start, word, character, disguise: disguised });
        }
    }
    found
}

/// What a character looks like, if that is not what it is.
fn disguise(c: char) -> Option<Disguise> {
    if is_invisible(c) { Some(Disguise::Invisible) } else { latin(c).map(Disguise::Latin) }
}

/// Whether a character has no width. The mark at the very beginning of a file is not asked for.
const fn is_invisible(c: char) -> bool {
    matches!(c, '\u{200B}'..='\u{200D}' | '\u{2060}' | '\u{FEFF}')
}

/// The Latin letter that a Cyrillic or Greek one looks like.
const fn latin(c: char) -> Option<char> {
    Some(match c {
        'А' | 'Α' => 'A',
        'В' | 'Β' => 'B',
        'С' => 'C',
        'Е' | 'Ε' => 'E',
        'Н' | 'Η' => 'H',
        'І' | 'Ι' => 'I',
        'Ј' => 'J',
        'К' | 'Κ' => 'K',
        'М' | 'Μ' => 'M',
        'Ν' => 'N',
        'О' | 'Ο' => 'O',
        'Р' | 'Ρ' => 'P',
        'Ѕ' => 'S',
        'Т' | 'Τ' => 'T',
        'Χ' | 'Х' => 'X',
        'Υ' => 'Y',
        'Ζ' => 'Z',
        'а' => 'a',
        'с' => 'c',
        'е' => 'e',
        'і' => 'i',
        'ј' => 'j',
        'о' | 'ο' => 'o',
        'р' => 'p',
        'ѕ' => 's',
        'ν' => 'v',
        'х' => 'x',
        'у' => 'y',
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<&str> {
        disguised(text).into_iter().map(|found| found.word).collect()
    }

    #[test]
    fn words_of_two_scripts_are_found() {
        assert_eq!(
            words("name: m\u{430}x, spe\u{200B}ed; \u{421}AN"),
            ["m\u{430}x", "spe\u{200B}ed", "\u{421}AN"]
        );
        let plain =
            disguised("\u{421}AN spe\u{200B}\u{435}d").iter().map(Disguised::plain).collect::<Vec<_>>();
        assert_eq!(plain, ["CAN", "speed"]);
    }

    #[test]
    fn words_of_one_script_are_none() {
        assert_eq!(
            words("größe, скорость, СОВ-ID, CANшина, 10 μm, kΩ, A\u{301}, №1, \u{200B}, Δt, °C, 速度"),
            [""; 0]
        );
    }
}
