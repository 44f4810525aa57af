//! The text form: sections, keys, comments above a section.

use std::fmt::{Display, Write as _};

use od_spec::ascii::transliterate;

/// Longest line without its line break (CiA 306 4.2).
const LONGEST_LINE: usize = 255;
/// Width at which comments are broken.
const COMMENT_WIDTH: usize = 110;

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
        let mut line = String::from(";");
        for word in text.split_whitespace() {
            if line.len() > 1 && line.len() + 1 + word.len() > COMMENT_WIDTH {
                self.text.push_str(&line);
                self.text.push_str("\r\n");
                line = String::from(";  ");
            }
            line.push(' ');
            line.extend(word.chars().take(LONGEST_LINE - COMMENT_WIDTH));
        }
        if line.trim_matches([';', ' ']).is_empty() {
            return;
        }
        self.text.push_str(&line);
        self.text.push_str("\r\n");
    }

    /// A key and its value. Text is transliterated and cut to the line length.
    pub(super) fn key(&mut self, key: &str, value: impl Display) {
        let mut value = transliterate(&value.to_string());
        value.truncate(LONGEST_LINE - 1 - key.len());
        let _ = write!(self.text, "{key}={}\r\n", value.trim());
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
