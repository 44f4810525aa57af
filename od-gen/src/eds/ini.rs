//! The text form: sections, keys, comments above a section.

use std::fmt::{Display, Write as _};

use od_spec::ascii::transliterate;

/// Longest line without its line break (CiA 306 4.2).
const LONGEST_LINE: usize = 255;
/// Width at which comments are broken.
const COMMENT_WIDTH: usize = 110;
/// Longest word of a comment; what is longer is cut.
const LONGEST_WORD: usize = LONGEST_LINE - COMMENT_WIDTH;

/// An EDS or DCF that is being written.
pub(super) struct Ini {
    text: String,
}

impl Ini {
    pub(super) const fn new() -> Self {
        Self { text: String::new() }
    }

    /// Starts a section, with comments directly above its header: the one place where every reader takes them.
    pub(super) fn section(&mut self, name: impl Display, comments: &[String]) {
        if !self.text.is_empty() {
            self.text.push_str("\r\n");
        }
        for comment in comments {
            self.comment(comment);
        }
        let _ = write!(self.text, "[{name}]\r\n");
    }

    fn comment(&mut self, text: &str) {
        let text = transliterate(text);
        let mut words = text.split_whitespace().map(|word| &word[..word.len().min(LONGEST_WORD)]).peekable();
        if words.peek().is_none() {
            return;
        }
        self.text.push(';');
        let mut length = 1;
        for word in words {
            if length > 1 && length + 1 + word.len() > COMMENT_WIDTH {
                self.text.push_str("\r\n;  ");
                length = 3;
            }
            self.text.push(' ');
            self.text.push_str(word);
            length += 1 + word.len();
        }
        self.text.push_str("\r\n");
    }

    /// A key and its value. Text is transliterated and cut to the line length.
    pub(super) fn key(&mut self, key: &str, value: impl Display) {
        self.text.push_str(key);
        self.text.push('=');
        let start = self.text.len();
        let _ = write!(self.text, "{value}");
        let written = &self.text[start..];
        let longest = LONGEST_LINE - 1 - key.len();
        let is_plain = written.bytes().all(|byte| matches!(byte, b' '..=b'~'));
        if !is_plain || written.len() > longest || written.trim() != written {
            let mut value = transliterate(written);
            value.truncate(longest);
            self.text.truncate(start);
            self.text.push_str(value.trim());
        }
        self.text.push_str("\r\n");
    }

    /// A key whose value is 1 or 0.
    pub(super) fn flag(&mut self, key: &str, value: bool) {
        self.key(key, u8::from(value));
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.text.into_bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::Ini;

    #[test]
    fn comments_stand_above_headers_and_lines_stay_short() {
        let mut ini = Ini::new();
        ini.section("A", &[]);
        ini.key("Name", "Größe");
        ini.section("B", &["word ".repeat(60), "x".repeat(400)]);
        ini.key("Long", "y".repeat(400));
        let text = String::from_utf8(ini.into_bytes()).unwrap();
        assert!(text.starts_with("[A]\r\nName=Groesse\r\n\r\n; word word"));
        assert!(text.is_ascii());
        assert!(text.split("\r\n").all(|line| line.len() <= 255 && !line.contains('\n')));
        assert!(text.ends_with("y\r\n"));
    }
}
