//! Invisible characters: control characters, which command a terminal, and those that change the direction of writing,
//! which let a text look like another. Where a text from outside is shown, escapes replace them.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Whether a character makes the text around it run from right to left, or back: what is read is not what is written.
pub(crate) const fn turns_text(c: char) -> bool {
    matches!(c, '\u{61C}' | '\u{200E}' | '\u{200F}' | '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

/// The characters of a text that turn what is around them, each with its place. In UTF-8, they begin with one of two bytes.
pub(crate) fn turning(text: &str) -> impl Iterator<Item = (usize, char)> {
    let at = memchr::memchr2_iter(0xD8, 0xE2, text.as_bytes());
    at.filter_map(|at| Some((at, text[at..].chars().next().filter(|c| turns_text(*c))?)))
}

/// Whether a character is obeyed, and not shown: by a terminal, by who reads lines, or by who lays out text; or has no width.
pub fn is_hidden(c: char) -> bool {
    c.is_control()
        || turns_text(c)
        || matches!(c, '\u{200B}' | '\u{2028}' | '\u{2029}' | '\u{2060}' | '\u{FEFF}')
}

/// A text on one line in which everything is seen: `\n`, `\u{1b}`.
pub fn visible(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden)
}

/// [`visible`], with line breaks, tabs and – where a terminal is to colour it – styles left as they are. What comes from outside was
/// made visible before styles were added.
pub fn printable(text: &str, styled: bool) -> Cow<'_, str> {
    let is_plain = |c: char| matches!(c, '\n' | '\t') || !is_hidden(c);
    if text.chars().all(is_plain) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let length = match c {
            '\r' if rest.starts_with("\r\n") => 2,
            '\u{1b}' if styled => style(rest),
            c if is_plain(c) => c.len_utf8(),
            _ => 0,
        };
        if length == 0 {
            out.extend(c.escape_default());
            rest = &rest[c.len_utf8()..];
        } else {
            out.push_str(&rest[..length]);
            rest = &rest[length..];
        }
    }
    Cow::Owned(out)
}

/// JSON in which everything is seen: JSON itself escapes fewer characters than a terminal obeys.
pub fn visible_json(text: &str) -> Cow<'_, str> {
    let is_hidden = |c: char| is_hidden(c) && !matches!(c, '\n' | '\t' | '\r');
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_hidden(c) {
            let _ = write!(out, "\\u{:04x}", u32::from(c));
        } else {
            out.push(c);
        }
    }
    Cow::Owned(out)
}

/// A foreign text with signs of the same length for what turns text, so that no output has to mind it: foreign files are read
/// whatever is in them. Places stay, and so does the file.
pub fn straight(text: &str) -> Cow<'_, str> {
    if turning(text).next().is_none() {
        return Cow::Borrowed(text);
    }
    Cow::Owned(text.chars().map(|c| if turns_text(c) { stand_in(c) } else { c }).collect())
}

/// A sign that takes the same bytes, so that places stay.
pub(crate) const fn stand_in(c: char) -> char {
    if c.len_utf8() == 3 { '\u{FFFD}' } else { '·' }
}

fn escaped(text: &str, hidden: impl Fn(char) -> bool + Copy) -> Cow<'_, str> {
    if !text.contains(hidden) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if hidden(c) { out.extend(c.escape_default()) } else { out.push(c) }
    }
    Cow::Owned(out)
}

/// The length of a style at the beginning of a text, `ESC [ 1 ; 31 m`; 0 if there is none.
fn style(text: &str) -> usize {
    let Some(rest) = text.strip_prefix("\u{1b}[") else { return 0 };
    let numbers = rest.bytes().take_while(|byte| byte.is_ascii_digit() || *byte == b';').count();
    if rest[numbers..].starts_with('m') { 2 + numbers + 1 } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_invisible_is_shown_as_its_escape() {
        assert_eq!(visible("Größe"), "Größe");
        assert_eq!(
            visible("a\u{1b}]0;x\u{7}\u{9b}\u{202e}\u{7f}\n"),
            "a\\u{1b}]0;x\\u{7}\\u{9b}\\u{202e}\\u{7f}\\n"
        );
        assert_eq!(
            printable("a\r\nb\rc\u{1b}[31mred\u{1b}[0m\u{1b}[2J", true),
            "a\r\nb\\rc\u{1b}[31mred\u{1b}[0m\\u{1b}[2J"
        );
        assert_eq!(printable("a\u{1b}[31m\tb\n", false), "a\\u{1b}[31m\tb\n");
        assert_eq!(
            visible_json("{\"a\": \"\u{9b}\u{7f}\u{202e}\"}\n"),
            "{\"a\": \"\\u009b\\u007f\\u202e\"}\n"
        );
        assert_eq!(straight("a\u{202e}b\u{61c}"), "a\u{fffd}b·");
    }

    #[test]
    fn what_turns_text_is_found_wherever_it_is() {
        let all: String = (char::MIN..=char::MAX).collect();
        let expected = all.char_indices().filter(|(_, c)| turns_text(*c));
        assert!(turning(&all).eq(expected) && turning(&all).count() == 12);
    }
}
