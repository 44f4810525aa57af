//! How well a code page fits: whether its characters make words and units.

/// How much speaks for the code page that gives these characters, against zero for a text in which none makes a word or a unit.
pub(super) fn fit(text: &[char]) -> i32 {
    let at = |position: Option<usize>| position.and_then(|position| text.get(position)).copied();
    let points = text.iter().enumerate().filter(|(_, c)| !c.is_ascii()).map(|(position, c)| {
        let around = Around {
            second_before: at(position.checked_sub(2)),
            before: at(position.checked_sub(1)),
            after: at(position.checked_add(1)),
            second_after: at(position.checked_add(2)),
        };
        around.points(*c)
    });
    points.sum()
}

/// The characters around one.
struct Around {
    second_before: Option<char>,
    before: Option<char>,
    after: Option<char>,
    second_after: Option<char>,
}

/// Letters of Western languages that are frequent.
const FREQUENT: &str = "äöüßéèàçñåøæáíóúýÄÖÜÉÀÇÑÅØÆÁÍÓÚ";
/// Other letters of the same languages.
const LESS_FREQUENT: &str = "âêîôûëïìòùãõšžœÂÊÎÔÛËÏÈÙŠŽŒ";
/// Units of a letter that has a `µ` before it.
const MICRO: &str = "mslgAVWFHNCTΩ";
/// Prefixes of a metre that is squared.
const PREFIXES: &str = "cmkdµ";
/// What a unit speaks for a code page: more than a letter at the edge of a word.
const UNIT: i32 = 5;
const VOWELS: &str = "aeiouyäöüáéíóúýåøæàèìòùâêîôûëï";

impl Around {
    fn points(&self, c: char) -> i32 {
        let is_letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
        let is_between_letters = is_letter(self.before) && is_letter(self.after);
        let has_blank_or_digit_before =
            self.before.is_none_or(|c| c.is_ascii_digit() || c.is_whitespace() || "([{=/;,".contains(c));
        match c {
            // A unit: 25 °C, m², µm, ±5, 10 kΩ.
            '°' if has_blank_or_digit_before && !self.after.is_some_and(char::is_lowercase) => UNIT,
            '²' | '³' if !is_letter(self.after) && self.is_behind_unit() => UNIT,
            'µ' if !is_letter(self.before) && !is_letter(self.second_after) => {
                if self.after.is_some_and(|c| MICRO.contains(c)) { UNIT } else { 0 }
            }
            'Ω' if !is_letter(self.after) => UNIT,
            '±' | '×' | '÷' | '‰' | '€' | '≤' | '≥' | '≈' | '½' | '¼' | '¾' | '√' | '∞'
                if !is_between_letters && !self.after.is_some_and(char::is_lowercase) =>
            {
                2
            }
            'º' | 'ª' if self.before.is_some_and(|c| c.is_ascii_digit()) => 2,
            '·' if is_between_letters || self.after.is_some_and(char::is_whitespace) => 2,
            // Signs of typesetting: “word”, l’axe, from – to.
            '“' | '‘' | '„' | '‚' | '«' | '‹' if !is_letter(self.before) && is_letter(self.after) => {
                2
            }
            '”' | '»' | '›' if is_letter(self.before) && !is_letter(self.after) => 2,
            '’' if is_letter(self.before) => 2,
            '–' | '—' if !is_letter(self.before) && !is_letter(self.after) => 2,
            '…' | '•' if !is_letter(self.after) => 2,
            '©' | '®' | '™' | '§' | '¶' | '\u{A0}' if !is_between_letters => 1,
            c if c.is_alphabetic() => self.points_of_letter(c),
            // A frame of boxes, or a control character, is not part of a text.
            '\u{80}'..='\u{9F}' | '\u{2500}'..='\u{259F}' => -3,
            _ => -2,
        }
    }

    /// A letter makes a word with its neighbours, and its size is like theirs.
    fn points_of_letter(&self, c: char) -> i32 {
        let is_letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
        let neighbours = i32::from(is_letter(self.before)) + i32::from(is_letter(self.after));
        let has_small_before = self.before.is_some_and(char::is_lowercase);
        let is_odd = match c {
            // A long vowel comes before it: `ei`, `ie`, or `a`, `o`, `u` and their umlauts.
            'ß' => !self.has_long_vowel_before(),
            // At the end of Italian words.
            'ì' => is_letter(self.after) || !self.before.is_some_and(|c| "dslr".contains(c)),
            'Ž' | 'Š' => self.after.is_some_and(|c| !VOWELS.contains(c)),
            'Ä' | 'Ü' => self.after.is_some_and(|c| c.is_alphabetic() && c != 'u' && VOWELS.contains(c)),
            _ => false,
        };
        let weight = match c {
            c if FREQUENT.contains(c) => 2,
            c if LESS_FREQUENT.contains(c) => 1,
            // Letters of other scripts are not in the middle of such words.
            _ => return if neighbours > 0 { -2 } else { 0 },
        };
        match neighbours {
            0 => 0,
            // fÜr
            _ if c.is_uppercase() && has_small_before => -2,
            _ if is_odd => 0,
            _ if c == 'ß' => weight + neighbours + 1,
            _ => weight + neighbours,
        }
    }

    /// `m`, `mm`, `s` and the like.
    fn is_behind_unit(&self) -> bool {
        let begins = self.second_before.is_none_or(|c| !c.is_alphabetic() || PREFIXES.contains(c));
        begins && self.before.is_some_and(|c| c == 'm' || c == 's')
    }

    fn has_long_vowel_before(&self) -> bool {
        match self.before {
            Some('i') => self.second_before == Some('e'),
            Some('e') => self.second_before == Some('i'),
            before => before.is_some_and(|c| "aouäöü".contains(c)),
        }
    }
}
